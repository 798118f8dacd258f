"""Archived individuals with their genomes: the lineages of a run, everybody it evaluated, founders files.

The archives are Lore's own; `lore-kb individuals` tells what is in them as JSON Lines, and so do files that hold its
output, which need no program.
"""
from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass
from typing import Any, Iterator

import numpy as np
from numpy.typing import NDArray

from .container import is_container
from .errors import Damaged, FilePath
from .programs import output_lines
from .table import Table

_FORMAT = 1
GENE_SPAN, GENE_ORIGIN = np.float32(10), np.float32(-5)


@dataclass(frozen=True, eq=False)
class Genome:
    """A controller: a directed graph of neurons, numbered in the order inputs, outputs, hidden; of collectball 0 .. 11,
    12 .. 14, 15 and so on."""

    sources: NDArray[np.uint8]  #: (edges,), inputs or hidden
    targets: NDArray[np.uint8]  #: (edges,), outputs or hidden
    weight_genes: NDArray[np.float32]  #: (edges,), in [0, 1]
    bias_genes: NDArray[np.float32]  #: (outputs + hidden,), in [0, 1]

    @property
    def weights(self) -> NDArray[np.float32]:
        """As the network uses them, in [-5, 5]."""
        return self.weight_genes * GENE_SPAN + GENE_ORIGIN

    @property
    def biases(self) -> NDArray[np.float32]:
        """As the network uses them, in [-5, 5]; outputs first."""
        return self.bias_genes * GENE_SPAN + GENE_ORIGIN


@dataclass(frozen=True, eq=False)
class Individual:
    id: str  #: GENERATION.SLOT of its birth; "" in a founders file
    parent: str | None  #: None for founders
    #: of its evaluation, whole where balls are counted; None where the file does not say, likewise the next two
    reward: float | None
    shaping: float | None  #: largest value of the features it showed [reward unit], -1 without one
    diversity: float | None  #: in the joint ranking of the generation it was born in
    genome: Genome

    @property
    def balls(self) -> float | None:
        """The reward, as files call it whose unit is balls."""
        return self.reward

    @property
    def generation(self) -> int:
        """Of its birth. Raises ValueError for one without an id."""
        return int(self.id.partition(".")[0])


class Individuals:
    """The individuals of a file one after the other, in order of birth; memory does not grow with their number.

    Each time that they are gone through, they come from the first on, and the file is read again.

    `header` is the file's first line: format, kind, individuals (their number), and what docs/manual/formats.md lists
    for each kind of file.
    """

    header: dict[str, Any]

    def __init__(self, path: FilePath) -> None:
        """Of lineage.lore, all.lore, a founders file, failed-genome.lore, or a file with the output of
        `lore-kb individuals`. Raises Damaged, FileNotFoundError (also for lore-kb), RuntimeError."""
        self.path = os.fspath(path)
        self._opened: Iterator[str] | None = self._open()

    def __iter__(self) -> Iterator[Individual]:
        """Raises as the constructor does."""
        lines, self._opened = self._opened or self._open(), None
        expected, number = self.header["individuals"], 0
        for number, line in enumerate(lines, 1):
            document = self._parsed(line, number + 1)
            try:
                yield _individual(document)
            except (KeyError, TypeError, ValueError, OverflowError) as error:
                raise Damaged(self.path, f"line {number + 1} is damaged: {error}") from error
        if number != expected:
            raise Damaged(self.path, f"the file was cut: {number} individuals of {expected} are there")

    def _open(self) -> Iterator[str]:
        """Reads the header; the lines of the individuals follow."""
        stored = is_container(self.path) or os.path.getsize(self.path) == 0
        lines = output_lines("lore-kb", ["individuals", self.path], self.path) if stored else _lines_of(self.path)
        self.header = self._parsed(next(lines, ""), 1)
        if not isinstance(self.header.get("individuals"), int) or not isinstance(self.header.get("kind"), str):
            raise Damaged(self.path, "it is not the output of 'lore-kb individuals'")
        if self.header.get("format") != _FORMAT:
            raise Damaged(
                self.path, f"written by a newer Lore: format {self.header.get('format')}, this one reads {_FORMAT}"
            )
        return lines

    def _parsed(self, line: str, number: int) -> dict[str, Any]:
        try:
            document = json.loads(line)
        except (ValueError, RecursionError) as error:
            raise Damaged(self.path, f"line {number} is no JSON: {error}") from error
        if not isinstance(document, dict):
            raise Damaged(self.path, f"line {number} is no JSON object")
        return document


class Lineage:
    """All ancestors of a run's last population, in order of birth. Individuals are known by id or by place."""

    header: dict[str, Any]  #: as Individuals.header
    individuals: list[Individual]
    parents: NDArray[np.int64]  #: (n,), place of the parent, -1 for founders
    best: str  #: id of the best-of-run
    last_population: list[str]  #: ids
    generation: int  #: of the last population

    def __init__(self, path: FilePath) -> None:
        """Of lineage.lore, or the output of `lore-kb individuals` for it. Raises as Individuals does."""
        source = Individuals(path)
        self.header = source.header
        try:
            self.best = str(source.header["best"])
            self.last_population = [str(id) for id in source.header["last_population"]]
            self.generation = int(source.header["generation"])
        except (KeyError, TypeError, ValueError) as error:
            raise Damaged(path, f"it is no lineage archive, its kind is '{source.header['kind']}'") from error
        self.individuals = list(source)
        self._word = "reward" if "reward_unit" in source.header else "balls"
        if any(None in (one.reward, one.shaping, one.diversity) for one in self.individuals):
            raise Damaged(path, f"an individual without {self._word}, shaping or diversity")
        self._places = {one.id: place for place, one in enumerate(self.individuals)}
        try:
            places = [-1 if one.parent is None else self._places[one.parent] for one in self.individuals]
            _ = [self._places[id] for id in (self.best, *self.last_population)]
        except KeyError as error:
            raise Damaged(path, f"individual {error} is missing") from error
        self.parents = np.array(places, np.int64)

    def __len__(self) -> int:
        return len(self.individuals)

    def __getitem__(self, individual: str) -> Individual:
        """By id, or "best". Raises KeyError."""
        return self.individuals[self.place(individual)]

    def place(self, individual: str) -> int:
        """Of an id, or of "best", in `individuals`. Raises KeyError."""
        return self._places[self.best if individual == "best" else individual]

    def ancestors(self, individual: str = "best") -> list[Individual]:
        """From the individual to its founder, both included: the order of the paper's Algorithm 1. Raises KeyError."""
        place, line = self.place(individual), []
        while place >= 0:
            line.append(self.individuals[place])
            place = int(self.parents[place])
        return line

    def table(self) -> Table:
        """A row an individual: id, generation, parent ("" for founders), balls (of another unit: reward), shaping,
        diversity, connections, hidden."""
        everyone = self.individuals
        outputs = int(self.header.get("outputs", 3))
        return Table({
            "id": np.array([one.id for one in everyone], np.str_),
            "generation": np.array([one.generation for one in everyone], np.int64),
            "parent": np.array([one.parent or "" for one in everyone], np.str_),
            self._word: np.array([one.reward for one in everyone], np.int64 if self._word == "balls" else np.float64),
            "shaping": np.array([one.shaping for one in everyone], np.float64),
            "diversity": np.array([one.diversity for one in everyone], np.float64),
            "connections": np.array([len(one.genome.sources) for one in everyone], np.int64),
            "hidden": np.array([len(one.genome.bias_genes) - outputs for one in everyone], np.int64),
        })  # fmt: skip


def _lines_of(path: str) -> Iterator[str]:
    with open(path, encoding="utf-8", errors="strict") as file:
        try:
            yield from file
        except UnicodeDecodeError as error:
            raise Damaged(path, "it is no UTF-8 text") from error


def _individual(document: dict[str, Any]) -> Individual:
    edges = document["edges"]
    if not all(0 <= neuron <= 255 for source, target, _ in edges for neuron in (source, target)):  # older numpy wraps
        raise ValueError("a neuron that no network has")
    genome = Genome(
        np.array([source for source, _, _ in edges], np.uint8),
        np.array([target for _, target, _ in edges], np.uint8),
        np.array([gene for _, _, gene in edges], np.float32),
        np.array(document["biases"], np.float32),
    )
    for genes in (genome.weight_genes, genome.bias_genes):
        if genes.size and not (genes.min() >= 0 and genes.max() <= 1):
            raise ValueError("a gene that is not in 0 .. 1")
    if not 0 <= (document.get("balls") or 0) < 1 << 31:
        raise ValueError("a number of balls that no evaluation gives")
    if not math.isfinite(document.get("reward") or 0):
        raise ValueError("a reward that is not finite")
    balls = _typed(document.get("balls"), int, None)
    return Individual(
        _typed(document.get("id", ""), str),
        _typed(document.get("parent"), str, None),
        balls if "balls" in document else _typed(document.get("reward"), float, int, None),
        _typed(document.get("shaping"), float, int, None),
        _typed(document.get("diversity"), float, int, None),
        genome,
    )


def _typed(value: Any, *kinds: type | None) -> Any:
    """The value, if it is of one of these types. Raises TypeError."""
    if not any(value is None if kind is None else isinstance(value, kind) for kind in kinds):
        raise TypeError(f"{value!r:.40} is of another type")
    return value
