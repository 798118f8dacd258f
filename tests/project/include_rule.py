#!/usr/bin/env python3
"""A module includes only modules of a lower level, and each foreign library enters by its own door.

    tests/project/include_rule.py SOURCE_DIR

src/CMakeLists.txt says the levels; the table in docs/design/architecture.md has the same.
Prints one line a breach and returns 1, or prints nothing.
"""
import pathlib
import re
import sys

# The report reads what a campaign has left; the campaign's step "replay" simulates. Neither a file of the report nor a
# header of its own or the campaign's that it includes may include these.
READERS = {"report": ["episode", "collectball", "maze"]}
FOLLOWED = ["report", "campaign"]

# Who may include a foreign header: modules, or single files. Programs (tools/) may include CLI11 and fmt.
DOORS = {
    r"mpi\.h": ["cluster"],
    r"boost/(archive|serialization)/.*": ["archive"],
    r"boost/math/.*": ["statistics"],
    r"flann/.*": ["knowledge/flann_index.cpp"],
    r"toml\+\+/.*": ["core/toml.cpp"],
    r"Random123/.*": ["core/random.cpp"],
    r"librsvg/.*|cairo.*": ["figure"],
    r"zstd.*": ["archive"],
    r"zlib\.h": ["collectball/trace_file.cpp"],
    r"xxhash\.h": ["archive", "core/checksum.cpp"],
    r"archive(_entry)?\.h": ["interchange/archive_file.cpp"],
    r"nettle/.*": ["interchange/sha256.cpp"],
    r"dlfcn\.h": ["world/library.cpp"],
    r"lore/world\.h": ["world"],
    r"CLI/.*": ["tools"],
    r"microhttpd\.h": ["tools/http_server.cpp"],
}

root = pathlib.Path(sys.argv[1])
breaches = []


def levels_of_build():
    """(level, module) in the order of src/CMakeLists.txt: a level is a line of its list of modules."""
    text = (root / "src/CMakeLists.txt").read_text()
    lines = re.search(r"foreach\(module\s(.*?)\)", text, re.DOTALL)[1].strip().splitlines()
    return [(level, module) for level, line in enumerate(lines) for module in line.split()]


def levels_of_page():
    """The same of the table in docs/design/architecture.md."""
    rows = re.findall(r"^\| (\d+) \| `(\w+)` \|", (root / "docs/design/architecture.md").read_text(), re.MULTILINE)
    return [(int(level), module) for level, module in rows]


LEVELS = levels_of_build()
LEVEL = {module: level for level, module in LEVELS}
if len(LEVEL) < 2 or levels_of_page() != LEVELS:
    breaches.append("docs/design/architecture.md: its table of levels is not that of src/CMakeLists.txt")
for folder in sorted({*root.glob("src/*/"), *root.glob("include/lore/*/")}):
    if folder.is_dir() and folder.name not in LEVEL:
        breaches.append(f"{folder.relative_to(root)}: src/CMakeLists.txt names no such module")
if breaches:
    print("\n".join(breaches))
    sys.exit(1)


def lore_headers(file):
    return re.findall(r'^\s*#\s*include\s*[<"](lore/(\w+)/[^>"]+)[>"]', file.read_text(), re.MULTILINE)


def check_reader(file, forbidden):
    """Follows the headers that `file` includes through the modules in FOLLOWED."""
    open_files, seen = [file], {file}
    while open_files:
        current = open_files.pop()
        for header, module in lore_headers(current):
            if module in forbidden:
                breaches.append(f"{file.relative_to(root)}: it only reads, and {current.relative_to(root)} includes {header}")
            followed = root / "include" / header
            if module in FOLLOWED and followed not in seen and followed.exists():
                seen.add(followed)
                open_files.append(followed)


for reader, forbidden in READERS.items():
    for file in sorted([*root.glob(f"include/lore/{reader}/*.h"), *root.glob(f"src/{reader}/*.*")]):
        if file.suffix in {".h", ".cpp"}:
            check_reader(file, forbidden)

for file in sorted([*root.glob("include/lore/*/*.h"), *root.glob("src/*/*"), *root.glob("tools/**/*.cpp"), *root.glob("tools/**/*.h")]):
    if file.suffix not in {".h", ".cpp"}:
        continue
    relative = file.relative_to(root)
    module = "tools" if relative.parts[0] == "tools" else relative.parts[2 if relative.parts[0] == "include" else 1]
    place = f"{module}/{file.name}"
    for number, line in enumerate(file.read_text().splitlines(), 1):
        include = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if not include:
            continue
        header = include.group(1)
        own = re.match(r"lore/(\w+)/", header)
        if own and module != "tools":
            other = own.group(1)
            if other != module and LEVEL[other] >= LEVEL[module]:
                breaches.append(f"{relative}:{number}: {module} includes {header}, which is not of a lower level")
        for pattern, doors in DOORS.items():
            if re.fullmatch(pattern, header) and module not in doors and place not in doors:
                breaches.append(f"{relative}:{number}: {header} may be included only by {', '.join(doors)}")

print("\n".join(breaches), end="\n" if breaches else "")
sys.exit(1 if breaches else 0)
