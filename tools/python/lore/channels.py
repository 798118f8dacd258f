"""The channels of collectball, in the order of traces, windows and networks; all values in [0, 1]."""
from __future__ import annotations

SENSORS = (
    "range_right", "range_left", "range_ahead", "ball_right", "ball_left", "basket_right", "basket_left",
    "switch_right", "switch_left", "bumper_right", "bumper_left", "carrying",
)  # fmt: skip
EFFECTORS = ("left_wheel", "right_wheel", "collect")
CHANNELS = SENSORS + EFFECTORS

#: Places in CHANNELS of those with any value between 0 and 1, and of those that are 0 or 1.
CONTINUOUS = (0, 1, 2, 12, 13, 14)
BINARY = (3, 4, 5, 6, 7, 8, 9, 10, 11)
