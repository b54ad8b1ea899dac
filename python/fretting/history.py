"""The result of a run."""

import json
import os
import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Self

import numpy as np
import numpy.typing as npt

from fretting import _core, _dataset, _notebook, differentiating, fatigue, heat, plot, stress
from fretting._arguments import checked, of_kind, text, whole
from fretting._arrays import Reals
from fretting._meaning import FIELD_NAMES, VECTORS, FieldName, VectorName
from fretting._table import Copied, Kept, Table, of_cycles
from fretting.errors import Fact, MissingFileError, UnreadableError

if TYPE_CHECKING:
    import xarray
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

    from fretting._explorer import Explorer
    from fretting.case_types import FatigueConstants


class History:
    """All of a run: numbers of every increment, fields of those that were kept.

    Values are in the units of the case. Fields have shape (nx, ny), index ``[i, j]`` at ``(x[i], y[j])``; of a line
    contact (``cells`` a single number) shape (nx,), and forces, areas and energies are those of a unit of its length.

    Attributes
    ----------
    increments : dict of str to ndarray
        One entry per increment: ``normal_force``, ``approach``, ``tangential_force_x``, ``tangential_force_y``,
        ``shift_x``, ``shift_y``, ``twist_moment``, ``twist``, ``max_pressure``, ``max_shear``, ``contact_area``,
        ``stick_area``, ``dissipated_energy``, ``worn_volume`` (both since the start, over all cycles that computed ones
        stand for), ``max_worn_depth``, ``residual``, ``wall_s`` (float); ``increment``, ``stage``, ``contact_cells``,
        ``stick_cells``, ``convolutions``, ``preconditioner_passes``, ``outer_iterations``, ``parts`` (int);
        ``full_grid_convolutions``, ``tilt_x``, ``tilt_y``, ``tilt_moment_x``, ``tilt_moment_y``, ``bulk_stress_x``,
        ``bulk_stress_y`` (of the lower body), ``upper_bulk_stress_x``, ``upper_bulk_stress_y``, ``bulk_work``,
        ``actuator_x``, ``actuator_y``, ``actuator_approach``, ``friction_coefficient`` (mean over the contact, weighted
        with the pressure), ``elastic_energy``, ``external_work``, ``wear_work``, ``unresolved_energy``, ``roll_x``,
        ``roll_y``, ``creepage_x``, ``creepage_y``, ``spin``, ``rolling_friction`` (the last four by
        distance rolled), ``debris_volume``, ``debris_outflow`` (since the start), ``max_debris``, ``mean_gap`` (NaN
        where surfaces do not repeat), ``yielded_area``, ``plastic_volume``, ``max_plastic_depth``, ``plastic_work``
        (of surfaces with a hardness) (float); ``regime`` (str).
    x, y : ndarray
        Coordinates of the cell centres [length], shapes (nx,) and (ny,); of a line contact `y` is one zero.
    stages : list of str
        Names of the stages.
    cycles : dict of str to ndarray
        One entry per cycle of the stages that have cycles; ``stage``, ``cycle``, ``first_increment``,
        ``last_increment``, ``stands_for``, ``last_cycle`` (int); ``dissipated_energy`` (of this one cycle),
        ``total_dissipated_energy`` (since the start), ``direction``, ``force_amplitude``,
        ``displacement_amplitude``, ``opening``, ``energy_ratio``, ``sliding_ratio``, ``stiffness``, ``closure``,
        ``worn_volume`` (since the start), ``max_worn_depth``, and of the loop at the actuator of a rig
        ``actuator_amplitude``, ``actuator_energy_ratio``, ``actuator_sliding_ratio``, ``actuator_stiffness``,
        ``friction_coefficient`` (mean), and where friction evolves ``friction_change``, ``jump_error``; of layers that
        wear ``lower_worn_depth``, ``upper_worn_depth``, ``compliance_spread``, ``wear_jump_error``, of debris
        ``debris_volume``, ``debris_outflow`` (float, NaN where a cycle has none); ``steady`` (bool); ``drive``,
        ``regime`` (str).
    running_conditions : list of str or None
        ``"partial"``, ``"mixed"`` or ``"gross"`` for each stage; None for one without cycles.
    worn_through : dict or None
        Where and when a coating was first worn through, or the surfaces worn to the limit: ``to`` (``"coating"`` or
        ``"limit"``), ``increment``, ``stage``, ``cycles``, ``cell``, ``place``. The history ends at the limit.
    worn_by_layer : dict or None
        Volumes lost by the layers of the ``lower`` and the ``upper`` body [length^3], from the surface down, the
        substrate last; None without ``wear_coefficient`` of layers.
    status : str
        ``"solved"``; of a history that ends early ``"interrupted"``, ``"failed"``, ``"refused"`` (the contact has grown
        to the edge of its grid, or slides away), or ``"running"`` (still, or killed).
    message : str or None
        Why it ends early.
    case : dict
        The case as it was given, to be run again or varied: ``fretting.run({**history.case, "solver": {...}})``.
    plan : dict
        The case as it was understood, every default filled in, with the grid and the automatic simplifications.
    version : str
        Version of the program that solved it.
    error_bars : dict or None
        Value and error bar of every quantity of interest at the end of each stage, where ``estimate_error`` asked for
        them.
    warnings : list of dict
        What about these numbers may mislead: ``name`` (stable, such as ``"few_cells"``), ``value``, ``bound``,
        ``stage``, ``message``, ``help``. Empty where nothing does. :func:`run` also passes them to Python's
        ``warnings``.

    Notes
    -----
    Can be pickled, and so be sent between processes.
    """

    increments: dict[str, npt.NDArray[Any]]
    x: Reals
    y: Reals
    stages: list[str]
    cycles: dict[str, npt.NDArray[Any]]
    running_conditions: list[str | None]
    worn_through: dict[str, Any] | None
    worn_by_layer: dict[str, list[float]] | None
    status: str
    message: str | None
    warnings: list[Fact]
    case: dict[str, Any]
    plan: dict[str, Any]
    version: str
    error_bars: dict[str, Any] | None

    _folder: Path | None
    _kept: Kept
    _continues = False  # starts from the end of another history

    def __init__(self, answer: _core.History, case: dict[str, Any]) -> None:
        self._take(of_kind("answer", answer, _core.History), json.loads(answer.record()))
        self.case = of_kind("case", case, dict)
        bars = json.loads(answer.error_bars() or "null")
        self.error_bars = None if bars is None or "missing" in bars else bars
        self._folder = None

    def _take(self, answer: _core.History | _core.StoredRun, record: dict[str, Any]) -> None:
        """Take what a run in memory and one in a folder have in common."""
        self._kept = answer
        self.plan = record["plan"]
        self.version = record["version"]
        self.status, self.message = record["status"], record.get("message")
        self.warnings = record["warnings"]
        self.worn_through, self.worn_by_layer = record.get("worn_through"), record.get("worn_by_layer")
        self.increments = Table((name, np.asarray(column)) for name, column in answer.increments().items())
        self.x, self.y = answer.centres(0), answer.centres(1)
        self.stages = [stage["name"] for stage in self.plan["case"]["stages"]]
        self.cycles = of_cycles(json.loads(answer.cycles()))
        self.running_conditions = json.loads(answer.running_conditions())

    def __getstate__(self) -> dict[str, Any]:
        """Everything as plain arrays."""
        kept = {
            increment: {name: self._kept.field(name, increment) for name in self._kept.kept_fields(increment)}
            for increment in self.kept_increments
        }
        return {**self.__dict__, "_kept": Copied(kept), "_folder": None}

    def __copy__(self) -> Self:
        """Return a history that shares what this one holds."""
        twin = type(self).__new__(type(self))
        twin.__dict__.update(self.__dict__)
        return twin

    def __len__(self) -> int:
        """Return the number of increments."""
        return len(self.increments["increment"])

    @property
    def finished(self) -> bool:
        """Whether this is the whole history of its case."""
        return self.status == "solved"

    @property
    def _units(self) -> dict[str, str]:
        """The declared units, and whether loads are those of a unit of length."""
        return self.units | {"line": "loads per unit length"} if self.units and len(self.y) == 1 else self.units

    @property
    def units(self) -> dict[str, str]:
        """Units of ``length``, ``force`` and ``pressure`` that ``[units]`` of the case declares; empty without."""
        return dict(self.plan["case"].get("units") or {})

    @property
    def is_line(self) -> bool:
        """Whether it is a line contact: the same all along y."""
        return len(self.y) == 1

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape (nx, ny) of the fields; (nx,) of a line contact."""
        return (len(self.x),) if self.is_line else (len(self.x), len(self.y))

    @property
    def kept_increments(self) -> list[int]:
        """Increments whose fields are kept, ascending."""
        return self._kept.kept_increments()

    def field(self, name: FieldName | VectorName, increment: int = -1) -> npt.NDArray[Any]:
        """Return a field of an increment.

        Parameters
        ----------
        name : str
            ``"pressure"``, ``"shear_x"``, ``"shear_y"``, ``"slip_x"``, ``"slip_y"``, ``"gap"``, ``"zone"``,
            ``"worn_depth"``, ``"lower_worn_depth"``, ``"upper_worn_depth"``, ``"debris"``,
            ``"plastic_depth"``, ``"friction_work"``, ``"friction"``, ``"shear"`` or ``"slip"``.
            ``lower_worn_depth``, ``upper_worn_depth``: of each body in its own frame, kept with ``worn_depth`` where
            ``kinematics.displacement = "finite"``; ``debris``: its thickness, of a case with ``wear.debris``;
            ``friction_work``: energy dissipated in the increment by area.
            ``slip_x``, ``slip_y``: relative slip since the start of the history, signed (the sum of the slip
            increments, not the slip distance); ``zone``: 0 open, 1 stick, 2 slip; ``shear``, ``slip``: both
            components, along the first axis.
        increment : int
            Number of the increment in the whole history, from 0; negative from the end.

        Returns
        -------
        ndarray
            Shape (nx, ny), of a line contact (nx,), of ``shear`` and ``slip`` with a 2 before; float64 [pressure or
            length], ``zone`` uint8. The caller's own copy.

        Raises
        ------
        KeyError
            When the field is not kept; the message lists what is. ``[output]`` of the case says what to keep.
        IndexError
            When there is no such increment.
        TypeError
            When `name` is no word or `increment` no whole number.
        """
        if text("name", name) in VECTORS:
            return np.stack([self.field(part, increment) for part in (f"{name}_x", f"{name}_y")])  # type: ignore[arg-type]
        if name not in FIELD_NAMES:
            raise KeyError(f"no field is called {name!r}; fields are: {', '.join((*FIELD_NAMES, *VECTORS))}")
        number = self._number(increment)
        kept = self._kept.kept_fields(number)
        if not kept:
            nearest = min(self.kept_increments, key=lambda other: abs(other - number), default=None)
            near = "" if nearest is None else f"; the nearest is {nearest}"
            raise KeyError(
                f"no fields of increment {number} are kept; kept are those of {_listed(self.kept_increments)}{near} "
                "([output] every = ... keeps more)"
            )
        if name not in kept:
            raise KeyError(f"{name} is not kept; kept are: {', '.join(kept)} ([output] fields = [...] keeps more)")
        return self._kept.field(name, number).reshape(self.shape)

    def _number(self, increment: int) -> int:
        """Return the number of an increment from 0."""
        increment = whole("increment", increment)
        count = len(self)
        if not -count <= increment < count:
            raise IndexError(f"increment {increment}: the history has {count} increments")
        return increment % count

    @checked
    def at(
        self,
        point: Literal["start", "end", "maximum", "minimum"] = "end",
        *,
        stage: int | str | None = None,
        cycle: int | None = None,
    ) -> int:
        """Return the number of an increment by what happens there.

        Parameters
        ----------
        point : {"start", "end", "maximum", "minimum"}
            First or last increment of the stage or cycle, or where the tangential force (the torsional moment, of a
            torsional cycle) along its main axis is largest or smallest.
        stage : int or str, optional
            Number or name of a stage. Default: the whole history; with `cycle`, the last stage that has cycles.
        cycle : int, optional
            Computed cycle of the stage, from 0; negative from the end.

        Raises
        ------
        ValueError
            When no stage is called so, the point is none of these, or there is no such increment yet.
        IndexError
            When there is no such stage or cycle.

        Examples
        --------
        >>> history.plot_zones(history.at("maximum", stage="fretting", cycle=-1))  # doctest: +SKIP
        """
        number = None if stage is None else plot.stage_number(self, stage)
        column = self.increments["stage"]
        rows = np.arange(len(self)) if number is None else np.flatnonzero(column == number)
        if cycle is not None:
            in_cycles = self.cycles["stage"]
            if not len(in_cycles):
                raise ValueError("cycle: the history has no cycles")
            chosen = np.flatnonzero(in_cycles == (in_cycles[-1] if number is None else number))
            if not -len(chosen) <= whole("cycle", cycle) < len(chosen):
                raise IndexError(f"cycle {cycle}: the stage has {len(chosen)} computed cycles, counted from 0")
            one = chosen[cycle]
            rows = np.arange(self.cycles["first_increment"][one], self.cycles["last_increment"][one] + 1)
        if not len(rows):
            raise ValueError("no increment of that stage is solved")
        if point in ("start", "end"):
            return int(rows[0 if point == "start" else -1])
        forces = np.stack([self.increments[f"tangential_force_{axis}"][rows] for axis in "xy"])
        along = forces[np.ptp(forces, axis=1).argmax()]
        if not np.ptp(along) > 0.0:
            along = self.increments["twist_moment"][rows]
        return int(rows[along.argmax() if point == "maximum" else along.argmin()])

    @checked
    def to_xarray(self, *, increments: Literal["all", "kept"] = "all") -> "xarray.Dataset":
        """Return everything as a Dataset: numbers of the increments and cycles, fields of the kept increments.

        Fields have the dimensions ``(..., y, x)``, so that ``dataset.pressure.isel(kept_increment=-1).plot()`` draws x
        to the right; :meth:`field` has the shape (nx, ny). ``zone`` has the attributes ``flag_values`` and
        ``flag_meanings`` of the CF conventions. Variables have ``long_name`` and ``units``: those that ``[units]`` of
        the case declares, else the kind of quantity in brackets.

        Parameters
        ----------
        increments : {"all", "kept"}
            ``"all"``: numbers of all increments along ``increment``, fields along ``kept_increment``; both are numbers
            of increments. ``"kept"``: numbers and fields of the kept increments alone, all along ``increment``.

        Returns
        -------
        xarray.Dataset
            Stages stand beside ``increment`` as ``stage`` and ``stage_name``. Cycles lie along ``cycle`` (from 0 over
            the whole history) as ``cycle_energy_ratio`` and so on, beside ``cycle_number`` (in its stage, from 1),
            ``cycle_stage`` and ``cycle_stage_name``.

        Raises
        ------
        ImportError
            When xarray is not installed (``pip install fretting[xarray]``).
        """
        return _dataset.of_history(self, every=increments == "all")

    @checked
    def save(self, folder: str | os.PathLike[str], *, replace: bool = False) -> Path:
        """Write the history into a folder, as ``fret run --out FOLDER`` would have done.

        :func:`open_results` opens it again.

        Parameters
        ----------
        folder : path
            Empty, or not there yet; or the folder of earlier results of the same case, which are replaced.
        replace : bool
            Replace the results of another case too. Files that are none of the program's are left alone.

        Returns
        -------
        Path
            The folder.

        Raises
        ------
        ValueError
            When the folder holds something else, or the history was pickled: it then has no solved states.
        UnreadableError
            When a file cannot be written; ``MissingFileError`` when the folder this history was opened from is gone.
        """
        place = Path(folder)
        if isinstance(self._kept, _core.History):
            early = None if self.finished else (self.status, self.message or "")
            self._kept.save(place, replace, early)
            return place
        if self._folder is None:
            raise ValueError(
                "save: a history that went through another process or a file holds no states; "
                "save it where it was solved"
            )
        if not self._folder.is_dir():
            way = "a history that was opened from a folder reads it when it is saved, and that folder is gone"
            raise MissingFileError(f"error: {self._folder}: no such folder\n  = help: {way}", str(self._folder))
        if place.exists() and (not place.is_dir() or any(place.iterdir())) and not replace:
            raise ValueError(f"{place}: holds something already\n  = help: choose another folder, or replace=True")
        try:
            if not (place.exists() and place.samefile(self._folder)):
                _core.clear_results(place)
                shutil.copytree(self._folder, place, dirs_exist_ok=True)
        except OSError as error:
            raise UnreadableError(f"error: {place}: {error.strerror or error}", str(place)) from None
        return place

    @checked
    def subsurface(
        self,
        depths: npt.ArrayLike,
        *,
        increment: int = -1,
        body: Literal["lower", "upper"] = "lower",
        displacement: bool = False,
        threads: int | None = None,
    ) -> "xarray.Dataset":
        """Return the subsurface stress of one body, and its displacements, from the kept tractions of an increment.

        Bulk stress and residual stress are included, layer by layer. Axes x and y of the contact, z into the body in
        question, from its own surface; tension is positive. Under the centres of the cells, exact for tractions that
        are uniform over each cell.

        Parameters
        ----------
        depths : array_like
            Depths under the surface [length], not negative, in or at the faces of the coatings where the base is rigid.
        increment : int
            Number of the increment, from 0; negative from the end. Its ``pressure`` must be kept, and ``shear`` if
            there is friction.
        body : {"lower", "upper"}
            The body.
        displacement : bool
            Also compute displacements, at depth 0 those of the surface; not of line contacts, nor where one axis alone
            is periodic. They are those of the tractions alone, without the strain of bulk and residual stress, and
            periodic ones without their mean. The relative displacement of the surfaces along z is the sum of both
            bodies', along x and y that of the lower less that of the upper body.
        threads : int, optional
            Worker threads. Default: all cores. The result is the same for any number.

        Returns
        -------
        xarray.Dataset
            ``xx``, ``yy``, ``zz``, ``xy``, ``xz``, ``yz``, ``von_mises`` [pressure] with the dimensions (depth, y, x),
            of a line contact (depth, x); ``principal`` with (order, depth, y, x), the largest first; `displacement`:
            ``displacement_x``, ``displacement_y``, ``displacement_z`` [length], z into the body. Beside ``depth``
            stands ``layer``: 0 in the outermost coating, the number of coatings in the substrate. A depth at an
            interface appears twice, first as seen from above, then from below.

        Raises
        ------
        ValueError
            When a depth is above the surface or in a rigid base, or the body is rigid.
        KeyError
            When the tractions of the increment were not kept.
        IndexError
            When there is no such increment.

        Examples
        --------
        >>> import fretting
        >>> history = fretting.run({
        ...     "grid": {"cells": [32, 32], "size": "auto"},
        ...     "upper": {"rigid": True},
        ...     "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
        ...     "profile": {"sphere": {"radius": 10e-3}},
        ...     "load": [{"normal_force": 10.0, "increments": 1}],
        ... })
        >>> dict(history.subsurface([0.0, 20e-6]).von_mises.sizes)
        {'depth': 2, 'y': 32, 'x': 32}
        """
        return stress.subsurface(self, depths, increment, body, displacement, threads)

    @checked
    def fatigue(
        self,
        depths: npt.ArrayLike,
        *,
        cycle: int = -1,
        body: Literal["lower", "upper"] = "lower",
        constants: "FatigueConstants | None" = None,
        threads: int | None = None,
    ) -> "xarray.Dataset":
        """Return fatigue parameters over a cycle, under all cells.

        Bulk stress and residual stress are included, layer by layer.

        Parameters
        ----------
        depths : array_like
            Depths under the surface of the body [length].
        cycle : int
            Computed cycle of the history, from 0; negative from the end. At least three of its increments, with the
            one it starts from, need their ``pressure``, ``shear`` and ``slip`` kept (``[output] every``).
        body : {"lower", "upper"}
            The body.
        constants : dict, optional
            Constants of fatigue for all layers, with the keys of a layer's ``fatigue`` in the case. Default: those of
            the case.
        threads : int, optional
            Worker threads. Default: all cores.

        Returns
        -------
        xarray.Dataset
            ``smith_watson_topper``, ``shakedown_strength``, and where all layers at the depths have their constants
            ``fatemi_socie``, ``crossland``, ``dang_van``, ``smith_watson_topper_cycles``, ``fatemi_socie_cycles``,
            with the dimensions (depth, y, x), of a line contact (depth, x), under the centres of the cells;
            ``ruiz_f1``, ``ruiz_f2`` at the surface, where 0 is among the depths.
            Over ``parameter``, what ``fret stress`` tells of the same depths: ``largest``, at the surface extrapolated
            to the rim of the contact, where cells miss the cusp of the tension, with ``largest_cycles``,
            ``largest_x``, ``largest_y``, ``largest_depth`` and the normal of the ``critical_plane``; beside it
            ``largest_cell`` and ``largest_cell_cycles`` of the cells at that depth; and with ``critical_distance``
            among the constants of the outermost layer and depths from 0 on ``point_method`` and ``line_method``, each
            with its ``_cycles``. NaN: not known. Formulas and sources: *Subsurface stress and fatigue* of the site.

        Raises
        ------
        ValueError
            When a depth or a constant is out of its range, the body is rigid, or too few increments of the cycle are
            kept.
        KeyError
            When its increments were kept without what is needed.
        IndexError
            When there is no such cycle.
        """
        return fatigue.fatigue(self, depths, whole("cycle", cycle), body, constants, threads)

    @checked
    def crack(
        self,
        *,
        cycle: int = -1,
        body: Literal["lower", "upper"] = "lower",
        constants: "FatigueConstants | None" = None,
        threads: int | None = None,
    ) -> "xarray.Dataset":
        """Return the course of a short crack through a cycle.

        It starts where the Smith-Watson-Topper parameter of the surface is largest and lies in its critical plane.
        Stress intensities by the weight function of an edge crack in one material, from the stresses below the contact.

        Parameters
        ----------
        cycle : int
            Computed cycle of the history, from 0; negative from the end. Three of its increments need their fields
            kept.
        body : {"lower", "upper"}
            The body.
        constants : dict, optional
            Constants of fatigue with the key ``crack``, as of a layer in the case. Default: those of the case.
        threads : int, optional
            Worker threads. Default: all cores.

        Returns
        -------
        xarray.Dataset
            ``k1_max``, ``k1_range``, ``k2_range``, ``threshold`` [pressure x sqrt(length)], and with constants of
            growth ``cycles``, over ``length``. Attributes: ``fate`` ("does_not_grow", "stops", "grows", "fractures";
            "none" with a ``reason``), ``x``, ``y``, ``angle`` from the normal of the surface [degrees] ``towards`` a
            horizontal direction, ``length`` and ``cycles`` at its end: inf of a crack that does not grow or stops, NaN
            without constants of growth. Without a crack they are NaN.

        Raises
        ------
        ValueError
            When there are no constants of cracks, one is out of its range, the body is rigid, or too few increments
            are kept.
        KeyError
            When its increments were kept without what is needed.
        IndexError
            When there is no such cycle.
        """
        return fatigue.crack(self, whole("cycle", cycle), body, constants, threads)

    @checked
    def coating_fracture(
        self,
        *,
        cycle: int = -1,
        body: Literal["lower", "upper"] = "lower",
        constants: "FatigueConstants | None" = None,
        threads: int | None = None,
    ) -> "xarray.Dataset":
        """Return the energy that channelling and delamination of the outermost coating release in a cycle.

        From the largest tension and the largest compression of the cycle, averaged over the thickness of the coating,
        of contact, bulk and residual stress; of a film under stress that is uniform over several thicknesses.

        Parameters
        ----------
        cycle : int
            Computed cycle of the history, from 0; negative from the end. Three of its increments need their fields
            kept.
        body : {"lower", "upper"}
            The body.
        constants : dict, optional
            Constants of fatigue of the coating, as in the case (``fracture_energy``, ``interface_energy``,
            ``channelling_factor``, ``interface_phase``). Default: those of the case.
        threads : int, optional
            Worker threads. Default: all cores.

        Returns
        -------
        xarray.Dataset
            Over ``sense`` ("tension", "compression", where there is such a stress): ``stress`` and its ``direction``
            to the x axis, the energies ``channelling`` (0 in compression) and ``delamination`` [force/length], its
            ``phase`` [degrees], ``x``, ``y`` and ``increment``, and where the constants have the energies of fracture
            ``channelling_factor_of_safety`` and ``delamination_factor_of_safety``, factors on the stress. NaN: the
            case does not name a constant that it needs.

        Raises
        ------
        ValueError
            When the body has no bonded coating on something that deforms, or too few increments are kept.
        KeyError
            When its increments were kept without what is needed.
        IndexError
            When there is no such cycle.
        """
        return fatigue.coating_fracture(self, whole("cycle", cycle), body, constants, threads)

    @checked
    def temperature(
        self, *, cycle: int = -1, frequency: float | None = None, threads: int | None = None
    ) -> "xarray.Dataset":
        """Return the steady temperature rise of both surfaces by the friction of a cycle.

        The dissipated energy of every cell times the frequency is the heat; it is shared so that both surfaces have
        one temperature in the contact, with the conductivities of all layers (``thermal_conductivity`` in the case). A
        body without takes no heat.

        Parameters
        ----------
        cycle : int
            Computed cycle of the history, from 0; negative from the end. Pressure, shear and slip of all its
            increments must be kept (``[output] every = 1``).
        frequency : float, optional
            Cycles per unit of time. Default: ``[thermal] frequency`` of the case.
        threads : int, optional
            Worker threads. Default: all cores. The result is the same for any number.

        Returns
        -------
        xarray.Dataset
            ``heat``, ``heat_into_lower`` [power/area], ``rise_lower``, ``rise_upper`` [temperature, above the bodies
            far from the contact] with the dimensions (y, x). The attribute ``kept_fields_account_for`` is the
            dissipated energy of the fields over that of the run, to which they are scaled.

        Raises
        ------
        ValueError
            When neither body conducts heat, the case is periodic or a line contact, or there is no frequency.
        KeyError
            When fields of an increment of the cycle were not kept.
        IndexError
            When there is no such cycle.
        """
        return heat.temperature(self, whole("cycle", cycle), frequency, threads)

    @checked
    def contact_resistance(
        self,
        *,
        increment: int = -1,
        kind: Literal["electrical", "thermal"] = "electrical",
        threads: int | None = None,
    ) -> float:
        """Return the resistance of the contact, between points far inside both bodies.

        Of all cells in contact, with all layers; both bodies need ``electrical_resistivity``, or
        ``thermal_conductivity``. In a periodic case what the contact of one period adds to that of bodies in full
        contact.

        Parameters
        ----------
        increment : int
            Number of the increment, from 0; negative from the end. Its ``pressure`` must be kept.
        kind : {"electrical", "thermal"}
            Resistance to current [that of the resistivities over length] or to heat [temperature/power].
        threads : int, optional
            Worker threads. Default: all cores. The result is the same for any number.

        Raises
        ------
        ValueError
            When a body does not conduct, the bodies are apart, or it is a line contact.
        KeyError
            When the pressure of the increment was not kept.
        IndexError
            When there is no such increment.

        Examples
        --------
        >>> import fretting
        >>> copper = {"young": 120e9, "poisson": 0.34, "electrical_resistivity": 1.7e-8}
        >>> history = fretting.run({
        ...     "grid": {"cells": [64, 64], "size": "auto"},
        ...     "upper": {"substrate": copper},
        ...     "lower": {"substrate": copper},
        ...     "profile": {"sphere": {"radius": 10e-3}},
        ...     "load": [{"normal_force": 10.0, "increments": 1}],
        ... })
        >>> print(f"{1e3 * history.contact_resistance():.2f} mOhm")
        0.08 mOhm
        """
        return heat.contact_resistance(self, increment, kind, threads)

    def vjp(
        self,
        weights: Mapping[str, float | npt.NDArray[np.float64] | npt.NDArray[np.bool_]],
        *,
        by: str | Iterable[str] = (),
        threads: int | None = None,
    ) -> dict[str, float]:
        """Pull weights of results and fields back to the numbers of the case, see :func:`fretting.vjp`.

        The history is run once more: the states of all its increments are needed.

        Parameters
        ----------
        weights : mapping of str to float or array
            The weight of every result, or of every cell of a field.
        by : str or iterable of str
            Numbers of the case. Default: all there are.
        threads : int, optional
            Worker threads. Default: all cores.

        Returns
        -------
        dict of str to float
            The derivative of the weighted sum by each number, by path.

        Raises
        ------
        ValueError
            When the case is of a kind that is not covered, or a result or a number not one of it; when this history
            started from another one.
        RunError
            When the linear equations of an increment are not solved.
        """
        if self._continues:
            raise ValueError("vjp: this history started from another one; give all stages in one case")
        return differentiating.vjp(self.case, weights, by=by, threads=threads)

    def plot_loop(
        self,
        *,
        along: plot.Motion | None = None,
        stage: int | str | None = None,
        ax: "Axes | None" = None,
        **line: Any,
    ) -> "Axes":
        """Draw force over displacement, or moment over twist; arguments and answer of :func:`fretting.plot.loop`."""
        return plot.loop(self, along=along, stage=stage, ax=ax, **line)

    def plot_loop_stack(
        self,
        *,
        along: plot.Motion | None = None,
        stage: int | str | None = None,
        most: int = 40,
        cmap: str = "viridis",
        ax: "Axes | None" = None,
        **line: Any,
    ) -> "Axes":
        """Draw the loops over the cycles; arguments and answer of :func:`fretting.plot.loop_stack`."""
        return plot.loop_stack(self, along=along, stage=stage, most=most, cmap=cmap, ax=ax, **line)

    def plot_section(
        self,
        fields: FieldName | VectorName | tuple[FieldName | VectorName, ...] = ("pressure", "shear_x"),
        increment: int = -1,
        *,
        along: Literal["x", "y"] = "x",
        at: float = 0.0,
        ax: "Axes | None" = None,
        **line: Any,
    ) -> "Axes":
        """Draw fields along a line through the grid; arguments and answer of :func:`fretting.plot.section`."""
        return plot.section(self, fields, increment, along=along, at=at, ax=ax, **line)

    def plot_field(
        self,
        name: FieldName = "pressure",
        increment: int = -1,
        *,
        ax: "Axes | None" = None,
        **image: Any,
    ) -> "Axes":
        """Draw a field as a map; arguments and answer of :func:`fretting.plot.field`."""
        return plot.field(self, name, increment, ax=ax, **image)

    def plot_zones(
        self,
        increment: int = -1,
        *,
        ax: "Axes | None" = None,
        **image: Any,
    ) -> "Axes":
        """Draw where the contact sticks and slips; arguments and answer of :func:`fretting.plot.zones`."""
        return plot.zones(self, increment, ax=ax, **image)

    def animate_loop(
        self, field: FieldName = "zone", *, along: plot.Motion | None = None, stage: int | str | None = None
    ) -> "FuncAnimation":
        """Animate the loop beside a field; arguments and answer of :func:`fretting.plot.animation`."""
        return plot.animation(self, field, along=along, stage=stage)

    @checked
    def explore(self, field: FieldName | None = None, *, along: plot.Motion | None = None) -> "Explorer":
        """Look through the history in a notebook: loop and field of an increment, with a slider over those kept.

        Nothing is solved again; ``fret explore`` has sliders for the numbers of the case. Needs ``fretting[notebook]``.

        Parameters
        ----------
        field : str, optional
            What is shown first. Default: ``"zone"``, of line contacts the first field kept.
        along : {"x", "y", "twist"}, optional
            Which motion. Default: the one whose loop is the largest, pressing where nothing else moves.

        Returns
        -------
        Explorer
            A widget of Jupyter; ``place`` is where its slider is, among ``kept_increments``, ``field`` what it shows:
            both can be set.

        Raises
        ------
        ValueError
            When no fields are kept (``[output] every`` of the case), or not this one.
        ImportError
            When anywidget is not installed.

        Examples
        --------
        >>> history.explore()  # doctest: +SKIP
        """
        try:
            from fretting._explorer import Explorer
        except ImportError as error:
            raise ImportError("a widget needs anywidget: pip install 'fretting[notebook]'") from error
        return Explorer(self, field, along=along)

    def __repr__(self) -> str:
        """Sizes, the last increment, and what is kept."""
        cells = " x ".join(map(str, self.shape)) + " cells" + " of a line contact" * self.is_line
        head = f"History: {len(self)} increments, {cells}, stages: {', '.join(self.stages)}"
        return "\n".join([head, *(f"  {name}: {value}" for name, value in _notebook.facts(self)[3:])])

    def _repr_html_(self) -> str:
        """Return the same as a table, for notebooks."""
        return _notebook.html_table("fretting.History", _notebook.facts(self))


def _listed(numbers: list[int]) -> str:
    if not numbers:
        return "no increment"
    if len(numbers) <= 12:
        return ", ".join(map(str, numbers))
    return f"{', '.join(map(str, numbers[:6]))}, ..., {', '.join(map(str, numbers[-3:]))} ({len(numbers)} in all)"
