"""Campaigns and their reports as lore-campaign makes them, and figures drawn from their tables."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree
from typing import Any

import numpy as np

import lore
from support import PAPER, SMALL, TASKS, LoreTest, program

try:
    import matplotlib  # noqa: F401

    from lore import plot
except ImportError:
    plot = None  # type: ignore[assignment]


def campaign_text() -> str:
    treatment = f"set = {SMALL[:2] + SMALL[3:]}\n".replace("'", '"')
    return f"""
title = "A campaign of a few seconds"
runs = 2
generations = 12
[source]
config = "{TASKS}/source.toml"
{treatment}
[[knowledge]]
name = "kb1"
balls = 1
[[knowledge]]
name = "kb2"
balls = 0
[[treatment]]
name = "none"
label = "no transfer"
config = "{TASKS}/target.toml"
{treatment}
[[treatment]]
name = "kb1"
config = "{TASKS}/target.toml"
knowledge = "kb1"
{treatment}
[report]
trajectory = "kb1"
figure5 = ["kb1"]
figure6 = ["kb1", "kb2"]
"""


class ReadCampaign(LoreTest):
    directory: pathlib.Path

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.directory = cls.scratch / "campaign"
        file = cls.scratch / "campaign.toml"
        file.write_text(campaign_text())
        program("lore-campaign", "run", file, "--dir", cls.directory, "-q")
        program("lore-campaign", "report", file, "--dir", cls.directory, "-q")

    def test_finds_treatments_runs_and_knowledge(self) -> None:
        campaign = lore.Campaign(self.directory)
        self.assertEqual(campaign.treatments, ["source", "kb1", "none"])
        self.assertEqual(list(campaign.runs("none")), [1, 2])
        self.assertEqual(campaign.knowledge, ["kb1", "kb2"])
        self.assertEqual(len(campaign.knowledge_base("kb1")), campaign.report.knowledge["features"][0])
        with self.assertRaises(FileNotFoundError):
            campaign.runs("kb9")
        with self.assertRaises(FileNotFoundError):
            lore.Campaign(self.scratch)

    def test_status_is_what_the_report_tells_of_runs(self) -> None:
        status, runs = lore.Campaign(self.directory).status(), lore.Campaign(self.directory).report.runs
        self.assertEqual(set(status["status"]), {"done"})
        for treatment, run, signature, balls in zip(
            *(runs[name] for name in ("treatment", "run", "signature", "balls"))
        ):
            row = status.where(treatment=treatment, run=run)
            self.assertEqual((row["signature"][0], row["best_balls"][0], row["generation"][0]), (signature, balls, 12))
        self.assertEqual(len(status), len(runs))
        copy = self.scratch / "of-two-units"
        shutil.copytree(self.directory / "runs", copy / "runs")
        path = copy / "runs" / "none" / "002" / "manifest.json"
        manifest = json.loads(path.read_text())
        manifest["world"]["reward_unit"] = "poles"  # which are whole, too
        path.write_text(json.dumps(manifest))
        self.assertIn("best_reward", lore.Campaign(copy).status().columns)

    def test_progress_is_tidy_and_has_the_means_of_the_curves(self) -> None:
        campaign = lore.Campaign(self.directory)
        progress, curves = campaign.progress(), campaign.report.curves
        self.assertEqual(progress.columns[:4], ["treatment", "run", "seed", "generation"])
        self.assertEqual(len(progress), 3 * 2 * 13)
        for treatment, generation, mean in zip(*(curves[name] for name in ("treatment", "generation", "mean"))):
            rows = progress.where(treatment=treatment, generation=generation)
            self.assertAlmostEqual(rows["best_balls"].mean(), mean, 4)
        self.assertEqual(len({(t, s) for t, s in zip(progress["treatment"], progress["seed"])}), 6)

    def test_a_campaign_under_way_shows_what_is_there(self) -> None:
        copy = self.scratch / "under-way"
        shutil.copytree(self.directory / "runs", copy / "runs")
        manifest = copy / "runs" / "none" / "002" / "manifest.json"
        manifest.write_text(manifest.read_text().replace('"status": "done"', '"status": "running"'))
        (copy / "runs" / "kb1" / "002" / "manifest.json").unlink()
        campaign = lore.Campaign(copy)
        self.assertEqual(len(campaign.progress()), 4 * 13)
        self.assertEqual(len(campaign.progress(unfinished=True)), 5 * 13)
        self.assertEqual(campaign.knowledge, [])
        with self.assertRaises(FileNotFoundError):
            campaign.report

    def test_a_damaged_run_is_named(self) -> None:
        copy = self.scratch / "damaged"
        shutil.copytree(self.directory / "runs", copy / "runs")
        progress = copy / "runs" / "none" / "001" / "progress.csv"
        progress.write_text(progress.read_text().replace(",0,", ",1,", 1))
        self.expect_damaged(lambda: lore.Campaign(copy).progress(), progress, "checksum mismatch")

    @unittest.skipIf(plot is None, "matplotlib is not here")
    def test_its_figures_can_be_drawn(self) -> None:
        written = plot.save_figures(self.directory, self.scratch / "figures", ["svg"])
        self.assertEqual([os.path.basename(path) for path in written], [f"figure{i}.svg" for i in range(3, 7)])


class SeveralTasks(LoreTest):
    """A report of two source and two target tasks, one of them in a world of its own, as its tables have it."""

    def setUp(self) -> None:
        super().setUp()
        self.report = self.scratch / "report"
        self.report.mkdir(exist_ok=True)
        targets = {"arena_from_none": "arena", "pole_from_none": "pole", "pole_from_pole": "pole"}
        treatments = [{"treatment": name, "label": name} for name in ("arena", "pole")]
        treatments += [{"treatment": name, "label": name, "target": task} for name, task in targets.items()]
        files = {
            "final.csv": "treatment,run,seed,reward,unit\narena,1,1,3,balls\npole,1,1,-4.5,cos\n"
            "arena_from_none,1,7,2,balls\npole_from_none,1,7,-9.5,cos\npole_from_pole,1,7,-3.25,cos\n",
            "curves.csv": "treatment,generation,runs,mean,low,high\npole,9,1,-4.5,-4.5,-4.5\narena_from_none,4,1,2,2,2\n"
            "pole_from_none,4,1,-9.5,-9.5,-9.5\npole_from_pole,4,1,-3.25,-3.25,-3.25\n",
            "matrix.csv": "source,target,treatment,none,unit,generation,n,n_none,mean,mean_none,difference,difference_low,"
            "difference_high,a12,a12_low,a12_high,p,p_holm,why\n"
            "arena,pole,,pole_from_none,,,,,,,,,,,,,,,other channels\n"
            "pole,pole,pole_from_pole,pole_from_none,cos,4,1,1,-3.25,-9.5,6.25,6.25,6.25,1,1,1,1,1,\n",
            "replay.csv": "replay,step,x,y,reward\npole/001,0,0.25,0.5,0\npole/001,1,0.5,0.5,-1\npole/001,2,0.75,1,-2\n",
            "values.csv": "figure,knowledge,window,value\nfigure5,pole,0,-0.5\nfigure5,pole,1,\n",
            "scene.json": json.dumps({
                "replays": [{"run": "pole/001", "signature": "0", "reward_unit": "cos",
                             "world": {"width": 2, "height": 1, "svg": "<rect width='1' height='1' fill='#ff0000'/>"}}],
                "panels": [{"figure": "figure5", "knowledge": "pole", "checksum": "0"}],
            }),
            "summary.json": json.dumps({"sources": ["arena", "pole"], "treatments": treatments,
                                        "knowledge": [{"knowledge": "pole", "label": "the pole's lineage"}]}),
        }  # fmt: skip
        for name, text in files.items():
            (self.report / name).write_text(text)

    def test_know_their_sources_tasks_and_matrix(self) -> None:
        report = lore.Report(self.report)
        self.assertEqual(report.sources, ["arena", "pole"])
        self.assertEqual(report.tasks, {"arena": ["arena_from_none"], "pole": ["pole_from_none", "pole_from_pole"]})
        self.assertEqual(report.reward_unit, "balls", "of the first target task")
        matrix = report.matrix
        self.assertEqual(matrix["why"].tolist(), ["other channels", ""])
        np.testing.assert_array_equal(matrix["difference"], [np.nan, 6.25])
        np.testing.assert_array_equal(report.values["value"], [-0.5, np.nan])
        scene = report.scenes["pole/001"]
        assert isinstance(scene, lore.WorldScene)
        self.assertEqual((scene.size.tolist(), scene.reward_unit), ([2, 1], "cos"))
        whole = (self.report / "matrix.csv").read_text()
        (self.report / "matrix.csv").write_text(whole.replace("6.25,1", "six,1"))
        self.expect_damaged(lambda: report.matrix, self.report / "matrix.csv", "difference_high")
        (self.report / "scene.json").write_text((self.report / "scene.json").read_text().replace(": 2,", ": -2,"))
        self.expect_damaged(lambda: report.scenes, self.report / "scene.json", "a world without extent")

    @unittest.skipIf(plot is None, "matplotlib is not here")
    def test_have_no_curves_of_other_units_on_one_axis(self) -> None:
        drawn = plot.figure3(self.report).axes[0]
        self.assertEqual(drawn.get_ylabel(), "reward [balls] (mean of best-of-runs)")
        self.assertEqual([line.get_label() for line in drawn.lines], ["arena_from_none (n = 1)"])
        boxes = plot.figure4(self.report).axes[0]
        self.assertEqual([tick.get_text() for tick in boxes.get_xticklabels()], ["arena_from_none\nn = 1"])

    @unittest.skipIf(plot is None, "matplotlib is not here")
    def test_give_a_treatment_one_color_whoever_has_runs(self) -> None:
        for name in ("final.csv", "curves.csv"):
            lines = (self.report / name).read_text().splitlines(keepends=True)
            (self.report / name).write_text("".join(line for line in lines if not line.startswith("pole_from_none")))
        (line,) = plot.figure3(self.report, "pole").axes[0].lines
        points = plot.figure4(self.report, "pole").axes[0].lines[-1]
        self.assertEqual([line.get_color(), points.get_color()], [plot.COLORS[1]] * 2)

    @unittest.skipIf(plot is None, "matplotlib is not here")
    def test_break_long_labels_and_leave_out_the_task_that_all_begin_with(self) -> None:
        summary = (self.report / "summary.json").read_text()
        for name, end in (("pole_from_none", "no knowledge"), ("pole_from_pole", "knowledge of the pole on the cart")):
            summary = summary.replace(f'"label": "{name}"', f'"label": "The pole: {end}"')
        (self.report / "summary.json").write_text(summary)
        lines = [line.get_label() for line in plot.figure3(self.report, "pole").axes[0].lines]
        self.assertEqual(lines, ["no knowledge (n = 1)", "knowledge of the pole on the\ncart (n = 1)"])
        boxes = [tick.get_text() for tick in plot.figure4(self.report, "pole").axes[0].get_xticklabels()]
        self.assertEqual(boxes, ["no knowledge\nn = 1", "knowledge of\nthe pole on the\ncart\nn = 1"])

    def test_have_replays_in_arenas_whatever_the_unit(self) -> None:
        (self.report / "replay.csv").write_text(
            "replay,step,x,y,theta,carrying,door_open,switch_on,balls_mask,collected\narena/001,0,1,2,0.5,0,0,0,255,0\n")  # fmt: skip
        self.assertEqual(lore.Report(self.report).replay["balls_mask"].tolist(), [255])

    def test_may_have_units_with_commas_and_quotes(self) -> None:
        for name in ("final.csv", "matrix.csv"):
            whole = (self.report / name).read_text()
            (self.report / name).write_text(whole.replace(",cos", ',"5"" steps, forward"'))
        report = lore.Report(self.report)
        self.assertEqual(report.final["unit"].tolist()[1], '5" steps, forward')
        self.assertEqual(report.matrix["unit"].tolist()[1], '5" steps, forward')

    @unittest.skipIf(plot is None, "matplotlib is not here")
    def test_have_figures_by_task_and_the_path_over_the_scene_of_a_world(self) -> None:
        if shutil.which("rsvg-convert") is None:
            with self.assertRaisesRegex(OSError, "no program rsvg-convert"):
                plot.figure5(self.report)
            self.skipTest("rsvg-convert is not here")
        written = plot.save_figures(self.report, self.scratch / "figures", ["svg"])
        self.assertEqual([os.path.basename(path) for path in written],
                         ["figure3_arena.svg", "figure3_pole.svg", "figure4_arena.svg", "figure4_pole.svg",
                          "figure5.svg"])  # fmt: skip
        axes = plot.figure3(lore.Report(self.report), "pole").axes[0]
        self.assertEqual([line.get_label() for line in axes.lines], ["pole_from_none (n = 1)", "pole_from_pole (n = 1)"])
        self.assertEqual(axes.get_ylabel(), "reward [cos] (mean of best-of-runs)")
        panel = plot.figure5(self.report).subfigs[0]
        pixels = panel.axes[0].images[0].get_array()
        self.assertEqual(pixels[10, 10].tolist()[:3], pixels[-10, 10].tolist()[:3])
        self.assertNotEqual(pixels[10, 10].tolist(), pixels[10, -10].tolist(), "the left half is red")
        self.assertEqual(panel.axes[1].get_ylabel(), "value (cos)")
        self.assertEqual(panel.texts[0].get_text(), "(a) values from the pole's lineage")
        legend = [text.get_text() for text in panel.axes[0].get_legend().get_texts()]
        self.assertEqual(legend, ["start", "end", "not in the knowledge base"])


@unittest.skipIf(plot is None, "matplotlib is not here")
class Windows(LoreTest):
    """A report of a life of 45 steps, whose windows of 20 steps do not divide it, in an arena of nothing."""

    def setUp(self) -> None:
        super().setUp()
        steps = "".join(f"source/001,{k},{k},{k % 2},0,0,0,0,0,0\n" for k in range(45))
        scene = {"width": 45, "height": 45, "walls": [], "doors": [], "balls": [], "balls_at_start": True,
                 "basket": [0, 0, 1], "basket_lights": [], "switch": [0, 0], "robot_radius": 1}  # fmt: skip
        self.scene: dict[str, Any] = {
            "replays": [{"run": "source/001", "signature": "0", "scene": scene}],
            "panels": [{"figure": "figure5", "knowledge": "kb1", "checksum": "0", "window_length": 20}],
        }
        files = {
            "final.csv": "treatment,run,seed,balls\nsource,1,1,3\n",
            "replay.csv": "replay,step,x,y,theta,carrying,door_open,switch_on,balls_mask,collected\n" + steps,
            "values.csv": "figure,knowledge,window,value\nfigure5,kb1,0,-0.5\nfigure5,kb1,1,\n",
            "scene.json": json.dumps(self.scene),
        }
        for name, text in files.items():
            (self.scratch / name).write_text(text)

    def lines(self) -> list[list[list[float]]]:
        """Where each window begins and ends along the path: not found, found."""
        plan = plot.figure5(self.scratch).subfigs[0].axes[0]
        return [[[p[0, 0], p[-1, 0]] for p in collection.get_segments()] for collection in plan.collections[:2]]

    def test_are_drawn_where_they_were(self) -> None:
        self.assertEqual(self.lines(), [[[20, 40], [40, 44]], [[0, 20]]])
        strip = plot.figure5(self.scratch).subfigs[0].axes[1]
        self.assertEqual(strip.get_xlim(), (0, 45))

    def test_made_before_1_0_0_have_a_length_that_fits_and_marks_for_those_not_found(self) -> None:
        del self.scene["panels"][0]["window_length"]
        (self.scratch / "scene.json").write_text(json.dumps(self.scene))
        (self.scratch / "values.csv").write_text(
            "figure,knowledge,window,value\nfigure5,kb1,0,2\nfigure5,kb1,1,-1.0000\n"
        )
        self.assertEqual(self.lines(), [[[20, 40], [40, 44]], [[0, 20]]])

    def test_without_length_are_refused(self) -> None:
        self.scene["panels"][0]["window_length"] = 0
        (self.scratch / "scene.json").write_text(json.dumps(self.scene))
        self.expect_damaged(lambda: plot.figure5(self.scratch), self.scratch / "scene.json", "a window without length")

    def test_of_a_figure_that_the_report_does_not_show_are_refused(self) -> None:
        with self.assertRaisesRegex(ValueError, "no figure 6: name bases in .report. figure6"):
            plot.figure6(self.scratch)


@unittest.skipIf(plot is None, "matplotlib is not here")
class Figures(LoreTest):
    def test_name_axes_units_and_treatments(self) -> None:
        plot.save_figures(PAPER, self.scratch, ["svg"])
        expected = {
            "figure3": ["generation", "collected balls (mean of best-of-runs)", "no transfer (n = 30)", "KB3 (n = 30)"],
            "figure4": ["collected balls (best-of-run)", "KB1 random", "n = 30", "**"],
            "figure5": [
                "x (u)",
                "y (u)",
                "time (steps)",
                "value (balls)",
                "(a) values from KB3",
                "(b) values from KB2",
            ],
            "figure6": ["product of the values from KB1 \u00d7 KB2 \u00d7 KB3", "time (steps)"],
        }
        for figure, texts in expected.items():
            document = xml.etree.ElementTree.parse(self.scratch / f"{figure}.svg")
            shown = {
                "".join(element.itertext()).strip() for element in document.iter("{http://www.w3.org/2000/svg}text")
            }
            for text in texts:
                self.assertIn(text, shown, figure)

    def test_have_an_axis_of_balls_where_nobody_has_any(self) -> None:
        (self.scratch / "final.csv").write_text("treatment,run,seed,balls\nsource,1,1,0\nnone,1,1,0\n")
        (self.scratch / "curves.csv").write_text("treatment,generation,runs,mean,low,high\nnone,0,1,0,0,0\nnone,9,1,0,0,0\n")
        for draw in (plot.figure3, plot.figure4):
            self.assertGreaterEqual(draw(self.scratch).axes[0].get_ylim()[1], 1)

    def test_break_a_long_title(self) -> None:
        summary = json.loads((PAPER / "summary.json").read_text())
        for entry in summary["knowledge"]:
            entry["label"] = "knowledge of a robot that " + "went on and " * 10 + "on"
        copy = self.scratch / "long"
        shutil.copytree(PAPER, copy)
        (copy / "summary.json").write_text(json.dumps(summary))
        lines = plot.figure5(copy).subfigs[0].texts[0].get_text().splitlines()
        self.assertEqual(len(lines), 3)
        self.assertLessEqual(max(map(len, lines)), 80)

    def test_equal_tables_make_equal_files(self) -> None:
        for place in ("once", "again"):
            plot.save_figures(PAPER, self.scratch / place, ["svg"])
        for figure in ("figure3.svg", "figure4.svg", "figure5.svg", "figure6.svg"):
            self.assertEqual(
                (self.scratch / "once" / figure).read_bytes(), (self.scratch / "again" / figure).read_bytes()
            )

    def test_show_what_the_tables_hold(self) -> None:
        report = lore.Report(PAPER)
        lines = {line.get_label(): line for line in plot.figure3(report).axes[0].lines}
        curve = report.curves.where(treatment="kb3")
        np.testing.assert_array_equal(lines["KB3 (n = 30)"].get_ydata(), curve["mean"])
        np.testing.assert_array_equal(lines["KB3 (n = 30)"].get_xdata(), curve["generation"])
        marks = sorted(text.get_text() for text in plot.figure4(report).axes[0].texts)
        p = report.comparisons["p"]
        self.assertEqual(marks, ["*"] * int(((p < 1e-2) & (p >= 1e-3)).sum()) + ["**"] * int((p < 1e-3).sum()))


    def test_figures_show_the_pools_that_the_report_shows(self) -> None:
        report = lore.Report(PAPER.parent / "all_bases")
        self.assertEqual(["none", "untrained", "permuted", "policies", "chosen", "all"], report.shown())
        lines = {line.get_label(): line for line in plot.figure3(report).axes[0].lines}
        self.assertIn("ten bases (n = 40)", lines)
        self.assertEqual(6, sum("n = 40" in label for label in lines))
        labels = [text.get_text() for text in plot.figure4(report).axes[0].get_xticklabels()]
        self.assertIn("ten bases\nn = 40", labels)
        self.assertEqual(6, len(labels))
    def test_are_drawn_by_a_command(self) -> None:
        command = [sys.executable, "-B", "-m", "lore.plot"]
        done = subprocess.run([*command, PAPER, "--out", self.scratch / "out", "--formats", "png"], capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.scratch / "out" / "figure6.png").read_bytes()[:4], b"\x89PNG")
        failed = subprocess.run(
            [*command, self.scratch / "nowhere", "--out", self.scratch], capture_output=True, text=True
        )
        self.assertEqual(failed.returncode, 2)
        self.assertEqual(failed.stderr.count("\n"), 1)
        self.assertIn("nowhere", failed.stderr)

    def test_damaged_tables_are_named(self) -> None:
        copy = self.scratch / "report"
        shutil.copytree(PAPER, copy)
        for name, draw in [
            ("curves.csv", plot.figure3),
            ("final.csv", plot.figure4),
            ("pvalues.csv", plot.figure4),
            ("replay.csv", plot.figure5),
            ("values.csv", plot.figure6),
            ("scene.json", plot.figure5),
            ("summary.json", plot.figure3),
        ]:
            whole = (copy / name).read_bytes()
            (copy / name).write_bytes(whole[: len(whole) // 2])
            self.expect_damaged(lambda: draw(lore.Report(copy)), copy / name)
            (copy / name).write_bytes(whole.replace(b"0", b"?"))
            self.expect_damaged(lambda: draw(lore.Report(copy)), copy / name)
            (copy / name).write_bytes(whole)
        (copy / "scene.json").write_text('{"replays": [{"run": "source/001", "scene": {"walls": 1}}], "panels": []}')
        self.expect_damaged(lambda: plot.figure5(copy), copy / "scene.json", "it does not describe replays")


if __name__ == "__main__":
    unittest.main()
