"""Exact sensitivities: what a result depends on, and how much."""

import math
import re
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from fretting import _case, _core
from fretting._arguments import mapping, real, text, texts
from fretting._arrays import real_array


class NearEvents(NamedTuple):
    """The increment of a history with most cells that are about to change their state (open, stick, slip)."""

    increment: int
    """Its number, from 0."""
    cells: int
    """Cells within a millionth of another state, by the maximum contact pressure, friction bound or displacement."""
    contact_cells: int
    """Cells in contact."""

    @property
    def share(self) -> float:
        """Fraction of such cells in those in contact."""
        return self.cells / self.contact_cells


class Gradient(dict[str, dict[str, float]]):
    """For every result its ``"value"``, and its derivatives by path; made by :func:`gradient`."""

    near_events: NearEvents | None = None
    """Where derivatives on either side of the case differ, up to the last increment asked for; None: nowhere."""
    on_the_other_side: dict[str, dict[str, float]] | None = None
    """For every result its derivatives by path on the other side of all such cells; None: there are none."""


def gradient(
    case: _case.CaseLike,
    *,
    of: str | Iterable[str],
    by: str | Iterable[str] = (),
    threads: int | None = None,
) -> Gradient:
    """Differentiate results of a history by numbers of its case, exactly.

    Parameters
    ----------
    case : path, str or mapping
        As for :func:`fretting.run`.
    of : str or iterable of str
        Results: a column of the last increment (``"max_pressure"``), of another (``"increments[7].shift_x"``), one of a
        cycle (``"cycles[0].dissipated_energy"``, ``"cycles[0].opening"``), the largest stress below the surface
        (``"stress.von_mises"``, ``"increments[7].stress.interface_shear"``), the largest fatigue parameter of a cycle
        (``"fatigue.crossland"``, ``"cycles[0].fatigue.dang_van"``, ``"fatigue.ruiz_f1"``).
    by : str or iterable of str
        Numbers of the case by their paths: ``"friction.coefficient"``, ``"friction.max_shear"``,
        ``"lower.coatings[0].young"``, ``"lower.substrate.poisson"``, ``"lower.coatings[0].thickness"``,
        ``"profile.sphere.radius"``, ``"load[0].normal_force"``, ``"load[1].tangential_force[0]"``,
        ``"rig.tangential_stiffness"``, ``"wear.coefficient"``. Default: all there are.
    threads : int, optional
        Worker threads. Default: all cores.

    Returns
    -------
    Gradient
        A dict: for every result its ``"value"``, and its derivatives by path, in the units of the case: of the result
        on the grid that the plan of the case chooses, which does not change with the numbers. Its ``near_events``
        tells in which increment most cells are within a millionth of another state, how many, and of how many in
        contact: there derivatives on either side differ. ``on_the_other_side`` has those with all such cells in their
        other state.

    Raises
    ------
    CaseError
        When the case is refused.
    ValueError
        When a result or a number is not one of the case, or the case is of a kind that is not covered: with
        ``wear.debris.stiffness`` or ``wear.thinning_tolerance``, hardness, surfaces that move or roll, or
        graded coatings.
    RunError
        When the run fails, or the linear equations of an increment are not solved.
    """
    results = texts("of", of)
    if not results:
        raise ValueError("of: expected at least one result, such as 'max_pressure'")
    found, near = _core.gradient(_case.read(case), results, texts("by", by), threads)
    derivatives = Gradient({name: {"value": value, **by_path} for name, value, by_path, _ in found})
    if near is not None:
        derivatives.near_events = NearEvents(*near)
        derivatives.on_the_other_side = {name: other for name, _, _, other in found if other is not None}
    return derivatives


def told(
    case: _case.CaseLike, of: list[str], by: list[str], threads: int | None
) -> tuple[dict[str, dict[str, float]], tuple[int, int, int] | None]:
    """Values and derivatives of results, and where most cells are about to change their state.

    The latter is the increment, how many cells there are, and how many are in contact; None where there are none.
    """
    found, near = _core.gradient(_case.read(case), of, by, threads)
    return {name: {"value": value, **derivatives} for name, value, derivatives, _ in found}, near


def near_in_words(near: tuple[int, int, int]) -> str:
    """What cells that are about to change their state mean for derivatives."""
    increment, cells, contact = near
    return (
        f"increment {increment}: {cells} of {contact} cells are within a millionth of another state (open, stick, "
        "slip): derivatives on either side of the case differ there"
    )


def vjp(
    case: _case.CaseLike,
    weights: Mapping[str, float | npt.NDArray[np.float64] | npt.NDArray[np.bool_]],
    *,
    by: str | Iterable[str] = (),
    threads: int | None = None,
) -> dict[str, float]:
    """Differentiate a weighted sum of results and fields by numbers of a case: pull weights back to the numbers.

    The product of a vector and the matrix of derivatives that a chain of derivatives asks for (reverse mode). By
    several numbers it is one pass backwards through the history, however many results and numbers there are.

    Parameters
    ----------
    case : path, str or mapping
        As for :func:`fretting.run`.
    weights : mapping of str to float or array
        The weight of every result, such as the derivatives of a loss by the results. Of a field its weights in all
        cells, with the shape of the field: ``"pressure"``, ``"shear_x"``, ``"shear_y"``, relative slip since the start
        ``"slip_x"``, ``"slip_y"`` and ``"worn_depth"`` of the last increment, or of another
        (``"increments[7].pressure"``).
    by : str or iterable of str
        Numbers of the case, as for :func:`gradient`. Default: all there are.
    threads : int, optional
        Worker threads. Default: all cores.

    Returns
    -------
    dict of str to float
        The derivative of the sum by each number, by path.

    Raises
    ------
    CaseError
        When the case is refused.
    ValueError
        As for :func:`gradient`; without any weight or with one that is not finite; of a field that has no
        derivatives here, or with weights of another shape.
    RunError
        As for :func:`gradient`.

    Examples
    --------
    >>> import fretting
    >>> case = {
    ...     "grid": {"cells": [16, 16], "size": "auto"},
    ...     "upper": {"rigid": True},
    ...     "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
    ...     "profile": {"sphere": {"radius": 10e-3}},
    ...     "load": [{"normal_force": 10.0, "increments": 1}],
    ... }
    >>> found = fretting.vjp(case, {"max_pressure": 1e-9, "approach": 1e6}, by="profile.sphere.radius")
    >>> list(found)
    ['profile.sphere.radius']
    """
    pairs, fields = [], []
    for name, weight in mapping("weights", weights).items():
        text("weights", name)
        if isinstance(weight, np.ndarray) and weight.ndim > 0:
            cells = real_array(f"weights[{name!r}]", weight, kinds="fiub")
            if cells.ndim > 2:
                raise ValueError(f"weights[{name!r}]: expected the shape of a field, got {cells.shape}")
            fields.append((name, cells[:, None] if cells.ndim == 1 else cells))
            continue
        number = real(f"weights[{name!r}]", weight)
        if not math.isfinite(number):
            raise ValueError(f"weights[{name!r}] = {number}: must be finite")
        pairs.append((name, number))
    if not pairs and not fields:
        raise ValueError("weights: of no result; expected such as {'max_pressure': 1.0}")
    return dict(_core.pulled_back(_case.read(case), pairs, fields, texts("by", by), threads))


def is_below(name: str) -> bool:
    """Whether a result with derivatives is a stress below the surface, or made of such, and no column of a history."""
    return re.search(r"(^|\.)(stress|fatigue)\.", name) is not None


def value_of(increments: Mapping[str, Any], cycles: Mapping[str, Any], name: str) -> float:
    """Return a result of a history by its name, which is one of the columns with derivatives."""
    found = re.fullmatch(r"(increments|cycles)\[(\d+)\]\.(\w+)", name)
    if found is None:
        return float(increments[name][-1])
    column = (increments if found[1] == "increments" else cycles)[found[3]]
    if int(found[2]) >= len(column):
        raise ValueError(f"of {name!r}: the history has {len(column)} {found[1]}, from 0")
    return float(column[int(found[2])])
