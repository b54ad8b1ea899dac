"""Results of a case as a function of some of its numbers: what differentiable programs and optimisers call."""

import copy
import numbers
from collections.abc import Iterable

import numpy as np

from fretting import _case, _core
from fretting._arguments import texts
from fretting._arrays import Reals
from fretting._paths import Table, at, place, put_at, steps
from fretting.differentiating import is_below, told, value_of
from fretting.simulation import run


class Results:
    """Results of a case as a function of some of its numbers, and how they change."""

    def __init__(
        self, case: _case.CaseLike, of: str | Iterable[str], by: str | Iterable[str], threads: int | None
    ) -> None:
        self.of, self.by = texts("of", of), texts("by", by)
        if not self.of or not self.by:
            raise ValueError("of, by: expected at least one result and one number of the case")
        _core.check_results(self.of)
        self._table = _case.table_from_anywhere(case)
        self._places = [steps(path) for path in self.by]
        alike = [place(self._table, path) for path in self.by]
        for number, (path, parts) in enumerate(zip(self.by, self._places, strict=True)):
            if alike[number] in alike[:number]:
                raise ValueError(f"by: {path} is named twice")
            if not isinstance(at(self._table, parts), numbers.Real):
                raise ValueError(f"by: {path}: no number of the case as it is written; such as 'friction.coefficient'")
        self._threads = threads
        self.start = [float(at(self._table, parts)) for parts in self._places]
        """The numbers of the case as it is."""

    def at(self, numbers: Reals) -> Table:
        """Return the case with these numbers."""
        given = np.asarray(numbers, dtype=float)
        if given.shape != (len(self.by),):
            raise ValueError(
                f"numbers: expected {len(self.by)} of them, in the order of `by`; found shape {given.shape}"
            )
        case = copy.deepcopy(self._table)
        for parts, number in zip(self._places, given, strict=True):
            put_at(case, parts, ".".join(parts), float(number))
        return case

    def values(self, numbers: Reals) -> Reals:
        """Return the results; what has no derivatives is refused here, too."""
        case = self.at(numbers)
        _core.check_derivatives(_case.read(case), self.of, self.by)
        if any(is_below(name) for name in self.of):
            # They are found with derivatives alone, of which one is enough.
            found, _ = told(case, self.of, self.by[:1], self._threads)
            return np.array([found[name]["value"] for name in self.of])
        history = run(case, threads=self._threads)
        return np.array([value_of(history.increments, history.cycles, name) for name in self.of])

    def differentiated(self, numbers: Reals) -> tuple[Reals, Reals]:
        """Return the results, and the matrix of their derivatives, shape (results, numbers)."""
        values, matrix, _ = self.told(numbers)
        return values, matrix

    def told(self, numbers: Reals) -> tuple[Reals, Reals, tuple[int, int, int] | None]:
        """Return the same, and where most cells are about to change their state: increment, cells, cells in contact."""
        found, near = told(self.at(numbers), self.of, self.by, self._threads)
        rows = [found[name] for name in self.of]
        matrix = np.array([[row[path] for path in self.by] for row in rows])
        return np.array([row["value"] for row in rows]), matrix, near
