"""What is installed."""

import importlib.metadata
import re
import tomllib
from pathlib import Path

import fretting


def test_the_wheel_and_the_module_have_one_version() -> None:
    assert fretting.__version__ == importlib.metadata.version("fretting")


def test_type_hints_are_installed() -> None:
    package = Path(fretting.__file__).parent
    assert (package / "py.typed").exists()
    assert (package / "_core.pyi").exists()


def test_public_names_are_there() -> None:
    for name in fretting.__all__:
        assert getattr(fretting, name) is not None
    for name in fretting.analytic.__all__:
        assert getattr(fretting.analytic, name).__doc__


def test_licences_of_everything_compiled_in_are_in_the_wheel() -> None:
    root = Path(__file__).parents[2]
    lock = tomllib.loads((root / "Cargo.lock").read_text(encoding="utf-8"))["package"]
    locked = {(package["name"], package["version"]) for package in lock if "source" in package}
    text = (root / "LICENSES-THIRD-PARTY").read_text(encoding="utf-8")
    told = set(re.findall(r"^={100}\n(\S+) (\S+): \S.*\n={100}$", text, re.M))
    assert told, "run docs/site/dependencies.py"
    assert told <= locked, f"run docs/site/dependencies.py: {sorted(told - locked)}"
    named = tomllib.loads((root / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["dependencies"]
    only_tools = {"dashu-float", "object", "rand_pcg", "walkdir"}  # of tests and chores
    outside = {name for name, how in named.items() if not (isinstance(how, dict) and "path" in how)} - only_tools
    assert outside <= {name for name, _ in told}, "run docs/site/dependencies.py"
    settings = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert "LICENSES-THIRD-PARTY" in settings["license-files"]
    page = (root / "docs" / "developers" / "dependencies.md").read_text(encoding="utf-8")
    rows = set(re.findall(r"^\| ([\w-]+) \| [^|]* \| [^|]* \| [^|]* \|$", page, re.M))
    ours = {"fret-cli", "fret-core", "fret-drawing", "fret-fft", "fret-results", "fret-table"}
    assert set(named) - ours <= rows, "run docs/site/dependencies.py"
    assert "TODO" not in page
