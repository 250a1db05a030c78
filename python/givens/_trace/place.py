"""Where in the user's program something happened."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass, replace
from types import CodeType, FrameType, TracebackType
from typing import Any

import numpy as np

__all__ = ["Place", "here", "is_users", "locals_at", "of_function", "of_traceback", "place_of"]

#: This package, NumPy, and what SymPy makes of expressions.
_OURS = (
    os.path.join(os.path.dirname(os.path.dirname(__file__)), ""),
    os.path.join(os.path.dirname(np.__file__), ""),
    "<lambdifygenerated",
)


@dataclass(frozen=True)
class Place:
    """A line of a program."""

    function: str | None = None
    file: str | None = None
    line: int | None = None
    source: str | None = None
    #: The function of a library at work there, which takes numbers only.
    library: str | None = None

    def __str__(self) -> str:
        if self.file is None:
            return self.function or "the function"
        inside = f", in {self.function}" if self.function else ""
        text = f": `{self.source}`" if self.source else ""
        return f"{_short(self.file)}:{self.line}{inside}{text}"


def is_users(code: CodeType) -> bool:
    """Whether it is neither this package's nor NumPy's."""
    return not code.co_filename.startswith(_OURS)


def here() -> Place:
    """The innermost line that is neither this package's nor NumPy's nor SciPy's."""
    frame: FrameType | None = sys._getframe(1)
    library, scipy = None, _folder_of("scipy")
    while frame is not None:
        if scipy is not None and frame.f_code.co_filename.startswith(scipy):
            library = _public(frame)
        elif is_users(frame.f_code):
            return replace(place_of(frame.f_code, frame.f_lineno), library=library)
        frame = frame.f_back
    return Place()


def _folder_of(library: str) -> str | None:
    """The folder of a library, if it is in use."""
    file = getattr(sys.modules.get(library), "__file__", None)
    return None if file is None else os.path.join(os.path.dirname(file), "")


def _public(frame: FrameType) -> str:
    """The name by which a function of a library is imported."""
    module = str(frame.f_globals.get("__name__", ""))
    parts = [part for part in module.split(".") if not part.startswith("_")]
    return ".".join([*parts, frame.f_code.co_name])


def of_traceback(traceback: TracebackType | None) -> Place:
    """The innermost such line of a traceback."""
    found = _innermost(traceback)
    return place_of(found.tb_frame.f_code, found.tb_lineno) if found is not None else Place()


def locals_at(traceback: TracebackType | None) -> dict[str, Any]:
    """The variables at that line."""
    found = _innermost(traceback)
    return found.tb_frame.f_locals if found is not None else {}


def _innermost(traceback: TracebackType | None) -> TracebackType | None:
    found = None
    while traceback is not None:
        if is_users(traceback.tb_frame.f_code):
            found = traceback
        traceback = traceback.tb_next
    return found


def of_function(function: object) -> Place:
    """The line where a function begins; of one that this package made, the line at work."""
    code = getattr(getattr(function, "__func__", function), "__code__", None)
    if isinstance(code, CodeType) and not is_users(code):
        return replace(here(), function=_name(code))
    if isinstance(code, CodeType):
        return Place(_name(code), code.co_filename, code.co_firstlineno, None)
    return Place(getattr(function, "__qualname__", None) or type(function).__name__)


def _name(code: CodeType) -> str:
    """Its name, with its class but without the function around it."""
    return code.co_qualname.rpartition("<locals>.")[2]


def _short(file: str) -> str:
    """As seen from the working folder, if the file lies in it."""
    folder = os.path.join(os.getcwd(), "")
    return file.removeprefix(folder)


def place_of(code: CodeType, line: int) -> Place:
    """That line, with its text."""
    import linecache

    source = linecache.getline(code.co_filename, line).strip() or None
    return Place(_name(code), code.co_filename, line, source)
