"""Tables: named columns of equal length, and the CSV files they come from."""
from __future__ import annotations

import csv
import gzip
import zlib
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from .errors import Damaged, FilePath

if TYPE_CHECKING:
    import pandas

#: What a column holds: "int" (int64), "seed" (uint64), "float" (float64, finite), "number" (with NaN and infinity),
#: "text", or "guess" (the first of int, number and text that takes every field).
Schema = Mapping[str, str]


class Table:
    """Named columns of equal length, as numpy arrays; rows in the order of the file.

    `table["seed"]` is a column, `len(table)` the number of rows, `table.where(treatment="none")` a part of it, and
    `table.frame()` the same as a pandas DataFrame.
    """

    def __init__(self, columns: Mapping[str, NDArray[Any]]) -> None:
        """Raises ValueError unless all columns have one length."""
        self._columns = dict(columns)
        if len({len(column) for column in self._columns.values()}) > 1:
            raise ValueError("columns of different lengths")

    @property
    def columns(self) -> list[str]:
        return list(self._columns)

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Raises KeyError, with the names of the columns that there are."""
        if name not in self._columns:
            raise KeyError(f"there is no column '{name}', only {', '.join(self._columns) or 'none at all'}")
        return self._columns[name]

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(next(iter(self._columns.values()))) if self._columns else 0

    def __repr__(self) -> str:
        return f"<Table of {len(self)} rows: {', '.join(self._columns)}>"

    def where(self, **equal: Any) -> Table:
        """The rows whose columns have these values. Raises KeyError for a column that is not there."""
        keep = np.ones(len(self), bool)
        for name, value in equal.items():
            keep &= self[name] == value
        return Table({name: column[keep] for name, column in self._columns.items()})

    def frame(self) -> pandas.DataFrame:
        """As a pandas DataFrame. Raises ImportError where pandas is not there."""
        import pandas

        return pandas.DataFrame(self._columns)


def stacked(tables: Sequence[Table]) -> Table:
    """One under the other, with the columns that all of them have."""
    if not tables:
        return Table({})
    shared = [name for name in tables[0] if all(name in table for table in tables)]
    return Table({name: np.concatenate([table[name] for table in tables]) for name in shared})


def read_table(path: FilePath, schema: Schema | None = None, optional: Iterable[str] = ()) -> Table:
    """A CSV file with a header, as Lore writes it; also gzip-compressed.

    Columns of `schema` must be there, but for the `optional` ones; others are guessed. Raises Damaged (no header, a
    row of another length than the header, a field that its column cannot hold), FileNotFoundError.
    """
    return parse_table(read_text(path), path, schema or {}, optional)


def read_text(path: FilePath) -> str:
    """The text of a file, unpacked where it is gzip. Raises Damaged, FileNotFoundError."""
    with open(path, "rb") as file:
        data = file.read()
    try:
        if data.startswith(b"\x1f\x8b"):
            data = gzip.decompress(data)
        return data.decode()
    except UnicodeDecodeError as error:
        raise Damaged(path, f"byte {error.start} is no UTF-8 text") from error
    except (EOFError, OSError, zlib.error) as error:
        raise Damaged(path, f"the compressed file is cut or changed: {error}") from error


def parse_table(text: str, path: FilePath, schema: Schema, optional: Iterable[str] = ()) -> Table:
    """The same of a text; `path` is what errors name. A last line without its end was cut, and is refused."""
    if not text:
        raise Damaged(path, "the file is empty")
    if not text.endswith("\n"):
        raise Damaged(path, "its last line was cut")
    header, *lines = text.replace("\r\n", "\n")[:-1].split("\n")
    names = _fields(header, path)
    if len(set(names)) != len(names):
        raise Damaged(path, "two columns have one name")
    for name in schema:
        if name not in names and name not in optional:
            raise Damaged(path, f"there is no column '{name}'")
    rows = [_fields(line, path) for line in lines]
    for number, row in enumerate(rows, 2):
        if len(row) != len(names):
            raise Damaged(path, f"line {number} has {len(row)} columns, its header {len(names)}")
    fields: Iterable[Sequence[str]] = zip(*rows) if rows else [()] * len(names)
    return Table(
        {name: _column(name, of_name, schema.get(name, "guess"), path) for name, of_name in zip(names, fields)}
    )


def _fields(line: str, path: FilePath) -> list[str]:
    """Those between quotes without them (RFC 4180); no field has a line end."""
    if '"' not in line:
        return line.split(",")
    try:
        return next(csv.reader([line]))
    except csv.Error as error:
        raise Damaged(path, f"'{line[:40]}' is no line of a table: {error}") from error


def _whole(fields: Sequence[str]) -> NDArray[np.int64]:
    if any("_" in field for field in fields):  # Python's int takes 1_0
        raise ValueError
    return np.array(fields, np.int64)


def _seeds(fields: Sequence[str]) -> NDArray[np.uint64]:
    if any("_" in field or "-" in field for field in fields):  # numpy wraps -1
        raise ValueError
    return np.array(fields, np.uint64)


def _finite(fields: Sequence[str]) -> NDArray[np.float64]:
    numbers = np.array(fields, np.float64)
    if any("_" in field for field in fields) or not np.isfinite(numbers).all():
        raise ValueError
    return numbers


def _any_number(fields: Sequence[str]) -> NDArray[np.float64]:
    if any("_" in field for field in fields):
        raise ValueError
    return np.array(fields, np.float64)


def _text(fields: Sequence[str]) -> NDArray[np.str_]:
    return np.array(fields, np.str_)


_READERS: dict[str, tuple[Callable[[Sequence[str]], NDArray[Any]], str]] = {
    "int": (_whole, "whole number"),
    "seed": (_seeds, "seed"),
    "float": (_finite, "finite number"),
    "number": (_any_number, "number"),
    "text": (_text, "text"),
}


def _column(name: str, fields: Sequence[str], kind: str, path: FilePath) -> NDArray[Any]:
    if kind == "guess":
        for guess in ("int", "number"):
            try:
                return _READERS[guess][0](fields)
            except (ValueError, OverflowError):
                pass
        return _text(fields)
    read, what = _READERS[kind]
    try:
        return read(fields)
    except (ValueError, OverflowError):
        for line, field in enumerate(fields, 2):
            try:
                read([field])
            except (ValueError, OverflowError):
                raise Damaged(path, f"line {line}, {name}: '{field[:40]}' is no {what}") from None
        raise
