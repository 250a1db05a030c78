"""Libraries that are only needed for what they are asked for."""

from __future__ import annotations

import importlib
from typing import Any

__all__ = ["wanted"]

_EXTRAS = {"pandas": "pandas", "polars": "polars", "xarray": "xarray", "matplotlib": "plot", "pyarrow": "arrow"}


def wanted(module: str) -> Any:
    """Imports a library, or says which extra brings it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        name = module.partition(".")[0]
        raise ImportError(f"{name} is not installed: pip install givens[{_EXTRAS[name]}]", name=name) from error
