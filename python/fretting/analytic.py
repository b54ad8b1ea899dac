"""Closed-form contact solutions, to plot and to compare with.

Signs: pressure and approach are positive in compression; shear, shift and tangential force are those of the upper body
on the lower. Any consistent system of units. Everything here holds for homogeneous half-spaces;
:func:`effective_moduli` says how compliant two of them are together.

>>> from fretting import analytic
>>> moduli = analytic.effective_moduli(lower=(210e9, 0.3))
>>> sphere = analytic.hertz(radius=10e-3, force=12.0, modulus=moduli.normal)
>>> f"{sphere.contact_radius:.3e} {sphere.peak_pressure:.3e}"
'7.306e-05 1.073e+09'
"""

import json
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
    "SlidingCylinder",
    "StretchedLine",
    "StretchedSphere",
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
    "sliding_cylinder",
    "stretched_line",
    "stretched_sphere",
    "tilted_line_punch",
    "tilted_punch",
    "torsion",
    "westergaard",
]

Material: TypeAlias = tuple[float, float]
"""Young's modulus [pressure] and Poisson's ratio [-]."""
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
    peak_pressure: float
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
    peak_pressure: float
    """Maximum contact pressure p0 [pressure]."""
    approach: float
    """Approach of distant points [length]."""

    def pressure(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Reals:
        """Pressure at points [pressure], of the broadcast shape of `x` and `y`; zero outside the contact."""
        a, b = self.semi_axes
        depth = 1.0 - (real_array("x", x) / a) ** 2 - (real_array("y", y) / b) ** 2
        pressure: Reals = self.peak_pressure * np.sqrt(np.maximum(depth, 0.0))
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
    peak_pressure: float
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
    friction_force: float
    """Largest tangential force that friction holds, mu P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    peak_friction: float
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
    friction: float
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
            _hertz_numbers(self.sphere), self.friction, self.shear_modulus, self.amplitude, branch, tangential_force
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
    peak_friction: float
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
    friction_force: float
    """Largest tangential force per length that friction holds [force/length]."""
    half_width: float
    """Half-width a of the contact [length]."""
    peak_friction: float
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
    friction_force: float
    """Largest tangential force that friction holds [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    peak_friction: float
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
    peak_pressure: float
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


def effective_moduli(lower: Material, upper: Material | None = None) -> EffectiveModuli:
    """Effective moduli of two bodies, each (young, poisson); default: a rigid upper body."""
    return EffectiveModuli(**_numbers(_core.effective_moduli(lower, upper)))


def hertz(radius: float, force: float, modulus: float) -> Hertz:
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


def hertz_ellipse(radius_x: float, radius_y: float, force: float, modulus: float) -> HertzEllipse:
    """Press an ellipsoid on a half-space without friction; relative radii of curvature [length].

    References
    ----------
    Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2.
    """
    numbers = _numbers(_core.hertz_ellipse((radius_x, radius_y), force, modulus))
    a, b = numbers.pop("semi_axes")
    return HertzEllipse(semi_axes=(a, b), **numbers)


def hertz_line(radius: float, line_force: float, modulus: float) -> HertzLine:
    """Press a cylinder on a half-space without friction, under a force per length [force/length].

    References
    ----------
    Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2(c).
    """
    solution = _core.hertz_line(radius, line_force, modulus)
    return HertzLine(radius=float(radius), modulus=float(modulus), **_numbers(solution), _solution=solution)


def flat_punch(radius: float, force: float, modulus: float) -> FlatPunch:
    """Press a flat circular punch on a half-space without friction.

    References
    ----------
    Boussinesq (1885); Johnson (1985), *Contact Mechanics*, section 3.4.
    """
    solution = _core.flat_punch(radius, force, modulus)
    return FlatPunch(**_numbers(solution), _solution=solution)


def cone(slope: float, force: float, modulus: float) -> Cone:
    """Press a blunt cone, of the `slope` [-] of its side against the surface, on a half-space without friction.

    References
    ----------
    Love (1939); Sneddon (1965), Int. J. Engng Sci. 3, 47.
    """
    solution = _core.cone(slope, force, modulus)
    return Cone(**_numbers(solution), _solution=solution)


def westergaard(amplitude: float, wavelength: float, mean_pressure: float, modulus: float) -> Westergaard:
    """Press a sinusoidal surface on a flat half-space without friction.

    References
    ----------
    Westergaard (1939), J. Appl. Mech. 6, 49; Johnson (1985), *Contact Mechanics*, section 13.2.
    """
    solution = _core.westergaard(amplitude, wavelength, mean_pressure, modulus)
    return Westergaard(**_numbers(solution), _solution=solution)


def cattaneo_mindlin(sphere: Hertz, friction: float, shear_modulus: float, tangential_force: float) -> CattaneoMindlin:
    """Partial slip of a Hertz contact under a first tangential load.

    Exact for uncoupled bodies with Poisson's ratio 0; otherwise it neglects the slip across the force.

    Parameters
    ----------
    sphere : Hertz
        The normal contact.
    friction : float
        Friction coefficient [-].
    shear_modulus : float
        Effective shear modulus G* [pressure].
    tangential_force : float
        Tangential force [force], at most friction times normal force.

    References
    ----------
    Cattaneo (1938); Mindlin (1949); Johnson (1985), *Contact Mechanics*, section 7.2.
    """
    solution = _core.cattaneo_mindlin(_hertz_numbers(sphere), friction, shear_modulus, tangential_force)
    return CattaneoMindlin(**_numbers(solution), _solution=solution)


def mindlin_deresiewicz(sphere: Hertz, friction: float, shear_modulus: float, amplitude: float) -> MindlinDeresiewicz:
    """Fretting loop of a Hertz contact between two equal and opposite tangential forces.

    Limits as for :func:`cattaneo_mindlin`.

    Parameters
    ----------
    sphere : Hertz
        The normal contact.
    friction : float
        Friction coefficient [-].
    shear_modulus : float
        Effective shear modulus G* [pressure].
    amplitude : float
        Amplitude of the tangential force [force], at most friction times normal force.

    References
    ----------
    Mindlin & Deresiewicz (1953); Johnson (1985), *Contact Mechanics*, section 7.4.
    """
    fretting_loop, peak = _core.mindlin_deresiewicz(_hertz_numbers(sphere), friction, shear_modulus, amplitude)
    return MindlinDeresiewicz(
        sphere=sphere,
        friction=friction,
        shear_modulus=shear_modulus,
        amplitude=amplitude,
        peak=CattaneoMindlin(**_numbers(peak), _solution=peak),
        **_numbers(fretting_loop),
    )


def torsion(sphere: Hertz, friction: float, shear_modulus: float, moment: float) -> Torsion:
    """Twist a Hertz contact about its normal for the first time; exact for any pair of homogeneous bodies.

    Parameters
    ----------
    sphere : Hertz
        The normal contact.
    friction : float
        Friction coefficient [-].
    shear_modulus : float
        Torsional shear modulus [pressure].
    moment : float
        Torsional moment [force x length], less than ``3 pi mu P a / 16``.

    References
    ----------
    Lubkin (1951), J. Appl. Mech. 18, 183.
    """
    solution = _core.torsion(_hertz_numbers(sphere), friction, shear_modulus, moment)
    return Torsion(**_numbers(solution), _solution=solution)


def cattaneo_line(cylinder: HertzLine, friction: float, tangential_force: float, strain: float = 0.0) -> CattaneoLine:
    """Push a Hertz line contact across its axis, while a strain grows in proportion.

    ``c = a sqrt(1 - |Q|/(mu P))``, ``e = a E* strain/(2 mu p0)``; for bodies that do not couple, as long as all that slips
    slips one way (``|e| + c <= a``).

    Parameters
    ----------
    cylinder : HertzLine
        The normal contact.
    friction : float
        Friction coefficient [-].
    tangential_force : float
        Tangential force per length [force/length], at most friction times normal force.
    strain : float
        Strain of the lower surface less that of the upper one [-]: ``sigma (1 - nu^2)/E`` under a tension of the lower body.

    References
    ----------
    Cattaneo (1938); Mindlin (1949); Nowell & Hills (1987), Int. J. Mech. Sci. 29, 355.
    """
    solution = _core.cattaneo_line(_line_numbers(cylinder), friction, tangential_force, strain)
    return CattaneoLine(**_numbers(solution), _solution=solution)


def stretched_line(cylinder: HertzLine, friction: float, strain: float) -> StretchedLine:
    """Stretch a Hertz line contact without a tangential force: both edges slip, in opposite senses.

    ``E* strain/(2 mu p0) = (2/pi) [K(k) - E(k)]``, ``k^2 = 1 - c^2/a^2``, for bodies that do not couple.
    """
    return StretchedLine(**_numbers(_core.stretched_line(_line_numbers(cylinder), friction, strain)))


def stretched_sphere(
    sphere: Hertz, friction: float, shear_modulus: float, tangential_force: float, strain: float
) -> StretchedSphere:
    """Push a Hertz contact along x while a strain along x grows in proportion; Poisson's ratio 0.

    ``c = a (1 - |T|/(mu P))^(1/3)``, ``e = 8 a G* strain/(pi mu p0)``, as long as ``|e| + c <= a``.
    """
    solution = _core.stretched_sphere(_hertz_numbers(sphere), friction, shear_modulus, tangential_force, strain)
    return StretchedSphere(**_numbers(solution), _solution=solution)


def equibiaxial_sphere(sphere: Hertz, friction: float, strain: float) -> EquibiaxialSphere:
    """Stretch a Hertz contact alike in all directions: ``E* strain/(mu p0) = K(k) - E(k)``, ``k^2 = 1 - c^2/a^2``."""
    return EquibiaxialSphere(**_numbers(_core.equibiaxial_sphere(_hertz_numbers(sphere), friction, strain)))


def sliding_cylinder(
    radius: float, line_force: float, modulus: float, coupling: float, friction: float
) -> SlidingCylinder:
    """Slide a cylinder across its axis on a half-space, with Dundurs' coupling beta [-].

    ``p = (E*/2R) cos(pi g) (a + x)^(1/2 - g) (a - x)^(1/2 + g)``, ``tan(pi g) = beta mu``; friction is negative for shear on the
    lower body along -x.

    References
    ----------
    Bufler (1959); Johnson (1985), *Contact Mechanics*, section 8.2.
    """
    solution = _core.sliding_cylinder(radius, line_force, modulus, coupling, friction)
    return SlidingCylinder(**_numbers(solution), _solution=solution)


def tilted_punch(radius: float, force: float, modulus: float, tilt: float) -> TiltedPunch:
    """Press a flat circular punch that is tilted by a slope, all of it in contact.

    References
    ----------
    Johnson (1985), *Contact Mechanics*, sections 3.4 and 5.5(c).
    """
    solution = _core.tilted_punch(radius, force, modulus, tilt)
    return TiltedPunch(**_numbers(solution), _solution=solution)


def tilted_line_punch(half_width: float, line_force: float, modulus: float, tilt: float) -> TiltedLinePunch:
    """Press a flat punch of infinite length that is tilted by a slope, all of it in contact.

    References
    ----------
    Johnson (1985), *Contact Mechanics*, section 2.8.
    """
    solution = _core.tilted_line_punch(half_width, line_force, modulus, tilt)
    return TiltedLinePunch(**_numbers(solution), _solution=solution)


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
