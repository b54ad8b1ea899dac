"""Partial slip of a sphere: tangential force, fretting loop, torsion, stretching of the bodies."""

from dataclasses import dataclass, field

import numpy.typing as npt

from fretting import _core
from fretting._arguments import checked
from fretting._arrays import Reals
from fretting.analytic._solution import Branch, curve, forces_of, numbers_of, of_each, surface
from fretting.analytic.normal import Hertz, hertz_numbers


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
        return curve(self._solution, "shear", r)

    def slip(self, r: npt.ArrayLike) -> Reals:
        """Slip at distances `r` [length], along the force, averaged over the direction; zero where the bodies stick."""
        return curve(self._solution, "slip", r)


@checked
def cattaneo_mindlin(
    sphere: Hertz, *, friction_coefficient: float, shear_modulus: float, tangential_force: float
) -> CattaneoMindlin:
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
    solution = _core.cattaneo_mindlin(hertz_numbers(sphere), friction_coefficient, shear_modulus, tangential_force)
    return CattaneoMindlin(**numbers_of(solution), _solution=solution)


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
        return curve(self._solution, "shear", r)


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

    @checked
    def at(self, branch: Branch, tangential_force: float) -> LoopPoint:
        """Return the contact at a tangential force [force] on a branch of the loop.

        Raises
        ------
        ValueError
            When the loop does not reach the force.
        """
        solution = _core.mindlin_deresiewicz_at(
            hertz_numbers(self.sphere),
            self.friction_coefficient,
            self.shear_modulus,
            self.amplitude,
            branch,
            tangential_force,
        )
        return LoopPoint(**numbers_of(solution), _solution=solution)


@checked
def mindlin_deresiewicz(
    sphere: Hertz, *, friction_coefficient: float, shear_modulus: float, amplitude: float
) -> MindlinDeresiewicz:
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
    fretting_loop, peak = _core.mindlin_deresiewicz(
        hertz_numbers(sphere), friction_coefficient, shear_modulus, amplitude
    )
    return MindlinDeresiewicz(
        sphere=sphere,
        friction_coefficient=friction_coefficient,
        shear_modulus=shear_modulus,
        amplitude=amplitude,
        peak=CattaneoMindlin(**numbers_of(peak), _solution=peak),
        **numbers_of(fretting_loop),
    )


@dataclass(frozen=True)
class TangentialHistory:
    """A Hertz contact taken through any sequence of tangential forces, at constant normal force."""

    tangential_forces: Reals
    """Tangential forces in their order [force]."""
    shift: Reals
    """Relative tangential displacement of the bodies at each force [length]."""
    stick_radius: Reals
    """Radius of the disc that has not slipped since the force last turned, at each force [length]."""
    dissipated_energy: Reals
    """Energy dissipated by friction since the start, at each force [force x length]."""
    _solution: _core.Solution = field(repr=False, compare=False)

    def shear(self, r: npt.ArrayLike) -> Reals:
        """Shear at the last force at distances `r` from the middle [pressure], along the force; zero outside."""
        return curve(self._solution, "shear", r)


@checked
def tangential_history(
    sphere: Hertz, *, friction_coefficient: float, shear_modulus: float, tangential_forces: npt.ArrayLike
) -> TangentialHistory:
    """Take a Hertz contact through tangential forces along one line, in any order.

    Loops that close are forgotten (Masing's rule). Limits as for :func:`cattaneo_mindlin`.

    Parameters
    ----------
    sphere : Hertz
        The normal contact.
    friction_coefficient : float
        Friction coefficient [-].
    shear_modulus : float
        Effective shear modulus G* [pressure].
    tangential_forces : array_like
        Tangential forces, one after the other from zero on, shape ``(n,)`` [force]; between them the force is monotone.
        None is more than friction times normal force.

    References
    ----------
    Mindlin & Deresiewicz (1953); Jäger (1993), *Arch. Appl. Mech.* 63, 402.

    Examples
    --------
    >>> from fretting import analytic
    >>> sphere = analytic.hertz(radius=10e-3, force=10.0, modulus=115e9)
    >>> history = analytic.tangential_history(
    ...     sphere, friction_coefficient=0.5, shear_modulus=24e9, tangential_forces=[3.0, -3.0, 3.0]
    ... )
    >>> bool(history.shift[2] == history.shift[0])
    True
    """
    solution = _core.tangential_history(
        hertz_numbers(sphere), friction_coefficient, shear_modulus, forces_of(tangential_forces)
    )
    return TangentialHistory(**of_each(numbers_of(solution)), _solution=solution)


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
        return curve(self._solution, "shear", r)


@checked
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
    solution = _core.torsion(hertz_numbers(sphere), friction_coefficient, shear_modulus, moment)
    return Torsion(**numbers_of(solution), _solution=solution)


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
        return surface(self._solution, x, y)


@checked
def stretched_sphere(
    sphere: Hertz, *, friction_coefficient: float, shear_modulus: float, tangential_force: float, strain: float
) -> StretchedSphere:
    """Push a Hertz contact along x while a strain along x grows in proportion; Poisson's ratio 0.

    ``c = a (1 - |T|/(mu P))^(1/3)``, ``e = 8 a G* strain/(pi mu p0)``, as long as ``|e| + c <= a``.

    Parameters
    ----------
    sphere : Hertz
        The contact that is stretched, of :func:`hertz`.
    friction_coefficient : float
        Coefficient of friction [-].
    shear_modulus : float
        Effective shear modulus G* [pressure]: ``effective_moduli(...).shear``.
    tangential_force : float
        Tangential force on the upper body along x [force].
    strain : float
        Strain of the lower surface less that of the upper one [-].
    """
    solution = _core.stretched_sphere(
        hertz_numbers(sphere), friction_coefficient, shear_modulus, tangential_force, strain
    )
    return StretchedSphere(**numbers_of(solution), _solution=solution)


@dataclass(frozen=True)
class EquibiaxialSphere:
    """A Hertz contact whose bodies are stretched against each other alike in all directions of the surface."""

    contact_radius: float
    """Radius a of the contact [length]."""
    stick_radius: float
    """Radius c of the disc that sticks [length]."""


@checked
def equibiaxial_sphere(sphere: Hertz, *, friction_coefficient: float, strain: float) -> EquibiaxialSphere:
    """Stretch a Hertz contact alike in all directions: ``E* strain/(mu p0) = K(k) - E(k)``, ``k^2 = 1 - c^2/a^2``.

    Parameters
    ----------
    sphere : Hertz
        The contact that is stretched, of :func:`hertz`.
    friction_coefficient : float
        Coefficient of friction [-].
    strain : float
        Strain of the lower surface less that of the upper one [-].
    """
    return EquibiaxialSphere(
        **numbers_of(_core.equibiaxial_sphere(hertz_numbers(sphere), friction_coefficient, strain))
    )
