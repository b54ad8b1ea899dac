"""What the number of increments costs in accuracy: a pressing with friction, and a coated fretting loop.

    python docs/data/reviews/increments.py

prints two tables, a minute each on one core. References: a rigid sphere on nu = 0.3 with mu = 0.2 sticks within 0.698
of its contact radius and dissipates 3.027e-14 (E = R = 1, P = 1e-6), by rings of uniform traction (another program);
the loop against its own with 256 increments a cycle.
"""

import warnings
from typing import Any

import numpy as np

import fretting

STICK_RADIUS, ENERGY = 0.698, 3.027e-14


def solved(**tables: Any) -> fretting.History:
    """Run a case of a rigid sphere whose warnings are what is measured."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fretting.FrettingWarning)
        return fretting.run({"upper": {"rigid": True}, "profile": {"sphere": {"radius": 1.0}}, **tables})


def pressed(increments: int | str, ramp: str) -> tuple[float, float]:
    """Return the error of the stick radius over the contact radius, and the relative error of the energy."""
    radius = (0.75e-6 * 0.91) ** (1 / 3)
    history = solved(
        grid={"cells": [64, 64], "size": [2.3 * radius, 2.3 * radius]},
        lower={"substrate": {"young": 1.0, "poisson": 0.3}},
        friction={"coefficient": 0.2},
        load=[{"normal_force": 1e-6, "increments": increments, "ramp": ramp}],
        output={"fields": []},
    )
    steps = history.increments
    ratio = float(np.sqrt(steps["stick_area"][-1] / steps["contact_area"][-1]))
    return ratio - STICK_RADIUS, float(steps["dissipated_energy"][-1]) / ENERGY - 1


def loop(increments: int) -> tuple[np.ndarray, float, float]:
    """Return shear at the end, energy of the cycle, and shift at its peak: E_c/E_s = 2, h = a, mu = 0.3, T = 0.75 mu
    P.
    """
    radius = (0.75e-6 * 0.91) ** (1 / 3)
    history = solved(
        grid={"cells": [48, 48], "size": [2.3 * radius, 2.3 * radius]},
        lower={
            "coatings": [{"thickness": radius, "young": 2.0, "poisson": 0.3}],
            "substrate": {"young": 1.0, "poisson": 0.3},
        },
        friction={"coefficient": 0.3},
        load=[
            {"normal_force": 1e-6, "increments": 32, "ramp": "cubic"},
            {"tangential_force": [0.75 * 0.3e-6, 0.0], "cycles": 1, "increments": increments},
        ],
    )
    peak = float(np.max(history.increments["shift_x"]))
    return history.field("shear_x"), float(history.cycles["dissipated_energy"][0]), peak


if __name__ == "__main__":
    print("| increments | c/a linear | cubic | energy linear | cubic |\n|---|---|---|---|---|")
    for increments in (5, 10, 20, 40, 80, 160, "auto"):
        (linear, lost), (cubic, gone) = pressed(increments, "linear"), pressed(increments, "cubic")
        print(
            f"| {increments} | {linear:+.4f} | {cubic:+.4f} | {100 * lost:+.1f} % | {100 * gone:+.1f} % |", flush=True
        )
    print(
        "\n| increments a cycle | shear at the end, rms | energy of the cycle | shift at the peak |\n|---|---|---|---|"
    )
    shear, energy, shift = loop(256)
    for increments in (8, 16, 32, 64, 128):
        found, lost, peak = loop(increments)
        rms = float(np.linalg.norm(found - shear) / np.linalg.norm(shear))
        print(
            f"| {increments} | {rms:.1e} | {100 * (lost / energy - 1):+.3f} % | {peak / shift - 1:+.1e} |", flush=True
        )
