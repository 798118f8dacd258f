"""What the tests share: a run of a few seconds made by lore-evolve, and what the programs say about files."""
from __future__ import annotations

import os
import pathlib
import random
import shutil
import subprocess
import tempfile
import unittest
from typing import Any, Callable

import lore
from lore.programs import find_program

SOURCE_DIR = pathlib.Path(__file__).resolve().parents[2]
TASKS = SOURCE_DIR / "jobs" / "tasks"
OTHER_WORLD = SOURCE_DIR / "tests" / "data" / "version-2" / "toy"
STORED = SOURCE_DIR / "tests" / "data" / "version-1"
PAPER = SOURCE_DIR / "docs" / "results" / "paper"
SMALL = ["evolution.population=20", "evolution.founders=100", "evolution.generations=30", "episode.steps=2000"]


def program(name: str, *arguments: object, cwd: pathlib.Path | None = None) -> str:
    """What it prints; fails the test with what it said where it ends with another code than 0."""
    ran = subprocess.run([find_program(name), *map(str, arguments)], capture_output=True, text=True, cwd=cwd)
    assert ran.returncode == 0, f"{name} ended with {ran.returncode}: {ran.stderr}"
    return ran.stdout


def evolve(directory: pathlib.Path, seed: int = 1) -> str:
    """A run with an archive of all; returns its signature."""
    settings = [word for setting in SMALL for word in ("--set", setting)]
    said = program("lore-evolve", TASKS / "source.toml", "--seed", seed, "--out", directory, "--archive", "all", "-q",
                   *settings)  # fmt: skip
    return said.strip().splitlines()[-1].removeprefix("signature: ")


class LoreTest(unittest.TestCase):
    """Tests in a directory of their class."""

    scratch: pathlib.Path

    @classmethod
    def setUpClass(cls) -> None:
        cls.scratch = pathlib.Path(tempfile.mkdtemp(prefix="lore-python-"))
        cls.addClassCleanup(shutil.rmtree, cls.scratch)

    def expect_damaged(self, read: Callable[[], Any], file: os.PathLike[str] | str, reason: str = "") -> None:
        """Exactly lore.Damaged, with the file's name and a reason."""
        with self.assertRaises(lore.Damaged) as caught:
            read()
        self.assertEqual(caught.exception.file, os.fspath(file))
        self.assertIn(reason, caught.exception.reason)
        self.assertNotEqual(caught.exception.reason, "")
        self.assertIn(os.fspath(file), str(caught.exception))

    def expect_damage_noticed(self, read: Callable[[], Any], file: pathlib.Path) -> None:
        """`read` raises Damaged for the file cut anywhere, and with any of some bytes changed; then it is as before."""
        whole = file.read_bytes()
        draw = random.Random(1)
        places = [*range(0, min(len(whole), 140), 7), *(draw.randrange(len(whole)) for _ in range(20)), len(whole) - 1]
        try:
            for place in places:
                with self.subTest(file=file.name, cut_at=place):
                    file.write_bytes(whole[:place])
                    self.expect_damaged(read, file)
                with self.subTest(file=file.name, changed_at=place):
                    file.write_bytes(whole[:place] + bytes([whole[place] ^ 1 << place % 8]) + whole[place + 1 :])
                    self.expect_damaged(read, file)
        finally:
            file.write_bytes(whole)
