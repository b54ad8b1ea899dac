"""Figures for a paper: one column wide, and numbers in the units that a reader expects."""

from typing import Any

import numpy as np
import pytest

import fretting

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
plt = pytest.importorskip("matplotlib.pyplot")


@pytest.fixture
def history(fretting_case: dict[str, Any]) -> fretting.History:
    fretting_case["grid"]["cells"] = [16, 16]
    fretting_case["load"][1]["increments"] = 8
    fretting_case["units"] = {"length": "m", "force": "N"}
    return fretting.run(fretting_case)


def ticks(axis: Any) -> tuple[np.ndarray[Any, Any], list[float]]:
    """Places of the ticks, and the numbers written beside them."""
    axis.axes.figure.canvas.draw()
    words = [text.get_text().replace("\N{MINUS SIGN}", "-") for text in axis.get_ticklabels()]
    return axis.get_majorticklocs(), [float(word) for word in words]


def test_a_figure_is_one_column_wide_and_the_look_before_comes_back(history: fretting.History) -> None:
    before = dict(matplotlib.rcParams)
    with fretting.plot.style("paper"):
        axes = history.plot_loop()
        figure: Any = axes.figure
        width, height = figure.get_size_inches()
        assert width * 25.4 == pytest.approx(85.0)
        assert height < width
        assert matplotlib.rcParams["savefig.dpi"] == 300.0
        # nothing of the figure lies outside of it
        figure.canvas.draw()
        inside = figure.get_tightbbox().padded(-0.02)
        assert inside.x0 >= 0.0 and inside.y0 >= 0.0 and inside.x1 <= width and inside.y1 <= height
    assert dict(matplotlib.rcParams) == before
    plt.close("all")


def test_the_legend_of_zones_beside_a_loop_hides_nothing(history: fretting.History) -> None:
    with fretting.plot.style("paper"):
        figure, (left, right) = plt.subplots(1, 2)
        fretting.plot.loop(history, ax=left)
        fretting.plot.zones(history, ax=right)
        figure.canvas.draw()
        legend = right.get_legend()
        words = {text.get_text() for text in legend.get_texts()}
        zones = np.unique(history.field("zone", -1))
        assert words == {("open", "stick", "slip")[int(zone)] for zone in zones}
        around = legend.get_window_extent()
        assert not around.overlaps(right.get_window_extent())
        # whole, on the figure
        inside = figure.bbox
        assert around.x0 >= inside.x0 and around.x1 <= inside.x1 and around.y1 <= inside.y1
    plt.close("all")


def test_axes_are_written_in_other_units(history: fretting.History) -> None:
    axes = fretting.plot.scale(history.plot_loop(), "um", "mN")
    assert axes.get_xlabel().endswith("[um]") and axes.get_ylabel().endswith("[mN]")
    places, numbers = ticks(axes.xaxis)
    np.testing.assert_allclose(numbers, places * 1e6, rtol=1e-9, atol=1e-12)
    places, numbers = ticks(axes.yaxis)
    np.testing.assert_allclose(numbers, places * 1e3, rtol=1e-9, atol=1e-12)
    # twice the same, and back
    assert fretting.plot.scale(axes, "um").get_xlabel().endswith("[um]")
    image = fretting.plot.scale(history.plot_field("pressure"), "um", "MPa")
    assert image.get_xlabel() == "x [um]" and image.get_ylabel() == "y [um]"
    bar: Any = image.images[0].colorbar
    assert "[MPa]" in bar.ax.get_ylabel()
    plt.close("all")


def test_units_that_no_axis_has_are_refused(history: fretting.History, fretting_case: dict[str, Any]) -> None:
    axes = history.plot_loop()
    for unit, words in [("furlong", "not known"), ("MPa", "no axis has a unit of its kind")]:
        with pytest.raises(ValueError, match=words):
            fretting.plot.scale(axes, unit)
    del fretting_case["units"]
    with pytest.raises(ValueError, match="declares its units"):
        fretting.plot.scale(fretting.run(fretting_case).plot_loop(), "um")
    for wrong in (10.0, 1000.0):
        with pytest.raises(ValueError, match="from 20 to 400 mm"):
            fretting.plot.style("paper", width=wrong)
    plt.close("all")
