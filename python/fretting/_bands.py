"""Figures of sweeps with uncertain parameters: bands between quantiles."""

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from fretting._arguments import checked
from fretting._arguments import variable as _variable

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

QUANTILES = (0.025, 0.5, 0.975)


@checked
def band(
    dataset: "xarray.Dataset",
    name: str,
    *,
    ax: "Axes | None" = None,
    **line: Any,
) -> "Axes":
    """Draw a number of a sweep over its one certain axis.

    The median of the samples, and the band that holds 95 % of them.

    Parameters
    ----------
    dataset : xarray.Dataset
        From :func:`fretting.sweep` with distributions, and one axis beside them (or ``keep="all"``: the increments).
    name : str
        The number, such as ``"cycle_energy_ratio"``.
    ax : matplotlib Axes, optional
        Where to draw.
    **line
        Keywords of matplotlib for the line, such as ``color`` or ``label``.

    Returns
    -------
    matplotlib Axes
    """
    values = _own_samples(dataset, name)
    others = [dimension for dimension in values.dims if dimension != "sample"]
    if len(others) != 1:
        raise ValueError(
            f"band: {name} needs one axis beside the samples, and has {', '.join(map(str, others)) or 'none'}"
        )
    low, middle, high = np.nanquantile(values.transpose("sample", ...).values, QUANTILES, axis=0)
    here = values[others[0]].values
    axes = _own_axes(ax)
    drawn = axes.plot(here, middle, **{"lw": 1.4, "label": "median", **line})
    axes.fill_between(here, low, high, color=drawn[0].get_color(), alpha=0.25, lw=0, label="95 % of the samples")
    axes.set(xlabel=str(others[0]), ylabel=values.attrs.get("long_name", name))
    axes.legend(frameon=False)
    return axes


@checked
def loop_band(
    dataset: "xarray.Dataset",
    *,
    along: str = "x",
    ax: "Axes | None" = None,
    **line: Any,
) -> "Axes":
    """Draw the loop of the median, and the band that holds the loops of 95 % of the samples, increment by increment.

    Parameters
    ----------
    dataset : xarray.Dataset
        From :func:`fretting.sweep` with distributions and ``keep="all"``.
    along : {"x", "y"}
        Which motion.
    ax : matplotlib Axes, optional
        Where to draw.
    **line
        Keywords of matplotlib for the line, such as ``color`` or ``label``.

    Returns
    -------
    matplotlib Axes
    """
    if along not in ("x", "y"):
        raise ValueError(f"along = {along!r}: must be 'x' or 'y'")
    shift, force = (_own_samples(dataset, f"{name}_{along}") for name in ("shift", "tangential_force"))
    if set(shift.dims) != {"sample", "increment"}:
        raise ValueError('loop_band: needs the samples of a sweep with keep="all", and no other axis')
    shifts, forces = (
        np.nanquantile(part.transpose("sample", ...).values, QUANTILES, axis=0) for part in (shift, force)
    )
    axes = _own_axes(ax)
    drawn = axes.plot(shifts[1], forces[1], **{"lw": 1.4, "label": "median", **line})
    # What is prescribed is the same in all samples: the band lies across it, branch by branch.
    spread = [np.ptp(part, axis=0).max() / max(np.ptp(part), 1e-300) for part in (forces, shifts)]
    by_force = spread[0] <= spread[1]
    course, low, high = (forces[1], shifts[0], shifts[2]) if by_force else (shifts[1], forces[0], forces[2])
    fill = axes.fill_betweenx if by_force else axes.fill_between
    style: dict[str, Any] = {"color": drawn[0].get_color(), "alpha": 0.25, "lw": 0}
    for number, (start, end) in enumerate(_branches(course)):
        part = slice(start, end + 1)
        fill(course[part], low[part], high[part], label="95 % of the samples" if number == 0 else None, **style)
    axes.set(xlabel=shift.attrs.get("long_name", "shift"), ylabel=force.attrs.get("long_name", "force"))
    axes.ticklabel_format(scilimits=(-2, 3))
    axes.legend(frameon=False)
    return axes


@checked
def band_map(
    dataset: "xarray.Dataset",
    name: str,
    x: str,
    y: str,
    *,
    axes: "tuple[Axes, Axes] | None" = None,
    **mesh: Any,
) -> "tuple[Axes, Axes]":
    """Draw a number of a sweep over two certain axes, and beside it how far the samples lie apart.

    Of a number the median, and the width of the band that holds 95 % of the samples. Of a sliding condition
    (``"cycle_regime"``) the one that most samples have, and the fraction of the samples that have it: where it is
    below 1, the border of the map is uncertain.

    Parameters
    ----------
    dataset : xarray.Dataset
        From :func:`fretting.sweep` with distributions, and two axes beside them.
    name : str
        The number, such as ``"cycle_energy_ratio"``, or ``"cycle_regime"``.
    x, y : str
        Names of the axes; their values are numbers, in ascending or descending order.
    axes : pair of matplotlib Axes, optional
        Where to draw the map, and its band. Default: side by side in a figure of their own.
    **mesh
        Keywords of matplotlib's ``pcolormesh`` for both, such as ``cmap``.

    Returns
    -------
    pair of matplotlib Axes
        Points that were not solved stay white.
    """
    from fretting import plot

    values = _own_samples(dataset, name)
    if set(values.dims) != {"sample", x, y}:
        beside = [str(dimension) for dimension in values.dims if dimension != "sample"]
        raise ValueError(
            f"band_map: {name} has the axes {', '.join(beside) or 'none'} beside the samples, not {x}, {y}"
        )
    for named, axis in (("x", x), ("y", y)):
        _variable(named, axis, dataset.coords)
    values = values.transpose("sample", y, x)
    label = values.attrs.get("long_name", name)
    if axes is None:
        axes = tuple(plot._pyplot().subplots(1, 2, figsize=(8.4, 3.4), layout="constrained")[1])
    edges = [plot._edges(np.asarray(dataset[axis].values, dtype=np.float64), axis) for axis in (x, y)]
    pictures: list[tuple[Any, str, dict[str, Any]] | None]
    if values.dtype.kind == "f":
        low, middle, high = _quantiles(values.values)
        pictures = [(middle, f"{label}: median", {}), (high - low, "width of the band of 95 %", {})]
    else:
        words = [word for word, _ in plot.REGIMES]
        counts = np.stack([(values.values == word).sum(axis=0) for word in words])
        solved = counts.sum(axis=0)
        most = dataset[name].isel(sample=0, drop=True).transpose(y, x).copy(data=np.array(words)[counts.argmax(axis=0)])
        unsolved = most.where(solved > 0, "")
        plot.regime_map(unsolved.to_dataset(name=name), x, y, variable=name, ax=axes[0], **mesh)
        with np.errstate(invalid="ignore"):
            share = np.where(solved > 0, counts.max(axis=0) / solved, np.nan)
        pictures = [None, (share, "fraction of the samples with it", {"vmin": 0.0, "vmax": 1.0})]
    for place, picture in zip(axes, pictures, strict=True):
        if picture is not None:
            numbers, words_beside, limits = picture
            drawn = place.pcolormesh(*edges, numbers, **{**limits, **mesh})
            place.figure.colorbar(drawn, ax=place, label=words_beside)
        place.set(xlabel=x, ylabel=y)
    return axes


def _quantiles(samples: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """The quantiles along the samples; not a number, and no warning, where none was solved."""
    known = np.isfinite(samples).any(axis=0)
    found = np.full((len(QUANTILES), *known.shape), np.nan)
    found[:, known] = np.nanquantile(samples[:, known], QUANTILES, axis=0)
    return found


def _branches(course: npt.NDArray[np.float64]) -> list[tuple[int, int]]:
    """First and last places of the parts of a course between its turns."""
    steps = np.sign(np.diff(course))
    turns = [place + 1 for place in range(len(steps) - 1) if steps[place] * steps[place + 1] < 0.0]
    ends = [0, *turns, len(course) - 1]
    return list(pairwise(ends))


def _own_samples(dataset: "xarray.Dataset", name: str) -> "xarray.DataArray":
    """The samples of a number, without those that only serve its indices."""
    if "sample" not in dataset.dims or not {"samples", "indices", "uncertain"} <= set(dataset.attrs):
        raise ValueError("the sweep has no samples; give it distributions, such as fretting.Normal(0.6, 0.05)")
    _variable("name", name, dataset)
    count = int(dataset.attrs["samples"]) * (2 if dataset.attrs["indices"] else 1)
    return dataset[name].isel(sample=slice(count))


def _own_axes(ax: "Axes | None") -> "Axes":
    from fretting import plot

    return plot._own_axes(ax)
