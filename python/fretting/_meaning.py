"""What every number and field of a history means; the one place that says so."""

import re
from collections.abc import Mapping
from typing import Literal, get_args

FieldName = Literal["pressure", "shear_x", "shear_y", "slip_x", "slip_y", "gap", "zone", "worn_depth"]
FIELD_NAMES: tuple[str, ...] = get_args(FieldName)
VectorName = Literal["shear", "slip"]
VECTORS: tuple[str, ...] = get_args(VectorName)
"""Fields of two components, as ``[output] fields`` of a case names them."""

MEANING = {
    "pressure": "contact pressure, compression positive [pressure]",
    "shear_x": "shear traction on the lower body along x [pressure]",
    "shear_y": "shear traction on the lower body along y [pressure]",
    "slip_x": "relative slip along x since the start, upper body relative to lower, signed [length]",
    "slip_y": "relative slip along y since the start, upper body relative to lower, signed [length]",
    "gap": "gap between the surfaces [length]",
    "zone": "zone: 0 open, 1 stick, 2 slip",
    "worn_depth": "wear depth of both bodies together [length]",
    "normal_force": "normal force, compression positive [force]",
    "approach": "rigid normal approach [length]",
    "tangential_force_x": "tangential force on the lower body along x [force]",
    "tangential_force_y": "tangential force on the lower body along y [force]",
    "shift_x": "rigid tangential displacement of the upper body along x [length]",
    "shift_y": "rigid tangential displacement of the upper body along y [length]",
    "twist_moment": "moment about z on the lower body [force x length]",
    "twist": "rotation of the upper body about z [rad]",
    "max_pressure": "maximum contact pressure of a cell [pressure]",
    "max_shear": "maximum shear traction of a cell [pressure]",
    "contact_area": "contact area [length^2]",
    "stick_area": "stick area [length^2]",
    "dissipated_energy": "dissipated energy since the start, including the cycles represented by cycle jumps [force x length]",
    "worn_volume": "wear volume since the start, including the cycles represented by cycle jumps [length^3]",
    "max_worn_depth": "maximum wear depth [length]",
    "residual": "largest of the complementarity, Coulomb and equilibrium residuals, relative [-]",
    "wall_s": "time spent on the increment [s]",
    "increment": "number of the increment in the whole history, from 0",
    "stage": "number of the stage, from 0",
    "parts": 'number of sub-steps: more than 1 with increments = "auto", or where the whole increment did not converge',
    "contact_cells": "cells in contact",
    "stick_cells": "stick cells",
    "convolutions": "operator applications, each one fused pass whatever its components",
    "full_grid_convolutions": "the same, each weighted by its fraction of the cells of the whole grid",
    "preconditioner_passes": "preconditioner applications",
    "outer_iterations": "changes of the contact, stick and slip zones",
    "regime": "sliding condition: apart, full_stick, partial_slip, gross_slip or frictionless",
}

ZONE_NAMES = ("open", "stick", "slip")
"""Names of the zones 0, 1, 2."""


Units = Mapping[str, str]
"""Units of ``length``, ``force`` and ``pressure``, as a case declares them; empty without."""


def in_units(kind: str, units: Units) -> str:
    """Return the unit of a kind of quantity, such as ``"force x length"``; the kind itself where the case declares no units."""
    if not units:
        return kind
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


def described(meaning: str, units: Units) -> dict[str, str]:
    """Return the attributes of a variable from its meaning, which has the kind of quantity in brackets at its end.

    ``units`` is an attribute of its own where the case declares units, or the kind has one: 1, s, rad.
    """
    words, bracket, rest = meaning.rpartition(" [")
    kind = rest.rstrip("]")
    if bracket and kind in ("-", "s", "rad"):
        return {"long_name": words, "units": "1" if kind == "-" else kind}
    if bracket and units:
        return {"long_name": words, "units": in_units(kind, units)}
    return {"long_name": meaning}
