"""Runs and lineages as lore-evolve leaves them and lore-kb tells of them."""
import gzip
import json
import os
import pathlib
import pickle
import shutil
import unittest
from unittest import mock

import numpy as np

import lore
from support import STORED, LoreTest, evolve, program


class ReadRun(LoreTest):
    directory: pathlib.Path
    run_: lore.Run
    signature: str

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.directory = cls.scratch / "run"
        cls.signature = evolve(cls.directory, seed=18446744073709551615)
        cls.run_ = lore.Run(cls.directory)

    def test_the_manifest_says_what_lore_evolve_said(self) -> None:
        manifest = self.run_.manifest
        self.assertEqual(manifest.signature, self.signature)
        self.assertEqual((manifest.status, manifest.task, manifest.seed), ("done", "source", 18446744073709551615))
        self.assertEqual((manifest.generation, manifest.generations), (30, 30))
        for file in manifest.outputs:
            data = (self.directory / file["path"]).read_bytes()
            self.assertEqual(lore.checksum_text(lore.xxh3_64(data)), file["xxh3_64"], file["path"])

    def test_progress_has_a_row_a_generation(self) -> None:
        progress = self.run_.progress()
        self.assertIn(
            f"progress of {len(progress)} generations", program("lore-kb", "verify", self.directory / "progress.csv")
        )
        self.assertEqual(progress["generation"].tolist(), list(range(31)))
        self.assertEqual(progress["best_balls"][-1], self.run_.manifest.best_balls)
        self.assertEqual(progress["evaluations"][-1], 100 + 30 * 20)
        self.assertEqual(progress["steps"].dtype, np.int64)
        lines = (self.directory / "progress.csv").read_text().splitlines()
        for row, line in enumerate(lines[1:]):
            fields = [progress[name][row] for name in lines[0].split(",")]
            for read, written in zip(fields, line.split(",")):
                self.assertEqual(read, written if isinstance(read, str) else float(written))

    def test_configuration_and_arena_are_dictionaries(self) -> None:
        self.assertEqual(self.run_.config["evolution"]["population"], 20)
        self.assertEqual(self.run_.arena["size"], [600, 400.34])

    def test_the_lineage_is_that_of_the_archive(self) -> None:
        lineage = self.run_.lineage()
        self.assertIn(
            f"lineage archive of {len(lineage)} individuals, generation {lineage.generation}",
            program("lore-kb", "verify", self.directory / "lineage.lore"),
        )
        self.assertEqual(lineage.best, self.run_.manifest.best)
        self.assertEqual(lineage["best"].balls, self.run_.manifest.best_balls)
        self.assertEqual(len(lineage.last_population), 20)
        ancestors = lineage.ancestors()
        self.assertEqual(ancestors[0].id, lineage.best)
        self.assertIsNone(ancestors[-1].parent)
        for child, parent in zip(ancestors, ancestors[1:]):
            self.assertEqual(child.parent, parent.id)
            self.assertLess(parent.generation, child.generation)
        # lore-kb build reads exactly these.
        program("lore-kb", "build", self.directory, "--out", self.scratch / "kb.lorekb", "-q")
        self.assertEqual(lore.KnowledgeBase(self.scratch / "kb.lorekb").provenance["individuals"], len(ancestors))
        with self.assertRaises(KeyError):
            lineage["99.0"]

    def test_the_population_has_the_means_of_progress(self) -> None:
        lineage, last = self.run_.lineage(), len(self.run_.progress()) - 1
        table, progress = lineage.table(), self.run_.progress()
        members = np.isin(table["id"], lineage.last_population)
        self.assertEqual(table["balls"][members].mean(), progress["mean_balls"][last])
        self.assertAlmostEqual(table["connections"][members].mean(), progress["mean_connections"][last])
        self.assertAlmostEqual(table["hidden"][members].mean(), progress["mean_hidden"][last])

    def test_genomes_are_those_of_the_archive_to_the_bit(self) -> None:
        lines = program("lore-kb", "individuals", self.directory).splitlines()
        for one, line in zip(self.run_.lineage().individuals, lines[1:]):
            told = json.loads(line)
            self.assertEqual([str(gene) for gene in one.genome.weight_genes],
                             [str(np.float32(gene)) for _, _, gene in told["edges"]])  # fmt: skip
            self.assertTrue((one.genome.targets >= 12).all())
            np.testing.assert_array_equal(one.genome.weights, one.genome.weight_genes * np.float32(10) - np.float32(5))
        self.assertEqual(len(self.run_.lineage().individuals), len(lines) - 1)

    def test_everybody_is_in_order_of_birth(self) -> None:
        everybody = self.run_.everybody()
        self.assertEqual(everybody.header["individuals"], 700)
        individuals = {one.id: one for one in everybody}
        self.assertEqual(len(individuals), 700)
        for one in self.run_.lineage().individuals:
            np.testing.assert_array_equal(individuals[one.id].genome.weight_genes, one.genome.weight_genes)
            self.assertEqual(individuals[one.id].parent, one.parent)
            self.assertEqual(individuals[one.id].balls, one.balls)

    def test_those_who_want_no_more_individuals_may_stop(self) -> None:
        self.assertEqual(next(iter(self.run_.everybody())).id, "0.0")

    def test_individuals_can_be_gone_through_again(self) -> None:
        exported = self.scratch / "everybody.jsonl"
        exported.write_text(program("lore-kb", "individuals", self.directory / "all.lore"))
        for everybody in (self.run_.everybody(), lore.Individuals(exported)):
            self.assertEqual(next(iter(everybody)).id, "0.0")
            ids = [one.id for one in everybody]
            self.assertEqual(len(ids), 700)
            self.assertEqual([one.id for one in everybody], ids)

    def test_an_archive_of_all_is_no_lineage(self) -> None:
        path = self.directory / "all.lore"
        self.expect_damaged(lambda: lore.Lineage(path), path, "its kind is 'archive of all individuals'")

    def test_an_exported_lineage_needs_no_program(self) -> None:
        exported = self.scratch / "lineage.jsonl"
        exported.write_text(program("lore-kb", "individuals", self.directory))
        with mock.patch.dict(os.environ, {"LORE_BIN": str(self.scratch)}):
            self.assertEqual(lore.Lineage(exported).best, self.run_.manifest.best)
            with self.assertRaisesRegex(FileNotFoundError, "LORE_BIN"):
                self.run_.lineage()
        whole = exported.read_text()
        exported.write_text(whole[: whole.rindex("{")])
        self.expect_damaged(lambda: lore.Lineage(exported), exported, "the file was cut")
        exported.write_text(whole.replace('"biases"', '"biasses"', 1))
        self.expect_damaged(lambda: lore.Lineage(exported), exported, "line 2 is damaged")
        exported.write_text(whole.replace('"format":1', '"format":2', 1))
        self.expect_damaged(lambda: lore.Lineage(exported), exported, "newer Lore")

    def test_a_trace_is_what_lore_replay_writes(self) -> None:
        program("lore-replay", self.directory, "--out", self.scratch / "replay", "-q")
        written, trace = lore.read_trace(self.scratch / "replay" / "trace.csv"), self.run_.trace()
        self.assertEqual(len(trace), 2000)
        for name in written:
            np.testing.assert_array_equal(trace[name], written[name])
        self.assertEqual(trace["collected"][-1], self.run_.manifest.best_balls)
        self.assertEqual(trace.windows(30).shape, (66, 30, 15))
        with self.assertRaisesRegex(RuntimeError, "99.0"):
            self.run_.trace("99.0")

    def test_a_directory_without_a_run_or_a_run_without_a_file_is_missing(self) -> None:
        with self.assertRaises(FileNotFoundError):
            lore.Run(self.scratch / "nowhere")
        with self.assertRaises(FileNotFoundError):
            lore.Run(self.scratch)
        copy = self.scratch / "incomplete"
        shutil.copytree(self.directory, copy)
        run = lore.Run(copy)
        for name, read in self.readers(run).items():
            (copy / name).unlink()
            with self.assertRaises(FileNotFoundError, msg=name):
                read()

    def test_damage_is_noticed_in_every_file(self) -> None:
        copy = self.scratch / "damaged"
        shutil.copytree(self.directory, copy)
        for name, read in self.readers(lore.Run(copy)).items():
            self.expect_damage_noticed(read, copy / name)

    def test_files_of_another_run_are_noticed(self) -> None:
        copy = self.scratch / "of-another"
        shutil.copytree(self.directory, copy)
        manifest = json.loads((copy / "manifest.json").read_text())
        for output in manifest["outputs"]:
            output["xxh3_64"] = "0123456789abcdef"
        (copy / "manifest.json").write_text(json.dumps(manifest))
        run = lore.Run(copy)
        self.expect_damaged(run.lineage, copy / "lineage.lore", "checksum mismatch")
        self.expect_damaged(lambda: list(run.everybody()), copy / "all.lore", "checksum mismatch")

    def readers(self, run: lore.Run):  # type: ignore[no-untyped-def]
        return {
            "config.toml": lambda: run.config,
            "arena.toml": lambda: run.arena,
            "progress.csv": run.progress,
            "lineage.lore": run.lineage,
            "all.lore": lambda: list(run.everybody()),
        }

    def test_a_manifest_that_was_cut_or_contradicts_itself_is_damaged(self) -> None:
        path = self.scratch / "manifest.json"
        whole = (self.directory / "manifest.json").read_text()
        for length in range(0, len(whole) - 2, 97):
            path.write_text(whole[:length])
            self.expect_damaged(lambda: lore.read_manifest(path), path)
        for old, new, reason in [
            ('"format": 1', '"format": 2', "newer Lore"),
            ('"status": "done"', '"status": "gone"', "unknown status"),
            ('"seed": 1', '"seed": "1", "was": 1', "'seed' is no int"),
            ('"seed"', '"sead"', "there is no 'seed'"),
            ('"xxh3_64"', '"xxh3"', "not described"),
        ]:
            path.write_text(whole.replace(old, new))
            self.expect_damaged(lambda: lore.read_manifest(path), path, reason)

    def test_damaged_can_be_sent_to_another_process(self) -> None:
        error = pickle.loads(pickle.dumps(lore.Damaged("a file", "why")))
        self.assertEqual((error.file, error.reason), ("a file", "why"))


class Tables(LoreTest):
    HEADER = (STORED / "progress.csv").read_text().splitlines()[0]
    ROW = "0,0,0.5,hamming,0.25,-1,36,0,9,2,0,16,6400,0.125"

    def read_progress(self, text: str) -> lore.Table:
        self.path = self.scratch / "progress.csv"
        self.path.write_text(text)
        return lore.read_progress(self.path)

    def test_stored_files_of_version_1_are_read(self) -> None:
        run = lore.read_progress(STORED / "progress.csv")
        self.assertIn(f"progress of {len(run)} generations", program("lore-kb", "verify", STORED / "progress.csv"))
        self.assertEqual(lore.read_manifest(STORED / "manifest.json").status, "interrupted")
        self.assertIn(f"{len(lore.Lineage(STORED / 'lineage.lore'))} individuals",
                      program("lore-kb", "verify", STORED / "lineage.lore"))  # fmt: skip
        founders = lore.Individuals(STORED / "founders.lore")
        self.assertEqual(len(list(founders)), founders.header["individuals"])
        self.assertEqual([one.id for one in lore.Individuals(STORED / "failed-genome.lore")][0].count("."), 1)
        plain, packed = lore.read_trace(STORED / "trace.csv"), lore.read_trace(STORED / "trace.csv.gz")
        np.testing.assert_array_equal(plain.channels, packed.channels)
        self.expect_damaged(
            lambda: lore.Individuals(STORED / "checkpoint.lore"), STORED / "checkpoint.lore", "it is a checkpoint"
        )

    def test_a_row_under_way_is_left_out_and_a_later_column_is_read(self) -> None:
        self.assertEqual(len(self.read_progress(f"{self.HEADER}\n{self.ROW}\n1,0,0.")), 1)
        later = self.read_progress(f"{self.HEADER},novel\n{self.ROW},7\n")
        self.assertEqual(later["novel"].tolist(), [7])

    def test_what_is_no_progress_is_refused_with_line_and_column(self) -> None:
        for text, reason in [
            ("", "no header"),
            (f"{self.HEADER}\n{self.ROW},1\n", "line 2 has 15 columns"),
            (f"{self.HEADER}\n{self.ROW.replace('0.5', 'nan')}\n", "line 2, mean_balls: 'nan' is no finite number"),
            (f"{self.HEADER}\n{self.ROW.replace('6400', '6_400')}\n", "line 2, steps: '6_400' is no whole number"),
            (f"{self.HEADER}\n{self.ROW}\n{self.ROW}\n", "line 3 is not of generation 1"),
            (f"{self.HEADER.replace('tied', 'tide')}\n", "there is no column 'tied'"),
            (f"{self.HEADER},tied\n", "two columns have one name"),
        ]:
            with self.subTest(reason=reason), self.assertRaises(lore.Damaged) as caught:
                self.read_progress(text)
            self.assertIn(reason, caught.exception.reason)

    def test_a_packed_trace_that_was_cut_or_changed_is_damaged(self) -> None:
        path = self.scratch / "trace.csv.gz"
        whole = gzip.compress((STORED / "trace.csv").read_bytes())
        path.write_bytes(whole[:-20])
        self.expect_damaged(lambda: lore.read_trace(path), path, "cut or changed")
        path.write_bytes(whole[:99] + bytes([whole[99] ^ 4]) + whole[100:])
        self.expect_damaged(lambda: lore.read_trace(path), path)

    def test_where_takes_rows_and_frame_makes_a_data_frame(self) -> None:
        table = lore.Table({"a": np.array([1, 2, 2]), "b": np.array(["x", "y", "z"])})
        self.assertEqual(table.where(a=2)["b"].tolist(), ["y", "z"])
        self.assertEqual(len(table.where(a=2, b="z")), 1)
        for ask in (lambda: table["c"], lambda: table.where(c=1)):
            with self.assertRaisesRegex(KeyError, "there is no column 'c', only a, b"):
                ask()
        with self.assertRaises(ValueError):
            lore.Table({"a": np.zeros(2), "b": np.zeros(3)})
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not here")
        frame = table.frame()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(frame.groupby("a")["b"].count().tolist(), [1, 2])


if __name__ == "__main__":
    unittest.main()
