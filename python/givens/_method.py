"""The method of a run with its options, and keywords that are neither an option nor an argument."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from functools import cache
from typing import Any

from givens import _native
from givens._join import Joined
from givens._scalars import shown, text
from givens.errors import MethodError
from givens.model_file import ModelFile

__all__ = ["choose"]

#: Arguments that runs have beside the options of methods.
_ARGUMENTS = ("prior", "method", "t0", "u", "at", "noise", "params", "threads", "lag", "point")
#: What others call them.
_ELSEWHERE = {
    **dict.fromkeys(
        ("R", "r", "measurement_noise"), "write noise=…, row by row, or the noise into the sensor: std=[…]"
    ),
    **dict.fromkeys(
        ("Q", "process_noise"), "it belongs to the model: diffusion=… of an Sde, noise_cov=… of a Transition"
    ),
    **dict.fromkeys(("controls", "control", "inputs", "input"), "did you mean `u`? `controls` of the model names them"),
    **dict.fromkeys(("x0", "P0", "P", "init", "initial", "belief"), "did you mean `prior`?"),
    **dict.fromkeys(("times", "t_eval"), "did you mean `at`?"),
    **dict.fromkeys(("parameters", "p", "theta"), "did you mean `params`?"),
    **dict.fromkeys(("workers", "n_jobs", "jobs"), "did you mean `threads`?"),
    "truth": "gv.compare takes it",
    **dict.fromkeys(("lag", "point"), "gv.smooth takes it"),
}


def choose(model: Any, joined: Joined, method: str | None, options: Mapping[str, Any]) -> _native.Choice:
    """The method with its options; those of a model file hold where no other method is named."""
    if method is not None and not isinstance(method, str):
        raise MethodError(
            f"`method` is {shown(method)}, not a name", remedy='write method="sr-ckf"; gv.methods() lists all'
        )
    for word in (method or "", *options):
        text("method", word, "a name", "gv.methods() lists all methods with their options")
    parameters = {name for part, _ in (*joined.motion, *joined.measuring) for name in part.parameters}
    for name, value in options.items():
        if name in parameters and name not in _options():
            remedy = f"it is a parameter: params={{{name!r}: …}}"
            raise MethodError(f"there is no option `{name}`", option=name, remedy=remedy)
        _refuse_mistaken(name, value)
    if isinstance(model, ModelFile):
        named = method is not None and method != model.method
        options = {**({} if named else model.options), **options}
        method = method or model.method
    choice = _native.Choice(method, dict(options), joined.kind)
    choice.check(joined.native)
    return choice


@cache
def _options() -> frozenset[str]:
    return frozenset(name for method in _native.methods() for name in method["options"])


def _refuse_mistaken(name: str, value: Any) -> None:
    """Refuses a keyword that is no option and was meant for an argument, or holds what no option does."""
    known = _options()
    if name in known:
        return
    words = {word.lower(): word for word in (*known, *_ARGUMENTS)}
    near = [words[word] for word in get_close_matches(name.lower(), words, 1)]
    remedy = _ELSEWHERE.get(name)
    if remedy is None and name in _ARGUMENTS:
        remedy = "gv.filter and gv.smooth take it"
    if remedy is None and near and (near[0] in _ARGUMENTS or not _is_plain(value)):
        remedy = f"did you mean `{near[0]}`?"
    if remedy is None and not _is_plain(value):
        remedy = "gv.methods() lists all methods with their options"
    if remedy is not None:
        raise MethodError(f"there is no option `{name}`", option=name, remedy=remedy)


def _is_plain(value: Any) -> bool:
    """Whether it may be the value of an option: a number or a word."""
    return isinstance(value, (bool, str)) or (hasattr(value, "__float__") and not hasattr(value, "__len__"))
