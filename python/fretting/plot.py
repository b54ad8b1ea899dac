"""Figures of histories and sweeps; needs matplotlib (``pip install fretting[plot]``).

Every function draws into `ax`, or into a figure of its own when none is given, and returns the axes; further keywords
go to the artist (``color=``, ``label=``, ``cmap=``). Units are those
of the case: labels say what ``[units]`` of the case declares, else length, force, pressure.

An argument of another kind is a ``TypeError``, as is a keyword that matplotlib does not know; a value out of its range
a ``ValueError``; a field that is unknown or not kept a ``KeyError``; an increment or a stage that is not there an
``IndexError``.
"""

from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from fretting._arguments import checked, matplotlib, texts
from fretting._arguments import variable as _variable
from fretting._arrays import Reals
from fretting._bands import band, band_map, loop_band
from fretting._meaning import VECTORS, ZONE_NAMES, in_units
from fretting._meaning import label as _label
from fretting._meaning import unit as _unit
from fretting._style import MIXED, OPEN, PARTIAL, SLIP, STICK, VERMILION, scale, style

if TYPE_CHECKING:
    import xarray
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage

    from fretting.history import History

__all__ = [
    "animation",
    "band",
    "band_map",
    "field",
    "loop",
    "loop_band",
    "loop_stack",
    "regime_map",
    "scale",
    "section",
    "style",
    "zones",
]

Direction = Literal["x", "y"]
Motion = Literal["x", "y", "twist"]

ZONES = tuple(zip(ZONE_NAMES, (OPEN, STICK, SLIP), strict=True))
"""Names and colours of the zones 0, 1, 2."""
REGIMES = (
    ("apart", OPEN), ("frictionless", "#d9d9d9"), ("full_stick", STICK), ("partial_slip", PARTIAL),
    ("mixed", MIXED), ("gross_slip", SLIP),
)  # fmt: skip
"""Names and colours of the sliding conditions, from less to more slip."""


@checked
def loop(
    history: "History",
    *,
    along: Motion | None = None,
    stage: int | str | None = None,
    ax: "Axes | None" = None,
    **line: Any,
) -> "Axes":
    """Draw tangential force over relative displacement, or moment over twist.

    Parameters
    ----------
    history : History
        A history.
    along : {"x", "y", "twist"}, optional
        Which motion. Default: the one whose loop is the largest, range of force times range of motion.
    stage : int or str, optional
        Number or name of a stage. Without: from the first stage in cycles on, or everything when there is none.
    ax : matplotlib Axes, optional
        Where to draw.
    **line
        Keywords of matplotlib for the line, such as ``color`` or ``label``.

    Returns
    -------
    matplotlib Axes
    """
    motion, force = _loop_columns(history, along, stage)
    rows = _loop_rows(history, stage)
    axes = _own_axes(ax)
    axes.plot(history.increments[motion][rows], history.increments[force][rows], **{"lw": 1.4, **_long_names(line)})
    axes.axhline(0.0, color="0.8", lw=0.8, zorder=0)
    axes.axvline(0.0, color="0.8", lw=0.8, zorder=0)
    axes.set_xlabel(_loop_label(history, motion), loc="left")
    axes.set_ylabel(_loop_label(history, force))
    _powers_of_ten(axes)
    return axes


@checked
def loop_stack(
    history: "History",
    *,
    along: Motion | None = None,
    stage: int | str | None = None,
    most: int = 40,
    cmap: str = "viridis",
    ax: "Axes | None" = None,
    **line: Any,
) -> "Axes":
    """Draw the fretting log: the loops of force and displacement over the cycles.

    Each loop stands at the number of its cycle, in axes of three dimensions.

    Parameters
    ----------
    history : History
        A history with cycles.
    along : {"x", "y", "twist"}, optional
        Which motion. Default: the one whose loop is the largest, range of force times range of motion.
    stage : int or str, optional
        Number or name of a stage with cycles. Without: all stages with cycles, one behind the other.
    most : int
        Number of loops drawn, at most, evenly over the computed cycles, the first and the last among them.
    cmap : str
        Colours from the first cycle to the last.
    ax : matplotlib Axes, optional
        Where to draw; with ``projection="3d"``.
    **line
        Keywords of matplotlib for the lines, such as ``lw``.

    Returns
    -------
    matplotlib Axes
        Axes in three dimensions: number of the cycle, motion, force.
    """
    motion, force = _loop_columns(history, along, stage)
    numbers, rows = _loops(history, stage)
    if not rows:
        raise ValueError("no cycles: a stack of loops needs a stage with cycles = ...")
    colormaps = matplotlib().colormaps
    if cmap not in colormaps:
        raise ValueError(f"cmap = {cmap!r}: matplotlib has no colours of that name")
    if getattr(ax, "name", "3d") != "3d":
        raise ValueError('ax: a stack of loops needs axes of three dimensions (projection="3d")')
    if most < 2:
        raise ValueError(f"most = {most}: must be at least 2")
    shown = np.unique(np.linspace(0, len(rows) - 1, min(most, len(rows))).round().astype(int))
    axes: Any = ax
    if axes is None:
        axes = _pyplot().figure(figsize=_size((6.4, 4.4)), layout="constrained").add_subplot(projection="3d")
    for one in shown:
        colour = colormaps[cmap](one / max(len(rows) - 1, 1))
        across, up = (history.increments[name][rows[one]] for name in (motion, force))
        height = np.full(len(across), numbers[one])
        axes.plot(height, across, up, **{"lw": 1.0, "color": colour, **_long_names(line)})
    axes.set(xlabel="cycle", ylabel=_loop_label(history, motion), zlabel=_loop_label(history, force))
    axes.view_init(elev=22.0, azim=-60.0)
    drawn: Axes = axes
    return drawn


@checked
def section(
    history: "History",
    fields: str | Sequence[str] = ("pressure", "shear_x"),
    increment: int = -1,
    *,
    along: Direction = "x",
    at: float = 0.0,
    ax: "Axes | None" = None,
    **line: Any,
) -> "Axes":
    """Draw fields along a line through the grid.

    Parameters
    ----------
    history : History
        A history.
    fields : str or sequence of str
        Names of kept fields, of one kind per figure: tractions, or lengths.
    increment : int
        Number of the increment, from 0; negative from the end.
    along : {"x", "y"}
        Direction of the line.
    at : float
        Where the line crosses the other axis [length]. Between two rows of cells the values are interpolated. In a line
        contact it does not matter.
    ax : matplotlib Axes, optional
        Where to draw.
    **line
        Keywords of matplotlib for the line, such as ``color`` or ``label``.

    Returns
    -------
    matplotlib Axes
    """
    if history.is_line:
        if along == "y":
            raise ValueError("along = 'y': nothing changes along the line of a line contact")
        at = 0.0
    names = texts("fields", fields)
    if not names:
        raise ValueError("fields: expected at least one")
    here, across = (history.x, history.y) if along == "x" else (history.y, history.x)
    half = 0.5 * (across[1] - across[0]) if len(across) > 1 else np.inf
    if not across[0] - half <= at <= across[-1] + half:
        raise ValueError(f"at = {at}: outside the grid, which reaches from {across[0] - half} to {across[-1] + half}")
    names = [part for name in names for part in ((f"{name}_x", f"{name}_y") if name in VECTORS else (name,))]
    values = {name: _along(history.field(name, increment), along, across, at) for name in names}  # type: ignore[arg-type]
    axes = _own_axes(ax)
    for name, course in values.items():
        axes.plot(here, course, **{"lw": 1.4, "label": name.replace("_", " "), **_long_names(line)})
    units = {in_units(_unit(name), history._units) for name in names}
    axes.set(
        xlabel=f"{along} [{in_units('length', history._units)}]", ylabel=f"[{units.pop()}]" if len(units) == 1 else ""
    )
    _powers_of_ten(axes)
    axes.legend(frameon=False)
    return axes


@checked
def field(
    history: "History",
    name: str = "pressure",
    increment: int = -1,
    *,
    ax: "Axes | None" = None,
    **image: Any,
) -> "Axes":
    """Draw a kept field as a map, with a colour bar; of a line contact, as a line.

    Parameters
    ----------
    history : History
        A history.
    name : str
        Name of the field; ``"zone"`` is drawn as by :func:`zones`.
    increment : int
        Number of the increment, from 0; negative from the end.
    ax : matplotlib Axes, optional
        Where to draw.
    **image
        Keywords of matplotlib for the image, such as ``cmap`` or ``norm``.

    Returns
    -------
    matplotlib Axes
    """
    if name == "zone":
        return zones(history, increment, ax=ax, **image)
    if history.is_line:
        return section(history, name, increment, ax=ax, **image)
    values = history.field(name, increment)  # type: ignore[arg-type]
    axes = _own_axes(ax)
    drawn = _image(history, values, axes, image)
    axes.figure.colorbar(drawn, ax=axes, label=_label(name, history._units))
    return axes


@checked
def zones(
    history: "History",
    increment: int = -1,
    *,
    ax: "Axes | None" = None,
    **image: Any,
) -> "Axes":
    """Draw the zones: open, stick and slip.

    Parameters
    ----------
    history : History
        A history whose ``zone`` is kept.
    increment : int
        Number of the increment, from 0; negative from the end.
    ax : matplotlib Axes, optional
        Where to draw.
    **image
        Keywords of matplotlib for the image, such as ``cmap`` or ``norm``.

    Returns
    -------
    matplotlib Axes
    """
    values = history.field("zone", increment)
    axes = _own_axes(ax)
    _image(history, values, axes, image, ZONES)
    _colour_legend(axes, [entry for number, entry in enumerate(ZONES) if (values == number).any()])
    return axes


@checked
def animation(
    history: "History",
    name: str = "zone",
    *,
    along: Motion | None = None,
    stage: int | str | None = None,
    interval: int = 80,
) -> "FuncAnimation":
    """Animate the loop beside a kept field, over the increments whose fields are kept.

    Parameters
    ----------
    history : History
        A history; ``[output] every`` of the case decides how many frames there are.
    name : str
        Name of the field.
    along : {"x", "y", "twist"}, optional
        Component of the loop.
    stage : int or str, optional
        As for :func:`loop`.
    interval : int
        Time between frames [ms].

    Returns
    -------
    matplotlib FuncAnimation
        ``.save("loop.gif", writer="pillow")`` writes it, ``.to_jshtml()`` shows it in a notebook. Keep a reference.
    """
    if interval < 1:
        raise ValueError(f"interval = {interval}: must be at least 1 ms")
    plt = _pyplot()
    chosen = set(_loop_rows(history, stage).tolist())
    kept = [increment for increment in history.kept_increments if increment in chosen]
    if not kept:
        raise ValueError("no fields of these increments are kept ([output] every = ... keeps more)")
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.8), layout="constrained")
    motion, force = _loop_columns(history, along, stage)
    loop(history, along=along, stage=stage, ax=left)
    (dot,) = left.plot([], [], "o", color=VERMILION)
    frames = [history.field(name, increment) for increment in kept]  # type: ignore[arg-type]
    if name == "zone":
        image = _image(history, frames[0], right, {}, ZONES)
        _colour_legend(right, ZONES)
    else:
        image = _image(history, frames[0], right, {}, limits=_limits(np.stack(frames)))
        figure.colorbar(image, ax=right, label=_label(name, history._units))

    def draw(number: int) -> list[Any]:
        increment = kept[number]
        dot.set_data([history.increments[motion][increment]], [history.increments[force][increment]])
        image.set_data(frames[number].T)
        left.set_title(f"increment {increment}", fontsize="medium")
        return [dot, image]

    moving: FuncAnimation = matplotlib("matplotlib.animation").FuncAnimation(
        figure, draw, frames=len(kept), interval=interval
    )
    return moving


@checked
def regime_map(
    dataset: "xarray.Dataset",
    x: str,
    y: str,
    *,
    variable: str = "cycle_regime",
    ax: "Axes | None" = None,
    **mesh: Any,
) -> "Axes":
    """Draw a fretting map: the sliding condition over two axes of a sweep.

    Parameters
    ----------
    dataset : xarray.Dataset
        Result of :func:`fretting.sweep`, reduced to the two axes (``dataset.sel(...)``).
    x, y : str
        Names of the axes; their values are numbers, in ascending or descending order.
    variable : str
        A variable of sliding conditions: ``"cycle_regime"`` or ``"regime"``.
    ax : matplotlib Axes, optional
        Where to draw. Points that were not solved stay white.

    Returns
    -------
    matplotlib Axes
    """
    values = dataset[_variable("variable", variable, dataset)]
    for name, axis in (("x", x), ("y", y)):
        _variable(name, axis, dataset.coords)
    if set(values.dims) != {x, y} or x == y:
        raise ValueError(f"{variable} has the axes {', '.join(map(str, values.dims)) or 'none'}: must be {x} and {y}")
    data = values.transpose(y, x)
    words = [name for name, _ in REGIMES]
    codes = np.asarray([[words.index(w) if w in words else np.nan for w in row] for row in data.values.tolist()])
    axes = _own_axes(ax)
    colours = matplotlib("matplotlib.colors").ListedColormap([colour for _, colour in REGIMES])
    edges = [_edges(np.asarray(dataset[name].values, dtype=np.float64), name) for name in (x, y)]
    fixed: dict[str, Any] = {"cmap": colours, "vmin": -0.5, "vmax": len(REGIMES) - 0.5}
    axes.pcolormesh(*edges, codes, **{"edgecolors": "white", "lw": 0.4, **mesh, **fixed})
    axes.set(xlabel=_with_unit(dataset[x]), ylabel=_with_unit(dataset[y]))
    _colour_legend(axes, [entry for number, entry in enumerate(REGIMES) if (codes == number).any()])
    return axes


def _with_unit(axis: "xarray.DataArray") -> str:
    """Return the name of an axis of a sweep with its unit, where its key has one and the case declares units."""
    unit = axis.attrs.get("units")
    return f"{axis.name} [{unit}]" if unit else str(axis.name)


def _pyplot() -> Any:
    return matplotlib("matplotlib.pyplot")


def _long_names(line: dict[str, Any]) -> dict[str, Any]:
    """Return keywords of a line under the names that the defaults have."""
    short = {"linewidth": "lw"}
    return {short.get(name, name): value for name, value in line.items()}


def _own_axes(axes: "Axes | None") -> "Axes":
    if axes is not None:
        return axes
    own: Axes = _pyplot().subplots(figsize=_size((5.2, 4.0)), layout="constrained")[1]
    return own


def _size(own: tuple[float, float]) -> tuple[float, float]:
    """Return the size of a figure: what a style has chosen, or its own [inches]."""
    library = matplotlib()
    chosen = library.rcParams["figure.figsize"]
    if list(chosen) == list(library.rcParamsDefault["figure.figsize"]):
        return own
    return float(chosen[0]), float(chosen[1])


_LOOPS = {
    "x": ("shift_x", "tangential_force_x"),
    "y": ("shift_y", "tangential_force_y"),
    "twist": ("twist", "twist_moment"),
}
"""Motions and what drives them."""

_LOOP_LABELS = {
    "shift_x": ("relative displacement x", "length"),
    "shift_y": ("relative displacement y", "length"),
    "twist": ("twist", "rad"),
    "tangential_force_x": ("tangential force along x", "force"),
    "tangential_force_y": ("tangential force along y", "force"),
    "twist_moment": ("torsional moment", "force x length"),
}


def _loop_label(history: "History", column: str) -> str:
    words, kind = _LOOP_LABELS[column]
    return f"{words} [{in_units(kind, history._units)}]"


def _loop_columns(history: "History", along: str | None, stage: int | str | None) -> tuple[str, str]:
    """Columns of a loop: motion and force."""
    if along is not None:
        return _LOOPS[along]
    rows = _loop_rows(history, stage)

    def work(columns: tuple[str, str]) -> float:
        motion, force = (history.increments[name][rows] for name in columns)
        return float(np.ptp(motion) * np.ptp(force)) if len(rows) else 0.0

    return max(_LOOPS.values(), key=work)


def _loop_rows(history: "History", stage: int | str | None) -> npt.NDArray[np.int64]:
    """Rows of a loop, with the state it starts from."""
    column = history.increments["stage"]
    if stage is None:
        in_cycles = history.cycles["stage"]
        rows = np.flatnonzero(column >= in_cycles[0]) if len(in_cycles) else np.arange(len(history))
    else:
        rows = np.flatnonzero(column == stage_number(history, stage))
    if not len(rows):
        raise ValueError("no increment of that stage is solved")
    return np.concatenate([rows[:1] - 1, rows]) if rows[0] > 0 else rows


def _loops(history: "History", stage: int | str | None) -> tuple[npt.NDArray[np.int64], list[npt.NDArray[np.int64]]]:
    """Numbers of the computed cycles, over all stages drawn, and the rows of each with the state it starts from."""
    cycles = history.cycles
    chosen = np.ones(len(cycles["cycle"]), dtype=bool)
    if stage is not None:
        chosen = cycles["stage"] == stage_number(history, stage)
    numbers, rows = [], []
    before, last = 0, (-1, 0)
    for index in np.flatnonzero(chosen):
        number = (int(cycles["stage"][index]), int(cycles["last_cycle"][index]))
        if number[0] != last[0]:
            before, last = before + last[1], (number[0], 0)
        first, end = int(cycles["first_increment"][index]), int(cycles["last_increment"][index])
        numbers.append(before + last[1] + 1)
        last = number
        rows.append(np.arange(max(first - 1, 0), end + 1))
    return np.asarray(numbers, dtype=np.int64), rows


@checked
def stage_number(history: "History", stage: int | str) -> int:
    """Return the number of a stage that is named or numbered."""
    count = len(history.stages)
    if isinstance(stage, str):
        if stage not in history.stages:
            raise ValueError(f"no stage is called {stage!r}; stages are: {', '.join(history.stages)}")
        return history.stages.index(stage)
    if not -count <= stage < count:
        raise IndexError(f"stage {stage}: the history has {count} stages")
    return stage % count


def _along(values: Reals, along: Direction, across: Reals, at: float) -> Reals:
    if values.ndim == 1:
        return values
    rows = values if along == "y" else values.T
    if len(across) == 1:
        only: Reals = rows[0]
        return only
    place = np.clip((at - across[0]) / (across[1] - across[0]), 0.0, len(across) - 1.0)
    below = min(int(place), len(across) - 2)
    fraction = place - below
    line: Reals = (1.0 - fraction) * rows[below] + fraction * rows[below + 1]
    return line


def _image(
    history: "History",
    values: npt.NDArray[Any],
    axes: Any,
    keywords: dict[str, Any],
    words: Sequence[tuple[str, str]] | None = None,
    limits: tuple[float, float] | None = None,
) -> "AxesImage":
    edges = (*_ends(history.x), *((0.0, 1.0) if history.is_line else _ends(history.y)))
    values = values.reshape(len(history.x), len(history.y))
    low, high = (-0.5, len(words) - 0.5) if words else limits or _limits(values)
    named = matplotlib("matplotlib.colors").ListedColormap
    colours = named([c for _, c in words]) if words else "RdBu_r" if low < 0.0 else "viridis"
    look = {"cmap": colours, "vmin": low, "vmax": high, "interpolation": "nearest", **keywords}
    if "norm" in keywords:
        del look["vmin"], look["vmax"]
    image: AxesImage = axes.imshow(values.T, origin="lower", extent=edges, **look)
    length = in_units("length", history._units)
    axes.set(xlabel=f"x [{length}]", ylabel="" if history.is_line else f"y [{length}]")
    if history.is_line:
        axes.set(aspect="auto", yticks=[])
    _powers_of_ten(axes, "x" if history.is_line else "both")
    return image


def _powers_of_ten(axes: Any, axis: Literal["x", "y", "both"] = "both") -> None:
    """Few ticks, with the power of ten beside the axis; an axis whose numbers the caller writes differently stays."""
    with suppress(AttributeError):
        axes.ticklabel_format(scilimits=(-2, 3), axis=axis, useMathText=True)
        axes.locator_params(axis="x", nbins=5)


def _limits(values: npt.NDArray[Any]) -> tuple[float, float]:
    """Limits of the colours: about zero where the field has both signs."""
    low, high = float(values.min()), float(values.max())
    largest = max(abs(low), abs(high))
    return (-largest, largest) if low < -1e-9 * largest else (0.0, high)


def _ends(centres: Reals) -> tuple[float, float]:
    half = 0.5 * (centres[1] - centres[0]) if len(centres) > 1 else 0.5
    return float(centres[0] - half), float(centres[-1] + half)


def _edges(centres: Reals, name: str) -> Reals:
    """Borders between values, half-way; half-way of their logarithms where they grow by factors."""
    if len(centres) < 2 or not (np.all(np.diff(centres) > 0) or np.all(np.diff(centres) < 0)):
        raise ValueError(f"{name}: a map needs at least two values, ascending or descending")
    by_factors = centres.min() > 0.0 and np.ptp(np.diff(np.log(centres))) < np.ptp(np.diff(centres)) / centres.mean()
    lattice = np.log(centres) if by_factors else centres
    middle = 0.5 * (lattice[1:] + lattice[:-1])
    edges = np.concatenate([[2 * lattice[0] - middle[0]], middle, [2 * lattice[-1] - middle[-1]]])
    answer: Reals = np.exp(edges) if by_factors else edges
    return answer


def _colour_legend(axes: Any, entries: Sequence[tuple[str, str]]) -> None:
    """Name the colours above the axes, where they hide nothing of what is drawn."""
    patch = matplotlib("matplotlib.patches").Patch
    patches = [patch(facecolor=colour, edgecolor="0.6", label=word.replace("_", " ")) for word, colour in entries]
    small = {"fontsize": "x-small", "handlelength": 1.0, "borderpad": 0.2, "labelspacing": 0.25, "columnspacing": 0.8}
    above = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0), "borderaxespad": 0.2, "frameon": False}
    # three short words fit above a panel of half a column
    axes.legend(handles=patches, ncols=min(len(patches), 3), **above, **small)
