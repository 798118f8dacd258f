#!/usr/bin/env python3
"""Uses report.html as a reader would, through ChromeDriver: tests/long/browser/use_report.py REPORT SCRATCH_DIRECTORY

Loads it without network, looks for console errors, sorts a table, drags the replay's slider, prints it.
Leaves report.png and report.pdf in the scratch directory.
"""
import base64
import pathlib
import sys
import time

from browser import browser

report, scratch = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()


def check(holds, what):
    print(("ok     " if holds else "FAILED ") + what)
    global failures
    failures += not holds


failures = 0
with browser() as page:
    page.call("POST", "/url", {"url": report.as_uri()})

    errors = page.errors()
    check(not errors, f"the page loads without a word on the console {errors}")
    loaded = page.script("return performance.getEntriesByType('resource').map(entry => entry.name)")
    check(not [name for name in loaded if not name.startswith("data:")], f"nothing is loaded besides {loaded}")
    check(page.script("return new Set([...document.querySelectorAll('[id]')].map(e => e.id)).size === document.querySelectorAll('[id]').length"),
          "ids are unique")
    check(page.script("return document.querySelectorAll('figure svg').length") >= 4, "four figures are there")

    widths = page.script("const frame = document.getElementById('speeds').parentNode; return [frame.scrollWidth, frame.clientWidth]")
    check(widths[0] <= widths[1], f"the widest table fits the page {widths}")

    # Sorting: by balls, then the other way round.
    balls = "return [...document.querySelectorAll('#runs tbody tr')].map(row => Number(row.cells[3].textContent))"
    before = page.script(balls)
    page.click("#runs th:nth-child(4) button")
    check(page.script(balls) == sorted(before) != before, "a click on 'balls' sorts the runs")
    page.click("#runs th:nth-child(4) button")
    check(page.script(balls) == sorted(before, reverse=True), "a second click sorts them the other way round")
    check(page.script("return document.querySelector('#runs th:nth-child(4)').ariaSort") == "descending", "and says so to screen readers")
    page.click("#pairs th:nth-child(6) button")
    values = page.script("return [...document.querySelectorAll('#pairs tbody tr')].map(row => Number(row.cells[5].dataset.value))")
    check(values == sorted(values) and len(values) == 3, "p-values sort as numbers, not as text")

    # Replay: the slider moves the robot, by keyboard as by hand.
    place = "return document.getElementById('replay-robot').getAttribute('transform')"
    start = page.script(place)
    page.type("#replay-slider", "\ue014" * 30)   # arrow right
    check(page.script("return Number(document.getElementById('replay-slider').value)") == 30, "30 keys move the slider 30 steps")
    check(page.script(place) != start, f"the robot has moved from {start} to {page.script(place)}")
    check("step 30 of" in page.script("return document.getElementById('replay-state').textContent"), "the step is told")
    page.type("#replay-slider", "\ue010")        # end
    check("1 ball collected" in page.script("return document.getElementById('replay-state').textContent"), "at the end one ball is collected")
    page.type("#replay-slider", "\ue011")        # home
    check(page.script(place) == start, "back at the start the robot is where it was")
    page.click("#replay-play")
    time.sleep(1)
    check(page.script("return Number(document.getElementById('replay-slider').value)") > 0, "play moves it too")
    page.script("const chooser = document.getElementById('replay-chooser'); chooser.selectedIndex = 1; chooser.dispatchEvent(new Event('change'))")
    check(page.script("return document.querySelectorAll('#replay-stage [fill=\"#cc79a7\"]').length") == 0, "the target task has no door")

    errors = page.errors()
    check(not errors, f"nothing went wrong meanwhile {errors}")
    page.type("#replay-slider", "\ue014" * 10)
    page.photograph(scratch / "report.png")
    pdf = base64.b64decode(page.call("POST", "/print", {}))
    (scratch / "report.pdf").write_bytes(pdf)
    check(pdf.startswith(b"%PDF"), "it prints")
sys.exit(1 if failures else 0)
