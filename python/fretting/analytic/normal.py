"""Frictionless contact of two bodies: sphere, ellipsoid, punches, cone, wave, layers."""

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from fretting import _core
from fretting._arguments import checked
from fretting._arrays import Reals, real_array
from fretting.analytic._solution import Layer, Material, curve, layer_numbers, material_numbers, numbers_of, surface


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


@checked
def effective_moduli(*, lower: Material, upper: Material | None = None) -> EffectiveModuli:
    """Effective moduli of two bodies, each ``{"young": ..., "poisson": ...}``; default: a rigid upper body.

    Parameters
    ----------
    lower : mapping
        ``{"young": ..., "poisson": ...}`` of the lower body [pressure, -].
    upper : mapping, optional
        The same of the upper body. Default: rigid.
    """
    first, second = material_numbers("lower", lower), None if upper is None else material_numbers("upper", upper)
    return EffectiveModuli(**numbers_of(_core.effective_moduli(first, second)))


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
        return curve(self._solution, "pressure", r)


@checked
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
    numbers = numbers_of(solution)
    return Hertz(
        radius=numbers.pop("sphere_radius"),
        modulus=numbers.pop("effective_modulus"),
        **numbers,
        _solution=solution,
    )


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


@checked
def hertz_ellipse(*, radius_x: float, radius_y: float, force: float, modulus: float) -> HertzEllipse:
    """Press an ellipsoid on a half-space without friction; relative radii of curvature [length].

    Parameters
    ----------
    radius_x : float
        Relative radius of curvature along x [length].
    radius_y : float
        Relative radius of curvature along y [length].
    force : float
        Normal force, positive in compression [force].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.

    References
    ----------
    Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2.
    """
    numbers = numbers_of(_core.hertz_ellipse((radius_x, radius_y), force, modulus))
    a, b = numbers.pop("semi_axes")
    return HertzEllipse(semi_axes=(a, b), **numbers)


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
        return curve(self._solution, "pressure", r)


@checked
def flat_punch(*, radius: float, force: float, modulus: float) -> FlatPunch:
    """Press a flat circular punch on a half-space without friction.

    Parameters
    ----------
    radius : float
        Radius of the punch [length].
    force : float
        Normal force, positive in compression [force].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.

    References
    ----------
    Boussinesq (1885); Johnson (1985), *Contact Mechanics*, section 3.4.
    """
    solution = _core.flat_punch(radius, force, modulus)
    return FlatPunch(**numbers_of(solution), _solution=solution)


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
        return curve(self._solution, "pressure", r)


@checked
def rounded_punch(*, flat_radius: float, edge_radius: float, force: float, modulus: float) -> RoundedPunch:
    """Press a flat punch with a rounded edge on a half-space without friction.

    Parameters
    ----------
    flat_radius : float
        Radius b of the flat part [length].
    edge_radius : float
        Radius R of curvature of the edge [length].
    force : float
        Normal force, positive in compression [force].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.

    References
    ----------
    Sneddon (1965), Int. J. Engng Sci. 3, 47; Ciavarella (1999), Int. J. Solids Struct. 36, 4149.
    """
    solution = _core.rounded_punch(flat_radius, edge_radius, force, modulus)
    numbers = numbers_of(solution)
    return RoundedPunch(**{name: numbers[name] for name in ("force", "contact_radius", "approach")}, _solution=solution)


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
        return surface(self._solution, x, y)


@checked
def tilted_punch(*, radius: float, force: float, modulus: float, tilt: float) -> TiltedPunch:
    """Press a flat circular punch that is tilted by a slope, all of it in contact.

    Parameters
    ----------
    radius : float
        Radius of the punch [length].
    force : float
        Normal force, positive in compression [force].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.
    tilt : float
        Slope of the punch against the surface [-].

    References
    ----------
    Johnson (1985), *Contact Mechanics*, sections 3.4 and 5.5(c).
    """
    solution = _core.tilted_punch(radius, force, modulus, tilt)
    return TiltedPunch(**numbers_of(solution), _solution=solution)


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
        return curve(self._solution, "pressure", r)


@checked
def cone(*, slope: float, force: float, modulus: float) -> Cone:
    """Press a blunt cone, of the `slope` [-] of its side against the surface, on a half-space without friction.

    Parameters
    ----------
    slope : float
        Slope of the side against the surface [-]: the gap is the slope times the distance from the tip.
    force : float
        Normal force, positive in compression [force].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.

    References
    ----------
    Love (1939); Sneddon (1965), Int. J. Engng Sci. 3, 47.
    """
    solution = _core.cone(slope, force, modulus)
    return Cone(**numbers_of(solution), _solution=solution)


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
        return curve(self._solution, "pressure", x)


@checked
def westergaard(*, amplitude: float, wavelength: float, mean_pressure: float, modulus: float) -> Westergaard:
    """Press a sinusoidal surface on a flat half-space without friction.

    Parameters
    ----------
    amplitude : float
        Amplitude of the wave, half its height [length].
    wavelength : float
        Wavelength [length].
    mean_pressure : float
        Mean pressure over a wavelength [pressure].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.

    References
    ----------
    Westergaard (1939), J. Appl. Mech. 6, 49; Johnson (1985), *Contact Mechanics*, section 13.2.
    """
    solution = _core.westergaard(amplitude, wavelength, mean_pressure, modulus)
    return Westergaard(**numbers_of(solution), _solution=solution)


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
        return curve(self._solution, "pressure", r)


@checked
def thin_layer(*, radius: float, force: float, layer: Layer) -> ThinLayer:
    """Press a rigid sphere on a thin bonded layer.

    The force is 2.5 % low at ``a = 20 h`` and 10 % at ``a = 5 h`` for Poisson's ratio 0.3; by factors for 0.5.

    Parameters
    ----------
    radius : float
        Radius of the sphere [length].
    force : float
        Normal force, positive in compression [force].
    layer : mapping
        ``{"young": ..., "poisson": ..., "thickness": ...}`` of the layer [pressure, -, length].

    References
    ----------
    Johnson (1985), *Contact Mechanics*, section 5.8; Jaffar (1989); Barber (1990).
    """
    solution = _core.thin_layer(radius, force, layer_numbers(layer))
    return ThinLayer(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class ThickLayer:
    """Rigid frictionless sphere on a thick bonded layer over a rigid base: an expansion in a/h."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    approach: float
    """Approach [length]."""


@checked
def thick_layer(*, radius: float, contact_radius: float, layer: Layer) -> ThickLayer:
    """Press a rigid sphere on a thick bonded layer until it touches over a disc of `contact_radius`, at most 0.4 h.

    Parameters
    ----------
    radius : float
        Radius of the sphere [length].
    contact_radius : float
        Radius of the contact, at most 0.4 of the thickness [length].
    layer : mapping
        ``{"young": ..., "poisson": ..., "thickness": ...}`` of the layer [pressure, -, length].

    References
    ----------
    Vorovich, Aleksandrov & Babeshko (1974); Argatov (2001); Li et al. (2020), Proc. IMechE J 234, 73.
    """
    return ThickLayer(**numbers_of(_core.thick_layer(radius, contact_radius, layer_numbers(layer))))


def hertz_numbers(sphere: Hertz) -> tuple[float, float, float]:
    """Return what tells a contact apart: radius, force and modulus.

    Parameters
    ----------
    sphere : Hertz
        The contact that is stretched, of :func:`hertz`.
    """
    return sphere.radius, sphere.force, sphere.modulus
