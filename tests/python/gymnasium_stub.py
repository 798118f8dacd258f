"""What lore_gymnasium uses of Gymnasium: spaces by the names of their classes, and an environment that draws at random."""
from __future__ import annotations

from typing import Any

import numpy as np


class Box:
    def __init__(self, low: Any, high: Any) -> None:
        self.low, self.high = np.array(low, np.float32), np.array(high, np.float32)
        self.shape, self.dtype = self.low.shape, np.dtype(np.float32)


class Discrete:
    def __init__(self, n: int, start: int = 0) -> None:
        self.n, self.start = np.int64(n), np.int64(start)


class MultiBinary:
    def __init__(self, n: Any) -> None:
        self.shape = (n,) if isinstance(n, int) else tuple(n)


class Text:
    """A space that is not mapped."""


class Spec:
    id = "Stub/Walk-v0"


class Walk:
    """A walker between -8 and 8, pushed about; the episode is cut after 40 steps."""

    spec = Spec()
    observation_space = Box([-8, -np.inf], [8, np.inf])
    action_space = Discrete(3)

    def __init__(self, slope: float = 0) -> None:
        self.slope = slope
        self.unwrapped = self

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[np.ndarray, dict[str, Any]]:
        self.draw = np.random.default_rng(seed)
        self.place, self.steps = float(self.draw.uniform(-1, 1)), 0
        return self.seen(), {}

    def step(self, action: int) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        self.place += action - 1 - self.slope * 0.1 + float(self.draw.normal(0, 0.1))
        self.steps += 1
        gone = abs(self.place) > 7.5
        self.place = min(8.0, max(-8.0, self.place))
        return self.seen(), 1.0, gone, self.steps >= 40, {}

    def seen(self) -> np.ndarray:
        return np.array([self.place, -self.place], np.float32)
