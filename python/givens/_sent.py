"""What is sent to other processes by pickle."""

from __future__ import annotations

import importlib
import pickle
from typing import Any

from givens import _native
from givens.errors import InputError

__all__ = ["Sent", "sendable"]


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
        self.__dict__.update({name: of.read() if isinstance(of, _Whole) else of for name, of in state.items()})
        self._came = True


def sendable(argument: str, given: Any) -> Any:
    """What pickle sends of a function: its name where it has one in a module, else the whole, by cloudpickle."""
    if not callable(given):
        return given
    try:
        pickle.dumps(given)
    except Exception as error:
        said = str(error)
    else:
        return given
    try:
        return _Whole(importlib.import_module("cloudpickle").dumps(given))
    except ImportError:
        remedy = "write it with `def` at the top of a module, or install cloudpickle, which sends functions whole"
    except Exception as error:
        said, remedy = str(error), "write it with `def` at the top of a module"
    raise InputError(f"`{argument}` cannot be sent: {said}", argument=argument, remedy=remedy)


class _Whole:
    """A function as cloudpickle has written it."""

    def __init__(self, data: bytes) -> None:
        self._data = data

    def read(self) -> Any:
        try:
            return importlib.import_module("cloudpickle").loads(self._data)
        except ImportError as error:
            raise InputError(
                "a function was sent whole, and cloudpickle is not installed here",
                remedy="pip install cloudpickle, or write the function with `def` at the top of a module",
            ) from error
