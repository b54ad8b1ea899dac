"""Write python/fretting/analytic/_generated.py: a function and a class for every closed form of the catalogue.

    python docs/site/closed_forms.py

from the rows and doc comments of crates/fret-core/src/analytic, which come with the installed package.
"""

import json
import re
import textwrap
from pathlib import Path
from typing import Any

from fretting import _core

ROOT = Path(__file__).resolve().parents[2]
HEAD = '''"""Closed forms of the catalogue.

Generated from crates/fret-core/src/analytic by docs/site/closed_forms.py; a test compares the two.
"""

from dataclasses import dataclass, field

import numpy.typing as npt

from fretting._arguments import checked
from fretting._arrays import Reals
from fretting.analytic._solution import (
    Layer,
    Material,
    Solution,
    layer_numbers,
    material_numbers,
    numbers_of,
    solution_of,
    values_of,
)
'''
TYPES = {"f64": "float", "[f64;2]": "tuple[float, float]", "bool": "bool"}
# Of each kind of parameter: how it stands in the signature, its type in the docstring, the numbers it is.
KINDS = {
    "number": ("{}: float", "float", "{}"),
    "number_or_zero": ("{}: float = 0.0", "float", "{}"),
    "sphere": ("{}: Hertz", "Hertz", "*({0}.radius, {0}.force, {0}.modulus)"),
    "cylinder": ("{}: HertzLine", "HertzLine", "*({0}.radius, {0}.line_force, {0}.modulus)"),
    "material": ("{}: Material", "mapping", '*material_numbers("{0}", {0})'),
    "material_or_rigid": (
        "{}: Material | None = None",
        "mapping, optional",
        '*(() if {0} is None else material_numbers("{0}", {0}))',
    ),
    "layer": ("{}: Layer", "mapping", "*layer_numbers({})"),
}
FIRST = ("sphere", "cylinder")


def generated() -> str:
    """Return the module's text."""
    forms = json.loads(_core.closed_forms())
    names = sorted(name for form in forms for name in (form["name"], form["solution"]["title"]))
    listed = "\n__all__ = [\n" + "".join(f'    "{name}",\n' for name in names) + "]\n"
    return HEAD + listed + "".join(_class(form["solution"]) + _function(form) for form in forms)


def _class(solution: dict[str, Any]) -> str:
    what, _, _ = _parts(solution["meaning"])
    lines = ["", "", "@dataclass(frozen=True)", f"class {solution['title']}:", *_docstring([what], 4), ""]
    curves = [function for function in solution["functions"] if function["at"]]
    numbers = [function | {"kind": "f64"} for function in solution["functions"] if not function["at"]]
    for entry in solution["numbers"] + numbers:
        lines += [f"    {entry['name']}: {_type(entry['kind'])}", *_docstring(_plain(entry["meaning"]), 4)]
    if curves:
        lines.append("    _solution: Solution = field(repr=False, compare=False)")
    for curve in curves:
        at = curve["at"]
        named = " and ".join(f"`{one}`" for one in at)
        shape = f"Of the shape of {named}." if len(at) == 1 else f"Of the broadcast shape of {named}."
        first, *more = _plain(curve["meaning"])
        lines += ["", f"    def {curve['name']}(self, {', '.join(f'{one}: npt.ArrayLike' for one in at)}) -> Reals:"]
        lines += _docstring([first, *more, shape], 8)
        given = ", ".join(f"{one}={one}" for one in at)
        lines.append(f'        return values_of(self._solution, "{curve["name"]}", {given})')
    return "\n".join(lines) + "\n"


def _type(kind: str) -> str:
    return TYPES[kind.replace(" ", "")]


def _function(form: dict[str, Any]) -> str:
    solution, parameters = form["solution"], form["parameters"]
    _, notes, source = _parts(solution["meaning"])
    signature = [KINDS[one["kind"]][0].format(one["name"]) for one in parameters]
    first = sum(one["kind"] in FIRST for one in parameters)
    signature.insert(first, "*")
    head = _call(f"def {form['name']}", signature, f" -> {solution['title']}:", 0)
    described = ["Parameters\n----------"]
    for one in parameters:
        described[0] += f"\n{one['name']} : {KINDS[one['kind']][1]}"
        described[0] += "\n" + textwrap.fill(one["meaning"], 112, initial_indent="    ", subsequent_indent="    ")
    sources = [f"References\n----------\n{_filled(source, 4)}"] if source else []
    numbers = [KINDS[one["kind"]][2].format(one["name"]) for one in parameters]
    lines = ["", "", "@checked", head, *_docstring([form["sentence"], *notes, *described, *sources], 4)]
    lines.append(_call("solution = solution_of", [f'"{form["name"]}"', *numbers], "", 4))
    has_curves = any(function["at"] for function in solution["functions"])
    handed = ", _solution=solution" if has_curves else ""
    lines.append(f"    return {solution['title']}(**numbers_of(solution){handed})")
    return "\n".join(lines) + "\n"


def _call(before: str, entries: list[str], after: str, indent: int) -> str:
    """Return a call, or the head of a function, on one line where it fits."""
    line = f"{' ' * indent}{before}({', '.join(entries)}){after}"
    if len(line) <= 120:
        return line
    return textwrap.indent(f"{before}(\n    " + ",\n    ".join(entries) + f",\n){after}", " " * indent)


def _parts(meaning: str) -> tuple[str, list[str], str]:
    """Split the doc comment of a solution: what it is, notes, source."""
    what, *notes = _plain(meaning)
    sources = [note.removeprefix("Source: ").replace("`", "") for note in notes if note.startswith("Source: ")]
    source = " ".join(sources)
    return what, [note for note in notes if not note.startswith("Source: ")], source[:1].upper() + source[1:]


def _plain(meaning: str) -> list[str]:
    """Return the paragraphs of a doc comment, each on one line, without links into the library."""
    paragraphs = [" ".join(part.split()) for part in meaning.split("\n\n")]
    return [re.sub(r"\[(`[^`]+`)\](\([^)]*\))?", r"\1", part) for part in paragraphs]


def _docstring(paragraphs: list[str], indent: int) -> list[str]:
    if len(paragraphs) == 1 and len(paragraphs[0]) + indent + 6 <= 120:
        return [f'{" " * indent}"""{paragraphs[0]}"""']
    blocks = [
        part if part.startswith(("Parameters\n", "References\n")) else _filled(part, indent) for part in paragraphs
    ]
    text = "\n\n".join(blocks)
    return [*textwrap.indent(f'"""{text}\n"""', " " * indent).splitlines()]


def _filled(text: str, indent: int) -> str:
    return textwrap.fill(text, 117 - indent, break_long_words=False, break_on_hyphens=False)


if __name__ == "__main__":
    (ROOT / "python" / "fretting" / "analytic" / "_generated.py").write_text(generated(), encoding="utf-8")
