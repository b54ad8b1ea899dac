"""Write docs/case-format.md from the JSON Schema of the case file.

    python docs/site/case_format.py

A test compares the page with what this would write now.
"""

import json
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
HEAD = """---
search:
  boost: 0.5
---

# Case file: every key

<!-- Written by docs/site/case_format.py from examples/fret.schema.json: edit the comments of the case reader. -->

A case is a TOML file, or the same structure as a Python dict. Any consistent system of units. `fret check CASE` finds
all mistakes at once; `fret schema` prints this page as a JSON Schema, with which editors complete and check a case:
put `#:schema ./fret.schema.json` into its first line.
"""


def page(schema: dict[str, Any]) -> str:
    """Return the page."""
    definitions = schema.get("$defs", {})
    parts = [HEAD, _table("The case", "", schema, definitions)]
    seen = set()
    todo = [(key, name) for key, value in schema["properties"].items() for name in _tables(value, definitions)]
    while todo:
        key, name = todo.pop(0)
        if (key, name) in seen:
            continue
        seen.add((key, name))
        definition = definitions[name]
        parts.append(_table(f"`{key}`", definition.get("description", ""), definition, definitions))
        entries = {**definition.get("properties", {})}
        for choice in definition.get("oneOf", []):
            entries.update(choice.get("properties", {}))
        inner = [(f"{key}.{name}", n) for name, value in entries.items() for n in _tables(_dict(value), definitions)]
        todo = inner + todo
    return "\n".join(parts)


def _table(title: str, text: str, node: dict[str, Any], definitions: dict[str, Any]) -> str:
    required = set(node.get("required", []))
    entries = dict(node.get("properties", {}))
    choices = node.get("oneOf", [])
    for choice in choices:
        described = {"description": choice["description"]} if choice.get("description") else {}
        for key, value in choice.get("properties", {}).items():
            entries[key] = {**_dict(value), **described}
    lines = [f"## {title}\n"]
    if text:
        lines.append(f"{text}\n")
    if choices:
        lines.append("One of:\n")
    lines += ["| key | value | meaning |", "|---|---|---|"]
    for key, given in entries.items():
        value = _dict(given)
        need = " (required)" if key in required and not choices else ""
        meaning = " ".join(_description(value, definitions).split()).replace("|", "\\|")
        lines.append(f"| `{key}`{need} | {_kind(value, definitions)} | {meaning} |")
    return "\n".join(lines) + "\n"


def _dict(value: Any) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def _description(value: dict[str, Any], definitions: dict[str, Any]) -> str:
    if value.get("description"):
        return str(value["description"])
    names = _references(value)
    return str(definitions[names[0]].get("description", "")) if len(names) == 1 else ""


def _references(value: Any) -> list[str]:
    if isinstance(value, dict):
        here = [value["$ref"].rsplit("/", 1)[1]] if "$ref" in value else []
        return here + [n for key, item in value.items() if key not in ("$ref", "properties") for n in _references(item)]
    return [name for item in value for name in _references(item)] if isinstance(value, list) else []


def _tables(value: dict[str, Any], definitions: dict[str, Any]) -> list[str]:
    """Names of the definitions behind a value that are tables of their own, looking through choices."""
    found = []
    for name in _references(value):
        node = definitions[name]
        if "properties" in node or any("properties" in choice for choice in node.get("oneOf", [])):
            found.append(name)
        else:
            inner = {key: item for key, item in node.items() if key in ("anyOf", "oneOf", "items")}
            found += _tables(inner, definitions)
    return found


def _kind(value: dict[str, Any], definitions: dict[str, Any]) -> str:
    if "$ref" in value:
        name = value["$ref"].rsplit("/", 1)[1]
        node = definitions[name]
        is_table = "properties" in node or any("properties" in choice for choice in node.get("oneOf", []))
        return "table" if is_table else _kind(node, definitions)
    for choices in ("anyOf", "oneOf"):
        if choices in value:
            kinds = [_kind(choice, definitions) for choice in value[choices] if choice.get("type") != "null"]
            return " or ".join(dict.fromkeys(kinds))
    if "const" in value:
        return f"`{json.dumps(value['const'])}`"
    if "enum" in value:
        return " or ".join(f"`{json.dumps(word)}`" for word in value["enum"])
    kinds = value.get("type", "any")
    kinds = [kind for kind in ([kinds] if isinstance(kinds, str) else kinds) if kind != "null"]
    words = {"number": "number", "integer": "whole number", "boolean": "true or false", "string": "text"}
    return " or ".join(_list(value, definitions) if kind == "array" else words.get(kind, kind) for kind in kinds)


def _list(value: dict[str, Any], definitions: dict[str, Any]) -> str:
    inner = value.get("items") or (value.get("prefixItems") or [{}])[0]
    count = value.get("minItems")
    many = f"{count} " if count and count == value.get("maxItems") else ""
    kind = _kind(inner, definitions) if inner and inner is not True else "values"
    return f"list of {many}{kind}" + ("s" if kind.endswith(("number", "table")) else "")


if __name__ == "__main__":
    schema = json.loads((ROOT / "examples" / "fret.schema.json").read_text(encoding="utf-8"))
    (ROOT / "docs" / "reference" / "case-format.md").write_text(page(schema), encoding="utf-8")
