"""Line contacts in plane strain: pressure, partial slip, bulk strain, sliding, tilt."""

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from fretting import _core
from fretting._arguments import checked
from fretting._arrays import Reals
from fretting.analytic._solution import curve, forces_of, numbers_of, of_each


@dataclass(frozen=True)
class HertzLine:
    """Frictionless line contact of a cylinder (gap ``x^2 / (2 R)``)."""

    radius: float
    """Relative radius R [length]."""
    modulus: float
    """Effective modulus E* [pressure]."""
    line_force: float
    """Force per length [force/length]."""
    half_width: float
    """Half-width of the contact [length]."""
    max_pressure: float
    """Maximum contact pressure p0 [pressure]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def pressure(self, x: npt.ArrayLike) -> Reals:
        """Pressure at `x` from the middle [pressure], of the shape of `x`; zero outside the contact."""
        return curve(self._solution, "pressure", x)


@checked
def hertz_line(*, radius: float, line_force: float, modulus: float) -> HertzLine:
    """Press a cylinder on a half-space without friction, under a force per length [force/length].

    Parameters
    ----------
    radius : float
        Relative radius of curvature [length].
    line_force : float
        Normal force per unit of length [force/length].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.

    References
    ----------
    Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2(c).
    """
    solution = _core.hertz_line(radius, line_force, modulus)
    return HertzLine(radius=float(radius), modulus=float(modulus), **numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class CattaneoLine:
    """Partial slip of a Hertz line contact under a tangential force and a strain that grow together."""

    tangential_force: float
    """Tangential force per length [force/length], signed."""
    sliding_force: float
    """Largest tangential force per length that friction holds [force/length]."""
    half_width: float
    """Half-width a of the contact [length]."""
    max_shear: float
    """Largest shear that friction holds anywhere, mu p0 [pressure]."""
    stick_half_width: float
    """Half-width c of what sticks [length]."""
    stick_offset: float
    """Middle e of what sticks [length]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def shear(self, x: npt.ArrayLike) -> Reals:
        """Shear at `x` from the middle [pressure], with the sign of the force; zero outside the contact."""
        return curve(self._solution, "shear", x)


@checked
def cattaneo_line(
    cylinder: HertzLine, *, friction_coefficient: float, tangential_force: float, strain: float = 0.0
) -> CattaneoLine:
    """Push a Hertz line contact across its axis, while a strain grows in proportion.

    ``c = a sqrt(1 - |Q|/(mu P))``, ``e = a E* strain/(2 mu p0)``; for bodies that do not couple, as long as all that
    slips slips one way (``|e| + c <= a``).

    Parameters
    ----------
    cylinder : HertzLine
        The normal contact.
    friction_coefficient : float
        Friction coefficient [-].
    tangential_force : float
        Tangential force per length [force/length], at most friction times normal force.
    strain : float
        Strain of the lower surface less that of the upper one [-]: ``sigma (1 - nu^2)/E`` under a tension of the lower
        body.

    References
    ----------
    Cattaneo (1938); Mindlin (1949); Nowell & Hills (1987), Int. J. Mech. Sci. 29, 355.
    """
    solution = _core.cattaneo_line(_line_numbers(cylinder), friction_coefficient, tangential_force, strain)
    return CattaneoLine(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class LineHistory:
    """A Hertz line contact taken through any sequence of tangential forces, at constant normal force."""

    tangential_forces: Reals
    """Tangential forces per length in their order [force/length]."""
    shift: Reals | None
    """Relative tangential displacement of points at the datum at each force [length]; None without a datum."""
    stick_half_width: Reals
    """Half-width of what has not slipped since the force last turned, at each force [length]."""
    dissipated_energy: Reals
    """Energy dissipated by friction per length since the start, at each force [force]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def shear(self, x: npt.ArrayLike) -> Reals:
        """Shear at the last force at `x` from the middle [pressure], along the force; zero outside the contact."""
        return curve(self._solution, "shear", x)


@checked
def line_history(
    cylinder: HertzLine,
    *,
    friction_coefficient: float,
    tangential_forces: npt.ArrayLike,
    shear_compliance: float | None = None,
    along_axis: bool = False,
    datum: float | None = None,
) -> LineHistory:
    """Take a Hertz line contact through tangential forces, in any order.

    Loops that close are forgotten (Masing's rule). For bodies that do not couple.

    Parameters
    ----------
    cylinder : HertzLine
        The normal contact.
    friction_coefficient : float
        Friction coefficient [-].
    tangential_forces : array_like
        Tangential forces per length, one after the other from zero on, shape ``(n,)`` [force/length]; between them the
        force is monotone. None is more than friction times normal force.
    shear_compliance : float, optional
        Sum of ``1/G`` of the bodies that deform [1/pressure]; needed along the axis and with a datum.
    along_axis : bool, optional
        Whether the forces act along the axis of the cylinder (antiplane), not across it.
    datum : float, optional
        Depth below the surfaces of the points whose displacement is asked for [length], far greater than the
        half-width.

    References
    ----------
    Cattaneo (1938); Mindlin (1949); Jäger (1993), *Arch. Appl. Mech.* 63, 402.
    """
    if shear_compliance is None and (along_axis or datum is not None):
        raise ValueError("shear_compliance: along the axis and with a datum the sum of 1/G of the bodies is needed")
    if datum is not None and not (np.isfinite(datum) and datum > 0):
        raise ValueError(f"datum = {datum!r}: must be a positive depth")
    of_bodies = 0.0 if shear_compliance is None else float(shear_compliance)
    compliance = of_bodies if along_axis else 2 / cylinder.modulus
    at_datum = 0.0 if along_axis else -of_bodies / (2 * np.pi)
    solution = _core.line_history(
        _line_numbers(cylinder),
        friction_coefficient,
        compliance,
        forces_of(tangential_forces),
        None if datum is None else (float(datum), at_datum),
    )
    return LineHistory(**of_each(numbers_of(solution)), _solution=solution)


@dataclass(frozen=True)
class StretchedLine:
    """A Hertz line contact whose bodies are stretched against each other without a tangential force."""

    half_width: float
    """Half-width a of the contact [length]."""
    stick_half_width: float
    """Half-width c of what sticks [length]."""


@checked
def stretched_line(cylinder: HertzLine, *, friction_coefficient: float, strain: float) -> StretchedLine:
    """Stretch a Hertz line contact without a tangential force: both edges slip, in opposite senses.

    ``E* strain/(2 mu p0) = (2/pi) [K(k) - E(k)]``, ``k^2 = 1 - c^2/a^2``, for bodies that do not couple.

    Parameters
    ----------
    cylinder : HertzLine
        The contact that is stretched, of :func:`hertz_line`.
    friction_coefficient : float
        Coefficient of friction [-].
    strain : float
        Strain of the lower surface less that of the upper one [-].
    """
    return StretchedLine(**numbers_of(_core.stretched_line(_line_numbers(cylinder), friction_coefficient, strain)))


@dataclass(frozen=True)
class SlidingCylinder:
    """Line contact of a cylinder in full sliding, with normal-tangential coupling."""

    line_force: float
    """Force per length [force/length]."""
    half_width: float
    """Half-width a of the contact [length]."""
    exponent: float
    """Exponent gamma [-], ``tan(pi gamma) = beta mu``."""
    offset: float
    """Middle of the contact from the cylinder's axis [length], with the shear on the lower body along +x."""
    max_pressure: float
    """Maximum contact pressure [pressure]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def pressure(self, x: npt.ArrayLike) -> Reals:
        """Pressure at `x` from the middle of the contact [pressure]; zero outside."""
        return curve(self._solution, "pressure", x)


@checked
def sliding_cylinder(
    *, radius: float, line_force: float, modulus: float, coupling: float, friction_coefficient: float
) -> SlidingCylinder:
    """Slide a cylinder across its axis on a half-space, with Dundurs' coupling beta [-].

    ``p = (E*/2R) cos(pi g) (a + x)^(1/2 - g) (a - x)^(1/2 + g)``, ``tan(pi g) = beta mu``; friction is negative for
    shear on the lower body along -x.

    Parameters
    ----------
    radius : float
        Relative radius of curvature [length].
    line_force : float
        Normal force per unit of length [force/length].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.
    coupling : float
        Dundurs' beta [-]: ``effective_moduli(...).coupling``.
    friction_coefficient : float
        Coefficient of friction [-].

    References
    ----------
    Bufler (1959); Johnson (1985), *Contact Mechanics*, section 8.2.
    """
    solution = _core.sliding_cylinder(radius, line_force, modulus, coupling, friction_coefficient)
    return SlidingCylinder(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class TiltedLinePunch:
    """A flat punch of infinite length under a force and tilted by a slope across it, deeper at positive x."""

    line_force: float
    """Force per length [force/length]."""
    tilt: float
    """Slope [-]."""
    moment: float
    """Moment per length [force], positive with the pressure to positive x."""
    half_width: float
    """Half-width of the punch and of the contact [length]."""
    modulus: float
    """Effective modulus E* [pressure]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def pressure(self, x: npt.ArrayLike) -> Reals:
        """Pressure at `x` from the middle [pressure]; infinite at the edge, zero outside."""
        return curve(self._solution, "pressure", x)


@checked
def tilted_line_punch(*, half_width: float, line_force: float, modulus: float, tilt: float) -> TiltedLinePunch:
    """Press a flat punch of infinite length that is tilted by a slope, all of it in contact.

    Parameters
    ----------
    half_width : float
        Half the width of the punch [length].
    line_force : float
        Normal force per unit of length [force/length].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.
    tilt : float
        Slope of the punch against the surface [-].

    References
    ----------
    Johnson (1985), *Contact Mechanics*, section 2.8.
    """
    solution = _core.tilted_line_punch(half_width, line_force, modulus, tilt)
    return TiltedLinePunch(**numbers_of(solution), _solution=solution)


def _line_numbers(cylinder: HertzLine) -> tuple[float, float, float]:
    return cylinder.radius, cylinder.line_force, cylinder.modulus
