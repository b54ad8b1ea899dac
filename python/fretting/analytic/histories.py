"""Contacts whose tangential force goes to and fro: the fretting loop of a sphere, histories of spheres and lines."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from fretting import _core
from fretting._arguments import checked
from fretting._arrays import Reals
from fretting.analytic._generated import CattaneoMindlin, Hertz, HertzLine
from fretting.analytic._solution import Branch, Solution, equal, forces_of, numbers_of, of_each, values_of


@dataclass(frozen=True)
class LoopPoint:
    """A Hertz contact at one point of its fretting loop."""

    tangential_force: float
    """Tangential force Q [force]."""
    shift: float
    """Relative tangential displacement of the bodies [length]."""
    stick_radius: float
    """Radius of the disc that has not slipped since the last turning point [length]."""
    _solution: Solution = field(repr=False, compare=False)

    def shear(self, r: npt.ArrayLike) -> Reals:
        """Shear at distances `r` from the middle [pressure], along the force; zero outside the contact."""
        return values_of(self._solution, "shear", r=r)


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
        solution = Solution(
            _core.mindlin_deresiewicz_at,
            _numbers(self.sphere),
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
    given = _numbers(sphere), friction_coefficient, shear_modulus, amplitude
    fretting_loop, peak = _core.mindlin_deresiewicz(*given)[0], Solution(_peak, *given)
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
    _solution: Solution = field(repr=False, compare=False)

    def __eq__(self, other: object) -> bool:
        """Whether the other has the same numbers."""
        return equal(self, other)

    def shear(self, r: npt.ArrayLike) -> Reals:
        """Shear at the last force at distances `r` from the middle [pressure], along the force; zero outside."""
        return values_of(self._solution, "shear", r=r)


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
    solution = Solution(
        _core.tangential_history, _numbers(sphere), friction_coefficient, shear_modulus, forces_of(tangential_forces)
    )
    return TangentialHistory(**of_each(numbers_of(solution)), _solution=solution)


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
    _solution: Solution = field(repr=False, compare=False)

    def __eq__(self, other: object) -> bool:
        """Whether the other has the same numbers."""
        return equal(self, other)

    def shear(self, x: npt.ArrayLike) -> Reals:
        """Shear at the last force at `x` from the middle [pressure], along the force; zero outside the contact."""
        return values_of(self._solution, "shear", x=x)


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
    solution = Solution(
        _core.line_history,
        (cylinder.radius, cylinder.line_force, cylinder.modulus),
        friction_coefficient,
        compliance,
        forces_of(tangential_forces),
        None if datum is None else (float(datum), at_datum),
    )
    return LineHistory(**of_each(numbers_of(solution)), _solution=solution)


def _peak(*given: Any) -> _core.Solution:
    """Return the contact at the first peak of a loop."""
    return _core.mindlin_deresiewicz(*given)[1]


def _numbers(sphere: Hertz) -> tuple[float, float, float]:
    return sphere.radius, sphere.force, sphere.modulus
