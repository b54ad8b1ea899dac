"""The coated contact that several figures show: a steel-like half-space under a rigid ball, bare and coated."""

from typing import Any

import numpy as np

from fretting import analytic

MU, FORCE, RADIUS, YOUNG, POISSON = 0.3, 12.0, 10e-3, 210e9, 0.3
MODULI = analytic.effective_moduli(lower={"young": YOUNG, "poisson": POISSON})
HERTZ = analytic.hertz(radius=RADIUS, force=FORCE, modulus=MODULI.normal)
ONSET = 3 * MU * FORCE / (16 * MODULI.shear * HERTZ.contact_radius)
"""Displacement at which the uncoated contact begins to slide (Cattaneo, Mindlin) [m]."""


def coated(ratio: float, stages: list[dict[str, Any]], cells: int = 96, **more: Any) -> dict[str, Any]:
    """Return a rigid ball on a half-space with a coating of E_c/E_s = ratio as thick as the Hertz radius."""
    coating = {"thickness": HERTZ.contact_radius, "young": ratio * YOUNG, "poisson": POISSON}
    return {
        "grid": {"cells": [cells, cells], "size": "auto"},
        "upper": {"rigid": True},
        "lower": {"coatings": [coating], "substrate": {"young": YOUNG, "poisson": POISSON}},
        "profile": {"sphere": {"radius": RADIUS}},
        "friction": {"coefficient": MU},
        "load": [{"name": "press", "normal_force": FORCE, "increments": 20}, *stages],
        **more,
    }


def cycle(amplitude: float, increments: int = 48, cycles: int = 2) -> dict[str, Any]:
    """Return a stage of tangential cycles of amplitude times mu P along x."""
    return {
        "name": "fretting",
        "tangential_force": [amplitude * MU * FORCE, 0.0],
        "increments": increments,
        "cycles": cycles,
    }


def along(history: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return relative displacement over that of the onset, and tangential force over mu P."""
    return history.increments["shift_x"] / ONSET, history.increments["tangential_force_x"] / (MU * FORCE)
