"""The container around Lore's binary files: 64 bytes of header, then the payload (docs/manual/formats.md)."""
from __future__ import annotations

import os
import struct
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .checksum import xxh3_64
from .errors import Damaged, FilePath

HEADER_BYTES = 64
KINDS = {
    1: "lineage archive",
    2: "checkpoint",
    3: "knowledge base",
    4: "archive of all individuals",
    5: "single genome",
    6: "founders file",
}

_MAGIC = b"\x89LORE\r\n\x1a"
_VERSION = 2
_BYTE_ORDER = 0x01020304
_FIELDS = struct.Struct("<8s4I2Q16sQ")
_CHECKED_BYTES = 56  # of the header
_FLAG_ZSTD = 1


@dataclass(frozen=True)
class Header:
    kind: str  #: one of KINDS
    packed: bool  #: the payload is a zstd frame
    stored_bytes: int  #: of the payload
    checksum: int  #: XXH3-64 of the header before it and of the stored payload


def is_container(path: FilePath) -> bool:
    """Whether the file starts as Lore's binary files do. Raises OSError."""
    with open(path, "rb") as file:
        return file.read(len(_MAGIC)) == _MAGIC


def header_of(start: bytes, path: FilePath) -> Header:
    """From the first 64 bytes of a file. Raises Damaged."""
    if not start:
        raise Damaged(path, "the file is empty")
    if start[: len(_MAGIC)] != _MAGIC[: len(start)]:
        raise Damaged(path, "it is not a file of Lore")
    if len(start) < HEADER_BYTES:
        raise Damaged(path, "the file was cut inside its header")
    _, version, byte_order, kind, flags, stored, raw, _, checksum = _FIELDS.unpack(start)
    if byte_order == int.from_bytes(_BYTE_ORDER.to_bytes(4, "little"), "big"):
        raise Damaged(path, "it was written on a machine of the other byte order")
    if byte_order != _BYTE_ORDER or version == 0:
        raise Damaged(path, "its header was changed")
    if version > _VERSION:
        raise Damaged(path, f"written by a newer Lore: format {version}, this one reads {_VERSION}")
    packed = flags & _FLAG_ZSTD != 0
    if flags & ~_FLAG_ZSTD != 0 or (not packed and stored != raw):
        raise Damaged(path, "its header contradicts itself")
    return Header(KINDS.get(kind, "file of unknown kind"), packed, stored, checksum)


def map_payload(path: FilePath, kind: str, check: bool = True) -> NDArray[np.uint8]:
    """The payload of a container that is not packed, as the read-only mapped file itself.

    `kind` is the one expected, of KINDS. With `check` the whole file is read once for its checksum; without it only
    the header and the length are looked at. Raises Damaged, FileNotFoundError, OSError.
    """
    with open(path, "rb") as file:
        start = file.read(HEADER_BYTES)
        length = os.fstat(file.fileno()).st_size
        # Of the open file: another may have taken its name meanwhile.
        file_bytes: NDArray[np.uint8] = np.memmap(file, np.uint8, "r") if length else np.empty(0, np.uint8)
    header = header_of(start, path)
    there = length - HEADER_BYTES
    if header.stored_bytes > there:
        raise Damaged(path, f"the file was cut: {there} bytes of {header.stored_bytes} are there")
    if header.stored_bytes < there:
        raise Damaged(path, f"{there - header.stored_bytes} bytes too many follow its end")
    payload = file_bytes[HEADER_BYTES:]
    if check and xxh3_64(payload, start[:_CHECKED_BYTES]) != header.checksum:
        raise Damaged(path, "checksum mismatch: the file was changed")
    if header.kind != kind:
        raise Damaged(path, f"it is a {header.kind}, not a {kind}")
    if header.packed:
        raise Damaged(path, f"a packed {kind} cannot be mapped")
    return payload
