"""Libraries that need not be installed: whatever needs one says so, and how it is installed."""

import subprocess
import sys

import pytest

PROGRAM = """
import sys
LIBRARY = sys.argv[1]
sys.modules[LIBRARY] = None  # as where it is not installed
import fretting
from fretting import plot

CASE = {
    "grid": {"cells": [12, 12], "size": "auto"},
    "upper": {"rigid": True},
    "lower": {"substrate": {"young": 2e11, "poisson": 0.3}},
    "profile": {"sphere": {"radius": 0.01}},
    "friction": {"coefficient": 0.3},
    "load": [
        {"normal_force": 5.0, "increments": 2},
        {"tangential_force": [0.5, 0.0], "cycles": 1, "increments": 8},
    ],
    "output": {"every": 1},
}
history = fretting.run(CASE)
by_matplotlib = {f"History.{name}": getattr(history, name) for name in dir(history) if name.startswith(("plot_", "an"))}
by_matplotlib |= {f"plot.{name}": lambda name=name: getattr(plot, name)(history) for name in plot.__all__}
by_matplotlib |= {
    "History.explore": history.explore,
    "Identification.plot": lambda: fretting.Identification.plot(object.__new__(fretting.Identification)),
    "Indentation.plot": lambda: fretting.Indentation.plot(object.__new__(fretting.Indentation)),
    "plot.field, axes": lambda: plot.field(history, ax=history),
    "plot.scale": lambda: plot.scale(history, "um"),
    "plot.style": plot.style,
}
if LIBRARY == "matplotlib":
    samples = {"load[0].normal_force": fretting.Normal(5.0, 0.1)}
    pressed = {**CASE, "load": CASE["load"][:1]}
    table = fretting.sweep(pressed, {**samples, "profile.sphere.radius": [0.01, 0.02]}, samples=2)
    loops = fretting.sweep(pressed, samples, samples=2, keep="all")
    by_matplotlib |= {
        "plot.band": lambda: plot.band(table, "max_pressure"),
        "plot.band_map": lambda: plot.band_map(
            fretting.sweep(pressed, {**samples, "friction.coefficient": [0.1, 0.2], "profile.sphere.radius": [0.01]},
                           samples=2), "max_pressure", "friction.coefficient", "profile.sphere.radius"),
        "plot.loop_band": lambda: plot.loop_band(loops),
        "plot.regime_map": lambda: plot.regime_map(
            fretting.sweep(pressed, {"friction.coefficient": [0.1, 0.2], "profile.sphere.radius": [0.01, 0.02]}),
            "friction.coefficient", "profile.sphere.radius", variable="regime"),
    }
ENTRIES = {
    "matplotlib": by_matplotlib,
    "xarray": {
        "sweep": lambda: fretting.sweep(CASE, {"friction.coefficient": [0.3]}),
        "study": lambda: fretting.study(CASE),
        "first_order": lambda: fretting.first_order(
            CASE, {"friction.coefficient": fretting.Normal(0.3, 0.01)}, of="max_pressure"),
        "uncertainty": lambda: fretting.uncertainty(history),
        "plot.band": lambda: plot.band(history, "max_pressure"),
        "plot.band_map": lambda: plot.band_map(history, "max_pressure", "x", "y"),
        "plot.loop_band": lambda: plot.loop_band(history),
        "plot.regime_map": lambda: plot.regime_map(history, "x", "y"),
        "History.to_xarray": history.to_xarray,
        "History.subsurface": lambda: history.subsurface([0.0]),
        "History.fatigue": lambda: history.fatigue([0.0]),
        "History.crack": history.crack,
        "History.coating_fracture": history.coating_fracture,
        "History.temperature": lambda: history.temperature(frequency=1.0),
    },
    "anywidget": {"History.explore": history.explore},
    "scipy": {"design": lambda: fretting.design(CASE, by={"friction.coefficient": (0.1, 0.5)}, minimize="max_shear")},
    "jax": {"fretting.jax": lambda: __import__("fretting.jax")},
    "torch": {"fretting.torch": lambda: __import__("fretting.torch")},
}
for name, entry in ENTRIES[LIBRARY].items():
    try:
        entry()
        print(f"{name}: nothing is missing")
    except ImportError as error:
        print("told" if "pip install" in str(error) else f"{name}: {error}")
"""
HOW_MANY = {"matplotlib": 20, "xarray": 14, "anywidget": 1, "scipy": 1, "jax": 1, "torch": 1}
"""Entries that need each, at least: a list that was empty would say nothing."""


@pytest.mark.parametrize("library", HOW_MANY)
def test_what_needs_a_library_that_is_missing_says_how_it_is_installed(library: str) -> None:
    for needed in ("matplotlib", "xarray", "anywidget") if library in ("matplotlib", "xarray", "anywidget") else ():
        pytest.importorskip(needed)
    told = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PROGRAM, library],
        capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert told.returncode == 0, told.stderr
    lines = told.stdout.splitlines()
    assert [line for line in lines if line != "told"] == []
    assert len(lines) >= HOW_MANY[library]
