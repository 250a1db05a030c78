"""NumPy's functions of whole arrays, called with symbols."""

from __future__ import annotations

import inspect
from typing import Any

import numpy as np

from givens._trace.array import Objects, SymArray, boxed, check_held, has_symbols, lifted, numbers, plain
from givens._trace.choice import CHOICE
from givens._trace.linear import LINEAR
from givens._trace.reductions import REDUCTIONS
from givens._trace.refuse import refuse_argument, refuse_function
from givens._trace.symbol import Sym
from givens._trace.universal import into, is_double

__all__ = ["TABLE", "call_function", "call_named"]


def _made(value: Any, dtype: Any = None, *, ndmin: int = 0, copy: Any = True, **_: Any) -> SymArray:
    check_held(dtype)
    array: Any = boxed(value)
    array = array.copy() if copy and array is value else array
    shaped: SymArray = array.reshape((1,) * max(ndmin - array.ndim, 0) + array.shape)
    return shaped


def _as_array(value: Any, dtype: Any = None, **kwargs: Any) -> SymArray:
    return _made(value, dtype, copy=False)


def _like(fill: float) -> Any:
    def made(a: Any, dtype: Any = None, *_: Any, shape: Any = None, **__: Any) -> Any:
        return lifted(np.full(np.shape(a) if shape is None else shape, fill, dtype=dtype))

    return made


def _full(shape: Any, fill_value: Any, dtype: Any = None, **_: Any) -> SymArray:
    if has_symbols(fill_value):
        check_held(dtype)
    elif dtype is not None:
        return lifted(np.full(shape, fill_value, dtype=dtype))  # type: ignore[no-any-return]
    array = lifted(np.zeros(shape))
    array[...] = fill_value
    return array  # type: ignore[no-any-return]


MAKING: dict[str, Any] = {
    "array": _made,
    "copy": _made,
    **dict.fromkeys(("asarray", "asanyarray", "ascontiguousarray", "asfarray", "require"), _as_array),
    **dict.fromkeys(("zeros_like", "empty_like"), _like(0.0)),
    "ones_like": _like(1.0),
    "full": _full,
    "full_like": lambda a, fill_value, dtype=None, **_: _full(np.shape(a), fill_value, dtype),
}

#: What each function does with symbols.
TABLE: dict[str, Any] = {**MAKING, **REDUCTIONS, **LINEAR, **CHOICE}

#: Functions that NumPy itself does right on arrays of objects: they move elements, or add and multiply them.
STRUCTURAL = frozenset(
    """
    append array_split atleast_1d atleast_2d atleast_3d block broadcast_arrays broadcast_to column_stack concat
    concatenate copyto cross delete diag diagflat diagonal diff dsplit dstack ediff1d expand_dims fill_diagonal flip
    fliplr flipud hsplit hstack insert iscomplexobj isrealobj isscalar linalg.cross linalg.diagonal matrix_transpose
    meshgrid moveaxis ndim permute_dims put ravel repeat reshape resize roll rollaxis rot90 shape size split squeeze
    stack swapaxes take take_along_axis tile transpose tril triu unstack vander vsplit vstack
    """.split()
)


def call_function(func: Any, args: Any, kwargs: Any) -> Any:
    """What `__array_function__` is to do."""
    module = str(getattr(func, "__module__", "") or "").removeprefix("numpy").strip(".")
    return call_named(f"{module}.{func.__name__}" if module else func.__name__, args, kwargs)


def call_named(name: str, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
    """A function of NumPy's by its name below `numpy`."""
    moves = name in STRUCTURAL and any(isinstance(value, SymArray) for value in (*args, *kwargs.values()))
    if kwargs.get("out") is not None:
        kwargs = dict(kwargs)
        return into(kwargs.pop("out"), call_named(name, args, kwargs))
    if not (moves or has_symbols(args) or has_symbols(kwargs)):
        return lifted(_real(name)(*map(_number, args), **{key: _number(value) for key, value in kwargs.items()}))
    if name in TABLE:
        _check_honoured(name, args, kwargs)
        return TABLE[name](*args, **kwargs)
    if name in STRUCTURAL:
        kwargs = {key: _stripped(value) for key, value in kwargs.items()}
        return _wrapped(_real(name)(*map(_stripped, args), **kwargs))
    raise refuse_function(f"numpy.{name}")


def _check_honoured(name: str, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
    """Refuses arguments that the function here does not take, or takes and would not honour."""
    try:
        given = inspect.signature(TABLE[name]).bind(*args, **kwargs).arguments
    except TypeError:
        given = kwargs
        known = inspect.signature(TABLE[name]).parameters
        unknown = [argument for argument in kwargs if argument not in known]
        if unknown:
            raise refuse_argument(f"numpy.{name}", unknown[0]) from None
    given = {**given, **given.get("kwargs", {})}
    if given.get("out") is not None:
        raise refuse_argument(f"numpy.{name}", "out")
    if name not in MAKING and not is_double(given.get("dtype")):
        raise refuse_argument(f"numpy.{name}", "dtype")
    if given.get("where", True) is not True:
        raise refuse_argument(f"numpy.{name}", "where")


def _real(name: str) -> Any:
    found: Any = np
    for part in name.split("."):
        found = getattr(found, part)
    return found


def _number(value: Any) -> Any:
    """Traced arrays without symbols as the arrays that they stand for."""
    if isinstance(value, SymArray):
        return numbers(value)
    if type(value) in (list, tuple):
        return type(value)(map(_number, value))
    return value


def _stripped(value: Any) -> Any:
    if isinstance(value, Sym):
        return plain(value)
    if isinstance(value, SymArray):
        return value.view(np.ndarray)
    if type(value) in (list, tuple):
        return type(value)(map(_stripped, value))
    return value


def _wrapped(result: Any) -> Any:
    if isinstance(result, (list, tuple)):
        return type(result)(map(_wrapped, result))
    if not isinstance(result, np.ndarray) or result.dtype != object:
        return lifted(result)
    _tidy(result)
    return result.view(SymArray)


def _tidy(objects: Objects) -> None:
    """In place, so that a view stays one: NumPy fills with zeros that are whole numbers."""
    for at in np.ndindex(objects.shape):
        if not isinstance(objects[at], (Sym, np.float64, np.bool_)):
            objects[at] = plain(boxed(objects[at])).item()
