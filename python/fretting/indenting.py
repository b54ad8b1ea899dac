"""Numbers of a case from a measured indentation."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal

from fretting import _case, _core
from fretting._arguments import checked, content, matplotlib, of_kind
from fretting._fitted import Fitted, named
from fretting.identifying import Constant

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class FittedNumber(Constant):
    """A number that was fitted to an indentation.

    Attributes
    ----------
    value : float
        Its value, in the units of the case.
    interval : tuple of float
        95 % confidence interval, linear about the solution; the error of the grid is not in it.
    told : bool
        Whether the curve determines it. Where it does not, value and interval mean nothing.
    change_on_half_the_cells : float or None
        By how much it differs on half of the cells along each side: a sign of the error of the grid, not a bound.
    """

    change_on_half_the_cells: float | None


class Indentation(Fitted):
    """What a measured indentation tells; returned by :func:`fretting.identify_indentation`.

    Attributes
    ----------
    constants : dict of str to FittedNumber
        The fitted numbers by their keys, and where they are fitted ``"depth at first touch"`` [length] and
        ``"frame compliance"`` [length/force].
    touch : float
        The depth at which the indenter touches, as the log counts it, in the unit of the case.
    frame_compliance : float
        Compliance of the instrument's frame [length/force].
    noise : float
        Standard deviation of the loads about the computed curve, over the largest load.
    correlation : float
        Correlation of the residuals of neighbouring points; 0 where it may be chance.
    solved_indentations : int
        How many indentations the solver computed for the fit.
    notes : list of str
        What the data cannot tell, and what was assumed.
    measured : dict of str to ndarray
        The points that were fitted: ``line`` in the log, ``depth`` from the touch on, ``force``, and
        ``computed_force`` at that depth.
    computed : dict of str to ndarray
        The computed curve: ``depth`` from the touch on, ``force``, and ``contact_depth``, without that of the frame.
    """

    def __init__(self, answer: Mapping[str, Any], page: str) -> None:
        super().__init__(answer, page, "identify_indentation", "solved_indentations")
        self.constants = {
            entry["name"]: FittedNumber(
                entry["value"], (entry["low"], entry["high"]), entry["told"], entry["change_on_half_the_cells"]
            )
            for entry in answer["parameters"]
        }
        self.touch: float = answer["touch"]
        self.frame_compliance: float = answer["frame_compliance"]
        self.correlation: float = answer["correlation"]
        self.solved_indentations: int = answer["solved_indentations"]

    def __repr__(self) -> str:
        """Return the constants in one line."""
        told = ", ".join(f"{name} = {entry.value:.4g}" for name, entry in self.constants.items() if entry.told)
        return f"Indentation({told})"

    @checked
    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the measured points beside the computed curve, over the depth from the first touch on."""
        if ax is None:
            ax = matplotlib("matplotlib.pyplot").subplots()[1]
        units = self._answer["units"]
        ax.set(xlabel=f"depth [{units['length']}]", ylabel=f"load [{units['force']}]")
        ax.plot(self.measured["depth"], self.measured["force"], ".", ms=3, label="measured")
        ax.plot(self.computed["depth"], self.computed["force"], label="computed")
        ax.legend(frameon=False)
        return ax


@checked
def identify_indentation(
    log: str | PathLike[str],
    *,
    case: _case.CaseLike,
    fit: str | Sequence[str] = (),
    columns: Mapping[str, str | int] | None = None,
    units: Mapping[str, str] | None = None,
    part: Literal["whole", "loading", "unloading"] = "whole",
    touch: float | None = None,
    frame: bool = False,
    strict: bool = False,
    threads: int | None = None,
) -> Indentation:
    """Fit moduli, thicknesses or other numbers of a case to measured load over depth of an indentation.

    The same as ``fret identify --indentation``: the elastic indentation of the case is computed, and its numbers are
    varied until it lies closest to the points (least squares, with exact derivatives); the depth at which the indenter
    touches is fitted with them.

    Parameters
    ----------
    log : path
        CSV file: depth of the indenter and load; any lines above the names of the columns, commas, semicolons or tabs,
        decimal commas with the last two.
    case : path, str or mapping
        Bodies, profile and grid; its stages do not matter. The numbers that are fitted start from its values.
    fit : str or sequence of str
        Keys of the case, such as ``"lower.coatings[0].young"``, ``"lower.coatings[0].thickness"``,
        ``"profile.sphere.radius"``. May be empty only with ``frame``.
    columns : mapping, optional
        Names of the columns, or their numbers from 1, of ``"depth"`` and ``"force"``. Default: usual names.
    units : mapping, optional
        Units of ``"depth"`` and ``"force"``, such as ``"nm"``. Default: those beside the names, or those of the case.
    part : {"whole", "loading", "unloading"}
        Which part of the test is fitted.
    touch : float, optional
        The depth at which the indenter touches, in the unit of the case. Default: fitted.
    frame : bool, default False
        Also fit the compliance of the instrument's frame. Otherwise it is that of ``rig.normal_stiffness`` in the
        case, or none.
    strict : bool, default False
        Refuse a log with a row without a number. Otherwise such rows are skipped and named.
    threads : int, optional
        Worker threads. Default: all cores.

    Returns
    -------
    Indentation
        Constants with intervals, the points beside the computed curve, what the data cannot tell.

    Raises
    ------
    CaseError
        When the case is refused.
    ValueError
        When the log cannot be read as load over depth, or a key is none of the bodies or the profile; the message says
        where and what to do.
    UnreadableError
        When the log is no file that can be read; ``MissingFileError`` when there is none.
    RunError
        When the indentation cannot be solved.
    """
    if not isinstance(fit, str | Sequence):
        raise TypeError(f"fit: expected a key of the case or a sequence of them, found {type(fit).__name__}")
    keys = [fit] if isinstance(fit, str) else list(fit)
    for key in keys:
        of_kind("fit", key, str)
    if not keys and not frame:
        raise ValueError("fit: nothing is fitted but the depth at first touch; name a key of the case, or frame=True")
    asked = named("columns", columns, numbered=True), named("units", units), keys, part, touch, frame, strict
    json_text, page = _core.identify_indentation((str(log), content("log", log)), _case.read(case), asked, threads)
    return Indentation(json.loads(json_text), page)
