"""The result of a run."""

import json
import operator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, Self

import numpy as np
import numpy.typing as npt

from fretting import _core, _dataset, plot
from fretting._arrays import Reals
from fretting._meaning import FIELD_NAMES, FieldName
from fretting.cycles import Columns, columns
from fretting.errors import Fact

if TYPE_CHECKING:
    import xarray
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

class Steps(dict[str, npt.NDArray[Any]]):
    """The numbers of every increment by name; an unknown name raises a KeyError that lists the known ones."""

    def __missing__(self, name: object) -> npt.NDArray[Any]:
        """Refuse a name."""
        if name in FIELD_NAMES:
            raise KeyError(f"{name!r} is a field, a number a cell: history.field({name!r}, step) has it")
        raise KeyError(
            f"steps has no {name!r}; it has: {', '.join(self)}; fields (history.field): {', '.join(FIELD_NAMES)}"
        )


class _Kept(Protocol):
    """Where the fields come from: the compiled module, or a copy that went through another process."""

    def kept_steps(self) -> list[int]: ...
    def kept_fields(self, increment: int) -> list[str]: ...
    def field(self, name: str, increment: int) -> npt.NDArray[Any]: ...


class _Copied:
    """Fields as plain arrays."""

    def __init__(self, fields: dict[int, dict[str, npt.NDArray[Any]]]) -> None:
        self.fields = fields

    def kept_steps(self) -> list[int]:
        return list(self.fields)

    def kept_fields(self, increment: int) -> list[str]:
        return list(self.fields.get(increment, {}))

    def field(self, name: str, increment: int) -> npt.NDArray[Any]:
        return self.fields[increment][name].copy()


class History:
    """All of a run: numbers of every increment, fields of those that were kept.

    Values are in the units of the case. Fields have shape (nx, ny), index ``[i, j]`` at ``(x[i], y[j])``; of a line contact
    (``cells`` a single number) shape (nx,), and forces, areas and energies are those of a unit of its length.

    Attributes
    ----------
    steps : dict of str to ndarray
        One entry per increment: ``normal_force``, ``approach``, ``tangential_force_x``, ``tangential_force_y``,
        ``shift_x``, ``shift_y``, ``twist_moment``, ``twist``, ``max_pressure``, ``max_shear``, ``contact_area``,
        ``stick_area``, ``dissipated_energy``, ``worn_volume`` (both since the start, over all cycles that computed ones
        stand for), ``max_worn_depth``, ``residual``, ``wall_s`` (float); ``increment``, ``stage``, ``contact_cells``, ``stick_cells``, ``convolutions``, ``preconditioner_passes``, ``outer_iterations``, ``parts``
        (int); ``full_grid_convolutions`` (float); ``regime`` (str).
    x, y : ndarray
        Coordinates of the cell centres [length], shapes (nx,) and (ny,); of a line contact `y` is one zero.
    stages : list of str
        Names of the stages.
    cycles : dict of str to ndarray
        One entry per cycle of the stages that have cycles; ``stage``, ``cycle``, ``first_increment``,
        ``last_increment``, ``stands_for``, ``last_cycle`` (int); ``dissipated_energy`` (of this one cycle),
        ``total_dissipated_energy`` (since the start), ``direction``, ``force_amplitude``,
        ``displacement_amplitude``, ``opening``, ``energy_ratio``, ``sliding_ratio``, ``stiffness``, ``closure``,
        ``worn_volume`` (since the start), ``max_worn_depth`` (float, NaN where a cycle has none); ``steady`` (bool); ``drive``,
        ``regime`` (str).
    running_conditions : list of str or None
        ``"partial"``, ``"mixed"`` or ``"gross"`` for each stage; None for one without cycles.
    worn_through : dict or None
        ``increment``, ``stage``, ``cycles``, ``cell``, ``place`` of the first place worn to the limit.
    status : str
        ``"solved"``; of a history that ends early ``"interrupted"``, ``"failed"``, ``"refused"`` (the contact has grown
        to the edge of its grid, or slides away), or ``"running"`` (still, or killed).
    message : str or None
        Why it ends early.
    warnings : list of dict
        What about these numbers may mislead: ``name`` (stable, such as ``"few_cells"``), ``value``, ``bound``, ``stage``,
        ``message``, ``help``. Empty where nothing does. :func:`run` also passes them to Python's ``warnings``.

    Notes
    -----
    Can be pickled, and so be sent between processes.
    """

    steps: dict[str, npt.NDArray[Any]]
    x: Reals
    y: Reals
    stages: list[str]
    cycles: Columns
    running_conditions: list[str | None]
    worn_through: dict[str, Any] | None
    status: str
    message: str | None
    warnings: list[Fact]

    _folder: Path | None
    _kept: _Kept
    _bodies: str
    _residual_stress: str
    _spacing: tuple[float, float]
    _periodic: bool

    def __init__(self, answer: _core.History) -> None:
        self._kept = answer
        self.steps = Steps((name, np.asarray(column)) for name, column in answer.steps().items())
        self.x = answer.centres(0)
        self.y = answer.centres(1)
        self.stages = answer.stages()
        self._bodies = answer.bodies()
        self._residual_stress = answer.residual_stress()
        dx, dy = answer.spacing()
        self._spacing = (dx, dy)
        self._periodic = answer.periodic()
        self.cycles = columns(json.loads(answer.cycles()))
        self.running_conditions = json.loads(answer.running_conditions())
        self.worn_through = json.loads(answer.worn_through())
        self.status = "solved"
        self.message = None
        self._folder = None
        self.warnings = json.loads(answer.warnings())

    def __getstate__(self) -> dict[str, Any]:
        """Everything as plain arrays."""
        kept = {
            increment: {name: self._kept.field(name, increment) for name in self._kept.kept_fields(increment)}
            for increment in self.kept_steps
        }
        return {**self.__dict__, "_kept": _Copied(kept), "_folder": None}

    def __copy__(self) -> Self:
        """Return a history that shares what this one holds."""
        twin = type(self).__new__(type(self))
        twin.__dict__.update(self.__dict__)
        return twin

    def __len__(self) -> int:
        """Return the number of increments."""
        return len(self.steps["increment"])

    @property
    def finished(self) -> bool:
        """Whether this is the whole history of its case."""
        return self.status == "solved"

    @property
    def is_line(self) -> bool:
        """Whether it is a line contact: the same all along y."""
        return len(self.y) == 1

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape (nx, ny) of the fields; (nx,) of a line contact."""
        return (len(self.x),) if self.is_line else (len(self.x), len(self.y))

    @property
    def kept_steps(self) -> list[int]:
        """Increments whose fields are kept, ascending."""
        return self._kept.kept_steps()

    def field(self, name: FieldName, step: int = -1) -> npt.NDArray[Any]:
        """Return a field of an increment.

        Parameters
        ----------
        name : {"pressure", "shear_x", "shear_y", "slip_x", "slip_y", "gap", "zone", "worn_depth"}
            ``slip_x``, ``slip_y``: relative slip since the start of the history, signed (the sum of the slip increments, not the
            slip distance); ``zone``: 0 open, 1 stick, 2 slip.
        step : int
            Number of the increment in the whole history, from 0; negative from the end.

        Returns
        -------
        ndarray
            Shape (nx, ny), of a line contact (nx,); float64 [pressure or length], ``zone`` uint8. The caller's own copy.

        Raises
        ------
        KeyError
            When the field is not kept; the message lists what is. ``[output]`` of the case says what to keep.
        IndexError
            When there is no such increment.
        TypeError
            When `step` is no whole number.
        """
        if name not in FIELD_NAMES:
            raise KeyError(f"no field is called {name!r}; fields are: {', '.join(FIELD_NAMES)}")
        step = _whole("step", step)
        count = len(self)
        if not -count <= step < count:
            raise IndexError(f"step {step}: the history has {count} increments")
        increment = step % count
        kept = self._kept.kept_fields(increment)
        if not kept:
            raise KeyError(
                f"no fields of increment {increment} are kept; kept are those of {_listed(self.kept_steps)} "
                "([output] every = ... keeps more)"
            )
        if name not in kept:
            raise KeyError(f"{name} is not kept; kept are: {', '.join(kept)} ([output] fields = [...] keeps more)")
        return self._kept.field(name, increment).reshape(self.shape)

    def to_xarray(self, steps: Literal["all", "kept"] = "all") -> "xarray.Dataset":
        """Return everything as a Dataset: numbers of the increments and cycles, fields of the kept increments.

        Fields have the dimensions ``(..., y, x)``, so that ``dataset.pressure.isel(kept_step=-1).plot()`` draws x to the
        right; :meth:`field` has the shape (nx, ny). ``zone`` has the attributes ``flag_values`` and ``flag_meanings`` of
        the CF conventions.

        Parameters
        ----------
        steps : {"all", "kept"}
            ``"all"``: numbers of all increments along ``step``, fields along ``kept_step``; both are numbers of
            increments. ``"kept"``: numbers and fields of the kept increments alone, all along ``step``.

        Returns
        -------
        xarray.Dataset
            Stages stand beside ``step`` as ``stage`` and ``stage_name``. Cycles lie along ``cycle`` (from 0 over the whole
            history) as ``cycle_energy_ratio`` and so on, beside ``cycle_number`` (in its stage, from 1), ``cycle_stage``
            and ``cycle_stage_name``.

        Raises
        ------
        ImportError
            When xarray is not installed (``pip install fretting[xarray]``).
        """
        if steps not in ("all", "kept"):
            raise ValueError(f"steps = {steps!r}: must be 'all' or 'kept'")
        return _dataset.of_history(self, every=steps == "all")

    def plot_loop(
        self, along: plot.Motion | None = None, stage: int | str | None = None, axes: "Axes | None" = None
    ) -> "Axes":
        """Draw tangential force over shift, or moment over twist: see :func:`fretting.plot.loop`."""
        return plot.loop(self, along, stage, axes)

    def plot_section(
        self,
        fields: FieldName | tuple[FieldName, ...] = ("pressure", "shear_x"),
        step: int = -1,
        along: Literal["x", "y"] = "x",
        at: float = 0.0,
        axes: "Axes | None" = None,
    ) -> "Axes":
        """Draw fields along a line through the grid: see :func:`fretting.plot.section`."""
        return plot.section(self, fields, step, along, at, axes)

    def plot_field(self, name: FieldName = "pressure", step: int = -1, axes: "Axes | None" = None) -> "Axes":
        """Draw a field as a map: see :func:`fretting.plot.field`."""
        return plot.field(self, name, step, axes)

    def plot_zones(self, step: int = -1, axes: "Axes | None" = None) -> "Axes":
        """Draw where the contact sticks and slips: see :func:`fretting.plot.zones`."""
        return plot.zones(self, step, axes)

    def animate_loop(
        self, field: FieldName = "zone", along: plot.Motion | None = None, stage: int | str | None = None
    ) -> "FuncAnimation":
        """Animate the loop beside a field: see :func:`fretting.plot.animation`."""
        return plot.animation(self, field, along, stage)

    def _facts(self) -> list[tuple[str, str]]:
        """Return what a person wants to know first."""
        cells = "a line contact of " * self.is_line + " x ".join(map(str, self.shape))
        facts = [("stages", ", ".join(self.stages)), ("increments", str(len(self))), ("cells", cells)]
        if not self.finished:
            facts.append(("not the whole history", ": ".join(filter(None, (self.status, self.message)))))
        if not len(self):
            return facts
        last = {name: column[-1] for name, column in self.steps.items()}
        facts += [
            ("sliding condition at the end", last["regime"].replace("_", " ")),
            ("normal force", f"{last['normal_force']:.6g}"),
            ("max pressure", f"{last['max_pressure']:.6g}"),
            ("contact area", f"{last['contact_area']:.6g}"),
            ("dissipated energy", f"{last['dissipated_energy']:.6g}"),
            *(
                [("worn volume", f"{last['worn_volume']:.6g}"), ("max wear depth", f"{last['max_worn_depth']:.6g}")]
                if last["worn_volume"] > 0.0
                else []
            ),
            ("worst residual", f"{self.steps['residual'].max():.1e}"),
        ]
        done = self.cycles
        if len(done["cycle"]):
            ratio, regime = done["energy_ratio"][-1], done["regime"][-1]
            facts.append((f"last of {done['last_cycle'][-1]} cycles", f"{regime.replace('_', ' ')}, ratio {ratio:.3g}"))
        facts += [("warning", f"{fact['message']}; {fact['help']}") for fact in self.warnings]
        kept = self.kept_steps
        fields = ", ".join(self._kept.kept_fields(kept[-1])) if kept else "none"
        return [*facts, (f"fields of {len(kept)} increments", fields)]

    def __repr__(self) -> str:
        """Sizes, the last step, and what is kept."""
        cells = " x ".join(map(str, self.shape)) + " cells" + " of a line contact" * self.is_line
        head = f"History: {len(self)} increments, {cells}, stages: {', '.join(self.stages)}"
        return "\n".join([head, *(f"  {name}: {value}" for name, value in self._facts()[3:])])

    def _repr_html_(self) -> str:
        """Return the same as a table, for notebooks."""
        return plot.html_table("fretting.History", self._facts())


def _whole(name: str, number: object) -> int:
    """Return a number that counts as an int; a truth value, a text or a fraction does not count."""
    if isinstance(number, bool | np.bool_):
        raise TypeError(f"{name} = {number!r}: must be a whole number")
    try:
        return operator.index(number)  # type: ignore[arg-type]
    except TypeError:
        raise TypeError(f"{name} = {number!r}: must be a whole number") from None


def _listed(steps: list[int]) -> str:
    if not steps:
        return "no increment"
    if len(steps) <= 12:
        return ", ".join(map(str, steps))
    return f"{', '.join(map(str, steps[:6]))}, ..., {', '.join(map(str, steps[-3:]))} ({len(steps)} in all)"
