"""Many cases: a base case, and axes along which it changes."""

import contextlib
import json
import os
import pickle
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from fretting import _case, _core, _start
from fretting._arguments import needed, path, truth, word
from fretting._meaning import CYCLE_MEANING, MEANING, described, in_units
from fretting._measuring import UNMEASURED, Measuring, all_measured, measured_variable
from fretting._paths import Table
from fretting._points import Dimension, Draw, Parameters, Point, dimensions, is_uncertain, points
from fretting._progress import PointLine
from fretting._sweep_folder import SweepFolder
from fretting.errors import CaseError, OutOfMemoryError, RunError
from fretting.history import History
from fretting.simulation import ended

if TYPE_CHECKING:
    import xarray

Keep: TypeAlias = Literal["last", "stages", "all"]
Measure: TypeAlias = Callable[[History], Mapping[str, Any]]
Told: TypeAlias = Callable[[dict[str, Any]], object]

_LENGTH = {"last": None, "stages": "stage", "all": "increment"}
"""Dimension, beside the axes, that the numbers of a history have."""

_NEEDS_XARRAY = "a sweep returns an xarray.Dataset: pip install 'fretting[xarray]'"


def sweep(
    base_case: _case.CaseLike,
    parameters: Parameters,
    *,
    executor: Executor | None = None,
    keep: Keep = "last",
    measure: Measure | None = None,
    folder: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    progress: bool | Told = False,
    start: _start.StartLike | None = None,
    samples: int | None = None,
    seed: int = 0,
    indices: bool = False,
) -> "xarray.Dataset":
    """Solve a case at all points of a grid of its parameters, or at samples of uncertain ones.

    Parameters
    ----------
    base_case : path, str or mapping
        As for :func:`fretting.run`.
    parameters : mapping or list of mappings
        A mapping from keys of the case to values gives their Cartesian product. A key is dotted
        (``"friction.coefficient"``); entries of lists go by number or, stages, by name (``"load.1.shift"`` or
        ``"load[1].shift"``, ``"load.indent.normal_force"``, ``"load.1.tangential_force.0"``). A tuple of keys with
        tuples of values makes several keys change together; a name with a :class:`Parameter` stands for a key of the
        case, or changes the case by a function. A list of mappings from keys to values is a list of points, along one
        dimension ``point``. A :class:`Distribution` in place of values makes a key uncertain: all of them are drawn
        together, along one dimension ``sample``, beside the other axes.
    executor : concurrent.futures.Executor, optional
        Where the points are solved: threads, processes, a dask client's ``get_executor()``, ``MPIPoolExecutor``.
        Default: the calling thread, one after the other. What points begin with alike is solved once, in this thread
        and in threads, unless `measure` is given; processes solve every point on its own. The answers are the same
        bits.
    keep : {"last", "stages", "all"}
        Which increments the result has: the last of the history, the last of every stage (dimension ``stage``), or all
        (dimension ``increment``).
    measure : callable, optional
        Called with the :class:`History` of every solved point, where it was solved; the numbers, words and arrays of
        the mapping it returns (``{"peak": 1e9}``) become variables. What it raises at the first point that is solved
        ends the sweep; at a later one the numbers of the point stay, what is measured is missing (NaN, or an empty
        text), and ``error`` says why. An executor of processes needs a function that can be pickled.
    folder : path, optional
        Where finished points are written down, each as soon as it is solved; points found there are not solved again.
        A point that changed in any way (another base case, a file it names, `keep`, the version) is another point.
    threads : int, optional
        Threads of one solve. Without: 1 with an executor, all cores without one. Results do not depend on it.
    progress : bool or callable
        ``True`` writes the progress to stderr. A callable is called after every point with a dict: ``done``,
        ``points``, ``failed``, ``name`` and ``status`` of the point.
    start : path, History or pair, optional
        A solved state that every point starts from, as for :func:`fretting.run`: press once, branch into many loads.
    samples : int, optional
        Samples of the distributions, 2 to 65536; a power of two is spread most evenly (Sobol' points).
    seed : int
        Chooses one set of samples of many; the same seed, the same samples.
    indices : bool
        Also solve the points that Sobol' indices need: ``samples * (uncertain keys + 2)`` in all. :func:`uncertainty`
        then has them.

    Returns
    -------
    xarray.Dataset
        One dimension per parameter, named by its key or name; parameters whose values are no plain numbers or words
        count from 0, their values stand as text in ``NAME_values``. Variables: the names of ``History.increments``;
        those of the last cycle as ``cycle_dissipated_energy``, ``cycle_energy_ratio``, ``cycle_regime`` and so on (see
        :class:`History`); ``status`` (``"solved"``, ``"refused"``, ``"failed"``) and ``error``, the message of a point
        that was not solved. Numbers of such points are NaN, counts -1, words empty. The attribute ``solved_before``
        counts the solved points found in `folder`, ``increments_in_common`` the increments that points took from
        beginnings solved for others.

    Raises
    ------
    CaseError
        When a parameter does not exist in the case, or every point is refused.
    RunError
        When no point could be solved.
    UnreadableError
        When `folder` cannot be used, or a file cannot be read.
    IndexError
        When a history to start from has no such increment.
    ImportError
        When xarray is not installed (``pip install fretting[xarray]``).
    OutOfMemoryError
        When as many points as the executor has workers need more memory than there is.
    concurrent.futures.BrokenExecutor
        When the executor itself breaks down. What is finished stands in `folder`.

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
    >>> answer = fretting.sweep(case, {"load.0.normal_force": [5.0, 10.0], "lower.substrate.poisson": [0.2, 0.3, 0.4]})
    >>> answer["approach"].dims, answer["approach"].shape
    (('load.0.normal_force', 'lower.substrate.poisson'), (2, 3))
    """
    needed("xarray", _NEEDS_XARRAY)
    word("keep", keep, tuple(_LENGTH))
    if executor is not None and (isinstance(executor, type) or not callable(getattr(executor, "submit", None))):
        found_one = f"the class {executor.__name__}" if isinstance(executor, type) else type(executor).__name__
        raise TypeError(f"executor: expected a concurrent.futures.Executor, found {found_one}")
    if measure is not None and not callable(measure):
        raise TypeError(f"measure: expected a function of a History, found {type(measure).__name__}")
    _core.check_threads(threads)
    base = _as_table(base_case)
    draw = Draw(samples, seed, truth("indices", indices))
    found = dimensions(parameters, draw)
    asked = list(points(base, found))
    settings = {"keep": keep, "measure": None if measure is None else _name_of(measure)}
    origin = _start.read(start)
    if origin is not None:
        settings["start"] = origin.digest()
    store = None if folder is None else SweepFolder(path("folder", folder), base, settings)
    answers: dict[tuple[int, ...], Table] = {}
    measuring = Measuring({name for one in found for name in (one.name, *one.coordinates)})
    if store:
        for point in asked:
            before = store.finished(point.case)
            if before:
                answers[point.place] = before
                measuring.judge(point, before, None)
    solved_before = sum(answer["status"] == "solved" for answer in answers.values())
    threads = threads or (None if executor is None else 1)
    open_points = [point for point in asked if point.place not in answers]
    _fits_memory(open_points, executor)
    asked_of_all = _Asked(origin, threads, keep, measure)
    with _Teller(progress, len(asked), answers.values()) as tell:
        tasks = [_Task(json.dumps(point.case), point.name, asked_of_all) for point in open_points]
        in_common = _in_common(tasks, executor)
        for point, solved, lasting in _solved(open_points, tasks, executor, in_common):
            answer = measuring.judge(point, solved.answer, solved.failure)
            if store and lasting and not answer["error"].startswith(UNMEASURED):
                store.keep(point.case, answer)
            answers[point.place] = answer
            tell(point, answer)
    _refuse_where_nothing_is_solved([answers[point.place] for point in asked])
    measuring.warn(len(asked))
    increments = 0 if in_common is None else in_common.increments()
    attributes: dict[str, Any] = {"solved_before": solved_before, "increments_in_common": increments}
    if samples is not None and isinstance(parameters, Mapping):
        uncertain = [str(key) for key, values in parameters.items() if is_uncertain(values)]
        attributes |= {"samples": samples, "seed": seed, "indices": int(indices), "uncertain": uncertain}
    return _dataset(found, answers, keep, attributes)


def _refuse_where_nothing_is_solved(answers: list[Table]) -> None:
    statuses = {answer["status"] for answer in answers}
    if "solved" in statuses:
        return
    first = answers[0]
    if statuses == {"refused"}:
        raise CaseError(f"all {len(answers)} points of the sweep are refused; the first:\n{first['error']}",
                        [tuple(mistake) for mistake in first["mistakes"]])  # fmt: skip
    first = next(answer for answer in answers if answer["status"] == "failed")
    raise RunError(f"none of the {len(answers)} points of the sweep is solved; the first failure:\n{first['error']}")


def _fits_memory(asked: list[Point], executor: Executor | None) -> None:
    """Refuse points beside each other that need more memory than there is.

    Where the number of workers is not told, each point finds out by itself.
    """
    beside = min(getattr(executor, "_max_workers", 1), len(asked))
    if beside < 2:
        return

    def cells(point: Point) -> float:
        try:
            nx, ny = point.case["grid"]["cells"]
            return float(nx) * float(ny)
        except (KeyError, TypeError, ValueError):
            return 0.0  # refused when it is read

    largest = max(asked, key=cells)
    try:
        needed = _core.memory_needed(_core.Case.from_json(json.dumps(largest.case), largest.name, Path(), []))
    except CaseError:
        return
    _core.check_memory(f"{beside} points of {largest.name} beside each other", beside * needed)


def _as_table(case: _case.CaseLike) -> Table:
    """Return the base case as a dict; it need not be a whole case yet."""
    if isinstance(case, Mapping):
        table = _case.plain(case, "")
        assert isinstance(table, dict)
        return table
    return _case.table_from_anywhere(case)


def _name_of(measure: Measure) -> str:
    return f"{getattr(measure, '__module__', '')}.{getattr(measure, '__qualname__', type(measure).__qualname__)}"


class _Asked(NamedTuple):
    """What is asked of every point."""

    origin: _core.Start | None
    threads: int | None
    keep: Keep
    measure: Measure | None


class _Task(NamedTuple):
    """What a worker needs to know."""

    text: str
    name: str
    asked: _Asked

    def case(self) -> _core.Case:
        return _core.Case.from_json(self.text, self.name, Path(), [], self.asked.origin)


def _in_common(tasks: list[_Task], executor: Executor | None) -> _core.InCommon | None:
    """Return what points that are solved in this process have in common.

    The fields of a common beginning belong to none of them: where all of a history is measured, every point has its
    own.
    """
    if len(tasks) < 2 or not (executor is None or isinstance(executor, ThreadPoolExecutor)):
        return None
    histories = []
    for number, task in enumerate(tasks):
        if task.asked.measure is None:
            with contextlib.suppress(CaseError, OutOfMemoryError):  # its own answer tells of it
                histories.append((number, task.case().beginnings()))
    return _core.InCommon(histories)


class _Solved(NamedTuple):
    """The answer of a point, and what `measure` raised there."""

    answer: Table
    failure: Exception | None = None


def _solve_elsewhere(task: _Task, point: tuple[_core.InCommon, int] | None = None) -> _Solved:
    """Solve one point in another process: an exception that cannot travel goes as its words."""
    answer, failure = _solve(task, point)
    try:
        pickle.loads(pickle.dumps(failure))
    except Exception:
        failure = RuntimeError(f"{type(failure).__name__}: {failure}")
    return _Solved(answer, failure)


def _solve(task: _Task, point: tuple[_core.InCommon, int] | None = None) -> _Solved:
    """Solve one point, wherever this is called; only what a person can do something about is caught."""
    try:
        history = ended(*_core.run(task.case(), task.asked.threads, None, False, point), json.loads(task.text))
    except CaseError as error:
        return _Solved(_answer("refused", str(error), mistakes=[list(mistake) for mistake in error.mistakes]))
    except OutOfMemoryError:
        raise  # no answer of the point: there may be room for it another time
    except RunError as error:
        return _Solved(_answer("failed", str(error)))
    rows = _rows(history, task.asked.keep)
    found, failure = {}, None
    if task.asked.measure is not None:
        try:
            found = all_measured(task.asked.measure(history))
        except Exception as error:  # a mistake of the function, not of the point
            failure = error
    steps = {
        name: column[rows].tolist()
        for name, column in history.increments.items()
        if (column[rows] == column[rows]).all()  # not a number: there is none
    }
    cycle = {
        name: column[-1].item()
        for name, column in history.cycles.items()
        if len(column) and column[-1] == column[-1]  # not a number: there is none
    }
    answer = _answer("solved", "", steps=steps, cycle=cycle, measured=found, units=history._units)
    return _Solved(answer, failure)


def _answer(status: str, error: str, **found: Any) -> Table:
    """Return what is known of a point, whether solved or not."""
    return {"status": status, "error": error, "steps": {}, "cycle": {}, "measured": {}, "mistakes": [], **found}


def _rows(history: History, keep: Keep) -> npt.NDArray[np.int64]:
    if keep == "all":
        return np.arange(len(history))
    if keep == "last":
        return np.asarray([len(history) - 1])
    stage = history.increments["stage"]
    return np.flatnonzero(np.append(stage[1:] != stage[:-1], True))


def _solved(
    points: list[Point], tasks: list[_Task], executor: Executor | None, in_common: _core.InCommon | None
) -> Iterator[tuple[Point, _Solved, bool]]:
    """Answers as they come, and whether each would be the same another time."""
    shared = [None if in_common is None else (in_common, number) for number in range(len(tasks))]
    if executor is None:
        for point, task, common in zip(points, tasks, shared, strict=True):
            try:
                yield point, _solve(task, common), True
            except Exception as error:  # whatever it is belongs to this point alone
                yield point, _surprise(error), False
        return
    solve = _solve if isinstance(executor, ThreadPoolExecutor) else _solve_elsewhere
    futures: dict[Future[_Solved], Point] = {
        executor.submit(solve, task, common): point for point, task, common in zip(points, tasks, shared, strict=True)
    }
    try:
        for future in as_completed(futures):
            try:
                yield futures[future], future.result(), True
            except BrokenExecutor:
                raise
            except Exception as error:
                yield futures[future], _surprise(error), False
    finally:
        for future in futures:
            future.cancel()


def _surprise(error: Exception) -> _Solved:
    return _Solved(_answer("failed", f"{type(error).__name__}: {error}"))


class _Teller:
    """Tells about every point."""

    def __init__(self, progress: bool | Told, count: int, before: Any) -> None:
        if not isinstance(progress, bool) and not callable(progress):
            raise TypeError(f"progress: expected a bool or a callable, found {type(progress).__name__}")
        self._line = PointLine() if progress is True else None
        self._told: Told | None = progress if callable(progress) else self._line
        self._count = count
        statuses = [answer["status"] for answer in before]
        self._done, self._failed = len(statuses), sum(status != "solved" for status in statuses)

    def __enter__(self) -> "_Teller":
        return self

    def __call__(self, point: Point, answer: Table) -> None:
        self._done += 1
        self._failed += answer["status"] != "solved"
        if self._told:
            news = {"done": self._done, "points": self._count, "failed": self._failed}
            self._told({**news, "name": point.name, "status": answer["status"]})

    def __exit__(self, *_: object) -> None:
        if self._line:
            self._line.end()


def _dataset(
    found: list[Dimension], answers: dict[tuple[int, ...], Table], keep: Keep, attributes: dict[str, Any]
) -> "xarray.Dataset":
    module = needed("xarray", _NEEDS_XARRAY)
    names = tuple(dimension.name for dimension in found)
    shape = tuple(len(dimension.changes) for dimension in found)
    variables: dict[str, Any] = {}
    for name, fill in (("status", "not solved"), ("error", "")):
        column = np.full(shape, fill, dtype=object)
        for place, answer in answers.items():
            column[place] = answer[name]
        variables[name] = (names, column.astype(str))
    units: dict[str, str] = next((answer["units"] for answer in answers.values() if answer.get("units")), {})
    extra = _LENGTH[keep]
    length = max((len(answer["steps"].get("increment", ())) for answer in answers.values()), default=0)
    for name in _all_names(answers, "steps"):
        if name == extra:
            continue
        table = _filled(shape if extra is None else (*shape, length), _sample(answers, "steps", name))
        for place, answer in answers.items():
            column = answer["steps"].get(name)
            if column is not None:
                if extra is None:
                    table[place] = column[0]
                else:
                    table[place][: len(column)] = column
        dims = names if extra is None else (*names, extra)
        variables[name] = (dims, table, described(MEANING[name], units))
    drives = [answer["cycle"]["drive"] for answer in answers.values() if "drive" in answer["cycle"]]
    for name in _all_names(answers, "cycle"):
        table = _filled(shape, _sample(answers, "cycle", name))
        for place, answer in answers.items():
            if name in answer["cycle"]:
                table[place] = answer["cycle"][name]
        meaning = described(f"last cycle: {CYCLE_MEANING[name]}", units, drives)
        variables[f"cycle_{name}"] = (names, table, meaning)
    for name in _all_names(answers, "measured"):
        variables[name] = measured_variable(name, names, shape, answers)
    coordinates: dict[str, Any] = {}
    for dimension in found:
        for key, values in dimension.coordinates.items():
            plain = all(isinstance(value, int | float | str) for value in values)
            label = key if plain else f"{key}_values"
            entries = np.asarray(values if plain else [json.dumps(value) for value in values])
            kind = _core.kind_of_key(dimension.keys.get(key, key)) if units else None
            coordinates[label] = (dimension.name, entries, {"units": in_units(kind, units)} if kind else {})
    if extra and length:
        coordinates[extra] = (extra, np.arange(length))
    dataset: xarray.Dataset = module.Dataset(variables, coords=coordinates, attrs=attributes)
    return dataset


def _all_names(answers: dict[tuple[int, ...], Table], part: str) -> list[str]:
    return list(dict.fromkeys(name for answer in answers.values() for name in answer[part]))


def _sample(answers: dict[tuple[int, ...], Table], part: str, name: str) -> Any:
    value = next(answer[part][name] for answer in answers.values() if name in answer[part])
    return value[0] if isinstance(value, list) else value


def _filled(shape: tuple[int, ...], sample: object) -> npt.NDArray[Any]:
    """Return an array of nothing, of the kind of the sample."""
    if isinstance(sample, str):
        return np.full(shape, "", dtype="<U12")
    if isinstance(sample, int):
        return np.full(shape, -1, dtype=np.int64)
    return np.full(shape, np.nan)
