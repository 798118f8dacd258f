"""This Lore keeps what releases promised, and a broken promise is told in one line.

    PROGRAMS=build/release/bin python3 -m unittest release_test
"""
import os
import pathlib
import shutil
import tempfile
import unittest

import release

DATA = release.SOURCE / "tests" / "data"
PROGRAMS = pathlib.Path(os.environ["PROGRAMS"]).resolve()


def missing(place):
    with tempfile.TemporaryDirectory() as work:
        return list(release.missing(place, PROGRAMS, pathlib.Path(work)))


class Releases(unittest.TestCase):
    def test_what_every_release_promised_is_there(self):
        places = sorted(DATA.glob("release-*"))
        self.assertTrue(places)
        for place in places:
            with self.subTest(place.name):
                self.assertEqual(missing(place), [])

    def test_what_went_missing_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder, "release-1.0.0")
            shutil.copytree(DATA / "release-1.0.0", place)
            for name, line in (("commands.txt", "lore-kb build --gone"), ("settings.txt", "evolution.gone"),
                               ("columns.txt", "final.csv gone"), ("python.txt", "lore.Gone"),
                               ("headers.txt", "lore/gone.h"), ("world_layout.txt", "lore_facts.gone 0 4"),
                               ("world.c", "#error gone"), ("program.cpp", "#error gone"),
                               ("jobs/campaigns/small.toml", "[gone]")):
                with open(place / name, "a") as file:
                    file.write(line + "\n")
            (place / "signature.txt").write_text("signature: 0123456789abcdef\n")
            (place / "base.lorekb").write_bytes((place / "base.lorekb").read_bytes()[:4000])
            told = "\n".join(missing(place))
        for line in ("1.0.0 has 'lore-kb build --gone' (commands.txt), and this Lore has not", "'evolution.gone'",
                     "'final.csv gone'", "'lore.Gone'", "'lore/gone.h'", "'lore_facts.gone 0 4'",
                     "1.0.0: the world that was compiled for it: ", "1.0.0: its program for the C++ library: ",
                     "1.0.0: its stopped run: it ends with 'signature: ", "1.0.0: its knowledge base: ",
                     "1.0.0: its campaigns: "):
            self.assertIn(line, told)
        self.assertEqual(len(told.splitlines()), 11, told)


if __name__ == "__main__":
    unittest.main()
