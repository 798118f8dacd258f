#!/usr/bin/env python3
"""Every relative link and anchor of a page leads somewhere, and what a page or a comment names is there.

    tests/project/link_rule.py SOURCE_DIR

* *.md: relative links and their anchors; paths in backticks or in commands that start with docs/, jobs/, tests/, tools/,
  src/ or include/ (README.md and docs/ alone: the changelog tells of what was); tests as `Suite.name`, `Suite.na...`.
* every other file, and the text of pages: pages named as docs/....md.

Prints one line a breach and returns 1, or prints nothing.
"""
import functools
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1]).resolve()
LEFT_OUT = {"build", "runs", ".git", ".cache"}


def files(*patterns):
    return sorted(file for pattern in patterns for file in root.glob(pattern)
                  if file.is_file() and not LEFT_OUT & set(file.relative_to(root).parts[:1]))


@functools.cache
def anchors(page):
    """As GitHub makes them of headings: lower case, without punctuation, hyphens for spaces, -1 for the second of a name."""
    found, seen = set(), {}
    for heading in re.findall(r"^#+ +(.*?) *$", re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S), re.M):
        name = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()).replace(" ", "-")
        found.add(f"{name}-{seen[name]}" if name in seen else name)
        seen[name] = seen.get(name, 0) + 1
    return found


@functools.cache
def tests():
    """Suite.name of every test."""
    pattern = re.compile(r"^TEST(?:_[FP])?\((\w+),\s*(\w+)\)", re.M)
    return {".".join(names) for file in files("tests/**/*.cpp") for names in pattern.findall(file.read_text())}


def breach_of_link(page, target):
    path, _, anchor = target.partition("#")
    goal = (page.parent / path).resolve() if path else page
    if not goal.exists():
        return f"links to {target}, which is not there"
    if anchor and (goal.suffix != ".md" or anchor not in anchors(goal)):
        return f"links to {target}, whose heading is not there"
    return None


def breach_of_code(code):
    """What stands in backticks or on a line of commands."""
    for path in re.findall(r"(?:^|[\s\"'(=])((?:docs|jobs|tests|tools|src|include)/[\w./*-]*)", code):
        path = path.rstrip(".")
        if not (any(root.glob(path)) if "*" in path else (root / path).exists()):
            return f"names {path}, which is not there"
    name = re.fullmatch(r"([A-Z]\w+\.)([a-z_0-9]*)(\*|\.\.\.|)", code)
    if name and name[3] and not any(test.startswith(name[1] + name[2]) for test in tests()):
        return f"names the test {code}, which is not there"
    if name and not name[3] and name[1] in {test.split(".")[0] + "." for test in tests()} and code not in tests():
        return f"names the test {code}, which is not there"
    return None


breaches = []
for page in files("*.md", "docs/**/*.md"):
    fenced = False
    for number, line in enumerate(page.read_text().splitlines(), 1):
        place = f"{page.relative_to(root)}:{number}"
        if line.startswith("```"):
            fenced = not fenced
            continue
        command = fenced or line.startswith("    ")
        if not command:
            links = re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line))
            breaches += [f"{place}: {found}" for target in links if not re.match(r"[a-z]+:", target)
                         and (found := breach_of_link(page, target))]
        if page.name != "CHANGELOG.md":
            codes = [line] if command else re.findall(r"`([^`]+)`", line)
            breaches += [f"{place}: {found}" for code in codes if (found := breach_of_code(code))]

for file in files("README.md", "docs/**/*.md", "CMakeLists.txt", "include/**/*", "src/**/*", "tests/**/*", "tools/**/*", "jobs/**/*", "docs/examples/**/*"):
    if file.relative_to(root).parts[:2] == ("tests", "data") or file == pathlib.Path(__file__).resolve():
        continue
    for number, line in enumerate(file.read_bytes().decode(errors="replace").splitlines(), 1):
        breaches += [f"{file.relative_to(root)}:{number}: names {path}, which is not there"
                     for path in re.findall(r"\bdocs/[\w./-]+\.md\b", line) if not (root / path).exists()]

print("\n".join(breaches), end="\n" if breaches else "")
sys.exit(1 if breaches else 0)
