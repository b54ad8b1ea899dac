"""Say what still keeps a version from being released: ``python .github/scripts/release_ready.py [TAG]``.

The version in ``Cargo.toml`` is the one everywhere, the changelog has a date for it, the registries get an address.
Exit code 1 where something is missing.
"""

import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def missing(tag: str | None) -> list[str]:
    """Return what is missing, one sentence each."""
    cargo = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]
    version = cargo["package"]["version"]
    found = []
    if tag and tag != f"v{version}":
        found.append(f"the tag is {tag}, the version in Cargo.toml {version}")
    if "repository" not in cargo["package"]:
        found.append("Cargo.toml: [workspace.package] has no repository, the crates no repository.workspace = true")
    for name, given in cargo["dependencies"].items():
        if isinstance(given, dict) and "path" in given and given.get("version") != f"={version}":
            found.append(f'Cargo.toml: {name} must have version = "={version}"')
    for name in ("fret-core", "fret-fft", "fret-table", "fret-results", "fret-drawing", "fret-cli"):
        package = tomllib.loads((ROOT / "crates" / name / "Cargo.toml").read_text(encoding="utf-8"))["package"]
        keys = ("description", "readme", "keywords", "categories", "include", "license")
        found += [f"crates/{name}/Cargo.toml: no {key}" for key in keys if key not in package]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    if "urls" not in project:
        found.append("pyproject.toml: no [project.urls] with Documentation, Source, Changelog")
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    if not re.search(rf"^version: {re.escape(version)}$", citation, re.M):
        found.append(f"CITATION.cff: the version is not {version}")
    if not re.search(r"^date-released: \d{4}-\d\d-\d\d$", citation, re.M):
        found.append("CITATION.cff: no date-released")
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    if not re.search(rf"^## \[{re.escape(version)}\]: \d{{4}}-\d\d-\d\d$", changes, re.M):
        found.append(f"CHANGELOG.md: no heading '## [{version}]: YYYY-MM-DD'")
    if not (ROOT / "docs" / "releases" / f"{version}.md").exists():
        found.append(f"docs/releases/{version}.md: no release notes")
    return found


def main() -> None:
    """Print what is missing."""
    found = missing(sys.argv[1] if len(sys.argv) > 1 else None)
    print("\n".join(found) or "nothing is missing")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
