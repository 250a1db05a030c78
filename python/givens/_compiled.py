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
    """Where it begins; `count` is how many arguments it is given. What it says of itself is held against that."""
    if _is_numba(given):
        address, signature = int(given.address), getattr(given, "_sig", None)
        takes = None if signature is None else [_NUMBA.get(str(kind), str(kind)) for kind in signature.args]
        gives = None if signature is None or str(signature.return_type) == "none" else str(signature.return_type)
    else:
        import ctypes

        address = ctypes.cast(given, ctypes.c_void_p).value or 0
        takes = None if given.argtypes is None else [_of_ctypes(ctypes, kind) for kind in given.argtypes]
        # a function of a library that says nothing of itself is taken to give an int
        gives = None if takes is None or given.restype is None else given.restype.__name__
    if not address:
        raise InputError(f"`{argument}` is a function pointer that points nowhere", argument=argument)
    wanted = [_DOUBLE] * (count - 3) + [_POINTER] * 3
    said = None
    if takes is not None and len(takes) != count:
        said = f"is a function of C with {len(takes)} arguments, and it is given {count}"
    elif takes is not None:
        wrong = [k for k in range(count) if takes[k] not in (wanted[k], _ANY if wanted[k] == _POINTER else wanted[k])]
        said = (
            f"is a function of C whose argument {wrong[0] + 1} is {takes[wrong[0]]}, not {wanted[wrong[0]]}"
            if wrong
            else None
        )
    if said is None and gives is not None:
        said = f"is a function of C that gives {gives}, and its results are to be written to `out`"
    if said is not None:
        step = "double dt, " if count == 5 else ""
        remedy = f"write void f(double t, {step}const double *x, const double *p, double *out)"
        raise InputError(f"`{argument}` {said}", argument=argument, remedy=remedy)
    return address


_DOUBLE, _POINTER, _ANY = "double", "double *", "void *"
_NUMBA = {"float64": _DOUBLE, "float64*": _POINTER, "void*": _ANY}


def _of_ctypes(ctypes: Any, kind: Any) -> str:
    known = {ctypes.c_double: _DOUBLE, ctypes.POINTER(ctypes.c_double): _POINTER, ctypes.c_void_p: _ANY}
    return known.get(kind) or str(kind.__name__)
