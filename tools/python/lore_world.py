"""Serves a world in Python to Lore. One file that needs Python 3.11 and numpy: copy it beside your world.

The configuration says ``process = ["python3", "mine.py"]`` in ``[world]``; mine.py is ::

    import lore_world

    class Mine:
        name = "mine"                              # identifiers: lower-case letters, digits and '_'
        sensors = {"angle": float, "touch": bool}  # those of bool are 0 or 1; a list of names: all continuous
        effectors = ["torque"]

        def __init__(self, length=1.0): ...        # [world.settings] by name
        def reset(self): ...                       # a new life; gives its sensors
        def step(self, effectors): ...             # gives sensors, reward, over

    lore_world.serve(Mine)

**The rules.** Sensors and effectors lie in [0, 1]; rewards, positions and outcomes are finite. A life is a function of
the settings and of the effectors it was given, to the bit: ``reset`` leaves nothing of the life before, nothing is
drawn at random and no clock is read. Noise comes from a generator that ``reset`` seeds with a fixed number.
``lore-world check --config mine.toml`` tries all that.

**Printing** goes to standard error, from ``import lore_world`` on: import it first. An exception ends the run: its
traceback is printed, and Lore ends with a line that names the world, the step and the exception.
"""
from __future__ import annotations

import functools
import inspect
import os
import struct
import sys
import tomllib
import traceback
from typing import Any, Callable, Mapping, NamedTuple, Protocol, Sequence, Union

import numpy as np
import numpy.typing as npt

__all__ = ["WorldError", "serve", "serve_batches", "unit"]

Floats = npt.NDArray[np.float32]
Channels = Union[Mapping[str, type], Sequence[str]]

VERSION = 1  # of the frames: docs/manual/formats.md
of_lore = {__file__}  # files that no message points to; lore_gymnasium adds itself


def unit(value: float, low: float, high: float) -> float:
    """Where `value` lies between `low`, 0, and `high`, 1; clipped to that."""
    return min(1.0, max(0.0, (value - low) / (high - low)))


def serve(world: Callable[..., Any]) -> None:
    """Answers Lore by lives of `world`, a class or a function that makes one, until Lore has no more questions.

    An object of it is one life at a time:

    * ``reset()`` gives the sensors at the start of a life; ``step(effectors)``, of a list of floats, acts and gives
      ``sensors, reward, over``. Both may give a position ``(x, y)`` besides, last, in [0, width] x [0, height], for
      pictures: ``reset`` as ``(sensors, position)``. It is not called once a life is over.
    * ``name``, ``sensors``, ``effectors`` must be there; ``task`` ("default"), ``reward_unit`` ("reward"), ``width``
      and ``height`` (1), ``max_batch`` (256, the most lives at a time) may.
    * ``outcome()`` may be there: numbers that say how a life has ended, whose distance tells two lives apart. Without
      it they are the last sensors.
    * ``scene()`` may be there: one SVG element that pictures show behind the paths, y downwards.

    The settings are the arguments. A ValueError or TypeError that making it raises refuses the settings.
    """
    _Server(world, _LivesInTurn).run()


def serve_batches(world: Callable[..., Any]) -> None:
    """As :func:`serve`, for a world that steps many lives at a time in arrays, whose last axis is the life.

    ``reset(n)`` gives sensors [sensor][n], or ``(sensors, positions)`` with positions [2][n]; ``step(effectors)``, of
    [effector][n], gives ``sensors, rewards, over`` [n], and maybe positions; ``outcome()`` gives [number][n]. The rest
    is as for :func:`serve`. What a life that is over does further does not count.
    """
    _Server(world, _LivesTogether).run()


class WorldError(Exception):
    """A rule of this page is broken: told without a traceback, which would show this file only."""


class _Refused(Exception):
    """The settings are."""


class _Facts(NamedTuple):
    """What Lore is told of a world."""

    name: str
    task: str
    reward_unit: str
    sensors: list[tuple[str, bool]]
    effectors: list[tuple[str, bool]]
    outcome_size: int
    max_batch: int
    width: float
    height: float
    scene: str

    def payload(self) -> bytes:
        numbers = (VERSION, len(self.sensors), len(self.effectors), self.outcome_size, self.max_batch)
        channels = [struct.pack("<I", binary) + _text(name) for name, binary in self.sensors + self.effectors]
        return b"".join([struct.pack("<5I2f", *numbers, self.width, self.height), _text(self.name), _text(self.task),
                         _text(self.reward_unit), *channels, _text(self.scene)])  # fmt: skip


def _text(text: str) -> bytes:
    data = text.encode(errors="replace")
    return struct.pack("<I", len(data)) + data


def _floats(array: Floats) -> bytes:
    return array.astype("<f4", copy=False).tobytes()


def _channels(channels: Channels) -> list[tuple[str, bool]]:
    kinds = channels if isinstance(channels, Mapping) else dict.fromkeys(channels, float)
    if len(kinds) != len(channels):
        raise WorldError("two channels have one name")
    return [(str(name), kind is bool) for name, kind in kinds.items()]


class _Batch(Protocol):
    """Lives side by side, as the server asks them; arrays are [channel][n]."""

    sensors: Floats
    positions: Floats  # [2][n]
    over: npt.NDArray[np.uint8]

    def __init__(self, worlds: _Pool, sensor_count: int, n: int) -> None:
        ...

    def act(self, effectors: Floats) -> Floats:
        ...

    def outcome(self) -> Floats:
        ...

    def end(self) -> None:
        ...


class _Pool:
    """Objects of the world that serve one life after the other."""

    def __init__(self, make: Callable[[], Any]) -> None:
        self._make = make
        self._free: list[Any] = []

    def take(self) -> Any:
        return self._free.pop() if self._free else self._make()

    def give_back(self, world: Any) -> None:
        self._free.append(world)


class _LivesInTurn:
    """One object a life."""

    def __init__(self, worlds: _Pool, sensor_count: int, n: int) -> None:
        self._pool = worlds
        self._count = sensor_count
        self._lives = [worlds.take() for _ in range(n)]
        self._rows: list[Sequence[float]] = []
        self._places: list[Sequence[float]] = []
        self.over = np.zeros(n, np.uint8)
        for life in self._lives:
            given = life.reset()
            has_place = isinstance(given, tuple) and len(given) == 2 and np.ndim(given[0]) == 1
            sensors, place = given if has_place else (given, (0.0, 0.0))
            self._rows.append(self._checked(sensors, "reset"))
            self._places.append(place)
        self.sensors = np.array(self._rows, np.float32).T
        self.positions = np.array(self._places, np.float32).T

    def act(self, effectors: Floats) -> Floats:
        rewards, moved = [0.0] * len(self._lives), False
        for i, row in enumerate(effectors.T.tolist()):
            if self.over[i]:
                continue
            given = self._lives[i].step(row)
            if len(given) == 4:
                self._places[i], moved = given[3], True
            elif len(given) != 3:
                raise WorldError(f"step gave {len(given)} things, and not sensors, reward, over and maybe a position")
            self._rows[i] = self._checked(given[0], "step")
            rewards[i] = float(given[1])
            self.over[i] = bool(given[2])
        self.sensors = np.array(self._rows, np.float32).T
        if moved:
            self.positions = np.array(self._places, np.float32).T
        return np.array(rewards, np.float32)

    def outcome(self) -> Floats:
        if not hasattr(self._lives[0], "outcome"):
            return self.sensors
        return np.array([life.outcome() for life in self._lives], np.float32).T

    def end(self) -> None:
        for life in self._lives:
            self._pool.give_back(life)

    def _checked(self, sensors: Sequence[float], method: str) -> Sequence[float]:
        if len(sensors) != self._count:
            raise WorldError(f"{method} gave {len(sensors)} sensors, and the world has {self._count}")
        return sensors


class _LivesTogether:
    """One object a batch."""

    def __init__(self, worlds: _Pool, sensor_count: int, n: int) -> None:
        self._pool = worlds
        self._world = worlds.take()
        self.over, self._some_over = np.zeros(n, np.uint8), False
        given = self._world.reset(n)
        has_places = isinstance(given, tuple) and len(given) == 2 and np.ndim(given[0]) == 2
        sensors, positions = given if has_places else (given, np.zeros((2, n)))
        self.sensors = _array(sensors, (sensor_count, n), "the sensors of reset")
        self.positions = _array(positions, (2, n), "the positions of reset")
        self._outcome = self._outcome_now()

    def act(self, effectors: Floats) -> Floats:
        given = self._world.step(effectors)
        if len(given) not in (3, 4):
            raise WorldError(f"step gave {len(given)} things, and not sensors, rewards, over and maybe positions")
        rewards = self._kept(_array(given[1], self.over.shape, "the rewards of step"), np.float32(0))
        over = self._kept(_array(given[2], self.over.shape, "over of step") != 0, True)
        self.sensors = self._kept(_array(given[0], self.sensors.shape, "the sensors of step"), self.sensors)
        if len(given) == 4:
            self.positions = self._kept(_array(given[3], self.positions.shape, "the positions of step"), self.positions)
        if over.sum() > self.over.sum():
            self._outcome = self._kept(self._outcome_now(), self._outcome)
            self._some_over = True
            self.over = over.astype(np.uint8)
        return rewards

    def outcome(self) -> Floats:
        return self._kept(self._outcome_now(), self._outcome)

    def end(self) -> None:
        self._pool.give_back(self._world)

    def _kept(self, now: npt.NDArray[Any], before: Any) -> npt.NDArray[Any]:
        """What is now, of lives that go on; the others stay as they were."""
        return np.where(self.over == 0, now, before) if self._some_over else now

    def _outcome_now(self) -> Floats:
        outcome = self._world.outcome() if hasattr(self._world, "outcome") else self.sensors
        return np.array(outcome, np.float32)


def _array(values: Any, shape: tuple[int, ...], what: str) -> Floats:
    """A copy: a world may change its own array in the next step."""
    array = np.array(values, np.float32)
    if array.shape != shape:
        raise WorldError(f"{what}: the shape is {array.shape}, and not {shape}")
    return array


class _Wire:
    """The frames. From its making on, standard output is standard error and standard input is empty."""

    def __init__(self) -> None:
        self._source, self._sink = os.dup(0), os.dup(1)
        nothing = os.open(os.devnull, os.O_RDONLY)
        os.dup2(nothing, 0)
        os.close(nothing)
        os.dup2(2, 1)
        if hasattr(sys.stdout, "reconfigure"):
            sys.stdout.reconfigure(line_buffering=True)  # and writes what was printed before
        self._bytes = b""

    def read(self) -> tuple[str, int, bytes] | None:
        """Tag, batch and payload of the next question; None at the end."""
        if not self._fill(16):
            return None
        tag, batch, size = struct.unpack_from("<8sII", self._bytes)
        if not self._fill(16 + size):
            return None
        payload, self._bytes = self._bytes[16 : 16 + size], self._bytes[16 + size :]
        return tag.rstrip(b"\0").decode(), batch, payload

    def write(self, tag: str, batch: int, *parts: bytes) -> None:
        payload = b"".join(parts)
        rest = memoryview(struct.pack("<8sII", tag.encode(), batch, len(payload)) + payload)
        while rest:
            rest = rest[os.write(self._sink, rest) :]

    def _fill(self, size: int) -> bool:
        while len(self._bytes) < size:
            more = os.read(self._source, 1 << 16)
            if not more:
                return False
            self._bytes += more
        return True


class _Server:
    """Answers question after question."""

    def __init__(self, world: Callable[..., Any], kind: type[_Batch]) -> None:
        self._world = world
        self._kind = kind
        self._batches: dict[int, _Batch] = {}
        self._facts: _Facts | None = None

    def run(self) -> None:
        if _wire is None and sys.stdin is not None and sys.stdin.isatty():
            sys.exit("This is a world for Lore, which starts it: lore-world check --config FILE")
        self._wire = _wire or _Wire()
        answers = {"open": self._open, "begin": self._begin, "act": self._act, "outcome": self._tell_outcome,
                   "end": self._end}  # fmt: skip
        while (question := self._wire.read()) is not None:
            tag, batch, payload = question
            try:
                if tag not in answers:
                    raise WorldError(f"there is no question '{tag}'; take the lore_world.py of this Lore")
                answers[tag](batch, payload)
            except BrokenPipeError:
                return  # Lore has ended
            except _Refused as refused:
                self._wire.write("refused", batch, _reason(str(refused)))
            except Exception as error:
                if not isinstance(error, WorldError):
                    traceback.print_exc()
                sys.stderr.flush()
                self._wire.write("failure", batch, _reason(_told(error)))
                sys.exit(1)

    def _open(self, batch: int, payload: bytes) -> None:
        (version, size) = struct.unpack_from("<II", payload)
        if version != VERSION:  # Lore says which two versions do not fit
            self._wire.write("facts", batch, struct.pack("<I", VERSION))
            return
        settings = tomllib.loads(payload[8 : 8 + size].decode())
        make = functools.partial(self._world, **settings)
        try:
            _expect_known(self._world, settings)
            world = make()
        except (TypeError, ValueError) as error:
            raise _Refused(_told(error)) from error
        self._pool = _Pool(make)
        self._pool.give_back(world)
        self._facts = self._look_at(world)
        self._wire.write("facts", batch, self._facts.payload())

    def _look_at(self, world: Any) -> _Facts:
        for needed in ("name", "sensors", "effectors", "reset", "step"):
            if not hasattr(world, needed):
                raise WorldError(f"the world has no '{needed}'")
        sensors, effectors = _channels(world.sensors), _channels(world.effectors)
        trial = self._kind(self._pool, len(sensors), 1)
        outcome_size = len(trial.outcome())
        trial.end()
        return _Facts(
            world.name, getattr(world, "task", "default"), getattr(world, "reward_unit", "reward"), sensors, effectors,
            outcome_size, getattr(world, "max_batch", 256), getattr(world, "width", 1), getattr(world, "height", 1),
            world.scene() if hasattr(world, "scene") else "",
        )  # fmt: skip

    def _begin(self, batch: int, payload: bytes) -> None:
        assert self._facts is not None
        (n,) = struct.unpack("<I", payload)
        lives = self._batches[batch] = self._kind(self._pool, len(self._facts.sensors), n)
        self._wire.write("senses", batch, _floats(lives.sensors), _floats(lives.positions))

    def _act(self, batch: int, payload: bytes) -> None:
        lives = self._batches[batch]
        rewards = lives.act(np.frombuffer(payload, "<f4").reshape(-1, len(lives.over)))
        self._wire.write("results", batch, _floats(lives.sensors), _floats(lives.positions), _floats(rewards),
                         lives.over.tobytes())  # fmt: skip

    def _tell_outcome(self, batch: int, payload: bytes) -> None:
        self._wire.write("outcomes", batch, _floats(self._batches[batch].outcome()))

    def _end(self, batch: int, payload: bytes) -> None:
        self._batches.pop(batch).end()


def _expect_known(make: Callable[..., Any], settings: Mapping[str, Any]) -> None:
    """Refuses settings that `make` does not take, by a line that says which it does."""
    parameters = inspect.signature(make).parameters
    if any(parameter.kind is inspect.Parameter.VAR_KEYWORD for parameter in parameters.values()):
        return
    for key in settings:
        if key not in parameters:
            raise _Refused(f"it does not know '{key}'; it knows: {', '.join(parameters) or 'none'}")


def _told(error: BaseException) -> str:
    """An exception in one line, with the last line of the world's own that it passed."""
    text = str(error) if isinstance(error, WorldError) else f"{type(error).__name__}: {error}"
    own = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename not in of_lore]
    if isinstance(error, WorldError) or not own:
        return text
    return f"{text}, {os.path.basename(own[-1].filename)}:{own[-1].lineno} in {own[-1].name}"


def _reason(text: str) -> bytes:
    return _text(text[:500])


# Lore says so to the process of a world. What is printed from here on, by other modules that are imported too, is no
# answer; a process of this one is none.
_wire = _Wire() if os.environ.pop("LORE_WORLD_PROCESS", "") else None
