"""Normal contact with friction and coupling: computed points of Spence's problem."""

import json
from dataclasses import dataclass

from fretting import _core
from fretting._arguments import checked


@dataclass(frozen=True)
class SpencePoint:
    """One computed solution of normal contact with friction and normal-tangential coupling (Spence's problem)."""

    poisson: float
    """Poisson's ratio [-]."""
    stick_ratio: float
    """Stick radius over contact radius, c/a [-]."""
    friction: float
    """Friction coefficient [-]."""
    radius_ratio: float | None
    """Contact radius over Hertz's [-]; None where it was not computed, as below."""
    peak_pressure_ratio: float | None
    """Pressure in the middle over Hertz's [-]."""
    approach_ratio: float | None
    """Approach over Hertz's [-]."""
    punch_force_ratio: float | None
    """Flat punch: force over the frictionless one at the same approach [-]."""


@checked
def spence_table() -> list[SpencePoint]:
    """Return the computed points of Spence's problem, by Poisson's ratio and stick ratio; uncertainty 1e-4.

    References
    ----------
    Spence (1968), Proc. R. Soc. A 305, 55; (1975), J. Elasticity 5, 297, for the problem.
    """
    return [SpencePoint(**point) for point in json.loads(_core.spence_table())]
