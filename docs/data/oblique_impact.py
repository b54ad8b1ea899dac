"""The oblique impact of a ball: tractions by the program, rigid-body motion of the ball integrated around it.

The program has no inertia. An impact is staged in passes: from a motion of the ball (approach and relative displacement
at equal times) the program gives the forces, and from the forces Newton's laws, ``m dv = F dt`` and ``I dw = F R dt``,
give the next motion. Where motion and forces no longer change they are those of the impact. The first motion comes from
the uncoupled theory, integrated in time directly: springs of the method of dimensionality reduction, exact for
elastically similar bodies.
"""

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import fretting
from fretting import analytic

GOLDEN = Path(__file__).parents[2] / "tests" / "golden" / "experiments" / "kharaz_2001"
GIVEN = ("tangential_restitution", "spin", "rebound_angle")
BALL = {"young": 380e9, "poisson": 0.23}
GLASS = {"young": 70e9, "poisson": 0.25}
RADIUS, DENSITY, FRICTION, SPEED = 2.5e-3, 4000.0, 0.092, 3.9
MASS = 4 / 3 * np.pi * RADIUS**3 * DENSITY
INERTIA = 0.4 * MASS * RADIUS**2
HERTZ_TIME = 2.9432
"""Duration of Hertz's impact over approach by speed (Johnson 1985, section 11.4)."""


@dataclass(frozen=True)
class Rebound:
    """What an impact leaves: velocity of the centre over that before, spin [rad/s], angle from the normal [deg]."""

    tangential: float
    normal: float
    spin: float
    angle: float


def measured(name: str) -> list[tuple[float, float]]:
    """Return rows of angle [deg] and measured value: ``tangential_restitution``, ``spin`` or ``rebound_angle``."""
    with (GOLDEN / f"{name}.csv").open(encoding="utf-8") as file:
        return [(float(row[0]), float(row[1])) for row in list(csv.reader(file))[1:]]


def rebound(angle: float, velocity: tuple[float, float, float]) -> Rebound:
    """Return what the velocities along x, along the normal (positive away) and of spin after an impact say."""
    along, away, spin = velocity
    incident = np.radians(angle)
    return Rebound(
        tangential=along / (SPEED * np.sin(incident)),
        normal=away / (SPEED * np.cos(incident)),
        spin=spin,
        angle=float(np.degrees(np.arctan2(along, away))),
    )


def rigid(angle: float, friction: float = FRICTION) -> Rebound:
    """Return the rebound of a rigid ball: it slides throughout, or rolls at the end (impulse mu P, or 2/7)."""
    before, normal = SPEED * np.sin(np.radians(angle)), SPEED * np.cos(np.radians(angle))
    impulse = min(2 * friction * normal, before * 2 / 7)
    return rebound(angle, (before - impulse, normal, impulse * MASS * RADIUS / INERTIA))


def largest_approach(angle: float, modulus: float) -> float:
    """Return the largest approach of a frictionless impact [m]."""
    stiffness = 4 / 3 * modulus * np.sqrt(RADIUS)
    return float((1.25 * MASS * (SPEED * np.cos(np.radians(angle))) ** 2 / stiffness) ** 0.4)


def uncoupled(
    angle: float,
    friction: float = FRICTION,
    bodies: tuple[Any, Any] = (BALL, GLASS),
    springs: int = 400,
    steps: int = 6000,
) -> tuple[Rebound, Any]:
    """Integrate an impact without normal-tangential coupling; also return rows of time, approach, displacement."""
    moduli = analytic.effective_moduli(upper=bodies[0], lower=bodies[1])
    before, normal = SPEED * np.sin(np.radians(angle)), SPEED * np.cos(np.radians(angle))
    deepest = largest_approach(angle, moduli.normal)
    duration = HERTZ_TIME * deepest / normal
    width = np.sqrt(RADIUS * deepest) * 1.05 / springs
    gap = ((np.arange(springs) + 0.5) * width) ** 2 / RADIUS
    along = np.zeros(springs)  # force of a spring over its stiffness: its stretch
    tangential = 4 * moduli.shear * width * 2  # both sides of the middle
    pressing = moduli.normal * width * 2
    step = duration / steps
    approach, shift = 0.0, 0.0
    velocity = np.array([before, -normal, 0.0])
    path = [(0.0, 0.0, 0.0)]
    push = np.zeros(2)
    for count in range(1, steps + 400):
        # leapfrog: velocities at half steps from the forces at the whole ones
        factor = 0.5 if count == 1 else 1.0
        velocity += step * factor * np.array([-push[0] / MASS, push[1] / MASS, push[0] * RADIUS / INERTIA])
        if approach < 0:
            break
        moved = step * (velocity[0] - RADIUS * velocity[2])
        shift += moved
        approach -= step * velocity[1]
        load = np.maximum(approach - gap, 0.0) * pressing
        bound = friction * load / tangential
        along = np.clip(along + moved, -bound, bound)
        push = np.array([tangential * along.sum(), load.sum()])
        path.append((count * step, approach, shift))
    return rebound(angle, (velocity[0], velocity[1], velocity[2])), np.array(path)


def coupled(
    angle: float,
    friction: float = FRICTION,
    bodies: tuple[Any, Any] = (BALL, GLASS),
    cells: int = 48,
    increments: int = 160,
    passes: int = 20,
    enough: float = 5e-4,
) -> tuple[Rebound, float]:
    """Return the rebound with the program's forces, and by how much of it the displacement still changed.

    Passes end when the motion that the forces give is the one that they were computed for, to `enough` of the largest
    displacement.
    """
    _, path = uncoupled(angle, friction, bodies)
    modulus = analytic.effective_moduli(upper=bodies[0], lower=bodies[1]).normal
    deepest = largest_approach(angle, modulus)
    before, normal = SPEED * np.sin(np.radians(angle)), SPEED * np.cos(np.radians(angle))
    times = np.linspace(0.0, HERTZ_TIME * deepest / normal, increments + 1)
    approach, shift = (np.interp(times, path[:, 0], path[:, column]) for column in (1, 2))
    mixed = Mixing()
    for _ in range(passes):
        history = fretting.run(
            {
                "grid": {"cells": [cells, cells], "size": [2.3 * np.sqrt(RADIUS * deepest)] * 2},
                "upper": {"substrate": bodies[0]},
                "lower": {"substrate": bodies[1]},
                "profile": {"sphere": {"radius": RADIUS}},
                "friction": {"coefficient": friction},
                "load": [
                    {"approach": float(depth), "shift": [float(place), 0.0], "increments": 1}
                    for depth, place in zip(approach[1:], shift[1:], strict=True)
                ],
                "output": {"fields": []},
            }
        ).increments
        impulse_along, impulse_normal = (
            _sums(times, np.concatenate([[0.0], history[name]])) for name in ("tangential_force_x", "normal_force")
        )
        along, away = before - impulse_along / MASS, impulse_normal / MASS - normal
        spin = impulse_along * RADIUS / INERTIA
        found = rebound(angle, (along[-1], away[-1], spin[-1]))
        given = np.concatenate([approach, shift])
        moved = np.concatenate([-_sums(times, away), _sums(times, along - spin * RADIUS)])
        changed = float(np.abs(moved - given)[increments + 1 :].max() / np.abs(shift).max())
        if changed < enough:
            break
        approach, shift = np.split(mixed.next(given, moved), 2)
        approach = np.maximum(approach, 0.0)
    return found, changed


class Mixing:
    """Anderson's mixing for a fixed point: the next motion from the last few and from what they led to.

    Source: D. G. Anderson (1965), J. ACM 12, 547. Without it motions at small angles alternate.
    """

    def __init__(self, depth: int = 10) -> None:
        self.depth = depth
        self.given: list[Any] = []
        self.led: list[Any] = []

    def next(self, given: Any, led: Any) -> Any:
        """Return the next motion, from one and what it led to."""
        self.given, self.led = [*self.given, given][-self.depth :], [*self.led, led][-self.depth :]
        off = [b - a for a, b in zip(self.given, self.led, strict=True)]
        if len(off) == 1:
            return 0.5 * (given + led)
        steps = np.array([off[-1] - earlier for earlier in off[:-1]]).T
        weights, *_ = np.linalg.lstsq(steps, off[-1], rcond=None)
        return led - sum(w * (self.led[-1] - earlier) for w, earlier in zip(weights, self.led[:-1], strict=True))


def _sums(times: Any, values: Any) -> Any:
    """Return the integral over time up to every time, by trapezoids."""
    return np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(times))])
