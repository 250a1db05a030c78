"""Whether there is memory for what is asked for: systems that promise more than they have end the program."""

from __future__ import annotations

import os

from givens.errors import InputError

__all__ = ["free", "room"]

#: What is always granted, without a look at the system.
_SMALL = 2**26


def free() -> int | None:
    """Bytes that can be had without swapping, as far as the system tells."""
    found = [left for left in (_of_system(), _of_group()) if left is not None]
    return min(found) if found else None


def _of_system() -> int | None:
    try:
        with open("/proc/meminfo", encoding="ascii") as file:
            for line in file:
                if line.startswith("MemAvailable:"):
                    return 1024 * int(line.split()[1])
    except (OSError, ValueError):
        pass
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, OSError, ValueError):
        return None


def _of_group() -> int | None:
    """What the container has left, if it has a limit."""
    try:
        with (
            open("/sys/fs/cgroup/memory.max", encoding="ascii") as most,
            open("/sys/fs/cgroup/memory.current", encoding="ascii") as now,
        ):
            return max(int(most.read()) - int(now.read()), 0)
    except (OSError, ValueError):
        return None


def room(argument: str, count: int, bytes_of_one: int, remedy: str) -> None:
    """Refuses `count` things of so many bytes if there is no memory for them."""
    wanted = count * bytes_of_one
    left = free() if wanted > _SMALL else None
    if left is not None and wanted > left:
        raise InputError(
            f"`{argument}` is {count}: they need {wanted:.3g} bytes at once, more than the {left:.3g} that are free",
            argument=argument,
            remedy=remedy,
        )
