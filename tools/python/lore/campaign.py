"""The directory of a campaign (docs/manual/formats.md)."""
from __future__ import annotations

import os

import numpy as np

from .errors import FilePath
from .knowledge import KnowledgeBase
from .report import SOURCE, Report
from .run import Run
from .table import Table, stacked


class Campaign:
    """Many runs that belong together: DIR/runs/TREATMENT/NNN, knowledge bases, perhaps a report."""

    path: str

    def __init__(self, path: FilePath) -> None:
        """Raises FileNotFoundError where no campaign is."""
        self.path = os.fspath(path)
        os.listdir(os.path.join(self.path, "runs"))

    def __repr__(self) -> str:
        return f"<Campaign {self.path}>"

    @property
    def treatments(self) -> list[str]:
        """Those that have runs: one called "source" first, then by name."""
        runs = os.path.join(self.path, "runs")
        folders = (entry.name for entry in os.scandir(runs) if entry.is_dir())
        names = [name for name in folders if name != "archive" and self._numbers(name)]
        return sorted(names, key=lambda name: (name != SOURCE, name))

    def runs(self, treatment: str) -> dict[int, Run]:
        """By their number, those that have begun. Raises Damaged, FileNotFoundError for a treatment without runs."""
        return {number: self.run(treatment, number) for number in self._numbers(treatment)}

    def run(self, treatment: str, number: int) -> Run:
        """Raises Damaged, FileNotFoundError."""
        return Run(os.path.join(self.path, "runs", treatment, f"{number:03}"))

    def status(self) -> Table:
        """A row a run: treatment, run, seed, status, generation, generations, best_balls (where any run has
        another unit: best_reward), best, signature.

        Raises Damaged.
        """
        found = [
            (treatment, number, run.manifest)
            for treatment in self.treatments
            for number, run in self.runs(treatment).items()
        ]
        rows = [
            (name, number, of.seed, of.status, of.generation, of.generations, of.best_reward, of.best, of.signature)
            for name, number, of in found
        ]
        counted = all(of.world.get("reward_unit", "balls") == "balls" for _, _, of in found)
        best, kind = ("best_balls", np.int64) if counted else ("best_reward", np.float64)
        names = ["treatment", "run", "seed", "status", "generation", "generations", best, "best", "signature"]
        kinds = [np.str_, np.int64, np.uint64, np.str_, np.int64, np.int64, kind, np.str_, np.str_]
        return Table(
            {name: np.array([row[i] for row in rows], kind) for i, (name, kind) in enumerate(zip(names, kinds))}
        )

    def progress(self, unfinished: bool = False) -> Table:
        """progress.csv of all finished runs, tidy: a row a treatment, run and generation, with the run's seed.

        Columns: treatment, run, seed, then those of progress.csv that all of the runs have. With `unfinished` also of
        runs under way, as far as they are. Raises Damaged.
        """
        tables = []
        for treatment in self.treatments:
            for number, run in self.runs(treatment).items():
                manifest = run.manifest
                if manifest.status != "done" and not unfinished:
                    continue
                try:
                    progress = run.progress()
                except FileNotFoundError:  # a run that has just begun
                    continue
                rows = len(progress)
                tables.append(Table({
                    "treatment": np.full(rows, treatment),
                    "run": np.full(rows, number, np.int64),
                    "seed": np.full(rows, manifest.seed, np.uint64),
                    **{name: progress[name] for name in progress},
                }))  # fmt: skip
        return stacked(tables)

    @property
    def knowledge(self) -> list[str]:
        """Names of the knowledge bases that are there."""
        place = os.path.join(self.path, "knowledge")
        files = os.listdir(place) if os.path.isdir(place) else []
        return sorted(file.removesuffix(".lorekb") for file in files if file.endswith(".lorekb"))

    def knowledge_base(self, name: str) -> KnowledgeBase:
        """Raises Damaged, FileNotFoundError."""
        return KnowledgeBase(os.path.join(self.path, "knowledge", f"{name}.lorekb"))

    @property
    def report(self) -> Report:
        """Raises FileNotFoundError where it was not made, or made elsewhere."""
        return Report(self.path)

    def _numbers(self, treatment: str) -> list[int]:
        place = os.path.join(self.path, "runs", treatment)
        return sorted(
            int(name)
            for name in os.listdir(place)
            if name.isdecimal() and os.path.exists(os.path.join(place, name, "manifest.json"))
        )
