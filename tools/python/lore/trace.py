"""Traces: what a controller sensed and did, step by step, as lore-replay writes it."""
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .channels import EFFECTORS, SENSORS
from .errors import Damaged, FilePath
from .table import Table, read_table, read_text

_SENSOR_COLUMNS = [f"in{i}" for i in range(len(SENSORS))]
_EFFECTOR_COLUMNS = [f"a{i}" for i in range(len(EFFECTORS))]
_COLUMNS = {
    "step": "int",
    **dict.fromkeys(("x", "y", "theta", *_SENSOR_COLUMNS, *_EFFECTOR_COLUMNS), "float"),
    **dict.fromkeys(("carrying", "door_open", "balls_mask", "collected", "switch_on", "switch_timer"), "int"),
    **dict.fromkeys(("x_next", "y_next", "theta_next"), "float"),
}

#: Of other worlds, with as many sensors and effectors as there are.
_WORLD_COLUMNS = {"step": "int", **dict.fromkeys(("x", "y", "in0", "a0", "reward"), "float")}


def _numbered(table: Table, letter: str) -> list[str]:
    """in0, in1, ... as many as there are."""
    names: list[str] = []
    while f"{letter}{len(names)}" in table:
        names.append(f"{letter}{len(names)}")
    return names


class Trace(Table):
    """A row a step, with the columns of trace.csv (docs/manual/formats.md): those of an arena, or of another world."""

    @property
    def channels(self) -> NDArray[np.float32]:
        """(steps, channels): sensors, then effectors; of an arena (steps, 15), in the order of lore.CHANNELS."""
        names = [*_numbered(self, "in"), *_numbered(self, "a")]
        return np.stack([self[name].astype(np.float32) for name in names], axis=1)

    def windows(self, length: int) -> NDArray[np.float32]:
        """(m, length, channels): the windows of a knowledge base, one after the other, without the steps left over."""
        whole = len(self) // length
        return self.channels[: whole * length].reshape(whole, length, -1)


def read_trace(path: FilePath) -> Trace:
    """trace.csv, plain or gzip-compressed. Raises Damaged, FileNotFoundError."""
    header = read_text(path).partition("\n")[0].rstrip("\r").split(",")
    table = read_table(path, _WORLD_COLUMNS if "reward" in header and "theta" not in header else _COLUMNS)
    if len(table) == 0:
        raise Damaged(path, "it has a header but no row")
    return Trace({name: table[name] for name in table})
