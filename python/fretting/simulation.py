"""Running a case."""

import contextlib
from collections.abc import Callable
from typing import Any

from fretting import _case, _core, _start
from fretting._progress import ProgressLine
from fretting.errors import RunError, RunInterrupted, warn
from fretting.history import History


def run(
    case: _case.CaseLike,
    threads: int | None = None,
    progress: bool | Callable[[dict[str, Any]], object] = False,
    *,
    start: _start.StartLike | None = None,
) -> History:
    """Solve the whole loading history of a case.

    Parameters
    ----------
    case : path, str or mapping
        Path of a TOML file, TOML text, or a mapping of the same structure. A ``str`` is a path when it ends with
        ``.toml`` or names an existing file.
    threads : int, optional
        Worker threads, from 1 to 1024; default: all cores. The result is the same for any number.
    progress : bool or callable
        ``True`` writes the progress to stderr. A callable is called after every increment with a dict of its numbers (the
        names of ``History.steps``), ``increments``, the number of all that are planned, and ``passed``, how many of these
        are behind the run: cycles that a computed one stands for count. What it raises ends the run, and carries the history so
        far as its attribute ``history``.
    start : path, History or pair, optional
        A solved state from which the stages of the case continue: the last one of a folder of results or of a history; of
        another increment as ``(folder or history, increment)`` or ``"folder:increment"``, counted from 0. Tractions,
        motions, slip, wear and dissipated energy continue; what is prescribed there stays until a stage changes it.
        Grid, bodies and profile must be those of the state (``size = "auto"`` takes its grid); loads, friction, wear and
        tolerances are the case's own. Increments count from 0 again. Without: bodies that have not touched yet.

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
        When `start` does not hold the state.

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
    ...     print(f"{rubbed.steps['normal_force'][-1]:.3f} {rubbed.steps['tangential_force_x'][-1]:.3f}")
    10.000 0.500
    10.000 1.000
    """
    question = _case.read(case, _start.read(start))
    if progress is False:
        return ended(*_core.run(question, threads, None), stacklevel=3)
    if progress is True:
        with ProgressLine() as line:
            return ended(*_core.run(question, threads, line), stacklevel=3)
    if not callable(progress):
        raise TypeError(f"progress: expected a bool or a callable, found {type(progress).__name__}")
    on_step = progress

    def pass_on(step: dict[str, Any], increments: int, passed: int) -> None:
        on_step({**step, "increments": increments, "passed": passed})

    return ended(*_core.run(question, threads, pass_on), stacklevel=3)


def ended(answer: _core.History, error: BaseException | None, stacklevel: int = 2) -> History:
    """Return a history that is whole; raise what ended it early, with what there is of it. What about it may mislead goes to
    Python's warnings, `stacklevel` calls up.
    """
    history = History(answer)
    warn(history.warnings, stacklevel=stacklevel)
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
