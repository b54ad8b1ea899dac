"""What a run will do, before it is done."""

import json
from collections.abc import Iterator, Mapping
from typing import Any, TypedDict

from fretting import _case, _core, _notebook, _start
from fretting.errors import Fact


class LeftOut(TypedDict):
    """An automatic simplification."""

    what: str
    """What is not computed."""
    why: str
    """Why it applies to the case."""
    saves: str
    """What that saves."""


class Plan(Mapping[str, Any]):
    """A case made numerical: a read-only mapping, whose entries are attributes too (``plan.grid["cells"]``).

    Keys are ``case``, ``grid`` (``cells``, ``spacing``), ``coupling`` (``"frictionless"``, ``"uncoupled"`` or
    ``"coupled"``), ``increments``, ``memory_bytes`` (without the kept fields), ``kept_bytes`` (those), ``left_out``,
    ``expected`` (``half_widths`` and ``approach`` of the contact under the heaviest load, or None), ``warnings``; and
    what the run is expected to take: ``increments_expected``, ``convolutions_expected``, both None where
    ``memory_lacking`` says that this machine has not the memory for it.

    Attributes
    ----------
    seconds_expected : float or None
        Time that the run will take on all cores of this machine [s], as measured just now: no part of the mapping,
        since it is never twice the same.
    """

    seconds_expected: float | None

    def __init__(self, entries: dict[str, Any], seconds_expected: float | None = None) -> None:
        self._entries = entries
        self.seconds_expected = seconds_expected

    @property
    def left_out(self) -> list[LeftOut]:
        """What is not computed, why, and what that saves."""
        return list(self._entries["left_out"])

    @property
    def warnings(self) -> list[Fact]:
        """What about the case may mislead, as far as the case alone tells: see ``History.warnings``."""
        return list(self._entries["warnings"])

    def __getattr__(self, key: str) -> Any:
        """Entry of that name: ``plan.increments`` is ``plan["increments"]``."""
        entries = self.__dict__.get("_entries", {})
        if key not in entries:
            raise AttributeError(f"a plan has no {key!r}; it has: {', '.join(entries)}")
        return entries[key]

    def __getitem__(self, key: str) -> Any:
        """Entry of that name."""
        if key not in self._entries:
            raise KeyError(f"a plan has no {key!r}; it has: {', '.join(self._entries)}")
        return self._entries[key]

    def __iter__(self) -> Iterator[str]:
        """Names of the entries."""
        return iter(self._entries)

    def __len__(self) -> int:
        """Return the number of entries."""
        return len(self._entries)

    def __repr__(self) -> str:
        """Sizes, expected work, and automatic simplifications."""
        nx, ny = self["grid"]["cells"]
        dx, dy = self["grid"]["spacing"]
        cells = f"{nx} x {ny} cells of {dx:.4g} x {dy:.4g} {(self['case'].get('units') or {}).get('length', '')}"
        lines = [
            f"Plan: {cells.rstrip()}, {self['increments']} increments, {self['coupling']}",
            f"  memory about {_amount(self['memory_bytes'])}, kept fields {_amount(self['kept_bytes'])}",
            f"  {self._expected()}",
        ]
        lines += [f"  simplification: {entry['what']} ({entry['why']})" for entry in self.left_out]
        lines += [f"  warning: {fact['message']}; {fact['help']}" for fact in self.warnings]
        return "\n".join(lines)

    def _expected(self) -> str:
        """Return what the run will take, in words."""
        if self["memory_lacking"]:
            return str(self["memory_lacking"])
        counts = f"{self['convolutions_expected']} convolutions in {self['increments_expected']} increments"
        return counts if self.seconds_expected is None else f"about {counts}, {self.seconds_expected:.2g} s"

    def _repr_html_(self) -> str:
        """Return the same as a table, for notebooks."""
        (nx, ny), (dx, dy) = self["grid"]["cells"], self["grid"]["spacing"]
        facts = [
            ("cells", f"{nx} x {ny} of {dx:.4g} x {dy:.4g}"),
            ("increments", str(self["increments"])),
            ("coupling", str(self["coupling"])),
            ("maximum memory", _amount(self["memory_bytes"])),
            ("kept fields", _amount(self["kept_bytes"])),
            ("expected", self._expected()),
        ]
        facts += [(f"simplification: {entry['what']}", entry["why"]) for entry in self.left_out]
        facts += [("warning", f"{fact['message']}; {fact['help']}") for fact in self.warnings]
        return _notebook.html_table("fretting.Plan", facts)


def _amount(count: int) -> str:
    """Return an amount of memory as a person reads it."""
    return f"{count / 1e6:.1f} MB" if count < 1e9 else f"{count / 1e9:.1f} GB"


def plan(case: _case.CaseLike, *, start: _start.StartLike | None = None) -> Plan:
    """Plan a case: sizes, expected work, and the automatic simplifications. Solves nothing; takes less than a second.

    Parameters
    ----------
    case : path, str or mapping
        Path of a TOML file, TOML text, or a mapping of the same structure.
    start : path, History or pair, optional
        A solved state to start from, as for :func:`fretting.run`.

    Returns
    -------
    Plan
        A mapping; its ``left_out`` lists what is skipped and why.

    Raises
    ------
    CaseError
        When the case is refused.
    OutOfMemoryError
        When there is not the memory to plan it.
    UnreadableError, ValueError, IndexError
        When `start` does not hold the state.
    """
    question = _case.read(case, _start.read(start))
    entries = json.loads(_core.plan(question))
    expected = json.loads(_core.expected(question))
    seconds = expected.pop("seconds_expected")
    return Plan({**entries, **expected}, seconds)
