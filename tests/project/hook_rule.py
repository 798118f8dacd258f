#!/usr/bin/env python3
"""What tests ask of a program through the environment stays in src/cluster/test_hooks.*, and out of shipped builds.

    tests/project/hook_rule.py SOURCE_DIR OBJECT...

OBJECT: the files of src/cluster that use the hooks, compiled as without the tests. Prints one line a breach and returns
1, or prints nothing.
"""
import pathlib
import sys

MARK = b"LORE_TEST_"

root = pathlib.Path(sys.argv[1])
sources = [file for folder in ("include", "src", "tools") for file in sorted((root / folder).rglob("*")) if file.suffix in {".h", ".cpp", ".in"}]
breaches = [f"{file.relative_to(root)} names a hook of tests; src/cluster/test_hooks.h has them all" for file in sources
            if MARK in file.read_bytes() and file.stem != "test_hooks"]
breaches += [f"{object} reads the environment for tests, though built without them" for object in sys.argv[2:]
             if MARK in pathlib.Path(object).read_bytes()]
if len(sys.argv) < 3:
    breaches.append("no object was given")

print("\n".join(breaches), end="\n" if breaches else "")
sys.exit(1 if breaches else 0)
