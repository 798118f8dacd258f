#!/usr/bin/env python3
"""One version everywhere: that of CMakeLists.txt, which is the latest of CHANGELOG.md, with its date and its set.

    tests/project/version_rule.py SOURCE_DIR

Prints one line a breach and returns 1, or prints nothing.
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
PLACES = (  # file, and what stands around a version in it
    ("CITATION.cff", r"^version: (\S+)$"),
    ("tools/python/lore/__init__.py", r'^__version__ = "(.*)"$'),
    ("tools/package/conda/meta.yaml", r'^ *version: "(.*)"$'),
    ("tools/package/spack/packages/lore/package.py", r'^ *version\("(.*)"\)$'),
    ("tools/package/spack/packages/lore/package.py", r"lore@(\d[\d.]*\d)"),
    ("tests/long/packages/run", r"lore@(\d[\d.]*\d)"),
)

version = re.search(r"^project\(Lore VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text(), re.M)[1]
breaches = []
for name, pattern in PLACES:
    found = set(re.findall(pattern, (root / name).read_text(), re.M))
    if found != {version}:
        breaches.append(f"{name}: version {', '.join(sorted(found)) or 'missing'}, and CMakeLists.txt has {version}")

headings = re.findall(r"^## \[(.+?)\](.*)$", (root / "CHANGELOG.md").read_text(), re.M)
releases = [heading for heading in headings if heading[0] != "Unreleased"]
dated = [name for name, rest in releases if re.fullmatch(r" - \d{4}-\d\d-\d\d", rest)]
if not releases or releases[0][0] != version:
    breaches.append(f"CHANGELOG.md: the latest release is {releases[0][0] if releases else 'missing'}, and CMakeLists.txt has {version}")
breaches += [f"CHANGELOG.md: release {name} has no date" for name, _ in releases if name not in dated]
cited = re.search(r"^date-released: (\S+)$", (root / "CITATION.cff").read_text(), re.M)
if releases and (not cited or f" - {cited[1]}" != releases[0][1]):
    breaches.append(f"CITATION.cff: date-released is not that of CHANGELOG.md,{releases[0][1].strip(' -')}")
if not (root / "tests/data" / f"release-{version}").is_dir():
    breaches.append(f"tests/data/release-{version} is missing (docs/manual/versions.md says how it is made)")

print("\n".join(breaches), end="\n" if breaches else "")
sys.exit(1 if breaches else 0)
