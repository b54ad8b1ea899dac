"""The widget of a history: what its slider and its choice show is what the history holds."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting
import fretting.plot

pytest.importorskip("anywidget", reason="a widget needs anywidget")
matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
traitlets = pytest.importorskip("traitlets")

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "python" / "fretting" / "_explorer.js"


@pytest.fixture(scope="module")
def history() -> fretting.History:
    return fretting.run(
        {
            "units": {"length": "m", "force": "N"},
            "grid": {"cells": [24, 20], "size": [240e-6, 200e-6]},
            "upper": {"rigid": True},
            "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
            "profile": {"sphere": {"radius": 10e-3}},
            "friction": {"coefficient": 0.3},
            "load": [
                {"name": "press", "normal_force": 12.0, "increments": 4, "ramp": "cubic"},
                {"name": "rub", "tangential_force": [2.5, 0.0], "cycles": 1, "increments": 8},
            ],
            "output": {"every": 1},
        }
    )


@pytest.fixture(scope="module")
def line() -> fretting.History:
    return fretting.run(
        {
            "grid": {"cells": 64, "size": 1e-3, "datum": 10e-3},
            "upper": {"rigid": True},
            "lower": {"substrate": {"young": 210e9, "poisson": 0.3}},
            "profile": {"cylinder": {"radius": 50e-3, "axis": "y"}},
            "load": [{"normal_force": 1e5, "increments": 3}],
            "output": {"every": 1},
        }
    )


def cells(widget: Any) -> Any:
    """Return the colours that the widget shows, index [i, j] as in the history."""
    nx, ny = widget.setting["cells"]
    return np.frombuffer(widget.seen["colours"], dtype=np.uint8).reshape(ny, nx, 4)[::-1].swapaxes(0, 1)


def test_the_zones_of_the_place_of_the_slider_are_shown(history: fretting.History) -> None:
    widget: Any = history.explore()
    assert widget.field == "zone"
    # it begins at the largest force
    force = np.abs(history.increments["tangential_force_x"])
    assert force[widget.seen["increment"]] == force.max()
    for place in (0, 5, len(history.kept_increments) - 1):
        widget.place = place
        increment = history.kept_increments[place]
        zone = history.field("zone", increment)
        colours = {word: matplotlib.colors.to_rgba(colour) for word, colour in fretting.plot.ZONES}
        expected = np.rint(255 * np.array([colours[word] for word in ("open", "stick", "slip")])[zone])
        np.testing.assert_array_equal(cells(widget), expected)
        assert widget.seen["increment"] == increment
        assert widget.seen["here"] == [
            history.increments["shift_x"][increment],
            history.increments["tangential_force_x"][increment],
        ]
        told = dict(widget.seen["numbers"])
        assert told["max pressure"] == f"{history.increments['max_pressure'][increment]:.5g} Pa"
        assert told["condition"] == history.increments["regime"][increment].replace("_", " ")


def test_a_field_has_the_same_colours_in_all_increments(history: fretting.History) -> None:
    widget: Any = history.explore("pressure")
    fields = np.stack([history.field("pressure", increment) for increment in history.kept_increments])
    for place in (0, 3, 9):
        widget.place = place
        expected = matplotlib.colormaps["viridis"](fields[place] / fields.max())
        np.testing.assert_array_equal(cells(widget), np.rint(255 * expected))
    # shear has both signs: its colours are those of a scale about zero
    widget.field = "shear_x"
    shear = np.stack([history.field("shear_x", increment) for increment in history.kept_increments])
    most = np.abs(shear).max()
    expected = matplotlib.colormaps["RdBu_r"]((shear[9] + most) / (2 * most))
    np.testing.assert_array_equal(cells(widget), np.rint(255 * expected))
    assert "pressure" in widget.setting["fields"] and "shear_y" in widget.setting["fields"]


def test_a_line_contact_is_shown_as_a_line(line: fretting.History) -> None:
    widget: Any = line.explore()
    assert "zone" not in widget.setting["fields"]
    np.testing.assert_array_equal(np.array(widget.seen["line"])[:, 0], line.x)
    widget.field, widget.place = "pressure", 1
    np.testing.assert_array_equal(np.array(widget.seen["line"])[:, 1], line.field("pressure", line.kept_increments[1]))
    # nothing but the normal force moves: the path is that of pressing
    assert widget.setting["path"][-1] == [line.increments["approach"][-1], line.increments["normal_force"][-1]]


def test_what_is_not_there_is_refused(history: fretting.History) -> None:
    widget: Any = history.explore()
    with pytest.raises(traitlets.TraitError, match="must be one of"):
        widget.field = "temperature"
    assert widget.field == "zone"
    widget.place = 1000
    assert widget.place == len(history.kept_increments) - 1
    with pytest.raises(ValueError, match="keeps others"):
        history.explore("friction_work")


def test_the_message_of_a_moved_slider_is_answered(history: fretting.History) -> None:
    # What the browser sends and gets back, without one: the state of the traits of the comm.
    widget: Any = history.explore()
    told: list[str] = []
    widget.observe(lambda change: told.append(change["name"]), names=["seen"])
    widget.set_state({"place": 2})
    assert told == ["seen"] and widget.seen["increment"] == history.kept_increments[2]
    widget.set_state({"field": "pressure"})
    assert told == ["seen", "seen"]
    state = widget.get_state()
    assert {"setting", "place", "field", "seen", "_esm"} <= state.keys()
    json.dumps(state["setting"])


MODEL = """
const { setting, seen, place, field, colours } = JSON.parse(document.getElementById("state").textContent);
if (colours) seen.colours = new DataView(Uint8Array.from(atob(colours), (letter) => letter.charCodeAt(0)).buffer);
const state = { setting, seen, place, field };
window.saved = [];
window.model = {
  get: (name) => state[name],
  set: (name, value) => { state[name] = value; },
  save_changes: () => window.saved.push({ place: state.place, field: state.field }),
  on: () => {}, off: () => {},
};
"""


@pytest.mark.parametrize("kind", ["history", "line"])
def test_a_browser_draws_it(kind: str, browser: Any, request: pytest.FixtureRequest) -> None:
    import base64

    widget: Any = request.getfixturevalue(kind).explore()
    seen = {name: value for name, value in widget.seen.items() if name != "colours"}
    colours = base64.b64encode(widget.seen.get("colours", b"")).decode()
    state = {"setting": widget.setting, "seen": seen, "place": widget.place, "field": widget.field, "colours": colours}
    page = browser.new_page()
    faults: list[str] = []
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.set_content(f'<div id="here"></div><script type="application/json" id="state">{json.dumps(state)}</script>')
    script = f"{MODEL}\n{SCRIPT.read_text(encoding='utf-8').replace('export default', 'const widget =')}\n"
    page.add_script_tag(
        content=f"{{{script} widget.render({{ model: window.model, el: document.getElementById('here') }}); }}"
    )
    assert faults == []
    loop = page.locator("svg[aria-label='path of the load']")
    assert len(loop.locator("polyline").get_attribute("points").split()) == len(widget.setting["path"])
    if kind == "history":
        # the picture of the cells is there, as wide and as high as the history has cells
        size = page.evaluate(
            "async () => { const image = new Image(); image.src = document.querySelector('image').getAttribute('href');"
            " await image.decode(); return [image.naturalWidth, image.naturalHeight]; }"
        )
        assert size == widget.setting["cells"]
    else:
        assert page.locator("svg polyline").count() == 2
    slider = page.locator("input[type=range]")
    assert int(slider.input_value()) == widget.place
    slider.focus()
    page.keyboard.press("Home")
    assert page.evaluate("window.saved.at(-1).place") == 0
    page.locator("select").select_option("pressure")
    assert page.evaluate("window.saved.at(-1).field") == "pressure"
    page.close()
