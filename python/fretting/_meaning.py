"""What every number and field of a history means: the vocabulary of the compiled module, with its units."""

import json
import re
from collections.abc import Collection, Mapping
from typing import Any, Literal, get_args

from fretting import _core

FieldName = Literal[
    "pressure",
    "shear_x",
    "shear_y",
    "slip_x",
    "slip_y",
    "gap",
    "zone",
    "worn_depth",
    "lower_worn_depth",
    "upper_worn_depth",
    "debris",
    "plastic_depth",
    "friction_work",
    "friction",
]
FIELD_NAMES: tuple[str, ...] = get_args(FieldName)
VectorName = Literal["shear", "slip"]
VECTORS: tuple[str, ...] = get_args(VectorName)
"""Fields of two components, as ``[output] fields`` of a case names them."""

_VOCABULARY: dict[str, Any] = json.loads(_core.vocabulary())
_KINDS: dict[str, type] = {"int": int, "float": float, "bool": bool, "str": str}


TORSION = "; of torsion "
"""What stands between the two kinds of a quantity that is another one where the contact turns."""


def _meanings(entries: list[dict[str, Any]]) -> dict[str, str]:
    def bracket(entry: dict[str, Any]) -> str:
        kinds = [entry["unit"], entry["turning"]] if entry.get("turning") else [entry["unit"]]
        return f" [{TORSION.join(kinds)}]" if entry["unit"] else ""

    return {entry["name"]: entry["meaning"] + bracket(entry) for entry in entries}


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


Units = Mapping[str, str]
"""Units of ``length``, ``force`` and ``pressure`` as declared, with ``line`` in a line contact; empty without."""


_PER_LENGTH = {
    "force": "force/length",
    "force x length": "force",
    "length^2": "length",
    "length^3": "length^2",
    "force/length": "force/length^2",
}


def in_units(kind: str, units: Units) -> str:
    """Return the unit of a kind of quantity, such as ``"force x length"``.

    The kind itself where the case declares no units. Loads of a line contact, of whose units ``line`` is one, are
    those of a unit of length.
    """
    if not units:
        return kind
    if "line" in units:
        kind = _PER_LENGTH.get(kind, kind)
    return re.sub(r"length|force|pressure", lambda word: units[word[0]], kind).replace(" x ", " ")


def label(name: str, units: Units | None = None) -> str:
    """Return the meaning of a number or field in few words, with its unit in brackets: for axes and bars of colour."""
    words, _, _ = MEANING[name].partition(" [")
    kind = unit(name)
    bracket = f" [{in_units(kind, units or {})}]" if kind else ""
    return words.partition(":")[0].partition(",")[0] + bracket


def unit(name: str) -> str:
    """Return the unit of a number or field, without brackets; empty for one that has none."""
    return MEANING[name].partition("[")[2].rstrip("]")


def described(meaning: str, units: Units, drives: Collection[str] = ()) -> dict[str, str]:
    """Return the attributes of a variable from its meaning, which has the kind of quantity in brackets at its end.

    ``units`` is an attribute of its own where the case declares units, or the kind has one: 1, s, rad. ``drives`` are
    the words of the cycles: where all turn, a quantity can be of another kind, and where some do, it has no one unit.
    """
    words, bracket, rest = meaning.rpartition(" [")
    kind, turns, turning = rest.rstrip("]").partition(TORSION)
    if turns and len(set(drives)) > 1:
        return {"long_name": meaning}
    if turns:
        kind = turning if "torsional" in drives else kind
        meaning = f"{words} [{kind}]"
    if bracket and kind in ("-", "s", "rad"):
        return {"long_name": words, "units": "1" if kind == "-" else kind}
    if bracket and units:
        return {"long_name": words, "units": in_units(kind, units)}
    return {"long_name": meaning}
