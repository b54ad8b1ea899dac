"""The arguments of public functions: each is checked against its annotation, before work begins.

What is not of the kind is refused with its name, what was found and what is allowed: a ``TypeError`` for another kind
of thing, a ``ValueError`` for a value out of its range, an ``UnreadableError`` for a name that no file can have.
"""

import functools
import importlib
import inspect
import operator
import os
import types
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Literal, ParamSpec, TypeVar, Union, get_args, get_origin

import numpy as np

from fretting.errors import MissingFileError, UnreadableError

P = ParamSpec("P")
T = TypeVar("T")
Check = Callable[[str, Any], Any]


def checked(function: Callable[P, T]) -> Callable[P, T]:
    """Let a function begin only when its arguments are of the kinds that its annotations say.

    Keywords are handed on to matplotlib: what it refuses becomes a ``TypeError``.
    """
    signature = inspect.signature(function)
    checks = {name: check for name, entry in signature.parameters.items() if (check := _check_of(entry))}
    hands_on = any(entry.kind is entry.VAR_KEYWORD for entry in signature.parameters.values())

    @functools.wraps(function)
    def checked_call(*args: P.args, **kwargs: P.kwargs) -> T:
        try:
            bound = signature.bind(*args, **kwargs)
        except TypeError as error:
            raise TypeError(f"{function.__name__}: {error}") from None
        for name, value in bound.arguments.items():
            if name in checks and value is not signature.parameters[name].default:
                bound.arguments[name] = checks[name](name, value)
        if not hands_on:
            return function(*bound.args, **bound.kwargs)
        try:
            return function(*bound.args, **bound.kwargs)
        except AttributeError as error:
            raise TypeError(f"{function.__name__}: {error}") from error

    return checked_call


def _check_of(parameter: inspect.Parameter) -> Check | None:
    """Return what checks a parameter, by its annotation; None where the function checks it itself."""
    annotation = parameter.annotation
    if parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL) or annotation is parameter.empty:
        return None
    if isinstance(annotation, str):
        return _OF_NAMES.get(annotation.removesuffix(" | None"))
    if annotation in _OF_TYPES:
        return _OF_TYPES[annotation]
    if get_origin(annotation) is Literal:
        return functools.partial(word, among=get_args(annotation))
    if get_origin(annotation) in (Union, types.UnionType):
        options = [option for option in get_args(annotation) if option is not types.NoneType]
        if options == [int, str]:
            return stage
        if options == [str, os.PathLike[str]]:
            return path
        if len(options) == 1:
            return _check_of(parameter.replace(annotation=options[0]))
        return None
    if inspect.isclass(annotation) and annotation.__module__.startswith("fretting"):
        return functools.partial(of_kind, kind=annotation)
    return None


def of_kind(name: str, value: object, kind: type[T]) -> T:
    """Return what is of a kind."""
    if not isinstance(value, kind):
        raise TypeError(f"{name}: expected a {kind.__name__}, found {type(value).__name__}")
    return value


def real(name: str, value: Any) -> float:
    """Return a real number as a double; whether it is finite, and its range, are checked by those that use it."""
    if value is np.ma.masked:
        raise ValueError(f"{name}: masked; what is under a mask is no number")
    if isinstance(value, _NO_NUMBERS) and not _is_scalar(value):
        raise TypeError(f"{name} = {_shown(value)}: must be a real number")
    try:
        return float(value)
    except OverflowError:
        raise ValueError(f"{name} = {_shown(value)}: too large for a real number") from None
    except (TypeError, ValueError):
        raise TypeError(f"{name} = {_shown(value)}: must be a real number") from None


_NO_NUMBERS = (bool, np.bool_, str, bytes, bytearray, complex, np.complexfloating, np.datetime64, np.ndarray)
"""Kinds that Python makes numbers of, and nobody else."""


def _is_scalar(value: object) -> bool:
    return isinstance(value, np.ndarray) and value.ndim == 0 and value.dtype.kind in "fiu"


def whole(name: str, value: object) -> int:
    """Return a number that counts as an int; a truth value, a text or a fraction does not count."""
    if isinstance(value, bool | np.bool_):
        raise TypeError(f"{name} = {value!r}: must be a whole number")
    try:
        return operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise TypeError(f"{name} = {_shown(value)}: must be a whole number") from None


def wholes(name: str, values: Any) -> list[int]:
    """Return whole numbers, one after the other."""
    return [whole(f"{name}[{index}]", value) for index, value in enumerate(_listed(name, values))]


def reals(name: str, values: Any) -> list[float]:
    """Return real numbers, one after the other."""
    return [real(f"{name}[{index}]", value) for index, value in enumerate(_listed(name, values))]


def texts(name: str, values: Any) -> list[str]:
    """Return a text, or several, as a list."""
    if isinstance(values, str):
        return [values]
    return [text(f"{name}[{index}]", value) for index, value in enumerate(_listed(name, values))]


MOST = 10_000
"""More entries than that no list of fields, cells, increments or tolerances has."""


def _listed(name: str, values: Any) -> list[Any]:
    if isinstance(values, str | bytes | Mapping):
        raise TypeError(f"{name}: expected several of them, found {type(values).__name__}")
    try:
        found = []
        for value in values:
            found.append(value)
            if len(found) > MOST:
                raise ValueError(f"{name}: more than {MOST} entries")
    except TypeError:
        raise TypeError(f"{name}: expected several of them, found {type(values).__name__}") from None
    return found


def truth(name: str, value: object) -> bool:
    """Return yes or no."""
    if not isinstance(value, bool | np.bool_):
        raise TypeError(f"{name} = {_shown(value)}: must be True or False")
    return bool(value)


def text(name: str, value: object) -> str:
    """Return a text."""
    if not isinstance(value, str):
        raise TypeError(f"{name}: expected a str, found {type(value).__name__}")
    return value


def word(name: str, value: object, among: tuple[Any, ...]) -> Any:
    """Return one of some words."""
    if not isinstance(value, str) or value not in among:
        raise ValueError(f"{name} = {_shown(value)}: must be one of {', '.join(map(repr, among))}")
    return value


def stage(name: str, value: Any) -> int | str:
    """Return the number or the name of a stage; whether there is such a stage is for the history to say."""
    return value if isinstance(value, str) else whole(name, value)


def path(name: str, value: Any) -> str | os.PathLike[str]:
    """Return a path that a file or a folder can have."""
    if not isinstance(value, str | os.PathLike) or not isinstance(os.fspath(value), str):
        raise TypeError(f"{name}: expected a path, found {type(value).__name__}")
    if not os.fspath(value):
        raise UnreadableError(f"error: {name}: an empty name of a file or folder", "")
    try:
        os.lstat(value)
    except (FileNotFoundError, NotADirectoryError, PermissionError):
        pass  # those say it that read or write there
    except (OSError, ValueError) as error:
        shown = os.fspath(value).encode("utf-8", "backslashreplace").decode()
        shown = shown if len(shown) < 80 else f"{shown[:60]}... ({len(shown)} letters)"
        why = error.strerror if isinstance(error, OSError) else error
        raise UnreadableError(f"error: {name} = {shown!r}: no name of a file or folder: {why}", shown) from None
    return value


def content(name: str, value: str | os.PathLike[str]) -> bytes:
    """Return what an ordinary file holds.

    Raises
    ------
    UnreadableError
        When it cannot be read; ``MissingFileError`` when there is none.
    """
    place = Path(path(name, value))
    try:
        if place.exists() and not place.is_file():
            what = "a folder, not a file" if place.is_dir() else "no ordinary file"
            raise UnreadableError(f"error: {place}: {what}", str(place))
        return place.read_bytes()
    except FileNotFoundError:
        here = f"relative names start at the current folder, {Path.cwd()}"
        raise MissingFileError(f"error: {place}: no such file\n  = help: {here}", str(place)) from None
    except UnreadableError:
        raise
    except OSError as error:
        raise UnreadableError(f"error: {place}: cannot be read: {error.strerror or error}", str(place)) from None


def needed(library: str, words: str) -> Any:
    """Return a library that may be missing, or say in these words what needs it and how it is installed."""
    try:
        importlib.import_module(library.partition(".")[0])
        return importlib.import_module(library)
    except ImportError as error:
        raise ImportError(words) from error


def matplotlib(part: str = "matplotlib") -> Any:
    """Return matplotlib or a part of it, which may be missing."""
    return needed(part, "figures need matplotlib: pip install 'fretting[plot]'")


def mapping(name: str, value: Any) -> Mapping[Any, Any]:
    """Return a mapping."""
    if not isinstance(value, Mapping):
        raise TypeError(f"{name}: expected a mapping, found {type(value).__name__}")
    return value


def constants(name: str, value: Any) -> Any:
    """Return constants of a layer as a case has them: numbers, words and tables."""
    from fretting import _case

    return _case.plain(mapping(name, value), name)


def history(name: str, value: Any) -> Any:
    """Return a history."""
    from fretting.history import History

    return of_kind(name, value, History)


def dataset(name: str, value: Any) -> Any:
    """Return an xarray Dataset."""
    library = needed("xarray", f"{name}, an xarray.Dataset, needs xarray: pip install 'fretting[xarray]'")
    return of_kind(name, value, library.Dataset)


def axes(name: str, value: Any) -> Any:
    """Return axes of matplotlib."""
    if not isinstance(value, matplotlib("matplotlib.axes").Axes):
        raise TypeError(f"{name}: expected the axes of a matplotlib figure, found {type(value).__name__}")
    return value


def pair_of_axes(name: str, value: Any) -> Any:
    """Return two axes of matplotlib."""
    if not isinstance(value, tuple | list | np.ndarray) or np.ndim(np.asarray(value, dtype=object)) != 1:
        raise TypeError(f"{name}: expected a pair of axes, found {type(value).__name__}")
    if len(value) != 2:
        raise ValueError(f"{name}: expected a pair of axes, found {len(value)}")
    return tuple(axes(f"{name}[{index}]", one) for index, one in enumerate(value))


def variable(name: str, value: str, found: Any) -> str:
    """Return the name of a variable or a coordinate of a dataset."""
    if value not in found:
        known = ", ".join(map(str, found.variables)) or "nothing"
        raise ValueError(f"{name} = {value!r}: the dataset has {known}")
    return value


def _shown(value: object) -> str:
    """Return a value in few letters."""
    shown = repr(value) if not isinstance(value, int) or abs(value) < 10**40 else "a number of more than 40 digits"
    return shown if len(shown) < 80 else f"{shown[:60]}..."


_OF_TYPES: dict[Any, Check] = {float: real, int: whole, str: text, bool: truth}
_OF_NAMES: dict[str, Check] = {
    "History": history,
    "xarray.Dataset": dataset,
    "FatigueConstants": constants,
    "Axes": axes,
    "tuple[Axes, Axes]": pair_of_axes,
}
