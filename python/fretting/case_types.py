"""The case as typed dictionaries, for completion and static checks: ``case: fretting.Case = {...}``.

Generated from examples/fret.schema.json by docs/site/case_types.py; a test compares the two.
"""

from collections.abc import Sequence
from typing import Any, Literal, NotRequired, TypeAlias, TypedDict

import numpy.typing as npt

AlongPhase: TypeAlias = Sequence[float] | float


Array: TypeAlias = Sequence[Sequence[float] | float] | npt.NDArray[Any]


Auto: TypeAlias = Literal["auto"]


Axis: TypeAlias = Literal["x", "y"]
"""
A direction in the surface.
"""


Base: TypeAlias = Literal["rigid"]
"""
The one foundation that is not a substrate.
"""


Beyond: TypeAlias = Literal["body", 'no body']
"""
What lies beyond the edge of the grid.
"""


BeyondMaps: TypeAlias = Literal["edge", "repeats", "mirrors"]
"""
What lies beyond the maps of heights and friction, which are as long as the grid, where a contact rolls off them with its grid.
"""


CellsItem: TypeAlias = int


Cells: TypeAlias = Sequence[CellsItem] | int


Coefficient: TypeAlias = float | str | Sequence[Sequence[float] | float] | npt.NDArray[Any]


class Cone(TypedDict):
    """
    A blunt cone.
    """

    slope: float
    """
    Slope of its side against the surface, positive: the tangent of the angle between them.
    """


class CrackConstants(TypedDict):
    """
    Constants of a short crack.
    """

    final_length: float
    """
    Length up to which it is followed [length].
    """
    initial_length: float
    """
    Length that the crack has first [length].
    """
    paris_coefficient: NotRequired[float]
    """
    Paris' C: growth per cycle [length] is `C dK^m`.
    """
    paris_exponent: NotRequired[float]
    """
    Paris' m [-].
    """
    short_crack_length: float
    """
    El Haddad's length l0 [length]: the threshold of a crack of length l is `threshold sqrt(l/(l + l0))`.
    """
    threshold: float
    """
    Threshold of long cracks, range of the stress intensity while the crack is open [pressure x sqrt(length)].
    """
    toughness: NotRequired[float]
    """
    Fracture toughness [pressure x sqrt(length)]: there the crack runs through.
    """


class CrownedRoller(TypedDict):
    """
    A crowned roller.
    """

    axis: Axis
    """
    Direction of its axis.
    """
    crown_radius: float
    """
    Radius of the crown along the axis [length], positive.
    """
    flat_length: NotRequired[float]
    """
    Length of the straight middle [length]. Default: none, crowned from the middle on.
    """
    length: float
    """
    Length along the axis [length], positive, with square ends.
    """
    radius: float
    """
    Radius [length], positive.
    """


class Cylinder(TypedDict):
    """
    A cylinder.
    """

    axis: Axis
    """
    Direction of its axis.
    """
    length: NotRequired[float]
    """
    Length along the axis [length], positive, with square ends. Default: infinite.
    """
    radius: float
    """
    Radius [length], positive; in a body's own profile negative for a groove.
    """


class Debris(TypedDict):
    """
    Debris between the surfaces: a layer that fills the gap, in each cell as thick as what has stayed there. It lies in the frame of the lower
    body.
    """

    fraction: float
    """
    Fraction of what wears off both bodies that stays between them, with its volume.
    """
    outflow_length: NotRequired[float]
    """
    Slip distance in which all but 1/e of the debris of a cell flows out over the rim of the contact [length]: its thickness falls by thickness x
    slip distance / `outflow_length`. Default: none flows out.
    """
    stiffness: NotRequired[float]
    """
    Modulus of the debris [pressure]: under a pressure p it gives by p x thickness / `stiffness` and no further aside. Default: it does not give.
    """


Depths: TypeAlias = Sequence[float] | Auto


Detrend: TypeAlias = Literal["none", "mean", "plane"]
"""
What is subtracted from heights.
"""


Displacement: TypeAlias = Literal["small", "finite"]
"""
How far the surfaces are taken to move.
"""


Driver: TypeAlias = Literal["energy", "slip_distance", "cycles"]
"""
What the friction coefficient follows.
"""


class Ellipsoid(TypedDict):
    """
    An ellipsoid.
    """

    radius_x: float
    """
    Radius of curvature in the x-z plane [length], positive; in a body's own profile negative for a hollow.
    """
    radius_y: float
    """
    Radius of curvature in the y-z plane [length], positive; in a body's own profile negative for a hollow.
    """


class Evolution(TypedDict):
    """
    Friction that evolves: the coefficient of each cell follows what slip has done to it, from `coefficient` or `map` on. It changes after
    each simulated cycle, and at the end of a stage without cycles.
    """

    by: Driver
    """
    What the coefficient follows: the energy dissipated in the cell by area [pressure x length], the slip distance of the cell
    [length], or the number of cycles.
    """
    every: NotRequired[int]
    """
    Maximum cycle jump: number of cycles one simulated cycle may represent. Default: 1.
    """
    last: NotRequired[float]
    """
    Coefficient it tends to, positive: coefficient = last + (first - last) exp(-driver / scale).
    """
    scale: NotRequired[float]
    """
    Scale of the exponential, positive, in the unit of what the coefficient follows.
    """
    table: NotRequired[Sequence[Sequence[float]]]
    """
    Instead of `last` and `scale`: rows of driver and coefficient, the first at 0 with `friction.coefficient`; linear between them,
    constant beyond the last.
    """
    tolerance: NotRequired[float]
    """
    Maximum change of the coefficient of a cell per cycle jump. Default: 0.01.
    """


Fill: TypeAlias = Literal["none", "harmonic"]


class FlatPunch(TypedDict):
    """
    A flat circular punch.
    """

    radius: float
    """
    Radius [length], positive; no body beyond it.
    """


class Formula(TypedDict):
    """
    A surface by a formula.
    """

    expression: str
    """
    The gap [length], in a body's own profile the distance of its surface from the plane of first touch, as an expression of x and y
    [length], counted from the middle of the grid, and of the parameters: "(x^2 + y^2)/(2*R)". Operators + - * / ^, parentheses, pi, and
    the functions abs, sqrt, exp, ln, log10, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, min, max, hypot, mod. It may be
    lowest anywhere: the gap is counted from where it touches first.
    """
    parameters: NotRequired[dict[str, Any]]
    """
    Numbers that the expression names, each a finite number: { R = 10e-3 }.
    """


Frame: TypeAlias = Literal["bodies", "contact"]
"""
Where the grid is while a contact rolls.
"""


Held: TypeAlias = Literal["held"]


Increments: TypeAlias = int | Auto


Indenter: TypeAlias = Literal["berkovich", "vickers", "cube_corner"]
"""
An indenter with plane sides.
"""


Integration: TypeAlias = Literal["second_order", "end_point"]
"""
How slip is integrated over an increment.
"""


NamedInterface: TypeAlias = Literal["bonded", "frictionless"]


class Kinematics(TypedDict):
    """
    How the surfaces move against each other.
    """

    beyond_maps: NotRequired[BeyondMaps]
    """
    What lies beyond the maps of heights and friction, which are as long as the grid, where it goes with the contact: what is at their "edge"
    continues, or the map "repeats", or "mirrors" itself at its edges. Needed where such a map travels through the grid.
    """
    displacement: NotRequired[Displacement]
    """
    "small": opposite points of the surfaces stay opposite, for a shift that is small against the contact; "finite": profile,
    topography and wear of the upper body move with it by its shift, and each body wears in its own frame, the lower one in that of the
    grid. A table [profile] is then the upper body's. Default: "small".
    """
    frame: NotRequired[Frame]
    """
    Where the grid is while the contact rolls: fixed to the "bodies", through which the contact travels, or with the "contact", by whole cells
    in every increment. Default: "bodies".
    """


Law: TypeAlias = Literal["exponential", "linear"]
"""
How Young's modulus runs over the depth.
"""


class LogColumns(TypedDict):
    """
    Columns of a measured log by what they hold.
    """

    cycle: NotRequired[str]
    """
    Number of the cycle.
    """
    displacement: NotRequired[str]
    """
    Displacement of the actuator.
    """
    force: NotRequired[str]
    """
    Tangential force.
    """
    normal_force: NotRequired[str]
    """
    Normal force.
    """


Map: TypeAlias = str | Sequence[Sequence[float] | float] | npt.NDArray[Any]


Of: TypeAlias = Literal["surface", "gap"]
"""
What heights describe.
"""


class Output(TypedDict):
    """
    What is written to the results.
    """

    every: NotRequired[int]
    """
    Keep fields of every n-th increment, and of the last of each stage. Default: only of the last of each stage.
    """
    fields: NotRequired[Sequence[str]]
    """
    Fields to keep: "pressure", "shear", "slip", "gap", "zone", "`worn_depth`" (of bodies that move against each other also of each), "debris",
    "`plastic_depth`", "`friction_work`" (energy that friction dissipates in the increment by area), "friction". Default: pressure, shear, slip, zone.
    """


Periodic: TypeAlias = bool | Axis


class Phase(TypedDict):
    """
    Phases of the controls [degrees], each by the name of its control.
    """

    actuator: NotRequired[Sequence[float]]
    """
    Of the actuator along x and y.
    """
    actuator_approach: NotRequired[float]
    """
    Of the actuator along z.
    """
    approach: NotRequired[float]
    """
    Of the approach.
    """
    bulk_stress: NotRequired[AlongPhase]
    """
    Of the bulk stress of the lower body.
    """
    creepage: NotRequired[Sequence[float]]
    """
    Not available: creepage is the same all along a stage.
    """
    mean_gap: NotRequired[float]
    """
    Of the mean gap.
    """
    normal_force: NotRequired[float]
    """
    Of the normal force.
    """
    roll: NotRequired[AlongPhase]
    """
    Of the distance rolled.
    """
    shift: NotRequired[Sequence[float]]
    """
    Of the shift along x and y.
    """
    spin: NotRequired[float]
    """
    Not available: spin is the same all along a stage.
    """
    tangential_force: NotRequired[Sequence[float]]
    """
    Of the tangential force along x and y.
    """
    tilt: NotRequired[AlongPhase]
    """
    Of the slopes.
    """
    tilt_moment: NotRequired[AlongPhase]
    """
    Of the moments of the pressure.
    """
    twist: NotRequired[float]
    """
    Of the rotation about z.
    """
    twist_moment: NotRequired[float]
    """
    Of the moment about z.
    """
    upper_bulk_stress: NotRequired[AlongPhase]
    """
    Of that of the upper body.
    """


class Pyramid(TypedDict):
    """
    A pyramid.
    """

    half_angle: NotRequired[float]
    """
    Angle between the axis and a side [degrees], in place of that of the indenter.
    """
    indenter: Indenter
    """
    A three-sided Berkovich indenter (65.27 degrees), a four-sided Vickers (68 degrees), or the corner of a cube (three sides, 35.264
    degrees). The first side faces x.
    """


Ramp: TypeAlias = Literal["linear", "square", "cubic"]
"""
How a ramp runs.
"""


class RectangularPunch(TypedDict):
    """
    A rectangular flat punch.
    """

    edge_radius: NotRequired[float]
    """
    Radius of the rounding around the flat [length], positive. Default: sharp edges, no body beyond.
    """
    length_x: float
    """
    Length of the flat along x [length], positive.
    """
    length_y: float
    """
    Length of the flat along y [length], positive.
    """


Resample: TypeAlias = Literal["none", "linear"]


Residual: TypeAlias = float | Sequence[float] | Sequence[Sequence[float]]


class Rig(TypedDict):
    """
    The machine: springs between the upper body and what a stage drives with `actuator` and `actuator_approach`.
    """

    columns: NotRequired[LogColumns]
    """
    What the columns of a log that was measured on it are called, for `fret identify`. Default: usual names.
    """
    normal_stiffness: NotRequired[float]
    """
    Normal stiffness of the machine [force/length]: `actuator_approach` = approach + normal force / stiffness. Default: rigid.
    """
    tangential_stiffness: NotRequired[AlongPhase]
    """
    Tangential stiffness of the machine [force/length], along x and y or in both directions alike: actuator = shift + tangential
    force / stiffness. Default: rigid.
    """


class Rim(TypedDict):
    """
    Wear by the distance from the rim of the contact to which air has access; a pocket inside of the contact has none.
    """

    interior: float
    """
    Wear coefficient farther inside, over that at the rim.
    """
    upper_interior: NotRequired[float]
    """
    The same of the upper body, with `kinematics.displacement` = "finite". Default: `interior`.
    """
    width: float
    """
    Distance from the rim within which the surfaces wear by their wear coefficient [length].
    """


class RoundedPunch(TypedDict):
    """
    A flat punch with a rounded edge.
    """

    edge_radius: float
    """
    Radius of the rounding [length], positive.
    """
    flat_radius: float
    """
    Radius of the flat [length], positive.
    """


ScanSize: TypeAlias = Sequence[float] | float


Scheme: TypeAlias = Literal["monolithic", "staggered"]
"""
How coupled pressure and shear are solved.
"""


Side: TypeAlias = Literal["upper", "lower"]
"""
One of the two bodies.
"""


Size: TypeAlias = Sequence[float] | float | Auto


class Solver(TypedDict):
    """
    Accuracy of the solution.
    """

    history_tolerance: NotRequired[float]
    """
    With `increments = "auto"`: tolerance of the adaptive sub-stepping, relative to the change of the tractions over the
    increment. Default: 0.03.
    """
    integration: NotRequired[Integration]
    """
    "`second_order`": the friction law at the end of an increment takes the direction that slip has there, and slip that turns goes
    along an arc; "`end_point`": the direction of the whole slip increment, and straight (backward Euler, of first order), for
    comparison. Default: "`second_order`".
    """
    scheme: NotRequired[Scheme]
    """
    "monolithic": pressure and shear together; "staggered": in alternation (Panagiotopoulos process, the published three-level
    scheme), for comparison. Default: "monolithic".
    """
    tolerance: NotRequired[float]
    """
    Largest accepted residual of every increment (complementarity, Coulomb, equilibrium; dimensionless). Default: 1e-8.
    """


class Sphere(TypedDict):
    """
    A sphere.
    """

    radius: float
    """
    Radius [length], positive; in a body's own profile negative for a hollow.
    """


class SpheroCone(TypedDict):
    """
    A cone with a spherical tip.
    """

    radius: float
    """
    Radius of the tip [length], positive.
    """
    slope: float
    """
    Slope of the side against the surface, positive: the tangent of the angle between them.
    """


class Springs(TypedDict):
    """
    Springs of no thickness between a coating and what lies below it: displacement jumps by traction over stiffness.
    """

    normal_stiffness: NotRequired[float]
    """
    Normal stiffness [pressure/length], positive. Default: bonded along the normal.
    """
    shear_stiffness: NotRequired[float]
    """
    Shear stiffness [pressure/length], the same in all directions; 0: no shear passes. Default: bonded against shear.
    """


class Steady(TypedDict):
    """
    When the cycle counts as steady.
    """

    most_cycles: int
    """
    Maximum number of cycles.
    """
    tolerance: float
    """
    Tractions, forces and motions at the end of a cycle differ from those at its start by at most this, relative.
    """


SteadyRoll: TypeAlias = Literal["steady"]


class StrainLife(TypedDict):
    """
    Coffin, Manson and Basquin's law: strain amplitude `= S/E (2N)^b + e (2N)^c`; in shear with G for E.
    """

    ductility_coefficient: float
    """
    Fatigue ductility coefficient e [-], positive.
    """
    ductility_exponent: float
    """
    Fatigue ductility exponent c [-], negative.
    """
    strength_coefficient: float
    """
    Fatigue strength coefficient S [pressure], positive.
    """
    strength_exponent: float
    """
    Fatigue strength exponent b [-], negative.
    """


class Stress(TypedDict):
    """
    Subsurface stresses of one body, and constants of the fatigue parameters for those of its layers that name none of their own.
    """

    body: NotRequired[Side]
    """
    The body. Default: "lower".
    """
    critical_distance: NotRequired[float]
    """
    Critical distance L [length]: fatigue parameters are also told at the depth L/2 (point method) and as means from the surface
    down to 2 L (line method).
    """
    depths: NotRequired[Depths]
    """
    Depths below the surface of the body [length], or "auto": denser near the surface and the interfaces.
    """
    every: NotRequired[int]
    """
    Evaluate every n-th kept increment, and the last. Default: 1.
    """
    normal_stress_sensitivity: NotRequired[float]
    """
    Weight of the normal stress in Fatemi and Socie's parameter [-]. Default: 1.
    """
    tension_limit: NotRequired[float]
    """
    Fatigue limit in fully reversed tension or bending, amplitude [pressure], for Crossland and Dang Van.
    """
    torsion_limit: NotRequired[float]
    """
    Fatigue limit in fully reversed torsion, amplitude [pressure], for Crossland and Dang Van.
    """
    volume: NotRequired[bool]
    """
    Write volumes for `ParaView`. Default: false.
    """
    yield_strength: NotRequired[float]
    """
    Yield strength [pressure], for Fatemi and Socie.
    """


class Thermal(TypedDict):
    """
    Steady temperature rise by the friction of the last cycle.
    """

    frequency: float
    """
    Cycles per unit of time; that of the conductivities, so that energy times frequency is their power.
    """


class Units(TypedDict):
    """
    Units of the numbers in the case. Nothing is converted: results are in the same units.
    """

    force: str
    """
    Unit of every force, such as "N". That of pressures and moduli follows: `MPa` for mm and N.
    """
    length: str
    """
    Unit of every length, such as "mm".
    """


class Wave(TypedDict):
    """
    A sinusoidal surface.
    """

    amplitude: float
    """
    Half of the height from valley to crest [length], positive.
    """
    wavelength_x: NotRequired[float]
    """
    Wavelength along x [length]. Default: constant along x.
    """
    wavelength_y: NotRequired[float]
    """
    Wavelength along y [length]. Default: constant along y.
    """


Waveform: TypeAlias = Literal["triangle", "sine", "trapezoid"]
"""
Shape of a cycle.
"""


WearLaw: TypeAlias = Literal["archard", "energy"]
"""
Wear law.
"""


WornBody: TypeAlias = Literal["upper", "lower"]
"""
One of the bodies.
"""


class WornSphere(TypedDict):
    """
    A worn or truncated sphere.
    """

    flat_radius: float
    """
    Radius of the flat [length], positive.
    """
    radius: float
    """
    Radius of the sphere [length], positive.
    """


Component: TypeAlias = float | Held


class FatigueConstants(TypedDict):
    """
    Constants of a layer for fatigue and fracture, each for what it is needed for.
    """

    channelling_factor: NotRequired[float]
    """
    Beuth's g(alpha, beta) of a coating [-], which channelling needs where coating and substrate differ in stiffness.
    """
    crack: NotRequired[CrackConstants]
    """
    Growth of a short crack from the most severe place of the surface.
    """
    critical_distance: NotRequired[float]
    """
    Critical distance L [length]: parameters are also told at the depth L/2 (point method) and as means down to 2 L (line method).
    """
    fracture_energy: NotRequired[float]
    """
    Fracture energy of a coating [force/length], for channelling cracks.
    """
    interface_energy: NotRequired[float]
    """
    Fracture energy of the interface below a coating [force/length], for delamination.
    """
    interface_phase: NotRequired[float]
    """
    Phase angle of the interface crack under tension [degrees], which the mode mix needs where coating and substrate differ in stiffness.
    """
    normal_stress_sensitivity: NotRequired[float]
    """
    Weight of the normal stress in Fatemi and Socie's parameter [-]. Default: 1.
    """
    shear_life: NotRequired[StrainLife]
    """
    Life in torsion over the shear strain, for cycles to initiation by Fatemi and Socie.
    """
    strain_life: NotRequired[StrainLife]
    """
    Life in tension over the normal strain, for cycles to initiation by Smith, Watson and Topper.
    """
    tension_limit: NotRequired[float]
    """
    Fatigue limit in fully reversed tension or bending, amplitude [pressure], for Crossland and Dang Van.
    """
    torsion_limit: NotRequired[float]
    """
    Fatigue limit in fully reversed torsion, amplitude [pressure], for Crossland and Dang Van.
    """
    yield_strength: NotRequired[float]
    """
    Yield strength [pressure], for Fatemi and Socie and for elastic shakedown.
    """


class Friction(TypedDict):
    """
    Coulomb's law of friction, with a shear strength of the interface where it has one.
    """

    coefficient: NotRequired[float]
    """
    Coefficient, zero or positive.
    """
    evolution: NotRequired[Evolution]
    """
    Friction that evolves: how the coefficient of each cell follows what slip has done to it. Default: it stays.
    """
    map: NotRequired[Map]
    """
    One coefficient per cell: a .npy or text file, rows of numbers, or from Python an array; index [i, j] = [x, y].
    """
    max_shear: NotRequired[Coefficient]
    """
    Shear strength of the interface [pressure], zero or positive, a number or one for every cell: shear is at most the smaller of it
    and the coefficient times the pressure. Default: none.
    """
    moves_with: NotRequired[Side]
    """
    The body that a map belongs to, and whose places remember what friction that evolves follows: it moves with that where
    `kinematics.displacement = "finite"`. Default: "lower".
    """


class Gradient(TypedDict):
    """
    Young's modulus over the depth of a coating: `young` at both faces and the `law` between them, or a `table`.
    """

    law: NotRequired[Law]
    """
    How it runs from one to the other.
    """
    layers: NotRequired[int]
    """
    Number of uniform sublayers. Default: chosen such that the surface response changes by less than 1e-4.
    """
    table: NotRequired[Sequence[Sequence[float]]]
    """
    Rows of depth [length] and Young's modulus [pressure], depths rising from 0 to the thickness; linear between them.
    """
    young: NotRequired[Sequence[float]]
    """
    Young's modulus at the coating's surface and at its lower face [pressure], positive.
    """


class Grid(TypedDict):
    """
    The mesh of the potential contact area, centred on the first point of touch.
    """

    beyond: NotRequired[Beyond]
    """
    What lies beyond the edge of the grid: "body" (contact that reaches the edge is refused) or "no body": one of the bodies
    ends there with a sharp edge, as a flat punch does, and contact may reach it (a rough specimen, a rectangular pad). Default: "body".
    """
    cells: Cells
    """
    Number of cells along x and y; a single number makes a line contact: plane strain across it, all loads per unit length.
    """
    datum: NotRequired[float]
    """
    Depth below the load of the point that approach and shift are relative to [length], in each body that has an elastic base; of a line
    contact, and of one that repeats along one axis. Default: the size of the grid across that axis.
    """
    periodic: NotRequired[Periodic]
    """
    Periodic in x and y (true), along one axis alone ("x" or "y"; along the other the half-spaces are infinite, and approach and shift are
    relative to a datum, as in a line contact), or not at all. Default: false, infinite half-spaces.
    """
    size: Size
    """
    Side lengths along x and y [length], or "auto": chosen so that the contact fits with a margin. A single number in a line contact.
    """


class Heights(TypedDict):
    """
    Topography, one height per cell or a scan that is resampled: `file` or `values`.
    """

    channel: NotRequired[str]
    """
    Channel of an instrument's file that has several, by its name. Default: its first with heights.
    """
    cut: NotRequired[Sequence[Sequence[float]]]
    """
    The part of the scan that is kept: from and to along x and along y [length], counted from its first corner; of a line scan one
    pair. Default: all of it.
    """
    detrend: NotRequired[Detrend]
    """
    What is subtracted: "none", the "mean", or the least-squares "plane". Default: "none".
    """
    file: NotRequired[str]
    """
    A .npy file, a text file with one row of numbers per line or one point x, y, height, or a file of an instrument (sur, x3p, plu, opd,
    al3d, ...; with `pip install 'fretting[instruments]'`). Relative paths start at the case file.
    """
    fill: NotRequired[Fill]
    """
    How points without a measurement are filled: "none" (they are refused), or "harmonic", the smoothest surface through the heights
    around each hole (Laplace's equation). Default: "none".
    """
    long_cutoff: NotRequired[float]
    """
    Waves longer than this are taken off: what a Gaussian filter of this length [length] passes is subtracted. Default: all are kept.
    """
    of: NotRequired[Of]
    """
    What the heights describe: a "surface" (the highest point touches first) or the "gap" (the lowest does). Default: "surface".
    """
    resample: NotRequired[Resample]
    """
    How measured points become heights of the cells: "none" (one point for every cell), or "linear", the mean over each cell of the
    surface that is linear between the points; the grid lies in the middle of the scan. Default: "none".
    """
    rows: NotRequired[Axis]
    """
    Axis along which the rows follow one another: "x" (index [i, j] = [x, y]) or "y" (rows of an image). Default: "x".
    """
    short_cutoff: NotRequired[float]
    """
    Waves shorter than this are taken off by a Gaussian filter, which passes half of a wave of this length [length] (ISO 16610-61).
    Default: all are kept.
    """
    size: NotRequired[ScanSize]
    """
    Side lengths of the scan along x and y [length], as many spacings of its points as points; one length of a line scan. Default: those
    that the file of an instrument states, or those of a list of points.
    """
    unit: NotRequired[float]
    """
    Length of one unit of the heights, in the case's unit of length. Default: 1.
    """
    values: NotRequired[Array]
    """
    The heights themselves, as rows of numbers, or in a line contact numbers; from Python an array.
    """


Interface: TypeAlias = NamedInterface | Springs


class Material(TypedDict):
    """
    An isotropic elastic material.
    """

    electrical_resistivity: NotRequired[float]
    """
    Electrical resistivity [resistance x length], positive; of all layers of a body and its substrate, or of none.
    """
    fatigue: NotRequired[FatigueConstants]
    """
    Constants for fatigue and fracture. Criteria without constants are skipped; there are no built-in materials.
    """
    poisson: float
    """
    Poisson's ratio, above -1, at most 0.5.
    """
    residual_stress: NotRequired[Residual]
    """
    Residual stress [pressure], as of a coating; below the last row of a table it stays as it is there.
    """
    thermal_conductivity: NotRequired[float]
    """
    Thermal conductivity [power/(length temperature)], positive; of all layers of a body and its substrate, or of none.
    """
    wear_coefficient: NotRequired[float]
    """
    Wear coefficient [1/pressure], zero or positive: wear depth = k times dissipated energy by area, or k times pressure times slip
    distance. Of all layers of a body and its substrate, or of none: then the body does not wear.
    """
    young: float
    """
    Young's modulus [pressure], positive.
    """


class Profile(TypedDict):
    """
    Shape of the undeformed gap, or of one body; the sum when several are given.
    """

    cone: NotRequired[Cone]
    """
    A blunt cone, slope r.
    """
    crowned_roller: NotRequired[CrownedRoller]
    """
    A roller of finite length with a crown along its axis.
    """
    cylinder: NotRequired[Cylinder]
    """
    A cylinder, as the parabola s^2 / (2 R) across its axis.
    """
    ellipsoid: NotRequired[Ellipsoid]
    """
    A paraboloid with two radii of curvature.
    """
    flat_punch: NotRequired[FlatPunch]
    """
    A flat circular punch.
    """
    formula: NotRequired[Formula]
    """
    A formula: an expression of x and y.
    """
    heights: NotRequired[Heights]
    """
    Measured or synthetic topography, one height per cell.
    """
    pyramid: NotRequired[Pyramid]
    """
    A pyramid, tip first: an indenter by its angle.
    """
    rectangular_punch: NotRequired[RectangularPunch]
    """
    A rectangular flat punch, with sharp or rounded edges.
    """
    rounded_punch: NotRequired[RoundedPunch]
    """
    A flat punch with a rounded edge: flat within b, (r - b)^2 / (2 R) beyond.
    """
    sphere: NotRequired[Sphere]
    """
    A sphere, as the paraboloid r^2 / (2 R).
    """
    sphero_cone: NotRequired[SpheroCone]
    """
    A cone with a spherical tip: r^2 / (2 R) up to the radius R slope, slope (r - R slope / 2) beyond.
    """
    wave: NotRequired[Wave]
    """
    A sinusoidal surface amplitude (1 - cos(2 pi x / Lx) cos(2 pi y / Ly)).
    """
    worn_sphere: NotRequired[WornSphere]
    """
    A worn or truncated sphere: flat within b, (r^2 - b^2) / (2 R) beyond.
    """


Roll: TypeAlias = Sequence[Component] | float | SteadyRoll


class Wear(TypedDict):
    """
    Wear of the surfaces: after each computed cycle the gap grows by the wear depth.
    """

    coefficient: NotRequired[float]
    """
    Wear coefficient k [1/pressure] of both bodies together: wear depth = k (pressure x slip distance) (Archard), or k (shear . slip)
    (energy). Instead: `wear_coefficient` of the layers, substrates and rigid bodies that wear.
    """
    debris: NotRequired[Debris]
    """
    Debris that stays between the surfaces. Default: all that wears off is gone; what a history starts with stays as it is.
    """
    every: NotRequired[int]
    """
    Maximum cycle jump: number of cycles one simulated cycle may represent. Default: 1; with `tolerance` 1000000.
    """
    largest_step: NotRequired[float]
    """
    Maximum wear depth per cycle jump, relative to the approach. Default: 0.01.
    """
    law: NotRequired[WearLaw]
    """
    Wear law. Default: "energy".
    """
    limit: NotRequired[float]
    """
    Stop when the wear depth reaches this value [length].
    """
    rim: NotRequired[Rim]
    """
    Another wear coefficient far from the rim of the contact. Default: the same everywhere.
    """
    thinning_tolerance: NotRequired[float]
    """
    Worn layers are thinner in the elastic response, too, which is found anew when the mean thickness of the layer at the surface has
    changed by this fraction. Needs `wear_coefficient` of the layers. Default: the response stays that of the unworn bodies.
    """
    through_coating_of: NotRequired[WornBody]
    """
    Stop when the outermost coating of this body is worn through.
    """
    tolerance: NotRequired[float]
    """
    Maximum relative error of the wear depth of a cycle jump, estimated from the change between computed cycles; jumps begin with
    one cycle and at most double. Default: not controlled.
    """


Along: TypeAlias = Sequence[Component] | float


class Coating(TypedDict):
    """
    A layer: uniform (`young`), or of a stiffness that changes with depth (`gradient`).
    """

    electrical_resistivity: NotRequired[float]
    """
    Electrical resistivity [resistance x length], positive; of all layers of a body and its substrate, or of none.
    """
    fatigue: NotRequired[FatigueConstants]
    """
    Constants for fatigue and fracture. Criteria without constants are skipped; there are no built-in materials.
    """
    gradient: NotRequired[Gradient]
    """
    Young's modulus over the depth; instead of `young`.
    """
    interface: NotRequired[Interface]
    """
    How it is bonded to what lies below it: "bonded" (default), "frictionless" (no shear passes; only without friction on the
    surface), or springs of no thickness, `{ normal_stiffness, shear_stiffness }`. Linear: an interface does not open.
    """
    poisson: float
    """
    Poisson's ratio, above -1, at most 0.5; the same at every depth.
    """
    residual_stress: NotRequired[Residual]
    """
    Residual stress [pressure], tension positive: the same along x and y, or one along each; or rows of depth below the upper
    face [length] and stress (one, or along x and y), linear between them. It adds to the stresses below, and to nothing else.
    """
    thermal_conductivity: NotRequired[float]
    """
    Thermal conductivity [power/(length temperature)], positive; of all layers of a body and its substrate, or of none.
    """
    thickness: float
    """
    Thickness [length], positive.
    """
    wear_coefficient: NotRequired[float]
    """
    Wear coefficient [1/pressure], zero or positive: wear depth = k times dissipated energy by area, or k times pressure times slip
    distance. Of all layers of a body and its substrate, or of none: then the body does not wear.
    """
    young: NotRequired[float]
    """
    Young's modulus [pressure], positive; instead of a gradient.
    """


class Stage(TypedDict):
    """
    A stage of the loading history. Controls not named stay as they were.
    """

    actuator: NotRequired[Sequence[Component]]
    """
    Displacement of the actuator along x and y [length], the far end of the machine's spring ([rig]): shift + tangential force /
    stiffness; at the end, or the amplitude; or "held".
    """
    actuator_approach: NotRequired[float]
    """
    Normal displacement of the actuator [length]: approach + normal force / stiffness; at the end, or the amplitude.
    """
    approach: NotRequired[float]
    """
    Rigid approach [length]: at the end of the stage, or the amplitude.
    """
    bulk_stress: NotRequired[Along]
    """
    Bulk stress of the lower body along x and y [pressure], remote stress of its substrate, tension positive: at the end, or the
    amplitude; or "held". A number in a line contact.
    """
    columns: NotRequired[dict[str, Any]]
    """
    Which column of the table holds which control, when they are named otherwise: `tangential_force_x = "Q [N]"`.
    """
    creepage: NotRequired[Sequence[Component]]
    """
    Creepage along x and y [-]: rigid displacement of the upper body by distance rolled, the same all along the stage, which has
    a `roll`; or "held".
    """
    cycles: NotRequired[int]
    """
    Number of cycles 0, +amplitude, -amplitude, 0 about the values before the stage.
    """
    dwell: NotRequired[float]
    """
    Fraction of a cycle for which a trapezoid holds each of its two extremes, below 0.5. Default: 0.25.
    """
    envelope: NotRequired[Sequence[float]]
    """
    Fraction of the amplitudes at the start and at the end of the cycles, linear between. Default: [1, 1].
    """
    friction: NotRequired[Coefficient]
    """
    Friction from this stage on: a coefficient, or one per cell (a file, or rows of numbers).
    """
    increments: Increments
    """
    Number of increments: per stage; with cycles, per cycle; with a table, per row. "auto": 16 per stage, 32 per cycle, 4 per
    row, each with adaptive sub-steps controlled by `solver.history_tolerance`.
    """
    mean_gap: NotRequired[float]
    """
    Mean gap between the surfaces [length], of periodic half-spaces, which have no approach: at the end of the stage, or the
    amplitude.
    """
    name: NotRequired[str]
    """
    A name for messages and tables.
    """
    normal_force: NotRequired[float]
    """
    Normal force [force], compression positive: at the end of the stage, or the amplitude of its cycles.
    """
    phase: NotRequired[Phase]
    """
    Phase lead of each control [degrees]; all reversal points are ends of increments. The cycle starts from the current value of the control.
    """
    ramp: NotRequired[Ramp]
    """
    How the controls run to their targets. Default: "linear".
    """
    roll: NotRequired[Roll]
    """
    Distance that the contact has rolled along both surfaces, along x and y [length]: at the end, or the amplitude; or "held". A
    number in a line contact. "steady": along `roll_direction`, in each increment until nothing changes any more.
    """
    roll_direction: NotRequired[AlongPhase]
    """
    Direction in which a contact with `roll = "steady"` rolls, along x and y, of any length; a number in a line contact. Default: [1, 0].
    """
    shift: NotRequired[Sequence[Component]]
    """
    Rigid tangential displacement of the upper body along x and y [length]: at the end, or the amplitude; or "held".
    """
    spin: NotRequired[float]
    """
    Spin [rad/length]: rotation of the upper body about the middle of the contact by distance rolled, the same all along the stage,
    which has a `roll`.
    """
    table: NotRequired[str]
    """
    A CSV file with the values of the controls, instead of naming them here; its columns are named like the controls.
    """
    tangential_force: NotRequired[Sequence[Component]]
    """
    Tangential force along x and y [force]: at the end, or the amplitude; "held" where this stage does not prescribe it.
    """
    tilt: NotRequired[Along]
    """
    Slope of the upper body along x and y [-], deeper towards positive x and y: at the end, or the amplitude; or "held". A
    number in a line contact. Default: 0, fixed.
    """
    tilt_moment: NotRequired[Along]
    """
    First moment of the pressure along x and y, `sum p x dA` [force x length]: at the end, or the amplitude; or "held". A number
    in a line contact.
    """
    twist: NotRequired[float]
    """
    Rotation of the upper body about z [rad]: at the end, or the amplitude.
    """
    twist_moment: NotRequired[float]
    """
    Moment about z [force x length]: at the end, or the amplitude.
    """
    until_steady: NotRequired[Steady]
    """
    Instead of a number of cycles: repeat until the cycle is steady.
    """
    upper_bulk_stress: NotRequired[Along]
    """
    The same of the upper body.
    """
    waveform: NotRequired[Waveform]
    """
    Shape of a cycle. Default: "triangle".
    """


class Body(TypedDict):
    """
    A body: `rigid = true`, or coatings (outermost first) on a `substrate` or on `base = "rigid"`.
    """

    base: NotRequired[Base]
    """
    What the coatings lie on when there is no substrate: "rigid".
    """
    coatings: NotRequired[Sequence[Coating]]
    """
    Coatings, outermost first.
    """
    electrical_resistivity: NotRequired[float]
    """
    Electrical resistivity [resistance x length], positive; of what is rigid: the body, or the base of its coatings.
    """
    hardness: NotRequired[float]
    """
    Hardness of this body's surface [pressure]: the contact pressure does not exceed that of the softer surface, which yields there and keeps
    the plastic depth (elastic - perfectly plastic; about three times the yield strength). Default: it does not yield.
    """
    profile: NotRequired[Profile]
    """
    Shape of this body's surface: its distance from the plane of first touch.
    """
    rigid: NotRequired[bool]
    """
    A body that does not deform.
    """
    substrate: NotRequired[Material]
    """
    The elastic half-space under the coatings.
    """
    thermal_conductivity: NotRequired[float]
    """
    Thermal conductivity [power/(length temperature)], positive; of what is rigid: the body, or the base of its coatings.
    """
    wear_coefficient: NotRequired[float]
    """
    Wear coefficient [1/pressure], zero or positive, of a rigid body.
    """


class Case(TypedDict):
    """
    A fretting contact: bodies, first gap, friction, and a loading history. Any consistent system of units.
    """

    friction: NotRequired[Friction]
    """
    Dry friction. Default: frictionless.
    """
    grid: Grid
    """
    The mesh of the potential contact area.
    """
    kinematics: NotRequired[Kinematics]
    """
    How the surfaces move against each other. Default: by displacements that are small against the contact.
    """
    load: Sequence[Stage]
    """
    Stages of the loading history, in order.
    """
    lower: Body
    """
    The body below; z points into it.
    """
    output: NotRequired[Output]
    """
    What is written to the results.
    """
    profile: NotRequired[Profile]
    """
    Undeformed gap: zero at first touch. The bodies' own profiles are added.
    """
    rig: NotRequired[Rig]
    """
    The machine between the upper body and what is driven. Default: rigid.
    """
    solver: NotRequired[Solver]
    """
    Accuracy of the solution.
    """
    stress: NotRequired[Stress]
    """
    Subsurface stresses, evaluated from the kept tractions after the run.
    """
    thermal: NotRequired[Thermal]
    """
    Temperature rise of the surfaces by friction, evaluated from the kept fields after the run.
    """
    title: NotRequired[str]
    """
    A title for tables and figures.
    """
    units: NotRequired[Units]
    """
    Units of the numbers in the case, which then stand on axes and in attributes. Default: none, any consistent system of units.
    """
    upper: Body
    """
    The body that moves.
    """
    wear: NotRequired[Wear]
    """
    Wear of the surfaces. Default: no wear.
    """
