#!/usr/bin/env python3
"""Every link and anchor of the documentation's site leads somewhere, and nothing of it is asked of the network.

    tests/project/site_rule.py SOURCE_DIR PROGRAMS SITE     makes the site in the folder SITE, then checks it
    tests/project/site_rule.py SITE                         checks a site that is there

Prints one line a breach and returns 1, or says how many links it followed. Returns 77 where the tools that make the
site are not here.
"""
import functools
import html.parser
import pathlib
import re
import subprocess
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """Anchors, (tag, target) of all links, and the texts of links that MyST found no goal for, of one page."""

    def __init__(self, file):
        super().__init__()
        self.anchors, self.links, self.lost, self._is_lost = set(), [], [], False
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        self._is_lost = self._is_lost or ("class", "xref myst") in attributes
        for name, value in attributes:
            if name in ("id", "name"):
                self.anchors.add(value)
            elif name in ("href", "src"):
                self.links.append((tag, value))

    def handle_data(self, text):
        if self._is_lost:
            self.lost.append(text)
        self._is_lost = False


page_of = functools.cache(Page)


def breach(site, page, tag, target):
    """Why a link does not hold, or None."""
    url = urllib.parse.urlsplit(target)
    if url.scheme == "data":
        return None
    if url.scheme or url.netloc:
        return None if tag == "a" else f"loads {target} from the network"
    goal = (page.parent / urllib.parse.unquote(url.path)).resolve() if url.path else page
    if site not in goal.parents:
        return f"links to {target}, which is outside of the site"
    if not goal.is_file():
        return f"links to {target}, which is not there"
    if url.fragment and goal.suffix == ".html" and urllib.parse.unquote(url.fragment) not in page_of(goal).anchors:
        return f"links to {target}, whose heading is not there"
    return None


def check(site):
    """Breaches, and the number of links followed."""
    pages = sorted(site.rglob("*.html"))
    links = [(page, tag, target) for page in pages for tag, target in dict.fromkeys(page_of(page).links)]
    breaches = [f"{page.relative_to(site)}: {found}" for page, tag, target in links
                if (found := breach(site, page, tag, target))]
    breaches += [f"{page.relative_to(site)}: the link '{text}' leads nowhere" for page in pages
                 for text in page_of(page).lost]
    styles = [f"{file.relative_to(site)}: {found}" for file in sorted(site.rglob("*.css"))
              for address in re.findall(r"url\([\"']?([^)\"']+)", file.read_text())
              if (found := breach(site, file, "link", address))]
    expected = ["index.html", "search.html", "searchindex.js", "gallery.html", "reference/python.html",
                "reference/cpp/core.html", "reference/programs/lore-evolve.html"]
    missing = [f"{name} is not there" for name in expected if not (site / name).is_file()]
    return breaches + styles + missing, len(links)


def main():
    if len(sys.argv) == 4:
        source, programs, site = sys.argv[1:]
        command = pathlib.Path(source) / "tools" / "site"
        try:
            made = subprocess.run([command, "--programs", programs, site], stderr=subprocess.PIPE, text=True)
        except FileNotFoundError:
            print(f"skipped: {command} needs /usr/bin/python3, which is not here")
            return 77
        if made.returncode != 0:
            print(made.stderr.strip())
            return 77 if "jobs/install-deps site" in made.stderr else 1
    site = pathlib.Path(sys.argv[-1]).resolve()
    breaches, links = check(site)
    print("\n".join(breaches) if breaches else f"{links} links lead somewhere")
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main())
