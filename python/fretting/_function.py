"""Results of a case as a function of some of its numbers: what differentiable programs and optimisers call."""

import copy
from collections.abc import Iterable

import numpy as np

from fretting import _case
from fretting._arguments import texts
from fretting._arrays import Reals
from fretting._points import Table, put
from fretting.differentiating import gradient, value_of
from fretting.simulation import run


class Results:
    """Results of a case as a function of some of its numbers, and how they change."""

    def __init__(
        self, case: _case.CaseLike, of: str | Iterable[str], by: str | Iterable[str], threads: int | None
    ) -> None:
        self.of, self.by = texts("of", of), texts("by", by)
        if not self.of or not self.by:
            raise ValueError("of, by: expected at least one result and one number of the case")
        self._table = _case.table_of(case)
        self._threads = threads

    def at(self, numbers: Reals) -> Table:
        """Return the case with these numbers."""
        case = copy.deepcopy(self._table)
        for path, number in zip(self.by, np.asarray(numbers, dtype=float), strict=True):
            put(case, path.replace("[", ".").replace("]", ""), float(number))
        return case

    def values(self, numbers: Reals) -> Reals:
        """Return the results."""
        history = run(self.at(numbers), threads=self._threads)
        return np.array([value_of(history.increments, history.cycles, name) for name in self.of])

    def differentiated(self, numbers: Reals) -> tuple[Reals, Reals]:
        """Return the results, and the matrix of their derivatives, shape (results, numbers)."""
        found = gradient(self.at(numbers), of=self.of, by=self.by, threads=self._threads)
        rows = [found[name] for name in self.of]
        return np.array([row["value"] for row in rows]), np.array([[row[path] for path in self.by] for row in rows])
