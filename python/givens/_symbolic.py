"""Expressions of SymPy as functions of NumPy."""

from __future__ import annotations

import keyword
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from difflib import get_close_matches
from typing import Any

from givens.errors import InputError

__all__ = ["is_symbolic", "of_sympy", "symbols_in"]


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


def symbols_in(given: Any) -> set[str]:
    """The names of the symbols of expressions."""
    return {str(symbol) for symbol in _free(sys.modules["sympy"], _listed(given)[1])}


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

    keys, expressions = _listed(given)
    free = sorted(_free(sympy, expressions), key=str)
    names = [str(symbol) for symbol in free]
    _check_names(argument, names, required, states, controls, parameters)
    _check_expressions(argument, sympy, expressions)
    # NumPy has no error function, `math` has
    known = [{"erf": math.erf, "erfc": math.erfc}, "numpy"]
    try:
        function = sympy.lambdify(free, expressions, modules=known)
    except Exception as error:
        raise InputError(
            f"`{argument}`: SymPy does not write it in NumPy: {str(error).splitlines()[0]}",
            argument=argument,
            remedy="work integrals, sums and derivatives out with .doit(), or write a function",
        ) from error
    used = [name for name in names if name in parameters]

    def of(values: dict[str, Any]) -> Any:
        result = function(*(values[name] for name in names))
        return result if keys is None else dict(zip(keys, result, strict=True))

    return _with_signature(of, required, states, controls, used)


def _listed(given: Any) -> tuple[list[Any] | None, Any]:
    """The keys of a table, or None; and the expressions, a matrix of one row or column as a list."""
    if isinstance(given, dict):
        return list(given), list(given.values())
    vector = hasattr(given, "free_symbols") and 1 in getattr(given, "shape", ())
    return None, list(given) if vector else given


def _check_names(
    argument: str,
    names: Sequence[str],
    required: Sequence[str],
    states: Sequence[str],
    controls: Sequence[str],
    parameters: Mapping[str, object],
) -> None:
    own = {**dict.fromkeys(states, "a state"), **dict.fromkeys(controls, "a control")}
    own |= dict.fromkeys(parameters, "a parameter")
    for k, name in enumerate(names):
        said, remedy = None, None
        if name in names[:k]:
            said = f"has two symbols `{name}`, which SymPy tells apart by their assumptions"
            remedy = "make each symbol once"
        elif name in ("t", "dt") and name in own:
            said, remedy = f"names `{name}`, which is {own[name]} and the {_TIMES[name]}", "name it differently"
        elif name == "dt" and "dt" not in required:
            said, remedy = "names `dt`, which there is in `f` and `noise_cov` only", "name it differently"
        elif name in states and "x" not in required:
            said, remedy = f"names the state `{name}`, on which it may not depend", None
        elif name in parameters and keyword.iskeyword(name):
            said, remedy = f"names `{name}`, which is a word of Python", "name the parameter differently"
        elif name not in own and name not in _TIMES:
            known = sorted(_TIMES.keys() | own.keys())
            close = get_close_matches(name, known, 1)
            said = f"names `{name}`, which is neither a state nor a control nor a parameter"
            remedy = f"did you mean `{close[0]}`?" if close else f"write parameters={{'{name}': …}}"
        if said is not None:
            raise InputError(f"`{argument}` {said}", argument=argument, component=name, remedy=remedy)


_TIMES = {"t": "time", "dt": "step"}


def _check_expressions(argument: str, sympy: Any, expressions: Any) -> None:
    whole = sympy.Tuple(*sympy.flatten(expressions)) if isinstance(expressions, (list, tuple)) else expressions
    unknown = sorted(map(str, whole.atoms(sympy.core.function.AppliedUndef)))
    if unknown:
        raise InputError(
            f"`{argument}` holds `{unknown[0]}`, a function that is not defined",
            argument=argument,
            remedy="put an expression in its place with .subs(…)",
        )
    infinite = next((part for part in sympy.flatten([whole]) if part in (sympy.oo, -sympy.oo)), None)
    wrong = infinite if infinite is not None else next(filter(whole.has, (sympy.nan, sympy.zoo)), None)
    if wrong is not None:
        raise InputError(f"`{argument}` holds `{wrong}`, which is no finite number", argument=argument)


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
