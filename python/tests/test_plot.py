"""Pictures show the numbers of the history."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting
from fretting._meaning import FIELD_NAMES, label

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")


@pytest.fixture
def history(fretting_case: dict[str, Any]) -> Iterator[fretting.History]:
    fretting_case["grid"]["cells"] = [20, 16]
    fretting_case["load"][1]["increments"] = 8
    fretting_case["output"]["every"] = 2
    yield fretting.run(fretting_case)
    matplotlib.pyplot.close("all")


def test_a_loop_shows_force_over_shift_with_the_state_it_starts_from(history: fretting.History) -> None:
    shift, force = history.plot_loop().lines[0].get_data()
    np.testing.assert_array_equal(shift, history.increments["shift_x"])
    np.testing.assert_array_equal(force, history.increments["tangential_force_x"])
    assert np.size(history.plot_loop(stage="indent").lines[0].get_xdata()) == 1
    with pytest.raises(ValueError, match="no stage is called 'rub'; stages are: indent, fretting"):
        history.plot_loop(stage="rub")
    with pytest.raises(ValueError, match="along = 'z'"):
        history.plot_loop(along="z")  # type: ignore[arg-type]


def test_a_section_passes_between_the_middle_rows(history: fretting.History) -> None:
    x, pressure = history.plot_section("pressure").lines[0].get_data()
    field = history.field("pressure")
    np.testing.assert_array_equal(x, history.x)
    np.testing.assert_allclose(np.asarray(pressure), 0.5 * (field[:, 7] + field[:, 8]), rtol=1e-12)
    y, row = history.plot_section("pressure", along="y", at=history.x[3]).lines[0].get_data()
    np.testing.assert_array_equal(y, history.y)
    np.testing.assert_allclose(np.asarray(row), field[3], atol=1e-9 * field.max())
    with pytest.raises(ValueError, match="outside the grid"):
        history.plot_section("pressure", at=1.0)


def test_maps_have_x_to_the_right_and_y_upwards(history: fretting.History) -> None:
    image = history.plot_field("shear_x").images[0]
    np.testing.assert_array_equal(image.get_array(), history.field("shear_x").T)
    assert image.origin == "lower"
    np.testing.assert_allclose(image.get_extent(), [-150e-6, 150e-6, -150e-6, 150e-6], rtol=1e-12)
    zones = history.plot_zones(increment=2)
    np.testing.assert_array_equal(zones.images[0].get_array(), history.field("zone", 2).T)
    legend = zones.get_legend()
    assert legend is not None
    words = {text.get_text() for text in legend.get_texts()}
    assert words == {("open", "stick", "slip")[zone] for zone in np.unique(history.field("zone", 2))}


@pytest.fixture
def scar(fretting_case: dict[str, Any]) -> Iterator[fretting.History]:
    """A contact that slips and wears."""
    fretting_case["grid"]["cells"] = [20, 16]
    fretting_case["load"][1] = {"shift": [3e-6, 0.0], "cycles": 2, "increments": 8}
    fretting_case["wear"] = {"coefficient": 1e-12}
    fretting_case["output"] = {"fields": ["pressure", "zone", "worn_depth"], "every": 8}
    yield fretting.run(fretting_case)
    matplotlib.pyplot.close("all")


def test_a_scar_is_drawn_as_map_section_and_animation(scar: fretting.History, tmp_path: Path) -> None:
    depth = scar.field("worn_depth")
    assert depth.max() > 0.0
    axes = scar.plot_field("worn_depth")
    np.testing.assert_array_equal(axes.images[0].get_array(), depth.T)
    assert "wear depth of both bodies together [length]" in {one.get_ylabel() for one in axes.figure.axes}
    section = scar.plot_section("worn_depth")
    _, line = section.lines[0].get_data()
    np.testing.assert_allclose(np.asarray(line), 0.5 * (depth[:, 7] + depth[:, 8]), rtol=1e-12)
    assert section.get_ylabel() == "[length]"
    pytest.importorskip("PIL")
    animation = scar.animate_loop("worn_depth")
    animation.save(tmp_path / "scar.gif", writer="pillow", dpi=40)
    np.testing.assert_array_equal(animation._fig.axes[1].images[0].get_array(), depth.T)  # type: ignore[attr-defined]


@pytest.mark.parametrize("name", FIELD_NAMES)
def test_every_field_has_words_for_its_picture(name: str) -> None:
    words = label(name)
    assert words
    assert name == "zone" or words.endswith(("[pressure]", "[length]", "[pressure x length]", "[-]"))


def test_an_animation_has_a_picture_of_every_kept_increment(history: fretting.History, tmp_path: Path) -> None:
    pytest.importorskip("PIL")
    history.animate_loop().save(tmp_path / "loop.gif", writer="pillow", dpi=40)
    from PIL import Image

    with Image.open(tmp_path / "loop.gif") as animation:
        assert getattr(animation, "n_frames", 1) == len([step for step in history.kept_increments if step >= 0])


def test_a_fretting_map_colours_each_point_by_its_regime(fretting_case: dict[str, Any]) -> None:
    pytest.importorskip("xarray")
    fretting_case["grid"] = {"cells": [20, 20], "size": "auto"}
    fretting_case["load"][1] = {"shift": [1e-7, 0.0], "cycles": 1, "increments": 8}
    answer = fretting.sweep(fretting_case, {"load.1.shift.0": [1e-8, 2e-7, 3e-6], "load.0.normal_force": [5.0, 10.0]})
    axes = fretting.plot.regime_map(answer, x="load.1.shift.0", y="load.0.normal_force")
    colours = axes.collections[0].get_array()
    words = [name for name, _ in fretting.plot.REGIMES]
    seen = [[words[int(code)] for code in row] for row in np.asarray(colours)]
    assert seen == answer["cycle_regime"].values.T.tolist()
    assert {row[-1] for row in seen} == {"gross_slip"}
    matplotlib.pyplot.close("all")


def test_without_matplotlib_the_error_says_what_to_install() -> None:
    """Importing the package needs no matplotlib."""
    program = (
        "import sys; sys.modules['matplotlib'] = None; import fretting\n"
        "try: fretting.plot._own_axes(None)\n"
        "except ImportError as error: print(error)"
    )
    said = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=600, check=True)
    assert said.stdout == "figures need matplotlib: pip install 'fretting[plot]'\n"


def test_a_loop_of_torsion_is_moment_over_twist(fretting_case: dict[str, Any]) -> None:
    fretting_case["grid"]["cells"] = [24, 24]
    del fretting_case["load"][1]["tangential_force"]
    fretting_case["load"][1] |= {"twist_moment": 5e-5, "increments": 8}
    history = fretting.run(fretting_case)
    axes = history.plot_loop()
    twist, moment = axes.lines[0].get_data()
    np.testing.assert_array_equal(twist, history.increments["twist"])
    np.testing.assert_array_equal(moment, history.increments["twist_moment"])
    assert axes.get_xlabel() == "twist [rad]"
    np.testing.assert_array_equal(history.plot_loop(along="x").lines[0].get_xdata(), history.increments["shift_x"])
    matplotlib.pyplot.close("all")


def test_loops_over_the_cycles_are_those_of_the_history(fretting_case: dict[str, Any]) -> None:
    fretting_case["friction"]["evolution"] = {"by": "cycles", "last": 0.9, "scale": 4.0, "every": 3, "tolerance": 0.5}
    fretting_case["load"][-1]["cycles"] = 9
    history = fretting.run(fretting_case)
    cycles = history.cycles
    axes: Any = history.plot_loop_stack(lw=0.5)
    assert len(axes.lines) == len(cycles["cycle"]) < 9
    starts = [1, *(cycles["last_cycle"][:-1] + 1)]
    for line, start, first, last in zip(
        axes.lines, starts, cycles["first_increment"], cycles["last_increment"], strict=True
    ):
        across, motion, force = line.get_data_3d()
        assert set(across) == {start}
        assert line.get_linewidth() == 0.5
        np.testing.assert_array_equal(motion[1:], history.increments["shift_x"][first : last + 1])
        np.testing.assert_array_equal(force[1:], history.increments["tangential_force_x"][first : last + 1])
        assert motion[0] == history.increments["shift_x"][first - 1]
    assert len(history.plot_loop_stack(most=2).lines) == 2
    with pytest.raises(ValueError, match="at least 2"):
        history.plot_loop_stack(most=1)


def test_a_stack_of_loops_needs_cycles(sphere_case: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="needs a stage with cycles"):
        fretting.run(sphere_case).plot_loop_stack()
