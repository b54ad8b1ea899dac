"""Worn scars beside measured ones: a cylinder and a ball in gross slip, and the closed forms of a finite stroke.

Lengths in mm, forces in N. Surfaces stay where they are or move with their bodies; the closed forms say what motion
changes for rigid ones.
"""

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np

import fretting
from fretting import analytic

GOLDEN = Path(__file__).parents[2] / "tests" / "golden" / "experiments" / "mccoll_2004"


def columns(name: str) -> Any:
    """Return the two columns of a file of the test of McColl, Ding and Leen."""
    with (GOLDEN / f"{name}.csv").open(encoding="utf-8") as file:
        return np.array([[float(cell) for cell in row] for row in list(csv.reader(file))[1:]]).T


def measured_scar() -> tuple[Any, Any]:
    """Return places [mm] and depth [um] of the measured scar of the flat, above the line through its two sides."""
    place, height = columns("measured_flat_18000")
    sides = [(place < -0.3), (place > 0.3)]
    ends = [float(-height[side].mean()) for side in sides]
    at = [float(place[side].mean()) for side in sides]
    return place, -height - np.interp(place, at, ends)


def width(place: Any, depth: Any, fraction: float = 0.1) -> float:
    """Return half the width of a scar where it is deeper than a fraction of its depth.

    From the middle outward to the first place that is not; a tenth of the depth is above the roughness of a measured
    scar.
    """
    level = fraction * depth.max()
    middle = int(np.argmin(np.abs(place)))
    ends = []
    for step in (-1, 1):
        at = middle
        while depth[at + step] > level:
            at += step
        part = (depth[at] - level) / (depth[at] - depth[at + step])
        ends.append(place[at] + part * (place[at + step] - place[at]))
    return float(ends[1] - ends[0]) / 2


STEEL = {"young": 200e3, "poisson": 0.3}
FLAT, CYLINDER = 2.9e-8, 1.9e-8
"""Archard coefficients of McColl's flat and cylinder [1/MPa]."""


def mccoll(
    cells: int, friction: float = 0.9, jump: int = 3, increments: int = 16, displacement: str = "small"
) -> fretting.History:
    """Wear a steel cylinder of R = 6 mm and a flat for 18 000 cycles of +-25 um under 18.5 N/mm."""
    return fretting.run(
        {
            "grid": {"cells": cells, "size": 0.7, "datum": 6.0},
            "upper": {"substrate": {**STEEL, "wear_coefficient": CYLINDER}},
            "lower": {"substrate": {**STEEL, "wear_coefficient": FLAT}},
            "profile": {"cylinder": {"radius": 6.0, "axis": "y"}},
            "friction": {"coefficient": friction},
            "kinematics": {"displacement": displacement},
            "wear": {"law": "archard", "every": jump, "largest_step": 1.0},
            "load": [
                {"normal_force": 18.5, "increments": 8, "ramp": "square"},
                {"shift": [0.025, 0.0], "cycles": 18000, "increments": increments},
            ],
            "output": {"fields": ["worn_depth"]},
        }
    )


def mccoll_scar(history: fretting.History) -> tuple[Any, Any]:
    """Return places [mm] and depth [um] of the flat's scar: its own, or its fraction of that of both bodies."""
    if history.case["kinematics"]["displacement"] == "finite":
        return history.x, 1e3 * history.field("lower_worn_depth")
    return history.x, 1e3 * history.field("worn_depth") * FLAT / (FLAT + CYLINDER)


def ball_depth(volume: float, radius: float, stroke: float) -> float:
    """Return the depth that an unworn ball leaves in a flat: ``V = pi R d^2 + 8/3 s d sqrt(2 R d)``, +-s the stroke."""
    low, high = 0.0, float(np.sqrt(volume / (np.pi * radius)))
    for _ in range(200):
        depth = 0.5 * (low + high)
        if np.pi * radius * depth**2 + 8 / 3 * stroke * depth * np.sqrt(2 * radius * depth) < volume:
            low = depth
        else:
            high = depth
    return depth


def ball_on_coating(
    cells: int,
    volume: float,
    largest_step: float = 0.02,
    stroke: float = 0.05,
    displacement: str = "small",
    size: float = 0.52,
) -> fretting.History:
    """Wear a TiC coating of 1.6 um on steel by an alumina ball, which does not wear, in gross slip, to a volume.

    Depth follows from volume and, where surfaces move, from the stroke: friction only makes it slide. The grid is
    longer by the stroke where they move; `cells` are those across it.
    """
    coefficient = 415e-12  # 415 um3/J = 415e-12 mm3/(N mm)
    more = 2 * math.ceil(stroke / size * cells) if displacement == "finite" else 0

    def case(cycles: int, jump: int, worn: float) -> dict[str, Any]:
        return {
            "grid": {"cells": [cells + more, cells], "size": [size * (cells + more) / cells, size]},
            "upper": {"substrate": {"young": 370e3, "poisson": 0.27}},
            "lower": {
                "coatings": [{"thickness": 1.6e-3, "young": 510e3, "poisson": 0.2, "wear_coefficient": worn}],
                "substrate": {"young": 230e3, "poisson": 0.3, "wear_coefficient": worn},
            },
            "profile": {"sphere": {"radius": 12.7}},
            "friction": {"coefficient": 0.3},
            "kinematics": {"displacement": displacement},
            "wear": {"law": "energy", "every": jump, "largest_step": largest_step},
            "load": [
                {"normal_force": 100.0, "increments": 8, "ramp": "cubic"},
                {"shift": [stroke, 0.0], "cycles": cycles, "increments": 16},
            ],
            "output": {"fields": ["worn_depth"]},
        }

    # a cycle of the loop is not quite a rectangle: how many make the volume, the second of two cycles tells
    energy = fretting.run(case(2, 1, coefficient * 1e-6)).cycles["dissipated_energy"][-1]
    cycles = round(volume / (coefficient * energy))
    return fretting.run(case(cycles, cycles, volume / (energy * cycles)))


def sliding(body: Any, radius: float, force: float, friction: float, stroke: float) -> fretting.History:
    """Press a cylinder on a flat of the same material and slide it two cycles, `stroke` of sliding to either side.

    The displacement is larger by what the bodies give before they slide, which a first run finds.
    """
    half = analytic.hertz_line(
        radius=radius, line_force=force, modulus=analytic.effective_moduli(upper=body, lower=body).normal
    ).half_width

    def run(shift: float) -> fretting.History:
        return fretting.run(
            {
                "grid": {"cells": 128, "size": 2.6 * half, "datum": radius},
                "upper": {"substrate": body},
                "lower": {"substrate": body},
                "profile": {"cylinder": {"radius": radius, "axis": "y"}},
                "friction": {"coefficient": friction},
                "load": [
                    {"normal_force": force, "increments": 1},
                    {"shift": [shift, 0.0], "cycles": 2, "increments": 256},
                ],
                "output": {"fields": []},
            }
        )

    first = run(1.5 * stroke)
    return run(1.5 * stroke + stroke - float(first.cycles["opening"][-1]))


TITANIUM = {"young": 119e3, "poisson": 0.287}


def titanium(cells: int, area: float, cycles: int = 5000) -> fretting.History:
    """Wear cylinder (R = 80 mm) and flat of Ti-6Al-4V under 1066 N/mm to an area lost by both [mm2].

    The displacement is 120 um, as in the tests; the wear coefficient is that which gives the area.
    """

    def case(count: int, jump: int, worn: float) -> dict[str, Any]:
        return {
            "grid": {"cells": cells, "size": 8.0, "datum": 80.0},
            "upper": {"substrate": TITANIUM},
            "lower": {"substrate": TITANIUM},
            "profile": {"cylinder": {"radius": 80.0, "axis": "y"}},
            "friction": {"coefficient": 0.6},
            "wear": {"law": "energy", "coefficient": worn, "every": jump, "largest_step": 0.2},
            "load": [
                {"normal_force": 1066.0, "increments": 4},
                {"shift": [0.120, 0.0], "cycles": count, "increments": 8},
            ],
            "output": {"fields": ["worn_depth"]},
        }

    # the energy of a cycle rises a little while the contact grows: a run with about the area tells the coefficient
    energy = fretting.run(case(2, 1, 1e-12)).cycles["dissipated_energy"][-1]
    worn = area / (energy * cycles)
    reached = fretting.run(case(cycles, cycles, worn)).cycles["worn_volume"][-1]
    return fretting.run(case(cycles, cycles, worn * area / reached))


ALPHA = {"rim": (5.1e-4 + 4.1e-4) / 2, "interior": (1.0e-4 + 1.0e-5) / 2}
"""Wear of both bodies by energy in the model of Arnaud and others [mm3/J], each body with half of it."""
FRACTION = 0.94
"""What stays of the debris, fitted to the half-width of the U scar."""
DIFFUSION = 20.6
"""Diffusion coefficient of oxygen in nitrogen at room temperature [mm2/s]."""


def friction_power(frequency: float, half_width: float) -> float:
    """Return the friction power ``4 mu P s f/(2 a)`` of the tests by area of a contact of a half-width [W/mm2]."""
    return 4 * 0.6 * 1066.0 * 0.075 * frequency / (2e3 * half_width)


def reach_of_oxygen(power: float, model: dict[str, float], power_of_porosity: float) -> float:
    """Return how far oxygen comes in from the rim [mm] at a friction power [W/mm2].

    Diffusion through debris in which it is used up at the rate ``r``: ``sqrt(D/r) ln(p0/p)`` to where its pressure has
    fallen from ``p0`` outside to the threshold ``p``. `model`: the constants of Arnaud and others. ``D`` is that of the
    gas times the porosity to a power, 3/2 by Bruggeman and at most 1.
    """
    rate = model["rate_per_s"] * (power / model["at_W_per_mm2"]) ** model["exponent"]
    diffusion = DIFFUSION * model["porosity"] ** power_of_porosity
    return math.sqrt(diffusion / rate) * math.log(model["outside_Pa"] / model["threshold_Pa"])


def titanium_with_debris(cells: int, width: float | None = None, fraction: float = FRACTION) -> fretting.History:
    """Wear cylinder and flat of Ti-6Al-4V for 5000 cycles of +-75 um of sliding, with debris that stays.

    `width` of the rim within which they wear by the higher coefficient; None: they do everywhere. The displacement is
    larger than the sliding by what the bodies give, which a first run finds.
    """

    def run(shift: float) -> fretting.History:
        wear: dict[str, Any] = {
            "law": "energy",
            "coefficient": 1e-3 * ALPHA["rim"],
            "tolerance": 0.1,
            "largest_step": 0.1,
            "debris": {"fraction": fraction},
        }
        if width is not None:
            wear["rim"] = {"width": width, "interior": ALPHA["interior"] / ALPHA["rim"]}
        return fretting.run(
            {
                "grid": {"cells": cells, "size": 6.0, "datum": 80.0},
                "upper": {"substrate": TITANIUM},
                "lower": {"substrate": TITANIUM},
                "profile": {"cylinder": {"radius": 80.0, "axis": "y"}},
                "friction": {"coefficient": 0.6},
                "wear": wear,
                "load": [
                    {"normal_force": 1066.0, "increments": 4},
                    {"shift": [shift, 0.0], "cycles": 5000, "increments": 8},
                ],
                "output": {"fields": ["worn_depth", "debris"]},
            }
        )

    return run(0.110 + 0.075 - float(run(0.110).cycles["opening"][-1]))


def cap(area: float, radius: float) -> tuple[float, float]:
    """Return half-width and depth of what a cylinder and a flat lose together while they touch over all of the scar.

    Both profiles rest against each other over ``|x| < a``, so they have lost ``(a^2 - x^2)/(2 R)``, of area
    ``2 a^3/(3 R)``.
    """
    half = (1.5 * radius * area) ** (1 / 3)
    return half, half**2 / (2 * radius)


def elastic_cap(area: float, radius: float, force: float, modulus: float) -> tuple[float, float]:
    """Return half-width and depth of the cap of elastic bodies that press evenly, ``p = P/(2 a)``.

    The displacement under an even pressure, of area ``2 P a/(pi E*)`` and depth ``2 ln 2 P/(pi E*)``, is a part of the
    gap that need not be worn (Johnson 1985, section 2.5(a)): ``area = 2 a^3/(3 R) - 2 P a/(pi E*)``.
    """
    give = 2 * force / (np.pi * modulus)
    low, high = cap(area, radius)[0], 2 * cap(area, radius)[0] + np.sqrt(2 * radius * give)
    for _ in range(200):
        half = 0.5 * (low + high)
        if 2 * half**3 / (3 * radius) - give * half < area:
            low = half
        else:
            high = half
    return float(half), float(half**2 / (2 * radius) - np.log(2) * give)
