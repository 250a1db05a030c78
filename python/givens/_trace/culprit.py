"""Which line of a function it is after which something holds."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import CodeType, FrameType
from typing import Any

from givens._trace.place import Place, is_users, place_of

__all__ = ["line_that"]

#: Steps of the function that are watched: one that takes more is not worth the wait.
_STEPS = 100_000


def line_that(did: Callable[[], bool], call: Callable[[], object]) -> Place | None:
    """Calls, and gives the first line after which `did` answers yes; None if that is none of the user's.

    Whatever the call raises ends it.
    """
    found: Place | None = None
    last: tuple[CodeType, int] | None = None
    steps = 0

    def watch(frame: FrameType, event: str, argument: object) -> Any:
        nonlocal found, last, steps
        steps += 1
        if found is not None or steps > _STEPS or not is_users(frame.f_code):
            return None
        if last is not None and did():
            found = place_of(*last)
            return None
        at: FrameType | None = frame
        if event == "return":
            # what comes next belongs to the line that called, perhaps by way of this package
            at = frame.f_back
            while at is not None and not is_users(at.f_code):
                at = at.f_back
        last = None if at is None else (at.f_code, at.f_lineno)
        return watch

    before = sys.gettrace()
    sys.settrace(watch)
    try:
        call()
    except Exception:
        return found
    finally:
        sys.settrace(before)
    return found
