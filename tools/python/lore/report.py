"""The tables of a campaign's report (docs/manual/formats.md)."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

from .errors import Damaged, FilePath
from .run import read_json
from .table import Table, parse_table, read_table, read_text

SOURCE = "source"  #: the treatment of the source task, where it has no name of its own


@dataclass(frozen=True, eq=False)
class Scene:
    """An arena and its task as pictures show them. Lengths in u, y downwards; rectangles are x0, x1, y0, y1."""

    size: NDArray[np.float64]  #: (2,), width and height
    walls: NDArray[np.float64]  #: (k, 4), without the door
    doors: NDArray[np.float64]  #: (k, 4), parts of one door
    balls: NDArray[np.float64]  #: (k, 2)
    balls_at_start: bool  #: False: each comes with a press of the switch
    basket: NDArray[np.float64]  #: (3,), x, y, radius
    basket_lights: NDArray[np.float64]  #: (k, 2)
    switch: NDArray[np.float64]  #: (2,)
    robot_radius: float


def _scene(document: dict[str, Any]) -> Scene:
    """Raises KeyError, TypeError or ValueError for what is no scene."""

    def numbers(value: Any, *shape: int) -> NDArray[np.float64]:
        array = np.array(value, np.float64)
        if not np.isfinite(array).all():
            raise ValueError("a length that is not finite")
        return array.reshape(shape)

    return Scene(
        numbers([document["width"], document["height"]], 2),
        numbers(document["walls"], -1, 4),
        numbers(document["doors"], -1, 4),
        numbers(document["balls"], -1, 2),
        bool(document["balls_at_start"]),
        numbers(document["basket"], 3),
        numbers(document["basket_lights"], -1, 2),
        numbers(document["switch"], 2),
        float(numbers(document["robot_radius"])),
    )


@dataclass(frozen=True, eq=False)
class WorldScene:
    """What pictures show of another world than an arena."""

    size: NDArray[np.float64]  #: (2,), width and height in its own unit of length; y downwards
    svg: str  #: elements in that unit, drawn below the path; may be empty
    reward_unit: str


def _world_scene(replay: dict[str, Any]) -> WorldScene:
    """Raises KeyError, TypeError or ValueError for what is no scene."""
    world = replay["world"]
    size = np.array([world["width"], world["height"]], np.float64)
    if not (np.isfinite(size).all() and (size > 0).all()):
        raise ValueError("a world without extent")
    return WorldScene(size, str(world["svg"]), str(replay["reward_unit"]))


class Report:
    """What `lore-campaign report` wrote: into the campaign's directory, or elsewhere by --out.

    Each table is read when it is asked for, and raises Damaged or FileNotFoundError (docs/manual/formats.md has their
    columns; runs, planned, matrix, replay, values and scene.json are not in every report).
    """

    path: str

    def __init__(self, path: FilePath) -> None:
        """Raises FileNotFoundError where no report is."""
        self.path = os.fspath(path)
        with open(self._file("final.csv"), encoding="utf-8", errors="replace") as file:
            columns = file.readline().rstrip("\r\n").split(",")
        #: "balls", or "reward" where a run's reward has another unit: in the names of columns
        self.reward_word = "reward" if "reward" in columns else "balls"

    def __repr__(self) -> str:
        return f"<Report {self.path}>"

    @property
    def final(self) -> Table:
        """A row a finished run: treatment, run, seed, balls of its best-of-run; of another unit than balls reward and
        unit."""
        return self._table("final.csv", treatment="text", run="int", seed="seed", balls="int")

    @property
    def reward_unit(self) -> str:
        """Of the (first) target task; of the source task as long as no target run is finished."""
        if self.reward_word == "balls":
            return "balls"
        final = self.final
        targets = final["unit"][~np.isin(final["treatment"], self.sources)]
        return str((targets if len(targets) else final["unit"])[0])

    @property
    def sources(self) -> list[str]:
        """The treatments of the source tasks."""
        if not os.path.exists(self._file("summary.json")):
            return [SOURCE]
        return [str(name) for name in self.summary.get("sources", [SOURCE])]

    @property
    def tasks(self) -> dict[str, list[str]]:
        """The treatments of each target task, in the order of figures; empty where the campaign names no tasks."""
        tasks: dict[str, list[str]] = {}
        if os.path.exists(self._file("summary.json")):
            for entry in self.summary.get("treatments", []):
                if "target" in entry:
                    tasks.setdefault(str(entry["target"]), []).append(str(entry["treatment"]))
        return tasks

    @property
    def pools(self) -> dict[str, list[str]]:
        """The treatments of each pool."""
        if not os.path.exists(self._file("summary.json")):
            return {}
        return {str(entry["pool"]): entry["treatments"] for entry in self.summary.get("pools", [])}

    def members(self, name: str) -> list[str]:
        """The treatments of a pool; of a treatment itself."""
        return self.pools.get(name, [name])

    def shown(self, task: str | None = None) -> list[str]:
        """The names of treatments and pools that figures 3 and 4 show, of one of `tasks` or of all, whether or not they
        have finished runs: the place gives the color."""
        treatments = list(self._treatments())
        summary = self.summary if os.path.exists(self._file("summary.json")) else {}
        names = [str(name) for name in summary.get("figure3", [])]
        targets = self.tasks[task] if task is not None else [name for name in treatments if name not in self.sources]
        return [name for name in names or treatments if any(member in targets for member in self.members(name))]

    @property
    def runs(self) -> Table:
        """The columns of `final`, then generations, evaluations, signature, version."""
        return self._table("runs.csv", treatment="text", run="int", seed="seed", balls="int", generations="int",
                           evaluations="int", signature="text", version="text")  # fmt: skip

    @property
    def curves(self) -> Table:
        """treatment (or a pool that figure 3 shows), generation, runs, mean of the best-of-runs [reward unit], low,
        high (95 % bootstrap band)."""
        return self._table("curves.csv", treatment="text", generation="int", runs="int", mean="float", low="float",
                           high="float")  # fmt: skip

    @property
    def population(self) -> Table:
        """What populations are like: a row a treatment and generation (0, 1, 2, 5, 10, 20, 50 and so on)."""
        return self._table("population.csv", treatment="text", generation="int", runs="int", mean_balls="float",
                           fronts="float", tied="float", best_shaping="float", shaping_at_max="float")  # fmt: skip

    @property
    def knowledge(self) -> Table:
        """A row a knowledge base (kbs.csv)."""
        return self._table("kbs.csv", knowledge="text", kind="text", source_run="int", seed="seed", balls="int",
                           features="int", least_value="float", greatest_value="float")  # fmt: skip

    @property
    def comparisons(self) -> Table:
        """A row a pair of treatments (pvalues.csv): a, b, n_a, n_b, u, p, p_holm, a12."""
        return self._table("pvalues.csv", a="text", b="text", n_a="int", n_b="int", u="float", p="float",
                           p_holm="float", a12="float")  # fmt: skip

    @property
    def planned(self) -> Table:
        """A row a comparison of pools (pools.csv): the same, a12_low, a12_high."""
        return self._table("pools.csv", a="text", b="text", n_a="int", n_b="int", u="float", p="float",
                           p_holm="float", a12="float", a12_low="float", a12_high="float")  # fmt: skip

    @property
    def matrix(self) -> Table:
        """A row a source and target task of a campaign with [transfer] (matrix.csv); numbers are nan where `why` says
        why there are none."""
        numbers = ("generation", "n", "n_none", "mean", "mean_none", "difference", "difference_low", "difference_high",
                   "a12", "a12_low", "a12_high", "p", "p_holm")  # fmt: skip
        return self._with_gaps("matrix.csv", numbers, source="text", target="text", why="text")

    @property
    def replay(self) -> Table:
        """The robots of figures 5 and 6 and of the page, a row a step; in other worlds than an arena replay, step, x, y
        and reward."""
        if "theta" not in read_text(self._file("replay.csv")).split("\n", 1)[0].split(","):
            return self._table("replay.csv", replay="text", step="int", x="float", y="float", reward="float")
        columns = {"replay": "text", "step": "int", "x": "float", "y": "float", "theta": "float", "carrying": "int",
                   "door_open": "int", "switch_on": "int", "balls_mask": "int", "collected": "int"}  # fmt: skip
        return read_table(self._file("replay.csv"), columns)  # balls whatever the reward's unit is

    @property
    def values(self) -> Table:
        """The values of figures 5 and 6, a row a whole window: figure, knowledge, window, value. One that is not found
        is nan; in arenas of files made before 1.0.0, whose panels are not among window_lengths, -1, or 0 of a product.
        """
        return self._with_gaps("values.csv", ("value",), figure="text", knowledge="text", window="int")

    @property
    def window_lengths(self) -> dict[tuple[str, str], int]:
        """Steps of a window, by figure and knowledge. Files made before 1.0.0 do not have them."""
        document = read_json(self._file("scene.json"))
        try:
            lengths = {
                (str(panel["figure"]), str(panel["knowledge"])): int(panel["window_length"])
                for panel in document["panels"]
                if "window_length" in panel
            }
            if any(length < 1 for length in lengths.values()):
                raise ValueError("a window without length")
        except (KeyError, TypeError, ValueError) as error:
            raise Damaged(self._file("scene.json"), f"it does not describe panels: {error!r}") from error
        return lengths

    @property
    def scenes(self) -> dict[str, Scene | WorldScene]:
        """By the name of the replay ("source/001"); the source run that figures 5 and 6 show comes first. All are
        arenas, or all are shown as worlds are."""
        document = read_json(self._file("scene.json"))
        try:
            return {
                str(replay["run"]): _world_scene(replay) if "world" in replay else _scene(replay["scene"])
                for replay in document["replays"]
            }
        except (KeyError, TypeError, ValueError) as error:
            raise Damaged(self._file("scene.json"), f"it does not describe replays: {error!r}") from error

    @property
    def summary(self) -> dict[str, Any]:
        """summary.json."""
        return read_json(self._file("summary.json"))

    @property
    def labels(self) -> dict[str, str]:
        """The label of each treatment, in the order of figures, the source's first, and pool; of a knowledge base
        whose name none of them has.

        Where summary.json is missing, the names of treatments serve as labels, in the order of final.csv.
        """
        labels = self._treatments()
        if not os.path.exists(self._file("summary.json")):
            return labels
        try:
            for entry in self.summary.get("pools", []):
                labels.setdefault(entry["pool"], entry["label"])
        except (KeyError, TypeError, AttributeError) as error:
            raise Damaged(self._file("summary.json"), f"it does not describe pools: {error!r}") from error
        for name, label in self.knowledge_labels.items():
            labels.setdefault(name, label)
        return labels

    @property
    def knowledge_labels(self) -> dict[str, str]:
        """The label of each knowledge base; empty where summary.json is missing."""
        if not os.path.exists(self._file("summary.json")):
            return {}
        try:
            bases = self.summary.get("knowledge", [])
            return {str(entry["knowledge"]): str(entry.get("label", entry["knowledge"])) for entry in bases}
        except (KeyError, TypeError, AttributeError) as error:
            raise Damaged(self._file("summary.json"), f"it does not describe knowledge: {error!r}") from error

    def _treatments(self) -> dict[str, str]:
        """The label of each treatment, in the order of figures."""
        if not os.path.exists(self._file("summary.json")):
            return {str(name): str(name) for name in dict.fromkeys(self.final["treatment"].tolist())}
        try:
            return {str(entry["treatment"]): str(entry["label"]) for entry in self.summary["treatments"]}
        except (KeyError, TypeError) as error:
            raise Damaged(self._file("summary.json"), f"it does not describe treatments: {error!r}") from error

    def _file(self, name: str) -> str:
        return os.path.join(self.path, name)

    def _with_gaps(self, name: str, numbers: Sequence[str], **columns: str) -> Table:
        """A table in which these columns may have empty fields, which are nan."""
        table = read_table(self._file(name), {**columns, **dict.fromkeys(numbers, "text")})
        arrays: dict[str, NDArray[Any]] = {column: table[column] for column in table}
        for column in numbers:
            fields = arrays[column]
            text = "\n".join([column, *fields[fields != ""], ""])
            numbers_there = parse_table(text, self._file(name), {column: "float"})
            arrays[column] = np.full(len(fields), np.nan)
            arrays[column][fields != ""] = numbers_there[column]
        return Table(arrays)

    def _table(self, name: str, **columns: str) -> Table:
        if self.reward_word != "balls":  # the tables of another unit say "reward" and have fractions
            columns = {
                key.replace("balls", "reward"): "float" if "balls" in key else kind for key, kind in columns.items()
            }
        return read_table(self._file(name), columns)
