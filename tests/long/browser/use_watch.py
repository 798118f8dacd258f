#!/usr/bin/env python3
"""Watches a small campaign at work in the browser: tests/long/browser/use_watch.py LORE_CAMPAIGN SCRATCH_DIRECTORY

Opens the page before the campaign begins, follows it to its end with names and logs that would like to be HTML, plays the
best robot, looks at it in the dark and on a phone. Leaves watch.png, watch-dark.png and watch-phone.png.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import time

from browser import browser

program, scratch = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
place = scratch / "watch"
HOSTILE = '<img src=x onerror="document.title=`taken`">'
CAMPAIGN = f"""
title = '{HOSTILE}'
generations = 60
[source]
config = "source.toml"
runs = 2
[[treatment]]
name = "none"
label = '{HOSTILE}'
runs = 3
config = "target.toml"
[[treatment]]
name = "broken"
label = "cannot be made"
runs = 1
config = "target.toml"
"""
TASK = """
name = "{0}"
task = "{0}"
[episode]
steps = 400
[evolution]
population = 16
founders = 32
"""
failures = 0


def check(holds, what):
    print(("ok     " if holds else "FAILED ") + what, flush=True)
    global failures
    failures += not holds


def until(page, code, what):
    end = time.monotonic() + 120
    while not (held := page.script(f"return {code}")) and time.monotonic() < end:
        time.sleep(0.3)
    check(held, what)


def text(page, selector):
    return page.script("return document.querySelector(arguments[0]).innerText", selector)


def shown(identifier):
    return f"!document.getElementById('{identifier}').hidden"


def emulate(page, command, **parameters):
    page.call("POST", "/goog/cdp/execute", {"cmd": f"Emulation.{command}", "params": parameters})


def watch_it_begin(page, address):
    page.call("POST", "/url", {"url": address})
    until(page, shown("notice"), "before the campaign begins the page says so")
    check("Waiting for" in text(page, "#notice"), text(page, "#notice"))
    check(page.script("return document.querySelectorAll('#steps details').length") == 3, "the steps to come are listed")


def watch_it_work(page):
    until(page, shown("curves"), "curves appear while runs are at work")
    check("of 6 steps done" in text(page, "#summary"), text(page, "#summary"))


def watch_the_end(page):
    until(page, "/^5 of 6 steps done/.test(document.getElementById('summary').textContent)", "5 of 6 steps are done in the end")
    until(page, shown("failures"), "the failure is shown")
    told = text(page, "#failures")
    check("broken/001" in told and HOSTILE in told and "</script>" in told, "with the end of its log, as text")
    check(page.script("return document.querySelectorAll('main img, main script').length") == 0, "no name has become HTML")
    check(page.script("return document.title").endswith(HOSTILE), "or has run")
    rows = page.script("return [...document.querySelectorAll('#treatments tbody tr')].map(row => row.cells[1].textContent)")
    check(rows == ["2 of 2", "3 of 3", "0 of 1"], f"the treatments' runs are counted: {rows}")
    check(page.script("return document.querySelectorAll('#chart polyline.whole').length") == 1, "a curve of the one target treatment that has begun")
    check(page.script("return [...document.querySelectorAll('#chart text')].map(text => text.textContent)").count("generation") == 1, "its axes are named")
    check("best-of-run [balls]" in page.script("return document.getElementById('chart').textContent"), "with their units")
    check(page.script("return getComputedStyle(document.querySelectorAll('#treatments line')[1]).stroke") == "rgb(0, 0, 0)",
          "the first target treatment has the report's first color")
    check(page.script("return [...document.querySelectorAll('#chart text.name')].every(name => Number(name.getAttribute('x')) + "
                      "name.getComputedTextLength() <= name.ownerSVGElement.viewBox.baseVal.width)"), "names at curves fit")
    page.click("#with-source")
    until(page, "document.querySelectorAll('#chart polyline.whole').length === 2", "the source task can be shown too")
    page.click("#steps details:nth-child(2) summary")
    page.script("window.marked = document.querySelector('#steps details:nth-child(2)')")
    time.sleep(4)
    check(page.script("return window.marked.isConnected && window.marked.open"), "what was opened stays open")


def play_the_robot(page):
    until(page, "document.getElementById('replay-robot') !== null", "the best robot is there")
    check(page.script("return document.querySelectorAll('#replay-chooser option').length") == 2, "that of each task")
    spot = "return document.getElementById('replay-robot').getAttribute('transform')"
    page.type("#replay-slider", "\ue011")   # home
    start = page.script(spot)
    page.type("#replay-slider", "\ue014" * 30)   # arrow right
    check(page.script(spot) != start, f"it moves from {start} to {page.script(spot)}")
    check("step 30 of 399" in text(page, "#replay-state"), "the step is told")
    page.click("#replay-play")
    time.sleep(1)
    check(page.script("return Number(document.getElementById('replay-slider').value)") > 0, "play moves it too")


def look_at_it(page):
    names = page.script("return [...document.querySelectorAll('button, input, select, progress, svg[role=img]')].filter("
                        "e => !(e.getAttribute('aria-label') || e.textContent.trim() || e.labels?.length)).map(e => e.outerHTML)")
    check(names == [], f"all that can be used or seen has a name {names}")
    check(page.script("return new Set([...document.querySelectorAll('[id]')].map(e => e.id)).size === document.querySelectorAll('[id]').length"),
          "ids are unique")
    page.photograph(scratch / "watch.png")
    emulate(page, "setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    background = page.script("return getComputedStyle(document.body).backgroundColor")
    check(max(int(number) for number in re.findall(r"\d+", background)) < 64, f"dark where people want it dark: {background}")
    page.photograph(scratch / "watch-dark.png")
    emulate(page, "setDeviceMetricsOverride", width=360, height=740, deviceScaleFactor=2, mobile=True)
    time.sleep(1)
    wide = page.script("return [document.documentElement.scrollWidth, window.innerWidth]")
    check(wide[0] <= 360, f"a phone need not scroll sideways: {wide}")
    long = page.script("return document.documentElement.scrollHeight")
    emulate(page, "setDeviceMetricsOverride", width=360, height=long, deviceScaleFactor=2, mobile=True)
    page.photograph(scratch / "watch-phone.png", 360)


def break_a_step():
    """As a run that has failed twice leaves it, with a log that would like to be HTML."""
    (place / "c/steps").mkdir(parents=True)
    (place / "c/steps/broken-001.json").write_text(json.dumps(
        {"attempts": 2, "how": "exit code 1", "log_tail": ["</script><script>document.title = 'taken'</script>", HOSTILE]}))


shutil.rmtree(place, ignore_errors=True)
place.mkdir(parents=True)
for task in ("source", "target"):
    (place / f"{task}.toml").write_text(TASK.format(task))
(place / "campaign.toml").write_text(CAMPAIGN)
campaign = ["campaign.toml", "--dir", "c"]
watch = subprocess.Popen([program, "watch", *campaign, "--port", "0"], cwd=place, stdout=subprocess.PIPE, text=True)
try:
    address = watch.stdout.readline().split()[0]
    with browser(arguments=("--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",)) as page:
        watch_it_begin(page, address)
        break_a_step()
        run = subprocess.Popen([program, "run", *campaign, "-q", "--jobs", "1", "--only", "source", "--only", "none"], cwd=place)
        watch_it_work(page)
        check(run.wait(300) == 0, "the campaign comes to its end")
        watch_the_end(page)
        play_the_robot(page)
        look_at_it(page)
        loaded = page.script("return performance.getEntriesByType('resource').map(entry => entry.name)")
        foreign = [name for name in loaded if not name.startswith((address, "data:"))]
        check(foreign == [], f"nothing was loaded from elsewhere {foreign}")
        errors = page.errors()
        check(not errors, f"not a word on the console {errors}")
        watch.terminate()
        check(watch.wait(60) == 0, "TERM ends the program with 0")
        until(page, "/No answer since/.test(document.getElementById('updated').textContent)", "and the page says that it has no answer")
finally:
    watch.kill()
    watch.wait()
sys.exit(1 if failures else 0)
