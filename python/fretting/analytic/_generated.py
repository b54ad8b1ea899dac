"""Closed forms of the catalogue.

Generated from crates/fret-core/src/analytic by docs/site/closed_forms.py; a test compares the two.
"""

from dataclasses import dataclass, field

import numpy.typing as npt

from fretting._arguments import checked
from fretting._arrays import Reals
from fretting.analytic._solution import (
    Layer,
    Material,
    Solution,
    layer_numbers,
    material_numbers,
    numbers_of,
    solution_of,
    values_of,
)

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
    "NoSlipPunch",
    "NoSlipSphere",
    "RoundedPunch",
    "SlidingCylinder",
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
    "no_slip_punch",
    "no_slip_sphere",
    "rounded_punch",
    "sliding_cylinder",
    "stretched_line",
    "stretched_sphere",
    "thick_layer",
    "thin_layer",
    "tilted_line_punch",
    "tilted_punch",
    "torsion",
    "westergaard",
]


@dataclass(frozen=True)
class EffectiveModuli:
    """Effective moduli of two homogeneous half-spaces; a rigid body adds no compliance."""

    normal: float
    """`1/E* = Σ (1 − ν²)/E` [pressure]: normal contact."""
    shear: float
    """`1/G* = Σ (2 − ν)/G` [pressure]: tangential contact."""
    torsional: float
    """`1/G = Σ 1/G` [pressure]: torsion."""
    coupling: float
    """Dundurs' `β = [(1 − 2ν)/G lower − upper] / (2 Σ (1 − ν)/G)` [-]: normal-tangential coupling, 0 for elastically
    similar bodies.
    """


@checked
def effective_moduli(*, lower: Material, upper: Material | None = None) -> EffectiveModuli:
    """Effective moduli of two bodies, each ``{"young": ..., "poisson": ...}``; default: a rigid upper body.

    Parameters
    ----------
    lower : mapping
        ``{"young": ..., "poisson": ...}`` of the lower body [pressure, -].
    upper : mapping, optional
        The same of the upper body. Default: rigid.

    References
    ----------
    Johnson (1985), *Contact Mechanics*, sections 4.2 and 7.2; Dundurs (1969) for the coupling.
    """
    solution = solution_of(
        "effective_moduli",
        *material_numbers("lower", lower),
        *(() if upper is None else material_numbers("upper", upper)),
    )
    return EffectiveModuli(**numbers_of(solution))


@dataclass(frozen=True)
class Hertz:
    """Frictionless contact of spheres (paraboloids `r² / 2R`)."""

    radius: float
    """Relative radius R of the spheres, `1/R = 1/R1 + 1/R2` [length]."""
    modulus: float
    """Effective modulus E* [pressure]."""
    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    max_pressure: float
    """Pressure p0 in the middle [pressure]."""
    approach: float
    """Approach δ of distant points [length]."""
    _solution: Solution = field(repr=False, compare=False)

    def pressure(self, r: npt.ArrayLike) -> Reals:
        """Pressure at distance `r` from the middle [pressure]; zero outside the contact.

        Of the shape of `r`.
        """
        return values_of(self._solution, "pressure", r=r)


@checked
def hertz(*, radius: float, force: float, modulus: float) -> Hertz:
    """Press a sphere on a half-space without friction.

    `a³ = 3PR/(4E*)`, `p0 = 3P/(2πa²)`, `δ = a²/R`, `p = p0 √(1 − r²/a²)`. Holds for `a << R`; exact with friction
    too when the bodies do not couple (coupling β = 0).

    Parameters
    ----------
    radius : float
        Relative radius of curvature R [length].
    force : float
        Normal force, positive in compression [force].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.

    References
    ----------
    Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2.
    """
    solution = solution_of("hertz", radius, force, modulus)
    return Hertz(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class HertzEllipse:
    """Frictionless contact of ellipsoids (gap `x² / 2Rx + y² / 2Ry`)."""

    force: float
    """Normal force P [force]."""
    semi_axes: tuple[float, float]
    """Semi-axes of the contact along x and y [length]; the longer lies along the larger radius."""
    max_pressure: float
    """Pressure p0 in the middle [pressure]."""
    approach: float
    """Approach δ of distant points [length]."""
    _solution: Solution = field(repr=False, compare=False)

    def pressure(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Reals:
        """Pressure at a point [pressure]; zero outside the contact.

        Of the broadcast shape of `x` and `y`.
        """
        return values_of(self._solution, "pressure", x=x, y=y)


@checked
def hertz_ellipse(*, radius_x: float, radius_y: float, force: float, modulus: float) -> HertzEllipse:
    """Press an ellipsoid on a half-space without friction; relative radii of curvature [length].

    With `A <= B` the two gap coefficients `1/2R`, a the semi-axis along A and `e² = 1 − b²/a²`: `B/A = [E/(1 − e²) −
    K]/(K − E)`, `a³ = 3P(K − E)/(2π E* e² A)`, `p0 = 3P/(2πab)`, `δ = p0 b K/E*`.

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
    solution = solution_of("hertz_ellipse", radius_x, radius_y, force, modulus)
    return HertzEllipse(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class HertzLine:
    """Frictionless line contact of cylinders, gap `x² / 2R`."""

    radius: float
    """Relative radius R of the cylinders [length]."""
    modulus: float
    """Effective modulus E* [pressure]."""
    line_force: float
    """Force per length P' [force / length]."""
    half_width: float
    """Half-width a of the contact [length]."""
    max_pressure: float
    """Pressure p0 in the middle [pressure]."""
    _solution: Solution = field(repr=False, compare=False)

    def pressure(self, x: npt.ArrayLike) -> Reals:
        """Pressure at `x` from the middle [pressure]; zero outside the contact.

        Of the shape of `x`.
        """
        return values_of(self._solution, "pressure", x=x)


@checked
def hertz_line(*, radius: float, line_force: float, modulus: float) -> HertzLine:
    """Press a cylinder on a half-space without friction, under a force per length [force/length].

    `a² = 4P'R/(πE*)`, `p0 = 2P'/(πa)`. An approach exists relative to a point at a depth alone: in two dimensions
    displacement grows with the logarithm of the distance.

    Parameters
    ----------
    radius : float
        Relative radius of curvature R [length].
    line_force : float
        Normal force per unit of length [force/length].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.

    References
    ----------
    Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2(c).
    """
    solution = solution_of("hertz_line", radius, line_force, modulus)
    return HertzLine(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class FlatPunch:
    """Frictionless contact of a flat circular punch."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the punch and of the contact [length]."""
    approach: float
    """Approach δ [length]."""
    _solution: Solution = field(repr=False, compare=False)

    def pressure(self, r: npt.ArrayLike) -> Reals:
        """Pressure at distance `r` from the middle [pressure]; infinite at the edge, zero outside.

        Of the shape of `r`.
        """
        return values_of(self._solution, "pressure", r=r)


@checked
def flat_punch(*, radius: float, force: float, modulus: float) -> FlatPunch:
    """Press a flat circular punch on a half-space without friction.

    `P = 2E* a δ`, `p = P / (2πa √(a² − r²))`.

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
    solution = solution_of("flat_punch", radius, force, modulus)
    return FlatPunch(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class RoundedPunch:
    """Frictionless contact of a punch that is flat within `b`, gap `(r - b)² / 2R` beyond."""

    force: float
    """Normal force [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    approach: float
    """Approach [length]."""
    _solution: Solution = field(repr=False, compare=False)

    def pressure(self, r: npt.ArrayLike) -> Reals:
        """Pressure at distance `r` from the middle [pressure]; zero outside the contact.

        Of the shape of `r`.
        """
        return values_of(self._solution, "pressure", r=r)


@checked
def rounded_punch(*, flat_radius: float, edge_radius: float, force: float, modulus: float) -> RoundedPunch:
    """Press a flat punch with a rounded edge on a half-space without friction.

    With `δ(t) = (t/R) (√(t² − b²) − b arccos(b/t))` the approach is `δ(a)`, the force `2E* ∫ t δ'(t) dt` and the
    pressure `(E*/π) ∫ δ'(t) / √(t² − r²) dt` up to `a`.

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
    solution = solution_of("rounded_punch", flat_radius, edge_radius, force, modulus)
    return RoundedPunch(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class TiltedPunch:
    """A flat circular punch under a force P and tilted by a slope θ along x, deeper at positive x."""

    force: float
    """Normal force P [force]."""
    tilt: float
    """Slope θ [-]."""
    moment: float
    """Moment M about y, positive with the pressure to positive x [force x length]."""
    contact_radius: float
    """Radius a of the punch and of the contact [length]."""
    modulus: float
    """Effective modulus E* [pressure]."""
    _solution: Solution = field(repr=False, compare=False)

    def pressure(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Reals:
        """Pressure at a point [pressure]; infinite at the edge, zero outside.

        Of the broadcast shape of `x` and `y`.
        """
        return values_of(self._solution, "pressure", x=x, y=y)


@checked
def tilted_punch(*, radius: float, force: float, modulus: float, tilt: float) -> TiltedPunch:
    """Press a flat circular punch that is tilted by a slope, all of it in contact.

    `M = (4/3) E* a³ θ`, `p = P/(2πa √(a² − r²)) + (2E*θ/π) x/√(a² − r²)`; in full contact while `M <= P a/3`.

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
    solution = solution_of("tilted_punch", radius, force, modulus, tilt)
    return TiltedPunch(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class TiltedLinePunch:
    """A flat punch of the half-width a and infinite length under a force P' per length and tilted by a slope θ across
    it, deeper at positive x.
    """

    line_force: float
    """Force per length P' [force / length]."""
    tilt: float
    """Slope θ [-]."""
    moment: float
    """Moment per length M', positive with the pressure to positive x [force]."""
    half_width: float
    """Half-width a of the punch and of the contact [length]."""
    modulus: float
    """Effective modulus E* [pressure]."""
    _solution: Solution = field(repr=False, compare=False)

    def pressure(self, x: npt.ArrayLike) -> Reals:
        """Pressure at `x` from the middle [pressure]; infinite at the edge, zero outside.

        Of the shape of `x`.
        """
        return values_of(self._solution, "pressure", x=x)


@checked
def tilted_line_punch(*, half_width: float, line_force: float, modulus: float, tilt: float) -> TiltedLinePunch:
    """Press a flat punch of infinite length that is tilted by a slope, all of it in contact.

    `M' = (π/4) E* a² θ`, `p = P'/(π √(a² − x²)) + (E*θ/2) x/√(a² − x²)`; in full contact while `M' <= P' a/2`.

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
    solution = solution_of("tilted_line_punch", half_width, line_force, modulus, tilt)
    return TiltedLinePunch(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class Cone:
    """Frictionless contact of a cone, gap `r t` with the slope `t` of its side against the surface."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    approach: float
    """Approach δ [length]."""
    mean_pressure: float
    """Mean pressure `E*t/2` [pressure], whatever the load."""
    _solution: Solution = field(repr=False, compare=False)

    def pressure(self, r: npt.ArrayLike) -> Reals:
        """Pressure at distance `r` from the tip [pressure]; infinite (logarithm) at the tip, zero outside the contact.

        Of the shape of `r`.
        """
        return values_of(self._solution, "pressure", r=r)


@checked
def cone(*, slope: float, force: float, modulus: float) -> Cone:
    """Press a blunt cone, of the `slope` [-] of its side against the surface, on a half-space without friction.

    `P = πa²E*t/2`, `δ = πat/2`, `p = (E*t/2) arcosh(a/r)`. For `t << 1`.

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
    solution = solution_of("cone", slope, force, modulus)
    return Cone(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class Westergaard:
    """Frictionless contact of a wavy surface, gap `D (1 − cos(2πx/L))`, periodic in x and endless in y."""

    wavelength: float
    """Wavelength L [length]."""
    mean_pressure: float
    """Mean pressure p̄ over a wavelength [pressure]."""
    full_contact_pressure: float
    """Mean pressure p* at which the contact becomes full [pressure]."""
    half_width: float
    """Half-width a of the contact at a crest [length]; L/2 in full contact."""
    _solution: Solution = field(repr=False, compare=False)

    def pressure(self, x: npt.ArrayLike) -> Reals:
        """Pressure at `x` from a crest [pressure]; zero where the surfaces are apart.

        Of the shape of `x`.
        """
        return values_of(self._solution, "pressure", x=x)


@checked
def westergaard(*, amplitude: float, wavelength: float, mean_pressure: float, modulus: float) -> Westergaard:
    """Press a sinusoidal surface on a flat half-space without friction.

    Full contact at the mean pressure `p* = πE*D/L`; below, `sin²(πa/L) = p̄/p*` and `p = 2p̄ cos(πx/L)/sin²(πa/L) ·
    √(sin²(πa/L) − sin²(πx/L))`; above, `p = p̄ + p* cos(2πx/L)`.

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
    solution = solution_of("westergaard", amplitude, wavelength, mean_pressure, modulus)
    return Westergaard(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class ThinLayer:
    """Rigid frictionless sphere on a thin bonded layer, `a >> h`."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    max_pressure: float
    """Pressure in the middle [pressure]."""
    approach: float
    """Approach δ [length]."""
    incompressible: bool
    """Whether the layer keeps its volume."""
    _solution: Solution = field(repr=False, compare=False)

    def pressure(self, r: npt.ArrayLike) -> Reals:
        """Pressure at distance `r` from the middle [pressure]; zero outside the contact.

        Of the shape of `r`.
        """
        return values_of(self._solution, "pressure", r=r)


@checked
def thin_layer(*, radius: float, force: float, layer: Layer) -> ThinLayer:
    """Press a rigid sphere on a thin bonded layer.

    Compressible, the layer answers like springs: `p = Et (δ − r²/2R)/h`, `Et = E(1 − ν)/((1 + ν)(1 − 2ν))`, `δ =
    a²/2R`, `P = πEt a⁴/(4Rh)`; the force is 2.5 % low at `a = 20h`, 10 % at `a = 5h` (`ν = 0.3`). Incompressible (`ν
    = 0.5`), it is squeezed out sideways: `p = 3G (a² − r²)²/(32Rh³)`, `δ = a²/4R`, `P = πGa⁶/(32Rh³)`; low by a
    factor 1.5 at `a = 20h`, 4.3 at `a = 5h`. Neither serves just below 0.5: at `ν = 0.45`, `a = 20h` the springs are
    12 % too stiff.

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
    solution = solution_of("thin_layer", radius, force, *layer_numbers(layer))
    return ThinLayer(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class ThickLayer:
    """Rigid frictionless sphere on a thick layer, expanded in `ε = a/h`."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    approach: float
    """Approach δ [length]."""


@checked
def thick_layer(*, radius: float, contact_radius: float, layer: Layer) -> ThickLayer:
    """Press a rigid sphere on a thick bonded layer until it touches over a disc of `contact_radius`, at most 0.4 h.

    `P = 4E*a³/(3R) · (1 − 8α1ε³/3π)`, `δ = a²/R · (1 − 4α0ε/3π − 16α1ε³/5π + 32α0α1ε⁴/9π²)`, where `α0 = ∫ Λ du` and
    `α1 = −¼ ∫ Λ u² du` of the layer's response. Refused above `a = 0.4h`.

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
    solution = solution_of("thick_layer", radius, contact_radius, *layer_numbers(layer))
    return ThickLayer(**numbers_of(solution))


@dataclass(frozen=True)
class CattaneoMindlin:
    """Partial slip of a Hertz contact under a growing tangential force T at constant normal force P."""

    tangential_force: float
    """Tangential force T [force], signed."""
    sliding_force: float
    """Largest tangential force that friction holds, μP [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    max_shear: float
    """Largest shear that friction holds anywhere, μp0 [pressure]."""
    initial_stiffness: float
    """Tangential stiffness before any slip, `8aG*` [force / length]."""
    stick_radius: float
    """Radius c of the disc that sticks [length]."""
    shift: float
    """Tangential shift of the bodies [length], with the sign of T."""
    full_slip_shift: float
    """Shift at the onset of full slip, `3μP/(16aG*)` [length]."""
    dissipated_energy: float
    """Energy dissipated by friction since the tangential force was zero [force x length].

    `3(μP)²/(80aG*) · (1 − c/a)³ (1 + 3c/a + c²/a²)`: a quarter of the loss in a cycle of this amplitude.
    """
    _solution: Solution = field(repr=False, compare=False)

    def shear(self, r: npt.ArrayLike) -> Reals:
        """Shear at distance `r` from the middle [pressure], along the force; zero outside the contact.

        Of the shape of `r`.
        """
        return values_of(self._solution, "shear", r=r)

    def slip(self, r: npt.ArrayLike) -> Reals:
        """Slip of the upper body on the lower at distance `r` [length], along the force; zero where the bodies stick.

        `3μP r²/(32a³G*) · [(1 − (2/π) asin(c/r))(1 − 2c²/r²) + (2/π)(c/r) √(1 − c²/r²)]` for `c <= r <= a`: the
        shift less the displacement inside the disc a and outside the disc c, averaged over the direction. Source:
        Johnson (1985), §7.2.

        Of the shape of `r`.
        """
        return values_of(self._solution, "slip", r=r)


@checked
def cattaneo_mindlin(
    sphere: Hertz,
    *,
    friction_coefficient: float,
    shear_modulus: float,
    tangential_force: float,
) -> CattaneoMindlin:
    """Partial slip of a Hertz contact under a first tangential load.

    With `f = |T|/μP`: `c = a (1 − f)^(1/3)`, `q = μ [p(r; a) − p(r; c)]` where `p(r; s) = p0 √(s² − r²)/a`, `shift =
    3μP/(16aG*) · [1 − (1 − f)^(2/3)]`. Exact for uncoupled bodies (β = 0) with ν = 0 only: otherwise it neglects the
    slip across the force, of order `ν/(4 − 2ν)`. At `|T| = μP` the shift is that at the onset of full slip, the
    least possible.

    Parameters
    ----------
    sphere : Hertz
        Normal contact, of :func:`hertz`.
    friction_coefficient : float
        Coefficient of friction [-].
    shear_modulus : float
        Effective shear modulus G* [pressure]: ``effective_moduli(...).shear``.
    tangential_force : float
        Tangential force [force], at most friction times normal force.

    References
    ----------
    Cattaneo (1938); Mindlin (1949); Johnson (1985), *Contact Mechanics*, section 7.2.
    """
    solution = solution_of(
        "cattaneo_mindlin",
        *(sphere.radius, sphere.force, sphere.modulus),
        friction_coefficient,
        shear_modulus,
        tangential_force,
    )
    return CattaneoMindlin(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class Torsion:
    """Partial slip of a Hertz contact under a growing twisting moment M at constant normal force."""

    moment: float
    """Twisting moment M [force x length], signed."""
    twist: float
    """Rotation of the upper body against the lower [rad], with the sign of M."""
    stick_radius: float
    """Radius c of the disc that sticks [length]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    max_shear: float
    """Largest shear that friction holds anywhere, μp0 [pressure]."""
    _solution: Solution = field(repr=False, compare=False)

    def shear(self, r: npt.ArrayLike) -> Reals:
        """Circumferential shear at distance `r` from the middle [pressure], with the sign of M; zero outside the
        contact.

        `μp` in the rim; `q = (2μp0 r/π) ∫ E dt / (t √(t² − r²))` from c to a where the bodies stick.

        Of the shape of `r`.
        """
        return values_of(self._solution, "shear", r=r)


@checked
def torsion(sphere: Hertz, *, friction_coefficient: float, shear_modulus: float, moment: float) -> Torsion:
    """Twist a Hertz contact about its normal for the first time; exact for any pair of homogeneous bodies.

    With `k² = 1 − c²/a²`: `twist = μp0/(2G) · (K − E)`, `M = (16/3) G twist c³ + 8μp0 ∫ t² (K − E) dt` from c to a,
    the integrals in it of modulus² `1 − t²/a²`. Full slip: Hetényi & `McDonald` (1958). Exact for any pair of
    homogeneous bodies: torsion does not couple with pressure.

    Parameters
    ----------
    sphere : Hertz
        Normal contact, of :func:`hertz`.
    friction_coefficient : float
        Coefficient of friction [-].
    shear_modulus : float
        Torsional shear modulus G [pressure]: ``effective_moduli(...).torsional``.
    moment : float
        Torsional moment [force x length], less than ``3 pi mu P a / 16``.

    References
    ----------
    Lubkin (1951), J. Appl. Mech. 18, 183.
    """
    solution = solution_of(
        "torsion",
        *(sphere.radius, sphere.force, sphere.modulus),
        friction_coefficient,
        shear_modulus,
        moment,
    )
    return Torsion(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class StretchedSphere:
    """Partial slip of a Hertz contact of bodies with Poisson's ratio 0 under a tangential force T along x and a strain
    along x that grows with it.
    """

    tangential_force: float
    """Tangential force T along x [force], signed."""
    sliding_force: float
    """Largest tangential force that friction holds, μP [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    max_shear: float
    """Largest shear that friction holds anywhere, μp0 [pressure]."""
    stick_radius: float
    """Radius c of the disc that sticks [length]."""
    stick_offset: float
    """Middle e of that disc along x [length]."""
    _solution: Solution = field(repr=False, compare=False)

    def shear(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Reals:
        """Shear along x at a point [pressure], with the sign of the force; zero outside the contact.

        Of the broadcast shape of `x` and `y`.
        """
        return values_of(self._solution, "shear", x=x, y=y)


@checked
def stretched_sphere(
    sphere: Hertz,
    *,
    friction_coefficient: float,
    shear_modulus: float,
    tangential_force: float,
    strain: float,
) -> StretchedSphere:
    """Push a Hertz contact along x while a strain along x grows in proportion; Poisson's ratio 0.

    With `f = |T|/μP`: `q = μp0 [√(1 − r²/a²) − (c/a) √(1 − ((x − e)² + y²)/c²)]`, `c = a (1 − f)^(1/3)`, `e = a 8 G*
    ε/(πμp0)`: what sticks is an offset circle. ε is the strain of the lower surface less that of the upper one; `e =
    aσ/(πμp0)` under a tension σ of one of two bodies of one elasticity. Exact for uncoupled bodies with ν = 0, as
    long as all that slips slips one way: `|e| + c <= a`.

    Parameters
    ----------
    sphere : Hertz
        Normal contact, of :func:`hertz`.
    friction_coefficient : float
        Coefficient of friction [-].
    shear_modulus : float
        Effective shear modulus G* [pressure]: ``effective_moduli(...).shear``.
    tangential_force : float
        Tangential force [force], at most friction times normal force.
    strain : float
        Strain of the lower surface less that of the upper one [-].

    References
    ----------
    The field of an ellipsoidal shear is uniform in strain; as for the line of Nowell & Hills (1987).
    """
    solution = solution_of(
        "stretched_sphere",
        *(sphere.radius, sphere.force, sphere.modulus),
        friction_coefficient,
        shear_modulus,
        tangential_force,
        strain,
    )
    return StretchedSphere(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class EquibiaxialSphere:
    """A Hertz contact of bodies that do not couple, stretched alike in all directions of the surface against each
    other.
    """

    contact_radius: float
    """Radius a of the contact [length]."""
    stick_radius: float
    """Radius c of the disc that sticks [length]."""


@checked
def equibiaxial_sphere(sphere: Hertz, *, friction_coefficient: float, strain: float) -> EquibiaxialSphere:
    """Stretch a Hertz contact alike in all directions: ``E* strain/(mu p0) = K(k) - E(k)``, ``k^2 = 1 - c^2/a^2``.

    A ring slips along the radius and a disc sticks: `E* ε/(μp0) = K(k) − E(k)`, `k² = 1 − c²/a²`, for a strain that
    grows at a constant normal force and any Poisson's ratio.

    Parameters
    ----------
    sphere : Hertz
        Normal contact, of :func:`hertz`.
    friction_coefficient : float
        Coefficient of friction [-].
    strain : float
        Strain of the lower surface less that of the upper one [-].

    References
    ----------
    The integral equation of Lubkin (1951), J. Appl. Mech. 18, 183, whose torsion has the same kernel.
    """
    solution = solution_of(
        "equibiaxial_sphere",
        *(sphere.radius, sphere.force, sphere.modulus),
        friction_coefficient,
        strain,
    )
    return EquibiaxialSphere(**numbers_of(solution))


@dataclass(frozen=True)
class CattaneoLine:
    """Partial slip of a Hertz line contact under a growing tangential force Q' per length and a strain that grows with
    it.
    """

    tangential_force: float
    """Tangential force per length Q' [force / length], signed."""
    sliding_force: float
    """Largest tangential force per length that friction holds, μP' [force / length]."""
    half_width: float
    """Half-width a of the contact [length]."""
    max_shear: float
    """Largest shear that friction holds anywhere, μp0 [pressure]."""
    stick_half_width: float
    """Half-width c of what sticks [length]."""
    stick_offset: float
    """Middle e of what sticks [length]."""
    _solution: Solution = field(repr=False, compare=False)

    def shear(self, x: npt.ArrayLike) -> Reals:
        """Shear at `x` from the middle [pressure], with the sign of the force; zero outside the contact.

        Of the shape of `x`.
        """
        return values_of(self._solution, "shear", x=x)


@checked
def cattaneo_line(
    cylinder: HertzLine,
    *,
    friction_coefficient: float,
    tangential_force: float,
    strain: float = 0.0,
) -> CattaneoLine:
    """Push a Hertz line contact across its axis, while a strain grows in proportion.

    With `f = |Q'|/μP'`: `c = a √(1 − f)`, `q = μp0 [√(1 − x²/a²) − (c/a) √(1 − (x − e)²/c²)]` along the force, the
    middle of what sticks at `e = a E* ε/(2μp0)`, ε the strain of the lower surface less that of the upper one (`σ(1
    − ν²)/E` under a tension of the lower body; `e = aσ/(4μp0)` for bodies of one elasticity). For uncoupled bodies
    (β = 0), as long as all that slips slips one way: `|e| + c <= a`.

    Parameters
    ----------
    cylinder : HertzLine
        Normal contact, of :func:`hertz_line`.
    friction_coefficient : float
        Coefficient of friction [-].
    tangential_force : float
        Tangential force per length [force/length], at most friction times normal force.
    strain : float
        Strain of the lower surface less that of the upper one [-]: ``sigma (1 - nu^2)/E`` under a tension of the
        lower body.

    References
    ----------
    Cattaneo (1938); Mindlin (1949); Nowell & Hills (1987), Int. J. Mech. Sci. 29, 355.
    """
    solution = solution_of(
        "cattaneo_line",
        *(cylinder.radius, cylinder.line_force, cylinder.modulus),
        friction_coefficient,
        tangential_force,
        strain,
    )
    return CattaneoLine(**numbers_of(solution), _solution=solution)


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

    Both edges slip, in opposite senses, and the middle sticks: `E* ε/(2μp0) = (2/π) [K(k) − E(k)]`, `k² = 1 −
    c²/a²`, for bodies that do not couple and a strain that grows at a constant normal force. Derived from the
    condition that the shear has no singularity at the edges of stick, and held to a dense program.

    Parameters
    ----------
    cylinder : HertzLine
        Normal contact, of :func:`hertz_line`.
    friction_coefficient : float
        Coefficient of friction [-].
    strain : float
        Strain of the lower surface less that of the upper one [-].
    """
    solution = solution_of(
        "stretched_line",
        *(cylinder.radius, cylinder.line_force, cylinder.modulus),
        friction_coefficient,
        strain,
    )
    return StretchedLine(**numbers_of(solution))


@dataclass(frozen=True)
class SlidingCylinder:
    """Line contact of a cylinder in full sliding, with normal-tangential coupling."""

    line_force: float
    """Force per length P' [force / length]."""
    half_width: float
    """Half-width a of the contact [length]."""
    exponent: float
    """Exponent γ [-], positive where coupling and friction are."""
    offset: float
    """Middle of the contact from the cylinder's axis [length], with the shear on the lower body along +x."""
    max_pressure: float
    """Largest pressure [pressure]."""
    _solution: Solution = field(repr=False, compare=False)

    def pressure(self, x: npt.ArrayLike) -> Reals:
        """Pressure at `x` from the middle of the contact [pressure]; zero outside.

        Of the shape of `x`.
        """
        return values_of(self._solution, "pressure", x=x)


@checked
def sliding_cylinder(
    *,
    radius: float,
    line_force: float,
    modulus: float,
    coupling: float,
    friction_coefficient: float,
) -> SlidingCylinder:
    """Slide a cylinder across its axis on a half-space, with Dundurs' coupling beta [-].

    `p = (E*/2R) cos(πγ) (a + x)^(1/2 − γ) (a − x)^(1/2 + γ)`, `tan(πγ) = βμ`, `P' = πa² E* (1 − 4γ²)/(4R)`; the
    middle of the contact lies `2γa` behind the cylinder's axis: at `−2γa` with the shear on the lower body along +x.
    x counts from the middle.

    Parameters
    ----------
    radius : float
        Relative radius of curvature R [length].
    line_force : float
        Normal force per unit of length [force/length].
    modulus : float
        Effective modulus E* [pressure]: ``effective_moduli(...).normal``.
    coupling : float
        Dundurs' beta [-]: ``effective_moduli(...).coupling``.
    friction_coefficient : float
        Coefficient of friction [-], negative for shear on the lower body along -x.

    References
    ----------
    Bufler (1959); Johnson (1985), *Contact Mechanics*, section 8.2.
    """
    solution = solution_of("sliding_cylinder", radius, line_force, modulus, coupling, friction_coefficient)
    return SlidingCylinder(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class NoSlipPunch:
    """Flat circular punch that sticks completely."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the punch and of the contact [length]."""
    approach: float
    """Approach δ [length]."""
    force_ratio: float
    """Force over that of the frictionless punch at the same approach [-]."""


@checked
def no_slip_punch(*, radius: float, force: float, modulus: float, coupling: float) -> NoSlipPunch:
    """Press a flat circular punch that sticks; `coupling` is Dundurs' beta [-].

    `P = 2E* a δ · ln((1 + β)/(1 − β))/(2β)`; for a rigid punch `β = (1 − 2ν)/(2(1 − ν))` and the factor is `(1 − ν)
    ln(3 − 4ν)/(1 − 2ν)`.

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
    solution = solution_of("no_slip_punch", radius, force, modulus, coupling)
    return NoSlipPunch(**numbers_of(solution))


@dataclass(frozen=True)
class NoSlipSphere:
    """Sphere that sticks as it touches."""

    force: float
    """Normal force P [force]."""
    contact_radius: float
    """Radius a of the contact [length]."""
    approach: float
    """Approach δ [length]."""
    approach_factor: float
    """`κ = δ R/a²` [-]."""
    force_ratio: float
    """Force over that of the frictionless sphere at the same contact radius [-]."""


@checked
def no_slip_sphere(*, radius: float, force: float, modulus: float, coupling: float) -> NoSlipSphere:
    """Press a sphere that sticks as it touches; `coupling` is Dundurs' beta [-], 0 gives the Hertz contact.

    `δ = κ a²/R`, `κ = 1 / (2 ∫ t cos(θ ln((1 + t)/(1 − t))) dt)` over 0..1, `θ = ln((1 + β)/(1 − β))/(2π)`; `P = κ ·
    (punch's ratio) · 4E*a³/(3R)`. For forces that only grow from zero. Coupling 0 gives the Hertz contact.

    Parameters
    ----------
    radius : float
        Relative radius of curvature R [length].
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
    solution = solution_of("no_slip_sphere", radius, force, modulus, coupling)
    return NoSlipSphere(**numbers_of(solution))
