"""What a run will do, before it is done."""

import json
from collections.abc import Iterator, Mapping
from typing import Any, TypedDict

from fretting import _case, _core, plot
from fretting.errors import Fact


class LeftOut(TypedDict):
    """Something the scene does not need."""

    what: str
    """What is not computed."""
    why: str
    """Why the answer is the same without it."""
    saves: str
    """What that saves."""


class Plan(Mapping[str, Any]):
    """A case made numerical: a read-only mapping.

    Keys are ``case``, ``grid`` (``cells``, ``spacing``), ``coupling`` (``"frictionless"``, ``"uncoupled"`` or
    ``"coupled"``), ``increments``, ``memory_bytes``, ``convolutions_expected``, ``left_out``, ``expected`` (``half_widths``
    and ``approach`` of the contact under the heaviest load, or None) and ``warnings``.
    """

    def __init__(self, entries: dict[str, Any]) -> None:
        self._entries = entries

    @property
    def left_out(self) -> list[LeftOut]:
        """What is not computed, why, and what that saves."""
        return list(self._entries["left_out"])

    @property
    def warnings(self) -> list[Fact]:
        """What about the case may mislead, as far as the case alone tells: see ``History.warnings``."""
        return list(self._entries["warnings"])

    def __getitem__(self, key: str) -> Any:  # noqa: ANN401 - entries are of many kinds
        """Entry of that name."""
        return self._entries[key]

    def __iter__(self) -> Iterator[str]:
        """Names of the entries."""
        return iter(self._entries)

    def __len__(self) -> int:
        """Return the number of entries."""
        return len(self._entries)

    def __repr__(self) -> str:
        """Sizes, expected work, and what is left out."""
        nx, ny = self["grid"]["cells"]
        dx, dy = self["grid"]["spacing"]
        lines = [
            f"Plan: {nx} x {ny} cells of {dx:.4g} x {dy:.4g}, {self['increments']} increments, {self['coupling']}",
            f"  about {self['convolutions_expected']} convolutions, {self['memory_bytes'] / 2**20:.1f} MiB at the most",
        ]
        lines += [f"  left out: {entry['what']} ({entry['why']})" for entry in self.left_out]
        lines += [f"  warning: {fact['message']}; {fact['help']}" for fact in self.warnings]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        """Return the same as a table, for notebooks."""
        (nx, ny), (dx, dy) = self["grid"]["cells"], self["grid"]["spacing"]
        facts = [
            ("cells", f"{nx} x {ny} of {dx:.4g} x {dy:.4g}"),
            ("increments", str(self["increments"])),
            ("coupling", str(self["coupling"])),
            ("convolutions expected", str(self["convolutions_expected"])),
            ("memory at the most", f"{self['memory_bytes'] / 2**20:.1f} MiB"),
        ]
        facts += [(f"left out: {entry['what']}", entry["why"]) for entry in self.left_out]
        facts += [("warning", f"{fact['message']}; {fact['help']}") for fact in self.warnings]
        return plot.html_table("fretting.Plan", facts)


def plan(case: _case.CaseLike) -> Plan:
    """Plan a case: sizes, expected work, and what is left out and why. Computes nothing heavy.

    Parameters
    ----------
    case : path, str or mapping
        Path of a TOML file, TOML text, or a mapping of the same structure.

    Returns
    -------
    Plan
        A mapping; its ``left_out`` lists what is skipped and why.

    Raises
    ------
    CaseError
        When the case is refused.
    """
    return Plan(json.loads(_core.plan(_case.read(case))))
