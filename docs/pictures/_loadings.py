"""The cases of the figures about loadings."""

from typing import Any

import numpy as np

from fretting import analytic

MU = 0.3
RADIUS = 100.0
MODULUS = 0.5  # E*, two bodies of E = 1, nu = 0
SHEAR = 0.125  # G*
FORCE = 4 * MODULUS / (3 * RADIUS)  # contact radius 1
PEAK = 1.5 * FORCE / np.pi
ONSET = 3 * MU * FORCE / (16 * SHEAR)  # displacement at the onset of gross slip


def problem(
    cells: int, stages: list[dict[str, Any]], coating: tuple[float, float] | None = None, **more: Any
) -> dict[str, Any]:
    """Return a sphere of contact radius 1 on an identical body with nu = 0, or rigid on a coated one with nu = 0.3."""
    body = {"substrate": {"young": 1.0, "poisson": 0.0}}
    upper = body
    if coating:
        body = {
            "coatings": [{"thickness": coating[1], "young": coating[0], "poisson": 0.3}],
            "substrate": {"young": 1.0, "poisson": 0.3},
        }
        upper = {"rigid": True}
    return {
        "grid": {"cells": [cells, cells], "size": [2.4, 2.4]},
        "upper": upper,
        "lower": body,
        "profile": {"sphere": {"radius": RADIUS}},
        "friction": {"coefficient": MU},
        "load": stages,
        "output": {"fields": ["pressure", "shear", "zone"], "every": 1},
        **more,
    }


def indentation(fraction: float = 1.0, **more: Any) -> dict[str, Any]:
    """Return a stage that loads to a fraction of the force."""
    return {"normal_force": fraction * FORCE, "increments": 1, **more}


class Springs:
    """The sphere as a row of independent springs (Popov & Hess): exact for these bodies and any history along one
    line.
    """

    def __init__(self, count: int = 4000, widest: float = 1.2) -> None:
        """Set the springs at rest."""
        self.x = (np.arange(count) + 0.5) * widest / count
        self.step = widest / count
        self.pulled = np.zeros(count)
        self.shift = self.loss = 0.0

    def follow(self, normal: float, pull: float) -> float:
        """Go to a normal and a tangential force, and return the relative displacement."""
        approach = (0.75 * normal / (MODULUS * RADIUS**0.5)) ** (2 / 3)
        bound = MU * MODULUS * np.maximum(approach - self.x**2 / RADIUS, 0) / (4 * SHEAR)

        def force(move: float) -> float:
            return float(2 * 4 * SHEAR * self.step * np.clip(self.pulled + move, -bound, bound).sum())

        low, high = -20 * ONSET, 20 * ONSET
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if force(middle) < pull else (low, middle)
        held = np.clip(self.pulled + low, -bound, bound)
        self.loss += 2 * 4 * SHEAR * self.step * (held * (self.pulled + low - held))[bound > 0].sum()
        self.pulled = held
        self.shift += low
        return self.shift


def along(history: Any) -> tuple[np.ndarray, float]:
    """Return displacement and dissipated energy of the springs along the forces of a history."""
    springs = Springs()
    steps = history.increments
    shifts = [springs.follow(p, t) for p, t in zip(steps["normal_force"], steps["tangential_force_x"], strict=True)]
    return np.array(shifts), springs.loss


def sphere_contact() -> Any:
    """Return the Hertz contact of the problem."""
    return analytic.hertz(radius=RADIUS, force=FORCE, modulus=MODULUS)
