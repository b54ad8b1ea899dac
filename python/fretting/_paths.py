"""Places of a case by their keys: ``load.rub.tangential_force.0``, ``lower.coatings[0].young``."""

import re
from collections.abc import Iterator, Sequence
from typing import Any, TypeAlias

from fretting.errors import CaseError

Table: TypeAlias = dict[str, Any]


def steps(path: str) -> list[str]:
    """Return the parts of a path: words as they are, and numbers, in brackets or as parts of their own."""
    return re.sub(r"\[(-?\d+)\]", r".\1", path).split(".")


def put(case: Table, key: str, value: object) -> None:
    """Give the value to the entry of a case that a dotted key names.

    Parts of the key are names of tables, numbers of a list's entries from 0 (negative: from the end), or, in a list of
    tables, the ``name`` of one (a stage); ``load[0]`` is ``load.0`` where nothing is called ``load[0]``. Tables that
    are not there are made; entries of lists are not.
    """
    put_at(case, _parts(case, key), key, value)


def _parts(table: Table, key: str) -> list[str]:
    """Return the parts of a key of a case, numbers in brackets apart where no stage is called with them."""
    here: Any = table
    parts: list[str] = []
    for part in key.split("."):
        numbered = re.fullmatch(r"([^\[\]]+)((?:\[-?\d+\])+)", part)
        stands_there = part in here if isinstance(here, dict) else part in _names(here)
        of_part = steps(part) if numbered and not stands_there else [part]
        parts += of_part
        here = at(here, of_part)
    return parts


def _names(items: Any) -> list[Any]:
    """Return what the tables of a list are called; of anything else nothing."""
    tables = items if isinstance(items, list | tuple) else ()
    return [item.get("name") if isinstance(item, dict) else None for item in tables]


def put_at(case: Table, parts: Sequence[str], key: str, value: object) -> None:
    """Give it to the entry that the parts of the key lead to."""
    here: Any = case
    for depth, part in enumerate(parts):
        last = depth == len(parts) - 1
        place = ".".join(parts[:depth]) or "the case"
        if isinstance(here, dict):
            if last:
                here[part] = value
            else:
                here = here.setdefault(part, {})
        elif isinstance(here, list):
            index = _entry(here, part, key, place)
            if last:
                here[index] = value
            else:
                here = here[index]
        else:
            raise _refusal(f"parameter {key!r}: {place} is {here!r}, which has no entry {part!r}")


def _entry(items: list[Any], part: str, key: str, place: str) -> int:
    try:
        return _index(items, part)
    except ValueError:
        known = ", ".join(repr(name) for name in _names(items) if name) or "none has a name"
        raise _refusal(
            f"parameter {key!r}: no entry of {place} is called {part!r} ({known}); a number from 0 serves as well"
        ) from None
    except IndexError:
        raise _refusal(
            f"parameter {key!r}: {place} has {len(items)} entries, from 0; there is no {int(part)}"
        ) from None


def _walk(table: Any, parts: Sequence[str]) -> Iterator[tuple[str, Any]]:
    """Go along the parts of a key: where each leads, entries of lists by their numbers, and what stands there."""
    for part in parts:
        try:
            key = _index(table, part) if isinstance(table, list | tuple) else part
            table = table[key]
        except (LookupError, TypeError, ValueError):
            key, table = part, None
        yield str(key), table


def _index(items: Any, part: str) -> int:
    """Where a list has what a number, or the name of a stage, stands for."""
    names = _names(items)
    return names.index(part) if part in names else range(len(items))[int(part)]


def place(table: Table, path: str) -> tuple[str, ...]:
    """Return the parts of a path, entries of lists by their numbers: alike for all ways to write one place."""
    return tuple(key for key, _ in _walk(table, _parts(table, path)))


def at(table: Table, parts: Sequence[str]) -> Any:
    """Return what stands at a place of a case; None where there is nothing."""
    return [table, *(found for _, found in _walk(table, parts))][-1]


def _refusal(message: str) -> CaseError:
    """Refuse the sweep itself."""
    return CaseError(f"error: sweep: {message}", [(None, None, message, None)])
