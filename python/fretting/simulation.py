"""Running a case."""

import contextlib
import json
import os
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeAlias

from fretting import _case, _core, _start
from fretting._arguments import path, truth
from fretting._progress import ProgressLine
from fretting.errors import FrettingWarning, OutOfMemoryError, RunError, RunInterrupted, warn
from fretting.history import History
from fretting.loading import open_results

Told: TypeAlias = Callable[[dict[str, Any]], object]


def run(
    case: _case.CaseLike,
    *,
    threads: int | None = None,
    progress: bool | Callable[[dict[str, Any]], object] = False,
    start: _start.StartLike | None = None,
    folder: str | os.PathLike[str] | None = None,
    resume: bool = False,
    replace: bool = False,
    estimate_error: bool = False,
) -> History:
    """Solve the whole loading history of a case.

    Parameters
    ----------
    case : path, str or mapping
        Path of a TOML file, TOML text, or a mapping of the same structure. A ``str`` with a line break is TOML text,
        any other a path.
    threads : int, optional
        Worker threads, from 1 to 1024; default: all cores. The result is the same for any number.
    progress : bool or callable
        ``True`` writes the progress to stderr. A callable is called after every increment with a dict of its numbers
        (the names of ``History.increments``), ``increments``, the number of all that are planned, and ``passed``, how
        many of these are behind the run: cycles that a computed one stands for count. What it raises ends the run, and
        carries the history so far as its attribute ``history``.
    start : path, History or pair, optional
        A solved state from which the stages of the case continue: the last one of a folder of results or of a history;
        of another increment as ``(folder or history, increment)`` or ``"folder:increment"``, counted from 0. Tractions,
        motions, slip, wear and dissipated energy continue; what is prescribed there stays until a stage changes it.
        Grid, bodies and profile must be those of the state (``size = "auto"`` takes its grid); loads, friction, wear
        and tolerances are the case's own. Increments count from 0 again. Without: bodies that have not touched yet.
    folder : path, optional
        Where results are written while the run goes, as ``fret run --out`` does; the history then reads its fields
        from there. A run that is killed can be resumed. Default: in memory, and :meth:`History.save` afterwards.
    resume : bool
        With `folder`: continue an interrupted run; start if there is none; do nothing if it is solved.
    replace : bool
        With `folder`: replace the results of another case.
    estimate_error : bool
        Also solve an auxiliary coarse case: ``history.error_bars`` then has an error bar for every quantity of
        interest.

    Returns
    -------
    History
        Numbers of every increment, and the fields that ``[output]`` of the case asks for.

    Raises
    ------
    CaseError
        When the case is refused, with all its errors.
    RunError
        When an increment cannot be solved to the tolerance; ``error.history`` holds what was solved before it.
    OutOfMemoryError
        When there is not the memory for the run and the fields it keeps; it is a ``RunError`` and a ``MemoryError``.
    RunInterrupted
        When Ctrl-C is pressed: a ``KeyboardInterrupt`` whose ``history`` holds what was solved.
    UnreadableError, ValueError
        When `start` does not hold the state; when `folder` holds something else or cannot be written.
    IndexError
        When a history to start from has no such increment.

    Warns
    -----
    FrettingWarning
        For every fact in ``History.warnings``: numbers that may mislead.

    Notes
    -----
    The interpreter is free for other threads meanwhile, and Ctrl-C ends the run.

    Examples
    --------
    Press once, then try two amplitudes:

    >>> import fretting
    >>> case = {
    ...     "grid": {"cells": [32, 32], "size": "auto"},
    ...     "upper": {"rigid": True},
    ...     "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
    ...     "profile": {"sphere": {"radius": 10e-3}},
    ...     "friction": {"coefficient": 0.2},
    ... }
    >>> pressed = fretting.run({**case, "load": [{"normal_force": 10.0, "increments": 1}]})
    >>> for force in (0.5, 1.0):
    ...     rub = {"tangential_force": [force, 0.0], "increments": 4}
    ...     rubbed = fretting.run({**case, "load": [rub]}, start=pressed)
    ...     print(f"{rubbed.increments['normal_force'][-1]:.3f} {rubbed.increments['tangential_force_x'][-1]:.3f}")
    10.000 0.500
    10.000 1.000
    """
    resume, replace = truth("resume", resume), truth("replace", replace)
    estimate_error = truth("estimate_error", estimate_error)
    if folder is not None:
        folder = path("folder", folder)
    if folder is None and (resume or replace):
        raise ValueError("resume, replace: of a run with a folder")
    if estimate_error and start is not None:
        raise ValueError(
            "estimate_error: an auxiliary coarse case cannot start from a state; solve the whole history as one case"
        )
    question = _case.read(case, _start.read(start))
    table = _case.table_of(case)
    with _told(progress) as on_step:
        if folder is None:
            history = ended(*_core.run(question, threads, on_step, estimate_error), table, stacklevel=3)
            history._continues = start is not None
            return history
        how = (resume, replace, estimate_error)
        return _ended_in(Path(folder), _core.run_into(question, Path(folder), how, threads, on_step), stacklevel=3)


@contextlib.contextmanager
def _told(progress: bool | Told) -> Iterator[Callable[[dict[str, Any], int, int], object] | None]:
    """Give what hears of every increment."""
    if progress is False:
        yield None
    elif progress is True:
        with ProgressLine() as line:
            yield line
    elif callable(progress):
        yield lambda step, increments, passed: progress({**step, "increments": increments, "passed": passed})
    else:
        raise TypeError(f"progress: expected a bool or a callable, found {type(progress).__name__}")


def _ended_in(folder: Path, error: BaseException | None, stacklevel: int) -> History:
    """Return the history in a folder that a run has just left; raise what ended it early."""
    if isinstance(error, ValueError | OSError) or (isinstance(error, OutOfMemoryError) and not error.increment):
        raise error  # refused: nothing was begun
    history = open_results(folder)
    warn(history.warnings, stacklevel=stacklevel)
    return _or_raised(history, error)


def ended(answer: _core.History, error: BaseException | None, case: dict[str, Any], stacklevel: int = 2) -> History:
    """Return a history that is whole; raise what ended it early, with what there is of it.

    What about it may mislead goes to Python's warnings, `stacklevel` calls up.
    """
    history = History(answer, case)
    warn(history.warnings, stacklevel=stacklevel)
    if why := json.loads(answer.error_bars() or "{}").get("missing"):
        warnings.warn(f"no error bars: {why}", FrettingWarning, stacklevel=stacklevel)
    return _or_raised(history, error)


def _or_raised(history: History, error: BaseException | None) -> History:
    """Return a history that is whole; raise what ended it early, with what there is of it."""
    if error is None:
        return history
    history.status, history.message = "interrupted", str(error) or type(error).__name__
    if isinstance(error, RunError):
        history.status = "failed"
        error.history = history
        raise error
    if type(error) is KeyboardInterrupt:
        history.message = f"stopped by Ctrl-C in increment {len(history)}"
        raise RunInterrupted(f"{history.message}; what was solved is in .history of this exception", history) from None
    with contextlib.suppress(AttributeError):
        error.history = history  # type: ignore[attr-defined]
    raise error
