"""Indentation with friction: without slip, and the partial slip of Spence."""

import json
from dataclasses import dataclass

from fretting import _core
from fretting._arguments import checked
from fretting.analytic._solution import numbers_of


@dataclass(frozen=True)
class NoSlipPunch:
    """Flat circular punch without slip, under a growing normal force."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the punch and of the contact [length]."""
    approach: float
    """Approach [length]."""
    force_ratio: float
    """Force over that of the frictionless punch at the same approach [-]."""


@checked
def no_slip_punch(*, radius: float, force: float, modulus: float, coupling: float) -> NoSlipPunch:
    """Press a flat circular punch that sticks; `coupling` is Dundurs' beta [-].

    ``P = 2 E* a delta ln((1 + beta)/(1 - beta)) / (2 beta)``.

    Parameters
    ----------
    radius : float
        Radius of the punch [length].
    force : float
        Normal force, positive in compression [force].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.
    coupling : float
        Dundurs' beta [-]: ``effective_moduli(...).coupling``.

    References
    ----------
    Mossakovskii (1954), PMM 18, 187; Spence (1968), Proc. R. Soc. A 305, 55.
    """
    return NoSlipPunch(**numbers_of(_core.no_slip_punch(radius, force, modulus, coupling)))


@dataclass(frozen=True)
class NoSlipSphere:
    """Sphere without slip, under a growing normal force."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    approach: float
    """Approach delta [length]."""
    approach_factor: float
    """``delta R / a^2`` [-]; 1 for the Hertz contact."""
    force_ratio: float
    """Force over that of the frictionless sphere at the same contact radius [-]."""


@checked
def no_slip_sphere(*, radius: float, force: float, modulus: float, coupling: float) -> NoSlipSphere:
    """Press a sphere that sticks as it touches; `coupling` is Dundurs' beta [-], 0 gives the Hertz contact.

    Parameters
    ----------
    radius : float
        Relative radius of curvature [length].
    force : float
        Normal force, positive in compression [force].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.
    coupling : float
        Dundurs' beta [-]: ``effective_moduli(...).coupling``.

    References
    ----------
    Mossakovskii (1963); Spence (1968), Proc. R. Soc. A 305, 55.
    """
    return NoSlipSphere(**numbers_of(_core.no_slip_sphere(radius, force, modulus, coupling)))


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
