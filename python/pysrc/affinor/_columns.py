"""Selection of columns of trajectories, by name or by stem."""

from __future__ import annotations

from collections.abc import Sequence


def components(columns: Sequence[str], name: str) -> list[str]:
    """The column with this name, or all columns with this stem, in the order of their components."""
    if name in columns:
        return [name]
    stem = [column for column in columns if column.rstrip("0123456789_") == name]
    if not stem:
        raise KeyError(f"no column {name!r}; the columns are {', '.join(columns)}")
    return sorted(stem, key=lambda column: [int(number) for number in column[len(name) :].split("_") if number])
