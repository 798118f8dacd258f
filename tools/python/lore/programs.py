"""Lore's programs, which read what Python does not: lineages and single individuals."""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from typing import Iterator, Sequence

from .errors import Damaged, FilePath


def find_program(name: str) -> str:
    """The path of `lore-kb` and the like: from the directory LORE_BIN where it is set, else from PATH.

    Raises FileNotFoundError.
    """
    place = os.environ.get("LORE_BIN")
    found = shutil.which(name, path=place) if place else shutil.which(name)
    if found is None:
        where = f"in LORE_BIN ({place})" if place else "on PATH"
        raise FileNotFoundError(f"{name} is not {where}; set LORE_BIN to the directory of Lore's programs")
    return found


def output_lines(name: str, arguments: Sequence[str], path: FilePath) -> Iterator[str]:
    """The lines that a program prints, as it prints them; `path` is the input that it reads.

    Raises Damaged with the program's reason where it cannot read `path`, RuntimeError where it was used wrongly (a
    program of another version) or was killed, and what open() raises where the input is not there.
    """
    if not os.path.isdir(path):
        open(path, "rb").close()
    with tempfile.TemporaryFile("w+", errors="replace") as errors:
        with subprocess.Popen(
            [find_program(name), *arguments],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=errors,
            encoding="utf-8",
        ) as process:
            assert process.stdout is not None
            try:
                yield from process.stdout
            except BaseException:  # also that nobody wants the rest
                process.kill()
                raise
        errors.seek(0)
        _check(name, process.returncode, errors.read(), path)


def run_program(name: str, arguments: Sequence[str], path: FilePath) -> None:
    """The same where only what it writes is wanted."""
    for _ in output_lines(name, arguments, path):
        pass


def _check(name: str, code: int, errors: str, path: FilePath) -> None:
    if code == 0:
        return
    said = (errors.strip().splitlines() or [f"it ended with {code} without a word"])[-1]
    if code != 1:
        raise RuntimeError(said if said.startswith(name) else f"{name}: {said}")
    # "lore-kb: cannot read FILE (why). What to do."
    told = re.fullmatch(rf"{re.escape(name)}: cannot read (?P<file>.+?) \((?P<why>.+)\)\. .*", said)
    raise Damaged(told["file"] if told else path, told["why"] if told else said.removeprefix(f"{name}: "))
