"""Knowledge bases (*.lorekb), mapped as they lie in the file: nothing is copied, and processes share the memory."""
from __future__ import annotations

import json
import math
import os
import struct
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .channels import BINARY, CHANNELS, EFFECTORS, SENSORS
from .container import map_payload
from .errors import Damaged, FilePath

_PREAMBLE = struct.Struct("<2If3I3Q16x")
_CONTRAST = struct.Struct("<2Qd")
_CONTRAST_OF_LAYOUT_2 = struct.Struct("<2QI4x")
_ALIGNMENT = 64
_LAYOUT = 3
_LONGEST_WINDOW = 4000
_MOST_FEATURES = 1 << 30
_MOST_GAMMAS = 16
_RETURNS, _CREDIT, _CONTRAST_PART = 1, 2, 4
_MOST_CHANNELS = 80


@dataclass(frozen=True)
class Returns:
    """Discounted returns of the windows that matched a feature."""

    gammas: NDArray[np.float64]  #: (G,), discounts a step, increasing, each in (0, 1)
    showings: NDArray[np.uint64]  #: (n,), windows that matched it
    sums: NDArray[np.float64]  #: (G, n) [reward unit], sum of the discounted returns over the showings

    def why_invalid(self) -> str:
        """A number outside its range, told as a reason; "" if there is none."""
        gammas = self.gammas
        if not (gammas.min() > 0 and gammas.max() < 1 and np.all(np.diff(gammas) > 0)):
            return "its gammas are no increasing discounts"
        if self.showings.size and self.showings.min() == 0:
            return "a feature that nobody showed"
        return "" if _all_finite(self.sums) else "a feature's evidence is not finite"


@dataclass(frozen=True)
class Credit:
    """Pairs of parent and child in which the child alone showed a feature."""

    news: NDArray[np.uint32]  #: (n,), such pairs
    gain_sums: NDArray[np.float64]  #: (n,) [reward unit], sum of the child's reward less the parent's

    def why_invalid(self) -> str:
        """As Returns.why_invalid."""
        return "" if _all_finite(self.gain_sums) else "a feature's evidence is not finite"


@dataclass(frozen=True)
class Contrast:
    """Individuals with enough reward against contemporaries with less."""

    success_reward: float  #: so much makes a success [reward unit]
    successes: int
    failures: int
    successes_that_showed: NDArray[np.uint32]  #: (n,)
    failures_that_showed: NDArray[np.uint32]  #: (n,)

    def why_invalid(self) -> str:
        """As Returns.why_invalid."""
        if not math.isfinite(self.success_reward):
            return "the reward of its successes is not finite"
        shown = ((self.successes_that_showed, self.successes), (self.failures_that_showed, self.failures))
        too_many = any(those.size and those.max() > everyone for those, everyone in shown)
        return "a feature that more have shown than there were" if too_many else ""


class KnowledgeBase:
    """n behavioral features, each a window of T steps and C channels, and what those who showed them earned.

    All arrays are read-only views of the mapped file, numbered by feature in the order in which they were first met.
    The file may be replaced meanwhile, as Lore does it, but whoever shortens it ends the process (SIGBUS).
    """

    path: str
    window_length: int  #: T [steps]
    channels: tuple[str, ...]  #: names of the C channels, sensors first
    continuous_channels: tuple[int, ...]  #: places in `channels` of those with any value between 0 and 1
    binary_channels: tuple[int, ...]  #: places in `channels` of those that are 0 or 1
    reward_unit: str  #: "balls"
    match_threshold: float  #: a window nearer than this to a feature matches it [L2]
    values: NDArray[np.float64]  #: (n,) [reward unit] by the rule `mean`
    reward_sums: NDArray[np.float64]  #: (n,) [reward unit], of the individuals that showed it
    counts: NDArray[np.uint32]  #: (n,), individuals that showed it, at least 1
    continuous: NDArray[np.float32]  #: (n, T, len(continuous_channels)), in [0, 1]
    #: (n, T, words), or (n, T) if one word holds all channels; bit i % 16 of word i // 16 is channel binary_channels[i]
    binary: NDArray[np.uint16]
    returns: Returns | None  #: None where the build did not gather it; likewise the next two
    credit: Credit | None
    contrast: Contrast | None
    provenance: dict[str, Any]  #: as `lore-kb info --json` shows it

    def __init__(self, path: FilePath, check: bool = True) -> None:
        """Maps the file and checks it whole: header, lengths, checksum, and that every number is in its range.

        `check=False` leaves out what reads the whole file (some 8 s a gigabyte): a changed byte then goes unnoticed.
        Raises Damaged, FileNotFoundError.
        """
        self.path = os.fspath(path)
        payload = map_payload(path, "knowledge base", check)
        try:
            self._lay_out(payload)
        except (struct.error, ValueError, RecursionError) as error:  # what is no UTF-8 or no JSON is a ValueError
            raise Damaged(path, str(error)) from error
        if check and (why := self._why_invalid()):
            raise Damaged(path, why)

    def __len__(self) -> int:
        return len(self.values)

    def __repr__(self) -> str:
        return f"<KnowledgeBase {self.path}: {len(self)} features of {self.window_length} steps>"

    def windows(self, features: Any = slice(None)) -> NDArray[np.float32]:
        """The windows of some features (a number, slice or array of them), put together: a copy.

        Shape (m, T, C), or (T, C) for one number; channels as `channels`, as `lore-kb export --npy` writes them.
        """
        continuous = self.continuous[features]
        words = self.binary[features].reshape(*continuous.shape[:-1], (len(self.channels) + 15) // 16)
        windows = np.empty((*continuous.shape[:-1], len(self.channels)), np.float32)
        windows[..., self.continuous_channels] = continuous
        for bit, channel in enumerate(self.binary_channels):
            windows[..., channel] = words[..., bit // 16] >> bit % 16 & 1
        return windows

    def _lay_out(self, payload: NDArray[np.uint8]) -> None:
        """Finds the arrays in the payload (docs/manual/formats.md). Raises ValueError with the reason."""
        preamble = _PREAMBLE.unpack(payload[: _PREAMBLE.size].tobytes())
        layout, steps, threshold, binary, continuous, gammas, features, provenance_bytes, evidence = preamble
        if layout > _LAYOUT:
            raise ValueError(f"written by a newer Lore: layout {layout}, this one reads {_LAYOUT}")
        if layout == 0:
            raise ValueError("its layout is unknown")
        if layout == 1:
            gammas = evidence = 0
        if evidence >= 8 or gammas > _MOST_GAMMAS or (gammas > 0) != (evidence & _RETURNS != 0):
            raise ValueError("its evidence is of no known kind")
        if not 2 <= binary + continuous <= _MOST_CHANNELS:
            raise ValueError(f"it has {binary} binary and {continuous} continuous channels")
        if not 1 <= steps <= _LONGEST_WINDOW:
            raise ValueError(f"a window length of {steps} steps")
        if not (threshold > 0 and math.isfinite(threshold)):
            raise ValueError(f"a match threshold of {threshold}")
        if features > _MOST_FEATURES:
            raise ValueError(f"{features} features do not fit its length")
        self.window_length, self.match_threshold = steps, threshold

        at = _PREAMBLE.size

        def take(kind: Any, *shape: int) -> NDArray[Any]:
            nonlocal at
            first, size = at, math.prod(shape) * np.dtype(kind).itemsize
            at = first + (size + _ALIGNMENT - 1) // _ALIGNMENT * _ALIGNMENT
            if at > len(payload):
                raise ValueError(f"{features} features do not fit its length")
            array: NDArray[Any] = payload[first : first + size].view(kind).reshape(shape)
            return array

        self.values, self.reward_sums = take("<f8", features), take("<f8", features)
        self.counts = take("<u4", features)
        words = (binary + continuous + 15) // 16
        self.continuous = take("<f4", features, steps, continuous)
        self.binary = take("<u2", features, steps, words) if words > 1 else take("<u2", features, steps)
        self.returns = self.credit = self.contrast = None
        if evidence & _RETURNS:
            self.returns = Returns(take("<f8", gammas), take("<u8", features), take("<f8", gammas, features))
        if evidence & _CREDIT:
            self.credit = Credit(take("<u4", features), take("<f8", features))
        if evidence & _CONTRAST_PART:
            totals = _CONTRAST_OF_LAYOUT_2 if layout == 2 else _CONTRAST
            successes, failures, reward = totals.unpack(take(np.uint8, totals.size).tobytes())
            self.contrast = Contrast(reward, successes, failures, take("<u4", features), take("<u4", features))
        if at + provenance_bytes != len(payload):
            raise ValueError(f"{features} features do not fit its length")
        self.provenance = _provenance(payload[at:].tobytes(), layout)
        self._name_channels(self.provenance["world"])
        if (binary, continuous) != (len(self.binary_channels), len(self.continuous_channels)):
            raise ValueError(f"it has {binary} binary and {continuous} continuous channels, its world others")

    def _name_channels(self, world: dict[str, Any]) -> None:
        """From a world's description. Raises ValueError."""
        try:
            self.channels = tuple(map(str, [*world["sensors"], *world["effectors"]]))
            binary = set(world["binary"])
            self.reward_unit = str(world.get("reward_unit", ""))
        except (KeyError, TypeError) as error:
            raise ValueError(f"its world cannot be understood: {error}") from error
        self.binary_channels = tuple(i for i, name in enumerate(self.channels) if name in binary)
        self.continuous_channels = tuple(i for i, name in enumerate(self.channels) if name not in binary)

    def _why_invalid(self) -> str:
        """The first number outside its range, told as a reason; "" if there is none. Takes no memory."""
        if len(self) == 0:
            return ""
        # Comparisons with NaN are false.
        if self.continuous.size and not (self.continuous.min() >= 0 and self.continuous.max() <= 1):
            return "a window's value is not in 0 .. 1"
        words = self.binary.reshape(len(self), self.window_length, -1)
        for word in range(words.shape[-1]):
            known = max(0, min(16, len(self.binary_channels) - 16 * word))
            if words[..., word].max() >> known != 0:
                return "a window has unknown channels"
        if not (_all_finite(self.values) and _all_finite(self.reward_sums)):
            return "a feature's value is not finite"
        if self.counts.min() == 0:
            return "a feature that nobody exhibited"
        parts = (self.returns, self.credit, self.contrast)
        return next((why for part in parts if part is not None and (why := part.why_invalid())), "")


def _all_finite(numbers: NDArray[np.float64]) -> bool:
    if numbers.size == 0:
        return True
    return math.isfinite(numbers.min()) and math.isfinite(numbers.max())  # NaN passes through both


def _provenance(text: bytes, layout: int) -> dict[str, Any]:
    provenance = json.loads(text)
    if not isinstance(provenance, dict):
        raise ValueError("its provenance is no JSON object")
    if layout < 3:  # of collectball, and does not say so
        provenance["world"] = {
            "reward_unit": "balls",
            "sensors": list(SENSORS),
            "effectors": list(EFFECTORS),
            "binary": [CHANNELS[channel] for channel in BINARY],
        }
    world = provenance.get("world")
    if not isinstance(world, dict):
        raise ValueError("its provenance has no 'world'")
    best = f"best_{world.get('reward_unit', '')}"
    for key in ("made_by", "kind", "index", "sources", "derivation", "task", "individuals", "windows", best):
        if key not in provenance:
            raise ValueError(f"its provenance has no '{key}'")
    return provenance
