"""The one exception for files that are there but cannot be read."""
from __future__ import annotations

import os
from typing import Union

FilePath = Union[str, "os.PathLike[str]"]


class Damaged(Exception):
    """A file is there, but it is not, or no longer, what it should be.

    It was cut or changed, is of another kind, or comes from a newer version of Lore. A file that is not there raises
    FileNotFoundError instead, one that may not be read PermissionError.
    """

    file: str  #: as it was given, or found in a directory that was given
    reason: str  #: why it cannot be read, without the file's name

    def __init__(self, file: FilePath, reason: str) -> None:
        super().__init__(os.fspath(file), reason)  # both, so that it can be pickled
        self.file = os.fspath(file)
        self.reason = reason

    def __str__(self) -> str:
        return f"cannot read {self.file} ({self.reason})"
