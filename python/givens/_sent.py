"""What is sent to other processes by pickle."""

from __future__ import annotations

from typing import Any

from givens import _native
from givens.errors import InputError

__all__ = ["Sent"]


class Sent:
    """Computes on one thread where it has come by pickle, unless another number was asked for; only by the version that
    has made it.
    """

    #: What it is called in an error.
    _word: str
    #: Threads that were asked for.
    _asked: int | None
    #: Whether it has come by pickle.
    _came = False

    @property
    def threads(self) -> int | None:
        """How many threads it computes on; None is all cores."""
        return 1 if self._asked is None and self._came else self._asked

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_version": _native.VERSION}

    def __setstate__(self, state: dict[str, Any]) -> None:
        made_by = state.pop("_version", "another version")
        if made_by != _native.VERSION:
            raise InputError(
                f"the {self._word} was made by givens {made_by}, and this is {_native.VERSION}",
                argument=self._word,
                remedy="install one version wherever it runs",
            )
        self.__dict__.update(state)
        self._came = True
