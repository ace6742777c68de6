"""Optional packages, and the extras that install them."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def optional(module: str, extra: str) -> Any:
    """Imports a module that an extra of affinor installs.

    Raises
    ------
    ImportError
        The package is not installed. The message contains the command that installs it.
    """
    try:
        return import_module(module)
    except ImportError as error:
        package = module.partition(".")[0]
        reason = f"this needs {package}, which is not installed: pip install 'affinor[{extra}]'"
        raise ImportError(reason, name=error.name, path=error.path) from error
