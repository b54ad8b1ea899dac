"""Refinement studies."""

import json
import os
import warnings
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from fretting import _case, _core, _dataset
from fretting._arguments import content, reals, truth, wholes
from fretting.errors import FrettingWarning

if TYPE_CHECKING:
    import xarray

QUANTITIES = (
    "max_pressure",
    "approach",
    "contact_area",
    "stick_area",
    "shift",
    "dissipated_energy",
    "creepage",
    "spin",
    "rolling_friction",
    "max_worn_depth",
    "worn_volume",
)
_READINGS = {
    "error": ("errors", "relative error against the reference, by sub-cell reconstruction"),
    "error_plain": ("errors_plain", "relative error of the plain sum or maximum over cells"),
    "error_extrapolated": ("errors_extrapolated", "relative error after extrapolation with the next coarser grid"),
    "order": ("orders", "observed order of convergence against the level before"),
}
_NUMBERS = {
    "error_of_pressure": "relative L2 error of the pressure at the end of the history",
    "error_of_shear": "relative L2 error of the shear traction at the end of the history",
    "order_of_pressure": "observed order of the pressure error",
    "order_of_shear": "observed order of the shear error",
    "wall_s": "time of the level [s]",
}
_NO_ERRORS = (
    "study: no errors: no closed form is available for this case, and a single level cannot be compared with a finer "
    "one; give more levels, as in cells=[32, 64, 128], or numbers with against=FILE"
)
"""What the command says of such a study, in the words of Python."""


def study(
    case: _case.CaseLike,
    *,
    cells: Iterable[int] = (),
    increments: Iterable[int] = (),
    tolerances: Iterable[float] = (),
    against: Literal["analytic", "finest"] | str | os.PathLike[str] | None = None,
    threads: int | None = None,
    progress: bool = False,
) -> "xarray.Dataset":
    """Solve a case at several resolutions: errors, orders of convergence, times, and which resolution to choose.

    Parameters
    ----------
    case : path, str or mapping
        As for :func:`fretting.run`.
    cells : iterable of int
        Numbers of cells along x; the grid keeps its size and shape. Default, without any list: the case's value, a
        half, a quarter.
    increments : iterable of int
        Numbers of increments per stage, or per cycle. Default: as for the cells.
    tolerances : iterable of float
        Tolerances of the solver. Default: that of the case.
    against : {"analytic", "finest"} or path, optional
        Reference: a closed form, the finest level, or a TOML file of numbers. Default: a closed form where the case
        has one, otherwise Richardson extrapolation.
    threads : int, optional
        Worker threads. Default: all cores.
    progress : bool
        Whether every level is told on stderr.

    Returns
    -------
    xarray.Dataset
        ``error``, ``error_plain``, ``error_extrapolated`` and ``order`` with the dimensions (level, quantity), NaN
        where nothing is known; ``error_of_pressure``, ``error_of_shear``, ``wall_s``, ``convolutions``,
        ``is_efficient`` along ``level``. Beside ``level`` stand ``refined`` (``"cells"``, ``"increments"``,
        ``"together"``, ``"tolerance"``), ``nx``, ``ny``, ``increments`` (of all stages, as text) and ``tolerance``;
        beside ``quantity``, ``measured_by`` and ``convergence`` (``"observed"``, ``"two_levels"``: they show none,
        ``"not_asymptotic"``: no plausible order, not extrapolated, ``"no_limit"``: the maximum contact pressure at a
        sharp edge, a tip or a crease). The attribute ``choice`` says in words what to choose for 1 %, 0.1 % and
        0.01 %.

    Raises
    ------
    CaseError
        When the case is refused.
    ValueError
        When a resolution cannot be had.
    UnreadableError
        When the file of the reference cannot be read; ``MissingFileError`` when there is none.
    RunError
        When the finest level cannot be solved.

    Warns
    -----
    FrettingWarning
        When no error is known: a single level, without a closed form or numbers to compare it with.
    """
    module = _dataset.module("study")
    if against is not None and not (isinstance(against, str) and against in ("analytic", "finest")):
        content("against", against)  # refuses what is no file
        against = os.fspath(against)
    resolutions = wholes("cells", cells), wholes("increments", increments), reals("tolerances", tolerances), against
    if any(number < 1 for number in resolutions[0] + resolutions[1]):
        raise ValueError(f"cells = {resolutions[0]}, increments = {resolutions[1]}: must be positive")
    answer = json.loads(_core.study(_case.read(case), resolutions, threads, truth("progress", progress)))
    levels = [(line["refined"], level) for line in answer["lines"] for level in line["levels"]]

    def numbers(values: Iterable[float | None]) -> list[float]:
        return [np.nan if value is None else value for value in values]

    variables: dict[str, Any] = {
        name: (
            ("level", "quantity"),
            np.reshape([numbers(level[key][q] for q in QUANTITIES) for _, level in levels], (-1, len(QUANTITIES))),
            {"long_name": meaning, "units": "1"},
        )
        for name, (key, meaning) in _READINGS.items()
    }
    for name, meaning in _NUMBERS.items():
        variables[name] = ("level", np.asarray(numbers(level[name] for _, level in levels)), {"long_name": meaning})
    if not any(np.isfinite(variables[name][1]).any() for name in _READINGS):
        skipped = "".join(f"; a level was left out: {level['message']}" for level in answer["unsolved"])
        warnings.warn(_NO_ERRORS + skipped, FrettingWarning, stacklevel=2)
    variables["convolutions"] = ("level", np.asarray([level["work"]["convolutions"] for _, level in levels], dtype=int))
    variables["is_efficient"] = ("level", np.asarray([level["is_efficient"] for _, level in levels], dtype=bool))
    increments_of = ["/".join(map(str, level["increments"])) for _, level in levels]
    coordinates: dict[str, Any] = {
        "quantity": ("quantity", list(QUANTITIES)),
        "measured_by": ("quantity", [str(answer["measured_by"][q] or "") for q in QUANTITIES]),
        "convergence": ("quantity", [str(answer["convergence"][q] or "") for q in QUANTITIES]),
        "refined": ("level", np.asarray([refined for refined, _ in levels], dtype=str)),
        "nx": ("level", np.asarray([level["cells"][0] for _, level in levels], dtype=int)),
        "ny": ("level", np.asarray([level["cells"][1] for _, level in levels], dtype=int)),
        "increments": ("level", np.asarray(increments_of, dtype=str)),
        "tolerance": ("level", np.asarray([level["tolerance"] for _, level in levels], dtype=float)),
    }
    attributes = {
        "title": answer["title"],
        "choice": answer["choice"],
        "closed_form": answer["closed_form"] or "",
        "unsolved": [f"{entry['cells'][0]} x {entry['cells'][1]}: {entry['message']}" for entry in answer["unsolved"]],
    }
    dataset: xarray.Dataset = module.Dataset(variables, coords=coordinates, attrs=attributes)
    return dataset
