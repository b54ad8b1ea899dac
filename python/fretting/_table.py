"""What a history holds: columns by name, and the fields of increments that were kept."""

from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from fretting._meaning import CYCLE_KINDS, FIELD_NAMES


class Table(dict[str, npt.NDArray[Any]]):
    """Columns by name; an unknown name raises a KeyError that lists the known ones."""

    def __missing__(self, name: object) -> npt.NDArray[Any]:
        """Refuse a name."""
        if name in FIELD_NAMES:
            raise KeyError(f"{name!r} is a field, a number per cell: history.field({name!r}, increment) has it")
        raise KeyError(
            f"no column {name!r}; columns are: {', '.join(self)}; fields (history.field): {', '.join(FIELD_NAMES)}"
        )


def of_cycles(records: list[dict[str, Any]]) -> Table:
    """Return records of cycles as one array a name; a missing number is NaN, a missing word empty."""
    missing: dict[type, object] = {float: np.nan, str: ""}
    return Table(
        (name, np.array([missing[kind] if record[name] is None else record[name] for record in records], dtype=kind))
        for name, kind in CYCLE_KINDS.items()
    )


class Kept(Protocol):
    """Where the fields come from: the compiled module, or a copy that went through another process."""

    def kept_increments(self) -> list[int]: ...
    def kept_fields(self, increment: int) -> list[str]: ...
    def field(self, name: str, increment: int) -> npt.NDArray[Any]: ...


class Copied:
    """Fields as plain arrays."""

    def __init__(self, fields: dict[int, dict[str, npt.NDArray[Any]]]) -> None:
        self.fields = fields

    def kept_increments(self) -> list[int]:
        return list(self.fields)

    def kept_fields(self, increment: int) -> list[str]:
        return list(self.fields.get(increment, {}))

    def field(self, name: str, increment: int) -> npt.NDArray[Any]:
        return self.fields[increment][name].copy()
