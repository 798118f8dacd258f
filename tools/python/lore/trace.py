"""Traces: what a robot sensed and did, step by step, as lore-replay writes it."""
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .channels import CHANNELS, EFFECTORS, SENSORS
from .errors import Damaged, FilePath
from .table import Table, read_table

_SENSOR_COLUMNS = [f"in{i}" for i in range(len(SENSORS))]
_EFFECTOR_COLUMNS = [f"a{i}" for i in range(len(EFFECTORS))]
_COLUMNS = {
    "step": "int",
    **dict.fromkeys(("x", "y", "theta", *_SENSOR_COLUMNS, *_EFFECTOR_COLUMNS), "float"),
    **dict.fromkeys(("carrying", "door_open", "balls_mask", "collected", "switch_on", "switch_timer"), "int"),
    **dict.fromkeys(("x_next", "y_next", "theta_next"), "float"),
}


class Trace(Table):
    """A row a step, with the columns of trace.csv (docs/manual/formats.md)."""

    @property
    def channels(self) -> NDArray[np.float32]:
        """(steps, 15), in the order of lore.CHANNELS: 12 sensors, then 3 effectors."""
        return np.stack([self[name].astype(np.float32) for name in (*_SENSOR_COLUMNS, *_EFFECTOR_COLUMNS)], axis=1)

    def windows(self, length: int) -> NDArray[np.float32]:
        """(m, length, 15): the windows of a knowledge base, one after the other; the steps left over are left out."""
        whole = len(self) // length
        return self.channels[: whole * length].reshape(whole, length, len(CHANNELS))


def read_trace(path: FilePath) -> Trace:
    """trace.csv, plain or gzip-compressed. Raises Damaged, FileNotFoundError."""
    table = read_table(path, _COLUMNS)
    if len(table) == 0:
        raise Damaged(path, "it has a header but no row")
    return Trace({name: table[name] for name in table})
