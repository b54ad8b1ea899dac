"""What every number and field of a history means: the vocabulary of the compiled module, with its units."""

import json
from typing import Any, Literal, get_args

from fretting import _core

FieldName = Literal["pressure", "shear_x", "shear_y", "slip_x", "slip_y", "gap", "zone", "worn_depth"]
FIELD_NAMES: tuple[str, ...] = get_args(FieldName)

_VOCABULARY: dict[str, Any] = json.loads(_core.vocabulary())
_KINDS: dict[str, type] = {"int": int, "float": float, "bool": bool, "str": str}


def _meanings(entries: list[dict[str, str]]) -> dict[str, str]:
    return {
        entry["name"]: entry["meaning"] + (f" [{entry['unit']}]" if entry["unit"] else "") for entry in entries
    }


def _kinds(entries: list[dict[str, str]]) -> dict[str, type]:
    return {entry["name"]: _KINDS[entry["kind"]] for entry in entries}


STEP_KINDS = _kinds(_VOCABULARY["steps"])
"""Type of every number of an increment, in the order of ``history.csv``."""

CYCLE_KINDS = _kinds(_VOCABULARY["cycles"])
"""Type of every number of a cycle, in the order of ``cycles.csv``."""

MEANING = _meanings(_VOCABULARY["fields"]) | _meanings(_VOCABULARY["steps"])
"""Meaning of every field and of every number of an increment."""

CYCLE_MEANING = _meanings(_VOCABULARY["cycles"])
"""Meaning of every number of a cycle."""

ZONE_NAMES: tuple[str, ...] = tuple(_VOCABULARY["zones"])
"""Names of the zones 0, 1, 2."""


def label(name: str) -> str:
    """Return the meaning of a number or field in few words, with its unit in brackets: for axes and bars of colour."""
    words, _, rest = MEANING[name].partition(" [")
    unit = f" [{rest}" if rest else ""
    return words.partition(":")[0].partition(",")[0] + unit


def unit(name: str) -> str:
    """Return the unit of a number or field, without brackets; empty for one that has none."""
    return MEANING[name].partition("[")[2].rstrip("]")
