"""What the program gives for five published experiments, beside what was measured."""

import json
import warnings
from typing import Any

import numpy as np
import oblique_impact as impact
import worn_scars as scars

import fretting
from fretting import analytic

QUOTED = json.loads((impact.GOLDEN.parent / "quoted.json").read_text(encoding="utf-8"))
SIMILAR = ({"young": 118.21e9, "poisson": 0.2472},) * 2
"""Identical bodies with the effective moduli of alumina on glass: no coupling."""
QUANTITIES = {"tangential_restitution": "tangential", "spin": "spin", "rebound_angle": "angle"}


def kharaz() -> dict[str, Any]:
    """Return the 24 measured points with the program, the uncoupled theory and a rigid ball."""
    found: dict[str, Any] = {}
    for quantity, name in QUANTITIES.items():
        found[quantity] = []
        for angle, value in impact.measured(quantity):
            if angle < 1:
                continue  # straight on: what is left of 0.016 degrees says nothing
            ours, changed = impact.coupled(angle)
            row = {
                "angle": angle,
                "measured": value,
                "computed": getattr(ours, name),
                "tangential": ours.tangential,
                "normal": ours.normal,
                "last_change": changed,
                "uncoupled": getattr(impact.uncoupled(angle)[0], name),
                "rigid": getattr(impact.rigid(angle), name),
            }
            found[quantity].append(row)
            print(quantity, row, flush=True)
    found["between"] = [
        {"angle": angle, "tangential": impact.coupled(angle)[0].tangential} for angle in (13.5, 16.5, 23.5, 26.0, 35.0)
    ]
    found["similar"] = [
        {
            "angle": angle,
            "computed": impact.coupled(angle, bodies=SIMILAR)[0].tangential,
            "uncoupled": impact.uncoupled(angle, bodies=SIMILAR)[0].tangential,
        }
        for angle in (1.84, 9.496, 20.012)
    ]
    found["higher_friction"] = [
        {
            "angle": angle,
            "friction": friction,
            "computed": impact.coupled(angle, friction=friction, cells=32, increments=80)[0].tangential,
        }
        for angle in (1.84, 3.703, 9.496)
        for friction in (0.15, 0.3, 0.6)
    ]
    found["refined"] = [
        {
            "angle": angle,
            "cells": cells,
            "increments": increments,
            "computed": impact.coupled(angle, cells=cells, increments=increments)[0].tangential,
        }
        for angle in (3.703, 20.012)
        for cells, increments in ((32, 80), (48, 160), (64, 240))
    ]
    moduli = analytic.effective_moduli(upper=impact.BALL, lower=impact.GLASS)
    found["coupling"] = moduli.coupling
    return found


def mccoll() -> dict[str, Any]:
    """Return the scar of the flat: measured, by finite elements that move, and by the program."""
    history = scars.mccoll(320)
    place, depth = scars.mccoll_scar(history)
    at, seen = scars.measured_scar()
    near = np.abs(at) < 0.3
    element, worn = scars.columns("finite_elements")
    cycles = history.cycles
    half = len(place) // 2
    return {
        "x": [round(float(x), 6) for x in place[half:]],
        "depth": [round(float(d), 5) for d in depth[half:]],
        "computed": {**_scar(place, depth), "cycles": len(cycles["cycle"])},
        "measured": {
            "depth": float(seen[np.abs(at) < 0.06].mean()),
            "deepest": float(seen.max()),
            "half_width": scars.width(at, seen),
            "area": float(np.trapezoid(seen, at)) * 1e-3,
        },
        "finite_elements": {
            "depth": float(worn.max()),
            "half_width": float(np.interp(-0.1 * worn.max(), -worn, element)),
            "area": 2e-3 * float(np.trapezoid(worn, element)),
        },
        "rms": float(np.sqrt(np.mean((seen - np.interp(at, place, depth))[near] ** 2))),
        "rms_finite_elements": float(
            np.sqrt(np.mean((seen - np.interp(np.abs(at), element, worn, right=0.0))[near] ** 2))
        ),
        "first_half_width": analytic.hertz_line(
            radius=6.0, line_force=18.5, modulus=analytic.effective_moduli(upper=scars.STEEL, lower=scars.STEEL).normal
        ).half_width,
        "friction": [
            {"friction": friction, **_scar(*scars.mccoll_scar(scars.mccoll(80, friction=friction, jump=24)))}
            for friction in (0.7, 0.9)
        ],
        "coarser": [
            {"cells": cells, "jump": jump, **_scar(*scars.mccoll_scar(scars.mccoll(cells, jump=jump)))}
            for cells, jump in ((80, 24), (160, 12))
        ],
    }


def _scar(place: Any, depth: Any) -> dict[str, float]:
    return {
        "depth": float(depth.max()),
        "half_width": scars.width(place, depth),
        "area": float(depth.sum() * (place[1] - place[0])) * 1e-3,
    }


def fouvry_2007() -> dict[str, Any]:
    """Return depths for the largest measured volume: by the program, and by the closed form of a finite stroke."""
    of = QUOTED["fouvry_2007"]
    volume = of["largest_volume_um3"] * 1e-9
    history = scars.ball_on_coating(64, volume)
    path = [
        {"volume": part * volume * 1e9, "depth": _deepest(scars.ball_on_coating(48, part * volume))}
        for part in (0.1, 0.25, 0.5, 0.75, 1.2)
    ]
    return {
        "volume": of["largest_volume_um3"],
        "measured": of["depths_um"],
        "computed": _deepest(history),
        "computed_volume": float(history.cycles["worn_volume"][-1]) * 1e9,
        "cycles": len(history.cycles["cycle"]),
        "path": path,
        "refined": [
            {"cells": cells, "largest_step": step, "depth": _deepest(scars.ball_on_coating(cells, volume, step))}
            for cells, step in ((32, 0.04), (48, 0.02), (48, 0.01))
        ],
        "strokes": [
            {"stroke": 1e3 * stroke, "depth": 1e3 * scars.ball_depth(volume, 12.7, stroke)}
            for stroke in (0.0, 0.05, 0.1)
        ],
        "max_pressure": float(history.increments["max_pressure"][7]),
        "last_pressure": float(history.increments["max_pressure"][-1]),
    }


def _deepest(history: fretting.History) -> float:
    return float(history.field("worn_depth").max()) * 1e3


def _titanium(history: fretting.History) -> dict[str, Any]:
    place, worn, debris = history.x, history.field("worn_depth"), history.field("debris")
    dx, middle = place[1] - place[0], len(place) // 2
    deepest = middle + int(worn[middle:].argmax())
    return {
        "half_width": scars.width(place, worn, 0.01),
        "depth": float(worn.max()),
        "deepest_at": float(place[deepest]),
        "middle": float(worn[middle]),
        "debris": float(debris.max()),
        "area": float(worn.sum() * dx),
        "energy_per_length": 1e-3 * float(history.cycles["total_dissipated_energy"][-1]),
        "sliding": float(history.cycles["opening"][-1]),
        "cycles": len(history.cycles["cycle"]),
        "x": [round(float(x), 4) for x in place[middle::2]],
        "worn": [round(float(d), 6) for d in worn[middle::2]],
    }


def moving_scars() -> dict[str, Any]:
    """Return worn scars of bodies that move, and with debris, beside what was measured."""
    of = QUOTED["fouvry_2007"]
    volume = of["largest_volume_um3"] * 1e-9
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fretting.FrettingWarning)
        history = scars.mccoll(160, jump=24, displacement="finite")
        place, depth = scars.mccoll_scar(history)
        at, seen = scars.measured_scar()
        near = np.abs(at) < 0.3
        half = len(place) // 2
        mccoll = {
            "x": [round(float(x), 6) for x in place[half:]],
            "depth": [round(float(d), 5) for d in depth[half:]],
            "computed": {**_scar(place, depth), "cycles": len(history.cycles["cycle"])},
            "rms": float(np.sqrt(np.mean((seen - np.interp(at, place, depth))[near] ** 2))),
            "coarser": _scar(*scars.mccoll_scar(scars.mccoll(80, jump=24, displacement="finite"))),
        }
        balls = []
        for stroke in (0.05, 0.1):
            found = {
                cells: float(
                    scars.ball_on_coating(cells, volume, step, stroke, "finite").field("lower_worn_depth").max() * 1e3
                )
                for cells, step in ((32, 0.04), (64, 0.02))
            }
            balls.append({"stroke": 1e3 * stroke, "depth": found[64], "coarser": found[32]})
            print(balls[-1], flush=True)
        model = QUOTED["arnaud_2021"]
        power = scars.friction_power(2.0, next(s["half_width_mm"] for s in model["scars"] if s["shape"] == "W"))
        rim, wider = (scars.reach_of_oxygen(power, model["oxygen"], of_porosity) for of_porosity in (1.5, 1.0))
        fraction = model["debris_fraction"]
        titanium = {
            "fraction": scars.FRACTION,
            "fraction_of_model": fraction,
            "power": power,
            "rim": rim,
            "wider_rim": wider,
            "U": _titanium(scars.titanium_with_debris(240)),
            "U_of_model": _titanium(scars.titanium_with_debris(240, fraction=fraction)),
            "W": _titanium(scars.titanium_with_debris(240, rim, fraction)),
            "W_wider": _titanium(scars.titanium_with_debris(240, wider, fraction)),
        }
    return {"mccoll": mccoll, "fouvry_2007": balls, "arnaud": titanium}


def fouvry_2017() -> dict[str, Any]:
    """Return Hertz pressures and dissipated energies of the test matrix beside the printed ones."""
    of = QUOTED["fouvry_2017"]
    body = {"young": 119e3, "poisson": 0.29}
    modulus = analytic.effective_moduli(upper=body, lower=body).normal
    rows = []
    for test in of["tests"]:
        radius, force = test["radius_mm"], test["force_N_per_mm"]
        line = analytic.hertz_line(radius=radius, line_force=force, modulus=modulus)
        history = scars.sliding(body, radius, force, 0.6, of["sliding_mm"])
        per_length = float(history.cycles["dissipated_energy"][-1])
        opening = float(history.cycles["opening"][-1])
        per_cycle = per_length * test["length_mm"] * 1e-3  # [J]
        rows.append(
            {
                **test,
                "computed_pressure": line.max_pressure,
                "program_pressure": float(history.increments["max_pressure"][0]),
                "half_width": line.half_width,
                "measured_energy": test["energy_J"] / 5000,
                "computed_energy": per_cycle,
                "opening": opening,
                "implied_friction": 0.6 * test["energy_J"] / 5000 / per_cycle * opening / of["sliding_mm"],
                "rectangle": per_length / (4 * 0.6 * force * opening),
            }
        )
        print(rows[-1], flush=True)
    return {"rows": rows}


def arnaud() -> dict[str, Any]:
    """Return the scars that two touching bodies can leave for the measured areas."""
    modulus = analytic.effective_moduli(upper=scars.TITANIUM, lower=scars.TITANIUM).normal
    rows = []
    for scar in QUOTED["arnaud_2021"]["scars"]:
        half, depth = scars.cap(scar["area_mm2"], 80.0)
        wide, less = scars.elastic_cap(scar["area_mm2"], 80.0, 1066.0, modulus)
        history = scars.titanium(256, scar["area_mm2"])
        place, worn = history.x, history.field("worn_depth")
        rows.append(
            {
                **scar,
                "cap": {"half_width": half, "depth": depth},
                "elastic_cap": {"half_width": wide, "depth": less},
                "computed": {
                    "half_width": scars.width(place, worn, 0.01),
                    "depth": float(worn.max()),
                    "area": float(worn.sum() * (place[1] - place[0])),
                },
                "x": [round(float(x), 4) for x in place[len(place) // 2 :: 4]],
                "depth": [round(float(d), 6) for d in worn[len(place) // 2 :: 4]],
            }
        )
    return {"rows": rows}


def experiments() -> dict[str, Any]:
    """Measure the page Comparison with experiments."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fretting.FrettingWarning)  # that displacements are not small is what is shown
        return {
            "kharaz": kharaz(),
            "mccoll": mccoll(),
            "fouvry_2007": fouvry_2007(),
            "fouvry_2017": fouvry_2017(),
            "arnaud": arnaud(),
        }
