"""Expressions of SymPy as functions of NumPy."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from givens.errors import InputError

__all__ = ["is_symbolic", "of_sympy"]


def is_symbolic(given: Any) -> bool:
    """Whether it is an expression of SymPy, or holds one; SymPy is not imported to find out."""
    sympy: Any = sys.modules.get("sympy")
    if sympy is None:
        return False
    if isinstance(given, (sympy.Basic, sympy.MatrixBase)):
        return True
    if isinstance(given, dict):
        return any(map(is_symbolic, given.values()))
    return isinstance(given, (list, tuple)) and any(map(is_symbolic, given))


def of_sympy(
    argument: str,
    given: Any,
    required: Sequence[str],
    states: Sequence[str],
    controls: Sequence[str],
    parameters: Mapping[str, object],
) -> Callable[..., Any]:
    """The function of these expressions, whose symbols are called as the states, the controls and the parameters are.

    `t` and `dt` are time and step.
    """
    import sympy

    if isinstance(given, dict):
        keys, given = list(given), list(given.values())
    else:
        keys = None
    column = isinstance(given, sympy.MatrixBase) and given.shape[1] == 1
    expressions = list(given) if column else given
    free = sorted(_free(sympy, expressions), key=str)
    known = {"t", "dt", *states, *controls, *parameters}
    for symbol in free:
        if str(symbol) not in known:
            from difflib import get_close_matches

            close = get_close_matches(str(symbol), sorted(known), 1)
            raise InputError(
                f"`{argument}` names `{symbol}`, which is neither a state nor a control nor a parameter",
                argument=argument,
                component=str(symbol),
                remedy=f"did you mean `{close[0]}`?" if close else f"write parameters={{'{symbol}': …}}",
            )
    # NumPy has no error function, `math` has
    function = sympy.lambdify(free, expressions, modules=[{"erf": math.erf, "erfc": math.erfc}, "numpy"])
    names = [str(symbol) for symbol in free]
    used = [name for name in names if name in parameters]

    def of(values: dict[str, Any]) -> Any:
        result = function(*(values[name] for name in names))
        return result if keys is None else dict(zip(keys, result, strict=True))

    return _with_signature(of, required, states, controls, used)


def _free(sympy: Any, given: Any) -> set[Any]:
    if isinstance(given, (sympy.Basic, sympy.MatrixBase)):
        return set(given.free_symbols)
    return set().union(*(_free(sympy, part) for part in given)) if isinstance(given, (list, tuple)) else set()


def _with_signature(
    of: Callable[[dict[str, Any]], Any],
    required: Sequence[str],
    states: Sequence[str],
    controls: Sequence[str],
    parameters: Sequence[str],
) -> Callable[..., Any]:
    import inspect

    positions = [*required, *(["u"] if controls else [])]

    def expressions(*args: Any, **named: Any) -> Any:
        at = dict(zip(positions, args, strict=True))
        values: dict[str, Any] = {name: at[name] for name in ("t", "dt") if name in at}
        values |= zip(states, at.get("x", ()), strict=False)
        values |= zip(controls, at.get("u", ()), strict=False)
        return of(values | named)

    kinds = inspect.Parameter
    signature = [kinds(name, kinds.POSITIONAL_ONLY) for name in positions]
    signature += [kinds(name, kinds.KEYWORD_ONLY) for name in parameters]
    expressions.__signature__ = inspect.Signature(signature)  # type: ignore[attr-defined]
    return expressions
