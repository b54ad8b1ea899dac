"""Closed-form contact solutions, to plot and to compare with.

Signs: pressure and approach are positive in compression; shear, shift and tangential force are those of the upper body
on the lower. Any consistent system of units. Everything here holds for homogeneous half-spaces;
:func:`effective_moduli` says how compliant two of them are together.

>>> from fretting import analytic
>>> moduli = analytic.effective_moduli(lower={"young": 210e9, "poisson": 0.3})
>>> sphere = analytic.hertz(radius=10e-3, force=12.0, modulus=moduli.normal)
>>> f"{sphere.contact_radius:.3e} {sphere.max_pressure:.3e}"
'7.306e-05 1.073e+09'
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from fretting import _core
from fretting._arrays import Reals, real_array

__all__ = [
    "CattaneoLine",
    "CattaneoMindlin",
    "Cone",
    "EffectiveModuli",
    "EquibiaxialSphere",
    "FlatPunch",
    "Hertz",
    "HertzEllipse",
    "HertzLine",
    "LoopPoint",
    "MindlinDeresiewicz",
    "NoSlipPunch",
    "NoSlipSphere",
    "RoundedPunch",
    "SlidingCylinder",
    "SpencePoint",
    "StretchedLine",
    "StretchedSphere",
    "ThickLayer",
    "ThinLayer",
    "TiltedLinePunch",
    "TiltedPunch",
    "Torsion",
    "Westergaard",
    "cattaneo_line",
    "cattaneo_mindlin",
    "cone",
    "effective_moduli",
    "equibiaxial_sphere",
    "flat_punch",
    "hertz",
    "hertz_ellipse",
    "hertz_line",
    "mindlin_deresiewicz",
    "no_slip_punch",
    "no_slip_sphere",
    "rounded_punch",
    "sliding_cylinder",
    "spence_table",
    "stretched_line",
    "stretched_sphere",
    "thick_layer",
    "thin_layer",
    "tilted_line_punch",
    "tilted_punch",
    "torsion",
    "westergaard",
]

Material: TypeAlias = Mapping[str, float]
"""``young`` [pressure] and ``poisson`` [-], as in a case."""
Layer: TypeAlias = Mapping[str, float]
"""``thickness`` [length], ``young`` [pressure] and ``poisson`` [-], as in a case."""
Branch: TypeAlias = Literal["loading", "unloading", "reloading"]


@dataclass(frozen=True)
class EffectiveModuli:
    """Effective moduli of two homogeneous half-spaces; a rigid body adds no compliance."""

    normal: float
    """``1/E* = sum of (1 - nu^2)/E`` [pressure]: normal contact."""
    shear: float
    """``1/G* = sum of (2 - nu)/G`` [pressure]: tangential contact."""
    torsional: float
    """``1/G = sum of 1/G`` [pressure]: torsion."""
    coupling: float
    """Dundurs' beta [-], 0 for elastically similar bodies."""


@dataclass(frozen=True)
class Hertz:
    """Frictionless contact of a sphere (paraboloid ``r^2 / (2 R)``)."""

    radius: float
    """Relative radius R [length]."""
    modulus: float
    """Effective modulus E* [pressure]."""
    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    max_pressure: float
    """Maximum contact pressure p0 [pressure]."""
    approach: float
    """Approach of distant points [length]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def pressure(self, r: npt.ArrayLike) -> Reals:
        """Pressure at distances `r` from the middle [pressure], of the shape of `r`; zero outside the contact."""
        return _curve(self._solution, "pressure", r)


@dataclass(frozen=True)
class HertzEllipse:
    """Frictionless contact of an ellipsoid (gap ``x^2 / (2 Rx) + y^2 / (2 Ry)``)."""

    force: float
    """Normal force P [force]."""
    semi_axes: tuple[float, float]
    """Semi-axes of the contact along x and y [length]."""
    max_pressure: float
    """Maximum contact pressure p0 [pressure]."""
    approach: float
    """Approach of distant points [length]."""

    def pressure(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Reals:
        """Pressure at points [pressure], of the broadcast shape of `x` and `y`; zero outside the contact."""
        a, b = self.semi_axes
        depth = 1.0 - (real_array("x", x) / a) ** 2 - (real_array("y", y) / b) ** 2
        pressure: Reals = self.max_pressure * np.sqrt(np.maximum(depth, 0.0))
        return pressure


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
        return _curve(self._solution, "pressure", x)


@dataclass(frozen=True)
class FlatPunch:
    """Frictionless contact of a flat circular punch."""

    force: float
    """Normal force [force]."""
    contact_radius: float
    """Radius of the punch and of the contact [length]."""
    approach: float
    """Approach [length]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def pressure(self, r: npt.ArrayLike) -> Reals:
        """Pressure at distances `r` from the middle [pressure]; infinite at the edge, zero outside."""
        return _curve(self._solution, "pressure", r)


@dataclass(frozen=True)
class Cone:
    """Frictionless contact of a blunt cone (gap ``slope r``)."""

    force: float
    """Normal force [force]."""
    contact_radius: float
    """Radius of the contact [length]."""
    approach: float
    """Approach [length]."""
    mean_pressure: float
    """Mean pressure [pressure], whatever the load."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def pressure(self, r: npt.ArrayLike) -> Reals:
        """Pressure at distances `r` from the tip [pressure]; infinite at the tip, zero outside the contact."""
        return _curve(self._solution, "pressure", r)


@dataclass(frozen=True)
class Westergaard:
    """Frictionless contact of a sinusoidal surface with a flat one, plane strain."""

    wavelength: float
    """Wavelength [length]."""
    mean_pressure: float
    """Mean pressure over a wavelength [pressure]."""
    full_contact_pressure: float
    """Mean pressure at which the contact becomes full [pressure]."""
    half_width: float
    """Half-width of the contact at a crest [length]; half the wavelength in full contact."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def pressure(self, x: npt.ArrayLike) -> Reals:
        """Pressure at `x` from a crest [pressure], of the shape of `x`."""
        return _curve(self._solution, "pressure", x)


@dataclass(frozen=True)
class CattaneoMindlin:
    """Partial slip of a Hertz contact under a growing tangential force at constant normal force."""

    tangential_force: float
    """Tangential force Q [force], signed."""
    sliding_force: float
    """Largest tangential force that friction holds, mu P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    max_shear: float
    """Largest shear that friction holds anywhere, mu p0 [pressure]."""
    initial_stiffness: float
    """Tangential stiffness before any slip [force/length]."""
    stick_radius: float
    """Stick radius c [length]."""
    shift: float
    """Relative tangential displacement of the bodies [length], with the sign of Q."""
    full_slip_shift: float
    """Relative displacement at the onset of full slip [length]."""
    dissipated_energy: float
    """Dissipated energy since the tangential force was zero [force x length]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def shear(self, r: npt.ArrayLike) -> Reals:
        """Shear at distances `r` from the middle [pressure], along the force; zero outside the contact."""
        return _curve(self._solution, "shear", r)

    def slip(self, r: npt.ArrayLike) -> Reals:
        """Slip at distances `r` [length], along the force, averaged over the direction; zero where the bodies stick."""
        return _curve(self._solution, "slip", r)


@dataclass(frozen=True)
class LoopPoint:
    """A Hertz contact at one point of its fretting loop."""

    tangential_force: float
    """Tangential force Q [force]."""
    shift: float
    """Relative tangential displacement of the bodies [length]."""
    stick_radius: float
    """Radius of the disc that has not slipped since the last turning point [length]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def shear(self, r: npt.ArrayLike) -> Reals:
        """Shear at distances `r` from the middle [pressure], along the force; zero outside the contact."""
        return _curve(self._solution, "shear", r)


@dataclass(frozen=True)
class MindlinDeresiewicz:
    """The fretting loop of a Hertz contact between two equal tangential forces, at constant normal force."""

    sphere: Hertz
    """The normal contact."""
    friction_coefficient: float
    """Friction coefficient [-]."""
    shear_modulus: float
    """Effective shear modulus G* [pressure]."""
    amplitude: float
    """Amplitude of the tangential force [force]."""
    dissipated_energy_per_cycle: float
    """Dissipated energy W_d of one cycle [force x length]: the area of the loop."""
    energy_ratio: float
    """``A = W_d / (4 Q* delta*)`` [-]: 0.2 at the onset of full slip."""
    peak: CattaneoMindlin
    """The contact at the first peak."""

    def at(self, branch: Branch, tangential_force: float) -> LoopPoint:
        """Return the contact at a tangential force [force] on a branch of the loop.

        Raises
        ------
        ValueError
            When the loop does not reach the force.
        """
        solution = _core.mindlin_deresiewicz_at(
            _hertz_numbers(self.sphere), self.friction_coefficient, self.shear_modulus, self.amplitude, branch, tangential_force
        )
        return LoopPoint(**_numbers(solution), _solution=solution)


@dataclass(frozen=True)
class Torsion:
    """Partial slip of a Hertz contact under a growing torsional moment at constant normal force."""

    moment: float
    """Torsional moment [force x length], signed."""
    twist: float
    """Rotation of the upper body against the lower [rad]."""
    stick_radius: float
    """Stick radius [length]."""
    contact_radius: float
    """Radius of the contact [length]."""
    max_shear: float
    """Largest shear that friction holds anywhere, mu p0 [pressure]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def shear(self, r: npt.ArrayLike) -> Reals:
        """Circumferential shear at distances `r` from the middle [pressure]; zero outside the contact."""
        return _curve(self._solution, "shear", r)


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
        return _curve(self._solution, "shear", x)


@dataclass(frozen=True)
class StretchedLine:
    """A Hertz line contact whose bodies are stretched against each other without a tangential force."""

    half_width: float
    """Half-width a of the contact [length]."""
    stick_half_width: float
    """Half-width c of what sticks [length]."""


@dataclass(frozen=True)
class StretchedSphere:
    """Partial slip of a Hertz contact under a tangential force and a strain along it, Poisson's ratio 0."""

    tangential_force: float
    """Tangential force along x [force], signed."""
    sliding_force: float
    """Largest tangential force that friction holds [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    max_shear: float
    """Largest shear that friction holds anywhere, mu p0 [pressure]."""
    stick_radius: float
    """Radius c of the disc that sticks [length]."""
    stick_offset: float
    """Middle e of that disc along x [length]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def shear(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Reals:
        """Shear along x at points [pressure], of the broadcast shape of `x` and `y`; zero outside the contact."""
        return _surface(self._solution, x, y)


@dataclass(frozen=True)
class EquibiaxialSphere:
    """A Hertz contact whose bodies are stretched against each other alike in all directions of the surface."""

    contact_radius: float
    """Radius a of the contact [length]."""
    stick_radius: float
    """Radius c of the disc that sticks [length]."""


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
        return _curve(self._solution, "pressure", x)


@dataclass(frozen=True)
class TiltedPunch:
    """A flat circular punch under a force and tilted by a slope along x, deeper at positive x, without friction."""

    force: float
    """Normal force [force]."""
    tilt: float
    """Slope [-]."""
    moment: float
    """Moment [force x length], positive with the pressure to positive x."""
    contact_radius: float
    """Radius of the punch and of the contact [length]."""
    modulus: float
    """Effective modulus E* [pressure]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def pressure(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Reals:
        """Pressure at points [pressure], of the broadcast shape of `x` and `y`; infinite at the edge, zero outside."""
        return _surface(self._solution, x, y)


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
        return _curve(self._solution, "pressure", x)


def effective_moduli(*, lower: Material, upper: Material | None = None) -> EffectiveModuli:
    """Effective moduli of two bodies, each ``{"young": ..., "poisson": ...}``; default: a rigid upper body."""
    first, second = _material("lower", lower), None if upper is None else _material("upper", upper)
    return EffectiveModuli(**_numbers(_core.effective_moduli(first, second)))


def hertz(*, radius: float, force: float, modulus: float) -> Hertz:
    """Press a sphere on a half-space without friction.

    ``a^3 = 3 P R / (4 E*)``, ``p0 = 3 P / (2 pi a^2)``, ``approach = a^2 / R``. Exact with friction too when the bodies
    do not couple.

    Parameters
    ----------
    radius : float
        Relative radius R of the spheres [length].
    force : float
        Normal force [force].
    modulus : float
        Effective modulus E* [pressure].

    References
    ----------
    Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2.
    """
    solution = _core.hertz((radius, force, modulus))
    numbers = _numbers(solution)
    return Hertz(
        radius=numbers.pop("sphere_radius"),
        modulus=numbers.pop("effective_modulus"),
        **numbers,
        _solution=solution,
    )


def hertz_ellipse(*, radius_x: float, radius_y: float, force: float, modulus: float) -> HertzEllipse:
    """Press an ellipsoid on a half-space without friction; relative radii of curvature [length].

    References
    ----------
    Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2.
    """
    numbers = _numbers(_core.hertz_ellipse((radius_x, radius_y), force, modulus))
    a, b = numbers.pop("semi_axes")
    return HertzEllipse(semi_axes=(a, b), **numbers)


def hertz_line(*, radius: float, line_force: float, modulus: float) -> HertzLine:
    """Press a cylinder on a half-space without friction, under a force per length [force/length].

    References
    ----------
    Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2(c).
    """
    solution = _core.hertz_line(radius, line_force, modulus)
    return HertzLine(radius=float(radius), modulus=float(modulus), **_numbers(solution), _solution=solution)


def flat_punch(*, radius: float, force: float, modulus: float) -> FlatPunch:
    """Press a flat circular punch on a half-space without friction.

    References
    ----------
    Boussinesq (1885); Johnson (1985), *Contact Mechanics*, section 3.4.
    """
    solution = _core.flat_punch(radius, force, modulus)
    return FlatPunch(**_numbers(solution), _solution=solution)


def cone(*, slope: float, force: float, modulus: float) -> Cone:
    """Press a blunt cone, of the `slope` [-] of its side against the surface, on a half-space without friction.

    References
    ----------
    Love (1939); Sneddon (1965), Int. J. Engng Sci. 3, 47.
    """
    solution = _core.cone(slope, force, modulus)
    return Cone(**_numbers(solution), _solution=solution)


def westergaard(*, amplitude: float, wavelength: float, mean_pressure: float, modulus: float) -> Westergaard:
    """Press a sinusoidal surface on a flat half-space without friction.

    References
    ----------
    Westergaard (1939), J. Appl. Mech. 6, 49; Johnson (1985), *Contact Mechanics*, section 13.2.
    """
    solution = _core.westergaard(amplitude, wavelength, mean_pressure, modulus)
    return Westergaard(**_numbers(solution), _solution=solution)


def cattaneo_mindlin(sphere: Hertz, *, friction_coefficient: float, shear_modulus: float, tangential_force: float) -> CattaneoMindlin:
    """Partial slip of a Hertz contact under a first tangential load.

    Exact for uncoupled bodies with Poisson's ratio 0; otherwise it neglects the slip across the force.

    Parameters
    ----------
    sphere : Hertz
        The normal contact.
    friction_coefficient : float
        Friction coefficient [-].
    shear_modulus : float
        Effective shear modulus G* [pressure].
    tangential_force : float
        Tangential force [force], at most friction times normal force.

    References
    ----------
    Cattaneo (1938); Mindlin (1949); Johnson (1985), *Contact Mechanics*, section 7.2.
    """
    solution = _core.cattaneo_mindlin(_hertz_numbers(sphere), friction_coefficient, shear_modulus, tangential_force)
    return CattaneoMindlin(**_numbers(solution), _solution=solution)


def mindlin_deresiewicz(sphere: Hertz, *, friction_coefficient: float, shear_modulus: float, amplitude: float) -> MindlinDeresiewicz:
    """Fretting loop of a Hertz contact between two equal and opposite tangential forces.

    Limits as for :func:`cattaneo_mindlin`.

    Parameters
    ----------
    sphere : Hertz
        The normal contact.
    friction_coefficient : float
        Friction coefficient [-].
    shear_modulus : float
        Effective shear modulus G* [pressure].
    amplitude : float
        Amplitude of the tangential force [force], at most friction times normal force.

    References
    ----------
    Mindlin & Deresiewicz (1953); Johnson (1985), *Contact Mechanics*, section 7.4.
    """
    fretting_loop, peak = _core.mindlin_deresiewicz(_hertz_numbers(sphere), friction_coefficient, shear_modulus, amplitude)
    return MindlinDeresiewicz(
        sphere=sphere,
        friction_coefficient=friction_coefficient,
        shear_modulus=shear_modulus,
        amplitude=amplitude,
        peak=CattaneoMindlin(**_numbers(peak), _solution=peak),
        **_numbers(fretting_loop),
    )


def torsion(sphere: Hertz, *, friction_coefficient: float, shear_modulus: float, moment: float) -> Torsion:
    """Twist a Hertz contact about its normal for the first time; exact for any pair of homogeneous bodies.

    Parameters
    ----------
    sphere : Hertz
        The normal contact.
    friction_coefficient : float
        Friction coefficient [-].
    shear_modulus : float
        Torsional shear modulus [pressure].
    moment : float
        Torsional moment [force x length], less than ``3 pi mu P a / 16``.

    References
    ----------
    Lubkin (1951), J. Appl. Mech. 18, 183.
    """
    solution = _core.torsion(_hertz_numbers(sphere), friction_coefficient, shear_modulus, moment)
    return Torsion(**_numbers(solution), _solution=solution)


def cattaneo_line(cylinder: HertzLine, *, friction_coefficient: float, tangential_force: float, strain: float = 0.0) -> CattaneoLine:
    """Push a Hertz line contact across its axis, while a strain grows in proportion.

    ``c = a sqrt(1 - |Q|/(mu P))``, ``e = a E* strain/(2 mu p0)``; for bodies that do not couple, as long as all that slips
    slips one way (``|e| + c <= a``).

    Parameters
    ----------
    cylinder : HertzLine
        The normal contact.
    friction_coefficient : float
        Friction coefficient [-].
    tangential_force : float
        Tangential force per length [force/length], at most friction times normal force.
    strain : float
        Strain of the lower surface less that of the upper one [-]: ``sigma (1 - nu^2)/E`` under a tension of the lower body.

    References
    ----------
    Cattaneo (1938); Mindlin (1949); Nowell & Hills (1987), Int. J. Mech. Sci. 29, 355.
    """
    solution = _core.cattaneo_line(_line_numbers(cylinder), friction_coefficient, tangential_force, strain)
    return CattaneoLine(**_numbers(solution), _solution=solution)


def stretched_line(cylinder: HertzLine, *, friction_coefficient: float, strain: float) -> StretchedLine:
    """Stretch a Hertz line contact without a tangential force: both edges slip, in opposite senses.

    ``E* strain/(2 mu p0) = (2/pi) [K(k) - E(k)]``, ``k^2 = 1 - c^2/a^2``, for bodies that do not couple.
    """
    return StretchedLine(**_numbers(_core.stretched_line(_line_numbers(cylinder), friction_coefficient, strain)))


def stretched_sphere(
    sphere: Hertz, *, friction_coefficient: float, shear_modulus: float, tangential_force: float, strain: float
) -> StretchedSphere:
    """Push a Hertz contact along x while a strain along x grows in proportion; Poisson's ratio 0.

    ``c = a (1 - |T|/(mu P))^(1/3)``, ``e = 8 a G* strain/(pi mu p0)``, as long as ``|e| + c <= a``.
    """
    solution = _core.stretched_sphere(_hertz_numbers(sphere), friction_coefficient, shear_modulus, tangential_force, strain)
    return StretchedSphere(**_numbers(solution), _solution=solution)


def equibiaxial_sphere(sphere: Hertz, *, friction_coefficient: float, strain: float) -> EquibiaxialSphere:
    """Stretch a Hertz contact alike in all directions: ``E* strain/(mu p0) = K(k) - E(k)``, ``k^2 = 1 - c^2/a^2``."""
    return EquibiaxialSphere(**_numbers(_core.equibiaxial_sphere(_hertz_numbers(sphere), friction_coefficient, strain)))


def sliding_cylinder(
    *, radius: float, line_force: float, modulus: float, coupling: float, friction_coefficient: float
) -> SlidingCylinder:
    """Slide a cylinder across its axis on a half-space, with Dundurs' coupling beta [-].

    ``p = (E*/2R) cos(pi g) (a + x)^(1/2 - g) (a - x)^(1/2 + g)``, ``tan(pi g) = beta mu``; friction is negative for shear on the
    lower body along -x.

    References
    ----------
    Bufler (1959); Johnson (1985), *Contact Mechanics*, section 8.2.
    """
    solution = _core.sliding_cylinder(radius, line_force, modulus, coupling, friction_coefficient)
    return SlidingCylinder(**_numbers(solution), _solution=solution)


def tilted_punch(*, radius: float, force: float, modulus: float, tilt: float) -> TiltedPunch:
    """Press a flat circular punch that is tilted by a slope, all of it in contact.

    References
    ----------
    Johnson (1985), *Contact Mechanics*, sections 3.4 and 5.5(c).
    """
    solution = _core.tilted_punch(radius, force, modulus, tilt)
    return TiltedPunch(**_numbers(solution), _solution=solution)


def tilted_line_punch(*, half_width: float, line_force: float, modulus: float, tilt: float) -> TiltedLinePunch:
    """Press a flat punch of infinite length that is tilted by a slope, all of it in contact.

    References
    ----------
    Johnson (1985), *Contact Mechanics*, section 2.8.
    """
    solution = _core.tilted_line_punch(half_width, line_force, modulus, tilt)
    return TiltedLinePunch(**_numbers(solution), _solution=solution)


@dataclass(frozen=True)
class RoundedPunch:
    """Frictionless contact of a punch that is flat within a radius b, gap ``(r - b)^2 / (2 R)`` beyond."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    approach: float
    """Approach [length]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def pressure(self, r: npt.ArrayLike) -> Reals:
        """Pressure at distances `r` from the middle [pressure], of the shape of `r`; zero outside the contact."""
        return _curve(self._solution, "pressure", r)


def rounded_punch(*, flat_radius: float, edge_radius: float, force: float, modulus: float) -> RoundedPunch:
    """Press a flat punch with a rounded edge on a half-space without friction.

    References
    ----------
    Sneddon (1965), Int. J. Engng Sci. 3, 47; Ciavarella (1999), Int. J. Solids Struct. 36, 4149.
    """
    solution = _core.rounded_punch(flat_radius, edge_radius, force, modulus)
    numbers = _numbers(solution)
    return RoundedPunch(
        **{name: numbers[name] for name in ("force", "contact_radius", "approach")}, _solution=solution
    )


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


def no_slip_punch(*, radius: float, force: float, modulus: float, coupling: float) -> NoSlipPunch:
    """Press a flat circular punch that sticks; `coupling` is Dundurs' beta [-].

    ``P = 2 E* a delta ln((1 + beta)/(1 - beta)) / (2 beta)``.

    References
    ----------
    Mossakovskii (1954), PMM 18, 187; Spence (1968), Proc. R. Soc. A 305, 55.
    """
    return NoSlipPunch(**_numbers(_core.no_slip_punch(radius, force, modulus, coupling)))


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


def no_slip_sphere(*, radius: float, force: float, modulus: float, coupling: float) -> NoSlipSphere:
    """Press a sphere that sticks as it touches; `coupling` is Dundurs' beta [-], 0 gives the Hertz contact.

    References
    ----------
    Mossakovskii (1963); Spence (1968), Proc. R. Soc. A 305, 55.
    """
    return NoSlipSphere(**_numbers(_core.no_slip_sphere(radius, force, modulus, coupling)))


@dataclass(frozen=True)
class ThinLayer:
    """Rigid frictionless sphere on a thin bonded layer over a rigid base: leading order for ``a >> h``."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    max_pressure: float
    """Maximum contact pressure [pressure]."""
    approach: float
    """Approach [length]."""
    incompressible: bool
    """Whether Poisson's ratio is 0.5."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def pressure(self, r: npt.ArrayLike) -> Reals:
        """Pressure at distances `r` from the middle [pressure], of the shape of `r`; zero outside the contact."""
        return _curve(self._solution, "pressure", r)


def thin_layer(*, radius: float, force: float, layer: Layer) -> ThinLayer:
    """Press a rigid sphere on a thin bonded layer.

    The force is 2.5 % low at ``a = 20 h`` and 10 % at ``a = 5 h`` for Poisson's ratio 0.3; by factors for 0.5.

    References
    ----------
    Johnson (1985), *Contact Mechanics*, section 5.8; Jaffar (1989); Barber (1990).
    """
    solution = _core.thin_layer(radius, force, _layer(layer))
    return ThinLayer(**_numbers(solution), _solution=solution)


@dataclass(frozen=True)
class ThickLayer:
    """Rigid frictionless sphere on a thick bonded layer over a rigid base: an expansion in a/h."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    approach: float
    """Approach [length]."""


def thick_layer(*, radius: float, contact_radius: float, layer: Layer) -> ThickLayer:
    """Press a rigid sphere on a thick bonded layer until it touches over a disc of `contact_radius`, at most 0.4 h.

    References
    ----------
    Vorovich, Aleksandrov & Babeshko (1974); Argatov (2001); Li et al. (2020), Proc. IMechE J 234, 73.
    """
    return ThickLayer(**_numbers(_core.thick_layer(radius, contact_radius, _layer(layer))))


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


def spence_table() -> list[SpencePoint]:
    """Return the computed points of Spence's problem, by Poisson's ratio and stick ratio; uncertainty 1e-4.

    References
    ----------
    Spence (1968), Proc. R. Soc. A 305, 55; (1975), J. Elasticity 5, 297, for the problem.
    """
    return [SpencePoint(**point) for point in json.loads(_core.spence_table())]


def _entries(name: str, given: Mapping[str, float], keys: tuple[str, ...]) -> tuple[float, ...]:
    """Return the entries of a material in order."""
    if not isinstance(given, Mapping):
        wanted = ", ".join(f"'{key}': ..." for key in keys)
        raise TypeError(f"{name}: expected a mapping as in a case, {{{wanted}}}, found {type(given).__name__}")
    if set(given) != set(keys):
        raise ValueError(f"{name}: has the keys {', '.join(map(str, given))}; must have {', '.join(keys)}")
    return tuple(float(given[key]) for key in keys)


def _material(name: str, material: Material) -> tuple[float, float]:
    young, poisson = _entries(name, material, ("young", "poisson"))
    return young, poisson


def _layer(layer: Layer) -> tuple[float, float, float]:
    thickness, young, poisson = _entries("layer", layer, ("thickness", "young", "poisson"))
    return young, poisson, thickness


def _hertz_numbers(sphere: Hertz) -> tuple[float, float, float]:
    return sphere.radius, sphere.force, sphere.modulus


def _line_numbers(cylinder: HertzLine) -> tuple[float, float, float]:
    return cylinder.radius, cylinder.line_force, cylinder.modulus


def _numbers(solution: _core.Solution) -> dict[str, Any]:
    numbers: dict[str, Any] = json.loads(solution.numbers())
    return numbers


def _curve(solution: _core.Solution, name: str, at: npt.ArrayLike) -> Reals:
    places = real_array(name, at)
    return solution.curve(name, places.ravel()).reshape(places.shape)


def _surface(solution: _core.Solution, x: npt.ArrayLike, y: npt.ArrayLike) -> Reals:
    along, across = np.broadcast_arrays(real_array("x", x), real_array("y", y))
    flat = [np.ascontiguousarray(places.ravel(), dtype=np.float64) for places in (along, across)]
    return solution.surface(flat[0], flat[1]).reshape(along.shape)
