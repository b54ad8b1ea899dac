"""Running a case."""

from collections.abc import Callable
from typing import Any

from fretting import _case, _core
from fretting._progress import ProgressLine
from fretting.errors import warn
from fretting.history import History


def run(
    case: _case.CaseLike,
    threads: int | None = None,
    progress: bool | Callable[[dict[str, Any]], object] = False,
) -> History:
    """Solve the whole loading history of a case.

    Parameters
    ----------
    case : path, str or mapping
        Path of a TOML file, TOML text, or a mapping of the same structure. A ``str`` is a path when it ends with
        ``.toml`` or names an existing file.
    threads : int, optional
        Worker threads; all cores when not given. The result is the same for any number.
    progress : bool or callable
        ``True`` writes a line to stderr. A callable is called after every increment with a dict of its numbers (the
        names of ``History.steps``) and ``increments``, the number of all increments; what it raises ends the run.

    Returns
    -------
    History
        Numbers of every increment, and the fields that ``[output]`` of the case asks for.

    Raises
    ------
    CaseError
        When the case is refused, with all its mistakes.
    RunError
        When an increment cannot be solved to the tolerance.

    Warns
    -----
    FrettingWarning
        For every fact in ``History.warnings``: numbers that may mislead.

    Notes
    -----
    The interpreter is free for other threads meanwhile, and Ctrl-C ends the run.
    """
    question = _case.read(case)
    if progress is False:
        return _heard(_core.run(question, threads, None))
    if progress is True:
        with ProgressLine() as line:
            return _heard(_core.run(question, threads, line))
    if not callable(progress):
        raise TypeError(f"progress: expected a bool or a callable, found {type(progress).__name__}")
    on_step = progress

    def pass_on(step: dict[str, Any], increments: int) -> None:
        on_step({**step, "increments": increments})

    return _heard(_core.run(question, threads, pass_on))


def _heard(answer: _core.History) -> History:
    """Return the history; what about it may mislead goes to Python's warnings, at the line that called :func:`run`."""
    history = History(answer)
    warn(history.warnings, stacklevel=3)
    return history
