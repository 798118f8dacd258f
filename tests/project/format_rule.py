#!/usr/bin/env python3
"""Every C++ file is as clang-format 14 leaves it; no line of a CMake file, or of Python in tools, programs included, has
more than 120 columns.

    tests/project/format_rule.py SOURCE_DIR

Prints one line a breach and returns 1, or prints nothing. Returns 77 where there is no clang-format 14: other versions
format otherwise.
"""
import pathlib
import shutil
import subprocess
import sys

root = pathlib.Path(sys.argv[1])
folders = ("src", "include", "tools", "tests", "docs/examples")
sources = [file for folder in folders for file in sorted((root / folder).rglob("*")) if file.suffix in {".h", ".cpp"}]


def is_python(file):
    with file.open("rb") as opened:
        return file.suffix == ".py" or b"python3" in opened.readline()


breaches = [f"{file.relative_to(root)}:{number}: more than 120 columns"
            for file in [root / "CMakeLists.txt", *(file for folder in folders for file in (root / folder).rglob("*"))]
            if file.suffix == ".cmake" or file.name == "CMakeLists.txt"
            or (file.is_file() and file.is_relative_to(root / "tools") and is_python(file))
            for number, line in enumerate(file.read_text().splitlines(), 1) if len(line) > 120]
if breaches:
    print("\n".join(breaches))
    sys.exit(1)

formatter = shutil.which("clang-format-14") or shutil.which("clang-format")
version = subprocess.run([formatter, "--version"], capture_output=True, text=True).stdout if formatter else ""
if "version 14." not in version:
    print(f"skipped: clang-format 14 is not here ({version.strip() or 'none'})")
    sys.exit(77)
result = subprocess.run([formatter, "--dry-run", "--Werror", *sources], capture_output=True, text=True, cwd=root)
lines = [line for line in result.stderr.splitlines() if "error:" in line]
print("\n".join(line.replace(f"{root}/", "") for line in lines), end="\n" if lines else "")
if lines:
    print("Run: clang-format -i FILE")
sys.exit(1 if lines else 0)
