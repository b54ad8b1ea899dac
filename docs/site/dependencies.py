"""Write what is known of the dependencies: the table of ``docs/developers/dependencies.md`` and the licences that go
into the wheel.

    python docs/site/dependencies.py

Reads ``cargo metadata`` and the local copy of the registry: no network. Purposes stand in the page, one line per
crate; licences and dates of the newest release come from the registry. ``LICENSES-THIRD-PARTY`` holds the licence
texts of every crate that is compiled into the wheel; ``pyproject.toml`` puts it there. A test compares the crates in
it with ``Cargo.lock``.
"""

import json
import os
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "developers" / "dependencies.md"
LICENCES = ROOT / "LICENSES-THIRD-PARTY"
WORDS = re.compile(r"(?i)^(licen[cs]e|copying|copyright|notice|unlicense)")


def metadata() -> dict[str, object]:
    """Return what cargo knows of the workspace, for the platforms that wheels are built for."""
    release = (ROOT / ".github" / "workflows" / "release.yml").read_text(encoding="utf-8")
    targets = re.findall(r"target: ([\w-]+),", release)
    call = ["cargo", "metadata", "--format-version=1", "--locked", "--offline"]
    call += [f"--filter-platform={target}" for target in targets]
    return dict(json.loads(subprocess.run(call, check=True, capture_output=True, text=True, cwd=ROOT).stdout))


def compiled_in(known: dict[str, object], root: str) -> list[dict[str, object]]:
    """Return the crates that a crate of the workspace has in it, without those that only build or test it."""
    packages = {package["id"]: package for package in known["packages"]}
    edges = {node["id"]: node["deps"] for node in known["resolve"]["nodes"]}
    todo = [key for key, package in packages.items() if package["name"] == root and package["source"] is None]
    seen: set[str] = set()
    while todo:
        key = todo.pop()
        if key in seen:
            continue
        seen.add(key)
        todo += [d["pkg"] for d in edges[key] if any(kind["kind"] is None for kind in d["dep_kinds"])]
    outside = (packages[key] for key in seen if packages[key]["source"])
    return sorted(outside, key=lambda package: (package["name"], package["version"]))


def licence_texts() -> str:
    """Return the licences of everything in the wheel."""
    seen: dict[str, str] = {}
    parts = ["Crates that are compiled into the Python wheel and the command on any platform, with their licences.\n"]
    for package in compiled_in(metadata(), "fret-py"):
        folder = Path(package["manifest_path"]).parent
        files = sorted(path for path in folder.iterdir() if path.is_file() and WORDS.match(path.name))
        head = f"{package['name']} {package['version']}: {package['license']}"
        texts = []
        for path in files:
            text = path.read_text(encoding="utf-8", errors="replace").strip()
            first = seen.setdefault(text, f"{package['name']} {package['version']}, {path.name}")
            is_first = first.startswith(f"{package['name']} {package['version']},")
            texts.append(f"--- {path.name}\n{text if is_first else f'The text of {first}.'}\n")
        said = "\n".join(texts) or f"The crate holds no file with a licence. See {package['repository']}\n"
        parts.append(f"{'=' * 100}\n{head}\n{'=' * 100}\n{said}")
    return "\n".join(parts)


def newest_release(name: str) -> str:
    """Return version and month of the newest release in the local copy of the registry's index."""
    letters = {1: f"1/{name}", 2: f"2/{name}", 3: f"3/{name[:1]}/{name}"}.get(
        len(name), f"{name[:2]}/{name[2:4]}/{name}"
    )
    home = Path(os.environ.get("CARGO_HOME", Path.home() / ".cargo"))
    places = [place for place in home.glob(f"registry/index/*/.cache/{letters}") if place.is_file()]
    found = [
        json.loads(part)
        for place in places
        for part in re.findall(rb'\{"name".*?\}(?=\x00|$)', place.read_bytes(), re.S)
    ]
    plain = [entry | {"vers": entry["vers"].partition("+")[0]} for entry in found if not entry.get("yanked")]
    dated = [entry for entry in plain if entry.get("pubtime") and "-" not in entry["vers"]]
    if not dated:
        return ""
    last = max(dated, key=lambda entry: [int(part) for part in entry["vers"].split(".")])
    return f"{last['vers']}, {last['pubtime'][:7]}"


def rows() -> list[str]:
    """Return the rows of the table, purposes as they stand in the page."""
    written = PAGE.read_text(encoding="utf-8")
    purpose = dict(re.findall(r"^\| ([\w-]+) \| [^|]* \| [^|]* \| ([^|]*) \|$", written, re.M))
    known = metadata()
    packages = {package["name"]: package for package in known["packages"]}
    ours = [package for package in known["packages"] if package["source"] is None]
    named = {dep["name"] for package in ours for dep in package["dependencies"] if dep["source"]}
    table = []
    for name in sorted(named & set(packages)):
        package = packages[name]
        licence = str(package["license"]).replace(" OR ", " or ").replace("/", " or ").replace(" AND ", " and ")
        table.append(f"| {name} | {licence} | {newest_release(name)} | {purpose.get(name, 'TODO')} |")
    return table


def main() -> None:
    """Write both."""
    LICENCES.write_text(licence_texts(), encoding="utf-8")
    written = PAGE.read_text(encoding="utf-8")
    head = "| Crate | Licence | Newest release | For |\n|---|---|---|---|\n"
    begin = written.index(head) + len(head)
    end = written.index("\n\n", begin)
    PAGE.write_text(written[:begin] + "\n".join(rows()) + written[end:], encoding="utf-8")


if __name__ == "__main__":
    main()
