"""The directory of a run (docs/manual/formats.md)."""
from __future__ import annotations

import json
import math
import os
import tempfile
import tomllib
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .checksum import checksum_text, xxh3_64
from .errors import Damaged, FilePath
from .individuals import Individuals, Lineage
from .programs import run_program
from .table import Table, parse_table, read_text
from .trace import Trace, read_trace

_MANIFEST_FORMAT = 1
_PROGRESS_COLUMNS = {
    "generation": "int", "best_balls": "int", "mean_balls": "float", "distance": "text", "mean_diversity": "float",
    "best_shaping": "float", "mean_connections": "float", "mean_hidden": "float", "fronts": "int", "tied": "int",
    "shaping_at_max": "float", "evaluations": "int", "steps": "int", "seconds": "float",
}  # fmt: skip
_MANIFEST_FIELDS: dict[str, type] = {
    "format": int, "status": str, "name": str, "task": str, "seed": int, "generation": int, "generations": int,
    "signature": str, "best": str, "build": dict, "inputs": list, "outputs": list, "sessions": list,
}  # fmt: skip


@dataclass(frozen=True)
class Manifest:
    """Provenance of a run: manifest.json."""

    status: str  #: "running", "interrupted" or "done"
    name: str  #: of the treatment
    task: str
    seed: int
    generation: int  #: reached at the last stop, likewise the next three
    signature: str  #: 16 hexadecimal digits
    best: str  #: its id
    generations: int  #: asked for
    build: dict[str, Any]  #: version, commit, compiler, build_type, libraries
    inputs: list[dict[str, Any]]  #: files: role, path, bytes, xxh3_64
    outputs: list[dict[str, Any]]
    sessions: list[dict[str, Any]]  #: one a start
    best_reward: float  #: of the best-of-run, whole where balls are counted
    world: dict[str, Any]  #: name, task, reward_unit and channels; {} of runs by earlier versions, in an arena

    @property
    def best_balls(self) -> float:
        """best_reward, as files call it whose unit is balls."""
        return self.best_reward


def read_manifest(path: FilePath) -> Manifest:
    """Raises Damaged (no JSON, a field missing or of another type, a newer format), FileNotFoundError."""
    document = read_json(path)
    for field, kind in _MANIFEST_FIELDS.items():
        if field not in document:
            raise Damaged(path, f"there is no '{field}'")
        if not isinstance(document[field], kind) or isinstance(document[field], bool):
            raise Damaged(path, f"'{field}' is no {kind.__name__}")
    best = document["best_balls" if "best_balls" in document else "best_reward"] if _has_best(document) else None
    if isinstance(best, bool) or not isinstance(best, (int, float)) or not math.isfinite(best):
        raise Damaged(path, "it tells of no best reward")
    if not isinstance(document.get("world", {}), dict):
        raise Damaged(path, "'world' is no dict")
    for field in ("format", "seed", "generation", "generations"):
        if not 0 <= document[field] < 1 << (64 if field == "seed" else 31):
            raise Damaged(path, f"'{field}' is {document[field]}")
    if document["format"] > _MANIFEST_FORMAT:
        raise Damaged(path, f"written by a newer Lore: format {document['format']}, this one reads {_MANIFEST_FORMAT}")
    if document["status"] not in ("running", "interrupted", "done"):
        raise Damaged(path, f"unknown status '{document['status']}'")
    for file in document["inputs"] + document["outputs"]:
        if not (isinstance(file, dict) and {"role", "path", "bytes", "xxh3_64"} <= file.keys()):
            raise Damaged(path, "an input or output is not described")
    fields = {field: document[field] for field in _MANIFEST_FIELDS if field != "format"}
    return Manifest(**fields, best_reward=best, world=document.get("world", {}))


def _has_best(document: dict[str, Any]) -> bool:
    return "best_balls" in document or "best_reward" in document


def read_json(path: FilePath) -> dict[str, Any]:
    """A JSON object. Raises Damaged, FileNotFoundError."""
    try:
        document = json.loads(read_text(path))
    except (ValueError, RecursionError) as error:
        raise Damaged(path, f"it is no JSON: {error}") from error
    if not isinstance(document, dict):
        raise Damaged(path, "it is no JSON object")
    return document


def read_toml(path: FilePath) -> dict[str, Any]:
    """Raises Damaged, FileNotFoundError."""
    try:
        return tomllib.loads(read_text(path))
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise Damaged(path, f"it is no TOML: {error}") from error


def read_progress(path: FilePath) -> Table:
    """progress.csv: a row a generation, from 0. A last line that is still being written is left out.

    Raises Damaged, FileNotFoundError.
    """
    text = read_text(path)
    if "\n" not in text:
        raise Damaged(path, "there is no header")
    columns = _PROGRESS_COLUMNS
    if "best_reward" in text[: text.index("\n")].split(","):  # of another unit than balls
        columns = {"best_reward": "float", "mean_reward": "float"} | columns
        del columns["best_balls"], columns["mean_balls"]
    table = parse_table(text[: text.rindex("\n") + 1], path, columns)
    if not np.array_equal(table["generation"], np.arange(len(table))):
        line = int(np.argmax(table["generation"] != np.arange(len(table)))) + 2
        raise Damaged(path, f"line {line} is not of generation {line - 2}")
    return table


class Run:
    """A run of lore-evolve, finished or under way.

    Files that the manifest of a run that is not running lists are checked against its checksums when they are read.
    """

    path: str

    def __init__(self, path: FilePath) -> None:
        """Raises FileNotFoundError where no run is, Damaged for its manifest."""
        self.path = os.fspath(path)
        read_manifest(self._file("manifest.json"))

    def __repr__(self) -> str:
        return f"<Run {self.path}>"

    @property
    def manifest(self) -> Manifest:
        """As it is now. Raises Damaged, FileNotFoundError."""
        return read_manifest(self._file("manifest.json"))

    @property
    def config(self) -> dict[str, Any]:
        """Every setting in force: config["evolution"]["population"]. Raises Damaged, FileNotFoundError."""
        return read_toml(self._checked("config.toml"))

    @property
    def arena(self) -> dict[str, Any]:
        """The arena's file, of a run in an arena; lengths in u, y downwards. Other worlds have none. Raises Damaged,
        FileNotFoundError."""
        return read_toml(self._checked("arena.toml"))

    def progress(self) -> Table:
        """A row a generation. Raises Damaged, FileNotFoundError."""
        return read_progress(self._checked("progress.csv"))

    def lineage(self) -> Lineage:
        """All ancestors of the last population. Raises Damaged, FileNotFoundError (a run that never stopped has none;
        also where lore-kb is not found)."""
        return Lineage(self._checked("lineage.lore"))

    def everybody(self) -> Individuals:
        """Every individual ever evaluated, one after the other, of a run with `--archive all`. Raises likewise."""
        return Individuals(self._checked("all.lore"))

    def trace(self, individual: str = "best") -> Trace:
        """What an archived individual does, simulated again by lore-replay.

        Raises Damaged, FileNotFoundError, RuntimeError where there is no such individual.
        """
        with tempfile.TemporaryDirectory(prefix="lore-") as scratch:
            run_program("lore-replay", [self.path, "--individual", individual, "--out", scratch, "-q"], self.path)
            return read_trace(os.path.join(scratch, "trace.csv"))

    def _file(self, name: str) -> str:
        return os.path.join(self.path, name)

    def _checked(self, name: str) -> str:
        """The path of an output, once it is as the manifest lists it."""
        path = self._file(name)
        why = _difference(path, name, self.manifest)
        if why and (why := _difference(path, name, self.manifest)):  # it may have been resumed in between
            raise Damaged(path, why)
        return path


def _difference(path: str, name: str, manifest: Manifest) -> str:
    listed = next((file for file in manifest.outputs if file["path"] == name), None)
    if manifest.status == "running" or listed is None:
        return ""
    size = os.path.getsize(path)
    if size != listed["bytes"]:
        return f"it has {size} bytes, its manifest lists {listed['bytes']}"
    # Mapped: an archive of all may not fit into memory.
    data: NDArray[np.uint8] = np.memmap(path, np.uint8, "r") if size else np.empty(0, np.uint8)
    if checksum_text(xxh3_64(data)) != listed["xxh3_64"]:
        return "checksum mismatch: it is not as its manifest lists it"
    return ""
