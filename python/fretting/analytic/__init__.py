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

from fretting.analytic.line import (
    CattaneoLine,
    HertzLine,
    SlidingCylinder,
    StretchedLine,
    TiltedLinePunch,
    cattaneo_line,
    hertz_line,
    sliding_cylinder,
    stretched_line,
    tilted_line_punch,
)
from fretting.analytic.no_slip import (
    NoSlipPunch,
    NoSlipSphere,
    SpencePoint,
    no_slip_punch,
    no_slip_sphere,
    spence_table,
)
from fretting.analytic.normal import (
    Cone,
    EffectiveModuli,
    FlatPunch,
    Hertz,
    HertzEllipse,
    RoundedPunch,
    ThickLayer,
    ThinLayer,
    TiltedPunch,
    Westergaard,
    cone,
    effective_moduli,
    flat_punch,
    hertz,
    hertz_ellipse,
    rounded_punch,
    thick_layer,
    thin_layer,
    tilted_punch,
    westergaard,
)
from fretting.analytic.partial_slip import (
    CattaneoMindlin,
    EquibiaxialSphere,
    LoopPoint,
    MindlinDeresiewicz,
    StretchedSphere,
    Torsion,
    cattaneo_mindlin,
    equibiaxial_sphere,
    mindlin_deresiewicz,
    stretched_sphere,
    torsion,
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
