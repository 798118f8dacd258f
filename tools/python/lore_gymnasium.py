"""Serves an environment of Gymnasium to Lore. Copy it and lore_world.py beside your program.

The configuration says ``process = ["python3", "mine.py"]`` in ``[world]``; mine.py is ::

    import gymnasium
    import lore_gymnasium

    lore_gymnasium.serve(lambda: gymnasium.make("Pendulum-v1"))

The rules are those of lore_world. This file does not import Gymnasium.
"""
from __future__ import annotations

from typing import Any, Callable, Sequence

import numpy as np
import numpy.typing as npt

import lore_world
from lore_world import WorldError

__all__ = ["serve"]

lore_world.of_lore.add(__file__)


def serve(
    make_env: Callable[..., Any],
    *,
    name: str = "",
    task: str = "default",
    reward_unit: str = "reward",
    seed: int = 0,
    sensors: Sequence[str] | None = None,
    effectors: Sequence[str] | None = None,
    position: Callable[[Any], tuple[float, float]] | None = None,
    size: tuple[float, float] = (1.0, 1.0),
    scene: str = "",
    max_batch: int = 64,
) -> None:
    """As :func:`lore_world.serve`, for an environment: ``serve(lambda: gymnasium.make("Pendulum-v1"))``.

    The settings are arguments of `make_env`, but for ``task`` (a name) and ``seed``, with which each life is reset, so
    that all lives are alike. A life is over where the environment terminates or truncates. A batch has an environment a
    life, `max_batch` at most. `position` gives a place within `size` from the unwrapped environment.

    ================================  =================================================================================
    observation                       sensors
    ================================  =================================================================================
    Box with bounds                   a continuous one a number: (value - low) / (high - low), clipped
    Box with a lower bound only       d / (1 + d), d the distance from it
    Box with an upper bound only      1 / (1 + d)
    Box without                       0.5 + 0.5 v / (1 + abs(v))
    Discrete(n), MultiBinary(n)       n binary ones: the value's is 1; as they are
    ================================  =================================================================================

    ================================  =================================================================================
    action                            effectors
    ================================  =================================================================================
    Box, with bounds                  a continuous one a number: low + effector (high - low)
    Discrete(2)                       a binary one
    Discrete(n)                       n continuous ones: the action is that of the largest, of equal ones the first
    MultiBinary(n)                    n binary ones
    ================================  =================================================================================
    """

    def make(task: str = task, seed: int = seed, **settings: Any) -> _GymnasiumLife:
        life = _GymnasiumLife(make_env(**settings), seed, sensors, effectors, position)
        life.task, life.reward_unit, life.max_batch = task, reward_unit, max_batch
        life.name = name or life.name
        life.width, life.height = size
        life.scene = lambda: scene
        return life

    lore_world.serve(make)


class _GymnasiumLife:
    """An environment as a life. Spaces are known by the names of their classes, so that Gymnasium is not imported."""

    def __init__(
        self,
        env: Any,
        seed: int,
        sensors: Sequence[str] | None,
        effectors: Sequence[str] | None,
        position: Callable[[Any], tuple[float, float]] | None,
    ) -> None:
        self._env, self._seed, self._position = env, seed, position
        kinds, self._observe = _observer(env.observation_space)
        self.sensors = _named(sensors, kinds, "sensor")
        kinds, self._action = _actor(env.action_space)
        self.effectors = _named(effectors, kinds, "effector")
        spec = getattr(env, "spec", None)
        self.name = "".join(c if c.isalnum() else "_" for c in spec.id.lower()) if spec else type(env).__name__.lower()
        self.task, self.reward_unit, self.max_batch = "default", "reward", 64
        self.width, self.height = 1.0, 1.0
        self.scene: Callable[[], str] = str

    def reset(self) -> tuple[list[float], tuple[float, float]]:
        observation, _ = self._env.reset(seed=self._seed)
        return self._observe(observation), self._place()

    def step(self, effectors: list[float]) -> tuple[list[float], float, bool, tuple[float, float]]:
        observation, reward, terminated, truncated, _ = self._env.step(self._action(effectors))
        return self._observe(observation), float(reward), bool(terminated or truncated), self._place()

    def _place(self) -> tuple[float, float]:
        return (0.0, 0.0) if self._position is None else self._position(self._env.unwrapped)


def _named(names: Sequence[str] | None, kinds: list[type], kind: str) -> dict[str, type]:
    names = [f"{kind}_{i}" for i in range(len(kinds))] if names is None else list(names)
    if len(names) != len(kinds):
        raise WorldError(f"{len(names)} names of {kind}s are given, and the environment has {len(kinds)}")
    return dict(zip(names, kinds))


def _observer(space: Any) -> tuple[list[type], Callable[[Any], list[float]]]:
    """Sensors of an observation space, float or bool each, and what makes their values of an observation."""
    kind = type(space).__name__
    if kind == "Box":
        low, high = _bounds(space)
        return [float] * low.size, lambda value: _to_unit(value, low, high)
    if kind == "Discrete":
        return [bool] * int(space.n), lambda value: [float(value - space.start == i) for i in range(int(space.n))]
    if kind == "MultiBinary":
        return [bool] * int(np.prod(space.shape)), lambda value: [float(each) for each in np.ravel(value)]
    raise WorldError(f"observations of the space {kind} are not mapped to sensors; wrap the environment")


def _actor(space: Any) -> tuple[list[type], Callable[[list[float]], Any]]:
    """Effectors of an action space, and what makes an action of their values."""
    kind = type(space).__name__
    if kind == "Box":
        low, high = _bounds(space)
        if not (np.isfinite(low) & np.isfinite(high)).all():
            raise WorldError("the space of actions has no bounds; wrap the environment")
        return [float] * low.size, lambda values: (low + values * (high - low)).reshape(space.shape).astype(space.dtype)
    if kind == "Discrete" and int(space.n) == 2:
        return [bool], lambda values: int(space.start + (values[0] > 0.5))
    if kind == "Discrete":
        return [float] * int(space.n), lambda values: int(space.start + np.argmax(values))
    if kind == "MultiBinary":
        return [bool] * int(np.prod(space.shape)), lambda values: np.array(values).reshape(space.shape).astype(np.int8)
    raise WorldError(f"effectors are not mapped to actions of the space {kind}; wrap the environment")


def _bounds(space: Any) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Of a Box, flat. Some environments write the largest float where there is no bound."""
    low, high = np.asarray(space.low, np.float64).ravel(), np.asarray(space.high, np.float64).ravel()
    return np.where(low < -1e30, -np.inf, low), np.where(high > 1e30, np.inf, high)


def _to_unit(values: Any, low: npt.NDArray[np.float64], high: npt.NDArray[np.float64]) -> list[float]:
    """As the table of serve says."""
    value = np.asarray(values, np.float64).ravel()
    with np.errstate(all="ignore"):  # formulas that are not taken meet infinities
        above, below = np.maximum(value - low, 0), np.maximum(high - value, 0)
        linear = np.where(high > low, above / (high - low), 0)
        free = 0.5 + 0.5 * value / (1 + abs(value))
        kinds = [np.isfinite(low) & np.isfinite(high), np.isfinite(low), np.isfinite(high)]
        unit_values = np.select(kinds, [linear, above / (1 + above), 1 / (1 + below)], free)
    return [float(each) for each in np.clip(unit_values, 0, 1)]
