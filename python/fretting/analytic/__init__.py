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

from fretting.analytic import _generated
from fretting.analytic._generated import *  # noqa: F403
from fretting.analytic.histories import (
    LineHistory,
    LoopPoint,
    MindlinDeresiewicz,
    TangentialHistory,
    line_history,
    mindlin_deresiewicz,
    tangential_history,
)
from fretting.analytic.spence import SpencePoint, spence_table

__all__ = [
    "LineHistory",
    "LoopPoint",
    "MindlinDeresiewicz",
    "SpencePoint",
    "TangentialHistory",
    "line_history",
    "mindlin_deresiewicz",
    "spence_table",
    "tangential_history",
]
__all__ += _generated.__all__
