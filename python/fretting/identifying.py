"""Constants of a model from measured fretting loops."""

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from fretting import _case, _core
from fretting._arguments import checked, content, matplotlib
from fretting._fitted import Fitted, named

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Constant:
    """A fitted constant.

    Attributes
    ----------
    value : float
        Its value, in the units of the case.
    interval : tuple of float
        95 % confidence interval, linear about the solution; the error of the grid is not in it.
    told : bool
        Whether the loop determines it. Where it does not, value and interval mean nothing.
    """

    value: float
    interval: tuple[float, float]
    told: bool


def _constants(entries: Iterable[Mapping[str, Any]]) -> dict[str, Constant]:
    return {entry["name"]: Constant(entry["value"], (entry["low"], entry["high"]), entry["told"]) for entry in entries}


class Identification(Fitted):
    """What a measured log tells; returned by :func:`fretting.identify`.

    Attributes
    ----------
    constants : dict of str to Constant
        ``"friction coefficient"``, ``"rig stiffness"`` [force/length], ``"actuator amplitude"`` [length], and the
        fitted key. Forces of a line contact are those of a unit of its length.
    cycles : dict of str to ndarray
        Quantities of every cycle: ``cycle``, ``points``, ``dissipated_energy``, ``force_amplitude``,
        ``displacement_amplitude``, ``opening`` (delta_0), ``energy_ratio`` (A), ``sliding_ratio`` (D), the same of the
        contact without the rig (``contact_energy_ratio``, ``contact_sliding_ratio``), ``slope_after_reversal``,
        ``plateau_friction`` and ``energy_friction`` (in gross slip); NaN where there is none, and in cycles that were
        skipped.
    skipped : dict of float to str
        Cycles that are no whole loop, by number, with the reason.
    fits : list of dict
        With ``every``, one for each group of cycles: ``cycle``, ``constants`` as above (empty where the cycle could not
        be fitted), ``noise``, and ``why`` it was not fitted, or None.
    sliding_condition : str
        Of the fitted cycle: ``"partial_slip"``, ``"mixed"`` or ``"gross_slip"``.
    sliding_conditions : list of dict
        The sliding condition over the test: ``from`` and ``to``, numbers of cycles, and ``sliding_condition``,
        ``"partial_slip"`` or ``"gross_slip"``. A change must explain more than five cycles.
    removed : dict
        What was taken off the log: offset, drift and bend of the drift of the displacement, offset of the force.
    noise : float
        Standard deviation of the points about the computed loop, relative to the amplitudes.
    notes : list of str
        What the data cannot tell, and what was assumed.
    measured, computed : dict of str to ndarray
        The fitted cycle as measured (``displacement``, ``force``), and the computed loop (``displacement`` of the
        actuator, ``force``, ``shift`` of the contact).
    """

    def __init__(self, answer: Mapping[str, Any], page: str) -> None:
        super().__init__(answer, page, "identify", "cycles")
        self.constants = _constants(answer["parameters"])
        self.fits: list[dict[str, Any]] = [
            {**fit, "constants": _constants(fit["parameters"])} for fit in answer["fits"]
        ]
        for fit in self.fits:
            del fit["parameters"]
        rows = answer["cycles"]
        self.cycles = {name: np.array([row[name] for row in rows], dtype=float) for name in (rows[0] if rows else {})}
        self.skipped: dict[float, str] = {entry["cycle"]: entry["why"] for entry in answer["skipped"]["cycles"]}
        self.sliding_condition: str = answer["sliding_condition"]
        self.sliding_conditions: list[dict[str, Any]] = [dict(span) for span in answer["sliding_conditions"]]
        self.removed: dict[str, float | None] = dict(answer["removed"])
        self.normal_force: float = answer["normal_force"]

    def __repr__(self) -> str:
        """Return the constants and the sliding condition in one line."""
        told = ", ".join(f"{name} = {entry.value:.4g}" for name, entry in self.constants.items() if entry.told)
        return f"Identification({told}; {self.sliding_condition})"

    @checked
    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the measured points, freed from offset and drift, beside the computed loop."""
        axes = self._axes(ax)
        displacement, force = self.measured["displacement"], self.measured["force"]
        time = (np.arange(len(force)) + 0.5) / len(force) - 0.5
        offset, straight, bend = (self.removed[f"displacement_{name}"] or 0.0 for name in ("offset", "drift", "bend"))
        drift = offset + time * straight + (4 * time**2 - 1 / 3) * bend
        axes.plot(displacement - drift, force - (self.removed["force_offset"] or 0.0), ".", ms=3, label="measured")
        axes.plot(self.computed["displacement"], self.computed["force"], label="computed, at the actuator")
        axes.plot(self.computed["shift"], self.computed["force"], "--", label="computed, the contact's own")
        axes.legend(frameon=False)
        return axes

    def _axes(self, axes: "Axes | None") -> "Axes":
        if axes is None:
            axes = matplotlib("matplotlib.pyplot").subplots()[1]
        units = self._answer["units"]
        force = f"{units['force']}/{units['length']}" if self._answer["line_contact"] else units["force"]
        axes.set(xlabel=f"displacement [{units['length']}]", ylabel=f"tangential force [{force}]")
        return axes


@checked
def identify(
    log: str | PathLike[str],
    *,
    case: _case.CaseLike,
    columns: Mapping[str, str | int] | None = None,
    units: Mapping[str, str] | None = None,
    cycle: float | None = None,
    every: int | None = None,
    fit: str | None = None,
    strict: bool = False,
    threads: int | None = None,
) -> Identification:
    """Identify friction coefficient and stiffness of the rig from measured fretting loops.

    Gives the quantities of every cycle, too. The same as ``fret identify``: the loop of the solver, behind a spring,
    is fitted to one cycle by least squares; offsets and a drift of the displacement are fitted with it.

    Parameters
    ----------
    log : path
        CSV file: displacement of the actuator and tangential force; any lines above the names of the columns, commas,
        semicolons or tabs, decimal commas with the last two.
    case : path, str or mapping
        Bodies, profile, grid and the stages that press them.
    columns : mapping, optional
        Names of the columns, or their numbers from 1, of ``"displacement"``, ``"force"``, ``"cycle"``,
        ``"normal_force"``. Default: those of ``rig.columns`` in the case, else usual names.
    units : mapping, optional
        Units of ``"displacement"``, ``"force"``, ``"normal_force"``, such as ``"um"``. Default: those beside the
        names, or those of the case.
    cycle : float, optional
        Number of the cycle that is fitted. Default: the last whole one.
    every : int, optional
        Repeat the fit on the first whole cycle of every so many numbers of cycles, over the whole test; see ``fits``.
    fit : str, optional
        A key of the case that is fitted too, such as ``"lower.substrate.young"``.
    strict : bool, default False
        Refuse a log with a cycle that is no whole loop, or a row without a number. Otherwise these are skipped and
        named, and only a bad cycle that is to be fitted is refused.
    threads : int, optional
        Worker threads. Default: all cores.

    Returns
    -------
    Identification
        Constants with intervals, quantities of the cycles, what was removed, what the data cannot tell.

    Raises
    ------
    CaseError
        When the case is refused.
    ValueError
        When the log cannot be read as fretting loops of such a case; the message says where and what to do.
    UnreadableError
        When the log is no file that can be read; ``MissingFileError`` when there is none.
    RunError
        When a loop cannot be solved.
    """
    if every is not None and every < 1:
        msg = f"every = {every}: must be at least 1"
        raise ValueError(msg)
    asked = named("columns", columns, numbered=True), named("units", units), cycle, every, fit, strict
    json_text, page = _core.identify((str(log), content("log", log)), _case.read(case), asked, threads)
    return Identification(json.loads(json_text), page)
