"""Knowledge bases as lore-kb builds, shows and exports them."""
import json
import mmap
import pathlib
import struct
import tracemalloc
import unittest

import numpy as np

import lore
from support import OTHER_WORLD, STORED, LoreTest, evolve, program


class Knowledge(LoreTest):
    base: pathlib.Path

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        evolve(cls.scratch / "run")
        cls.base = cls.scratch / "kb.lorekb"
        program("lore-kb", "build", cls.scratch / "run", "--out", cls.base, "-q")

    def exported(self, base: pathlib.Path) -> dict[str, np.ndarray]:
        directory = self.scratch / f"{base.stem}-npy"
        program("lore-kb", "export", base, "--npy", directory)
        return {file.stem: np.load(file) for file in directory.glob("*.npy")}

    def test_is_what_lore_kb_tells_and_exports(self) -> None:
        program("lore-kb", "build", self.scratch / "run", "--all", "--every", 3, "--success", 1,
                "--out", self.scratch / "all.lorekb", "-q")  # fmt: skip
        bases = [self.base, self.scratch / "all.lorekb", STORED / "sample.lorekb"]
        for path in bases:
            with self.subTest(base=path.name):
                base, told = lore.KnowledgeBase(path), json.loads(program("lore-kb", "info", path, "--json"))
                self.assertEqual(len(base), told["features"])
                self.assertEqual(base.window_length, told["window_length"])
                self.assertEqual(base.match_threshold, np.float32(told["threshold"]))
                self.assertEqual(base.provenance, told["provenance"])
                self.assertEqual(base.values.min(), told["values"]["min"])
                self.assertEqual(base.values.max(), told["values"]["max"])
                self.assertAlmostEqual(base.values.mean(), told["values"]["mean"])
                arrays = self.exported(path)
                np.testing.assert_array_equal(base.windows(), arrays["features"])
                np.testing.assert_array_equal(base.windows(1), arrays["features"][1])
                np.testing.assert_array_equal(base.windows([1, 0]), arrays["features"][[1, 0]])
                for name in ("values", "reward_sums", "counts"):
                    np.testing.assert_array_equal(getattr(base, name), arrays[name])

    def test_has_the_evidence_that_the_build_gathered(self) -> None:
        base, arrays = lore.KnowledgeBase(self.base), self.exported(self.base)
        assert base.returns is not None and base.credit is not None
        self.assertIsNone(base.contrast)
        np.testing.assert_array_equal(base.returns.gammas, arrays["gammas"])
        np.testing.assert_array_equal(base.returns.showings, arrays["showings"])
        np.testing.assert_array_equal(base.returns.sums, arrays["return_sums"])
        np.testing.assert_array_equal(base.credit.news, arrays["news"])
        np.testing.assert_array_equal(base.credit.gain_sums, arrays["gain_sums"])
        old = lore.KnowledgeBase(STORED / "sample.lorekb")
        self.assertIsNone(old.returns or old.credit or old.contrast)

    def test_has_the_contrast_of_a_build_of_everybody(self) -> None:
        path = self.scratch / "contrast.lorekb"
        program("lore-kb", "build", self.scratch / "run", "--all", "--success", 1, "--out", path, "-q")
        contrast = lore.KnowledgeBase(path).contrast
        told = json.loads(program("lore-kb", "info", path, "--json"))["evidence"]["contrast"]
        arrays = self.exported(path)
        assert contrast is not None
        self.assertEqual(
            {"success_balls": contrast.success_reward, "successes": contrast.successes, "failures": contrast.failures},
            told,
        )
        np.testing.assert_array_equal([contrast.successes, contrast.failures], arrays["contrast_totals"])
        np.testing.assert_array_equal(contrast.successes_that_showed, arrays["successes_that_showed"])
        np.testing.assert_array_equal(contrast.failures_that_showed, arrays["failures_that_showed"])

    def test_finds_what_lore_kb_query_finds(self) -> None:
        program("lore-kb", "query", self.base, "--run", self.scratch / "run", "--csv", self.scratch / "found.csv")
        found = lore.read_table(self.scratch / "found.csv")
        base = lore.KnowledgeBase(self.base)
        windows = lore.Run(self.scratch / "run").trace().windows(base.window_length)
        self.assertEqual(len(windows), len(found))
        distances = np.sqrt(((windows[:, None].astype(float) - base.windows()[None]) ** 2).sum(axis=(2, 3)))
        np.testing.assert_allclose(distances.min(axis=1), found["distance"], atol=1e-5)
        nearest = found["feature"]
        np.testing.assert_allclose(distances[np.arange(len(windows)), nearest], found["distance"], atol=1e-5)
        np.testing.assert_array_equal(base.counts[nearest], found["count"])

    def test_of_any_world_has_its_channels_by_name(self) -> None:
        # tests/support/sample_archive.h: two features of three steps, bits counted up from 1 through all words.
        base = lore.KnowledgeBase(OTHER_WORLD / "sample.lorekb")
        self.assertEqual(base.channels, (*(f"sensor_{i}" for i in range(19)), "effector_0", "effector_1"))
        self.assertEqual(base.binary_channels, (1, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20))
        self.assertEqual(len(base.continuous_channels), 10)
        self.assertEqual(base.reward_unit, "points")
        self.assertEqual(base.provenance["best_points"], 2.5)
        windows = base.windows()
        self.assertEqual(windows.shape, (2, 3, 21))
        self.assertTrue(np.all(windows[..., base.continuous_channels] == 0.25))
        first_words = windows[..., base.binary_channels] @ (1 << np.arange(11))
        np.testing.assert_array_equal(first_words, [[1, 3, 5], [7, 9, 11]])
        np.testing.assert_array_equal(base.values, [1.5, -2.25])
        assert base.contrast is not None
        self.assertEqual(base.contrast.success_reward, 0.75)

    def test_of_layout_1_is_of_collectball(self) -> None:
        base = lore.KnowledgeBase(STORED / "sample.lorekb")
        self.assertEqual(base.channels, lore.CHANNELS)
        self.assertEqual(base.binary_channels, lore.BINARY)
        self.assertEqual(base.continuous_channels, lore.CONTINUOUS)
        self.assertEqual(base.reward_unit, "balls")

    def test_is_mapped_and_not_copied(self) -> None:
        tracemalloc.start()
        base = lore.KnowledgeBase(self.base, check=False)
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        self.assertLess(peak, base.continuous.nbytes / 2)
        for array in (base.values, base.reward_sums, base.counts, base.continuous, base.binary):
            owner = array
            while isinstance(owner, np.ndarray):
                owner = owner.base
            self.assertIsInstance(owner, mmap.mmap)
            with self.assertRaises(ValueError):
                array[0] = 0
        self.assertIn(str(self.base), pathlib.Path("/proc/self/maps").read_text())

    def test_without_check_a_changed_byte_passes_but_a_cut_does_not(self) -> None:
        path = self.scratch / "changed.lorekb"
        data = bytearray(self.base.read_bytes())
        data[200] ^= 1
        path.write_bytes(data)
        self.assertEqual(len(lore.KnowledgeBase(path, check=False)), len(lore.KnowledgeBase(self.base)))
        self.expect_damaged(lambda: lore.KnowledgeBase(path), path, "checksum mismatch")
        path.write_bytes(data[:-1])
        self.expect_damaged(lambda: lore.KnowledgeBase(path, check=False), path, "the file was cut")

    def test_notices_every_damage(self) -> None:
        path = self.scratch / "damaged.lorekb"
        path.write_bytes(self.base.read_bytes())
        self.expect_damage_noticed(lambda: lore.KnowledgeBase(path), path)

    def test_refuses_numbers_that_a_forged_checksum_covers(self) -> None:
        path = self.scratch / "forged.lorekb"
        for at, forged, reason in [
            (64 + 0, struct.pack("<I", 9), "newer Lore: layout 9"),
            (64 + 4, struct.pack("<I", 0), "a window length of 0"),
            (64 + 8, struct.pack("<f", float("nan")), "a match threshold of nan"),
            (64 + 12, struct.pack("<I", 8), "8 binary"),
            (64 + 12, struct.pack("<I", 99), "99 binary"),
            (64 + 24, struct.pack("<Q", 1 << 62), "do not fit its length"),
            (64 + 24, struct.pack("<Q", 1), "do not fit its length"),
            (64 + 40, struct.pack("<Q", 8), "evidence is of no known kind"),
            (64 + 64, struct.pack("<d", float("inf")), "not finite"),
        ]:
            with self.subTest(reason=reason):
                data = bytearray(self.base.read_bytes())
                data[at : at + len(forged)] = forged
                data[56:64] = lore.xxh3_64(memoryview(data)[64:], bytes(data[:56])).to_bytes(8, "little")
                path.write_bytes(data)
                self.expect_damaged(lambda: lore.KnowledgeBase(path), path, reason)

    def test_refuses_what_is_no_knowledge_base(self) -> None:
        run = self.scratch / "run"
        self.expect_damaged(lambda: lore.KnowledgeBase(run / "lineage.lore"), run / "lineage.lore", "lineage archive")
        self.expect_damaged(
            lambda: lore.KnowledgeBase(run / "progress.csv"), run / "progress.csv", "not a file of Lore"
        )
        with self.assertRaises(FileNotFoundError):
            lore.KnowledgeBase(self.scratch / "missing.lorekb")

    def test_may_be_empty(self) -> None:
        path = self.scratch / "empty.lorekb"
        program("lore-kb", "reduce", self.base, "--min-value", 1000, "--out", path)
        base = lore.KnowledgeBase(path)
        self.assertEqual(len(base), 0)
        self.assertEqual(base.windows().shape, (0, 20, 15))
        assert base.returns is not None and base.credit is not None
        self.assertEqual(base.returns.why_invalid() + base.credit.why_invalid(), "")
        nobody = np.empty(0, np.uint32)
        self.assertEqual(lore.Contrast(1, 0, 0, nobody, nobody).why_invalid(), "")


if __name__ == "__main__":
    unittest.main()
