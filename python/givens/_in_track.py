"""Errors of a batch, which say of which track they are and where its row stands in the table."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from givens.errors import InputError

__all__ = ["in_track", "tell", "told_by_number"]

#: What the native half notes on an exception of a batch, before the number of the track.
_NOTE = "in track "


@contextmanager
def in_track(name: Any, rows: Sequence[int] | None, several: bool = True) -> Iterator[None]:
    """Says of an error which track it is of; `rows` are those of the table that its rows are."""
    try:
        yield
    except InputError as error:
        if several:
            tell(error, name, rows)
        raise


def tell(error: InputError, name: Any, rows: Sequence[int] | None, before: int = 0) -> None:
    """Puts the track into an error; `before` are rows of the track that the error does not count."""
    if error.track is not None:
        return
    place, message = f"track `{name}`" if isinstance(name, str) else f"track {name}", error.message
    if error.row is not None:
        message = message.removeprefix(f"row {error.row}: ")
        error.row += before
        place += f", its row {error.row}"
        if rows is not None and error.row < len(rows):
            place += f" (row {rows[error.row]} of the table)"
    error.track = name
    error.message = f"{place}: {message}"
    error.args = (error.message,)


def told_by_number(error: InputError) -> int | None:
    """The number of the track that the native half has noted on an error, which the note loses."""
    for note in getattr(error, "__notes__", []):
        if note.startswith(_NOTE):
            error.__notes__.remove(note)
            return int(note.removeprefix(_NOTE))
    return None
