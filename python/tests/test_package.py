"""What is installed."""

import importlib.metadata
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
