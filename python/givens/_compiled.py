"""Functions of C that are called by their address: of numba, or of ctypes."""

from __future__ import annotations

import sys
from typing import Any

from givens.errors import InputError

__all__ = ["address_of", "is_compiled"]


def is_compiled(given: object) -> bool:
    """Whether it is a numba `cfunc` or a function pointer of ctypes; what else has an `address` is never called by it.

    Neither package is imported to find out.
    """
    return _is_numba(given) or _is_ctypes(given)


def _is_numba(given: object) -> bool:
    kept: Any = sys.modules.get("numba.core.ccallback")
    return kept is not None and isinstance(given, kept.CFunc)


def _is_ctypes(given: object) -> bool:
    kept: Any = sys.modules.get("_ctypes")
    return kept is not None and isinstance(given, kept.CFuncPtr)


def address_of(argument: str, given: Any, count: int) -> int:
    """Where it begins; `count` is how many arguments it is given, and refused if it says that it takes others."""
    if _is_numba(given):
        address, signature = int(given.address), getattr(given, "_sig", None)
        taken = count if signature is None else len(signature.args)
    else:
        import ctypes

        address = ctypes.cast(given, ctypes.c_void_p).value or 0
        taken = count if given.argtypes is None else len(given.argtypes)
    if not address:
        raise InputError(f"`{argument}` is a function pointer that points nowhere", argument=argument)
    if taken != count:
        raise InputError(
            f"`{argument}` is a function of C with {taken} arguments, and it is given {count}",
            argument=argument,
            remedy="write void f(double t, [double dt,] const double *x, const double *p, double *out)",
        )
    return address
