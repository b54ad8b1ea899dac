"""Arguments that nobody should give: every public function refuses them with the exceptions that its pages name."""

import decimal
import inspect
import types
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting
from fretting import analytic, plot

CASE: dict[str, Any] = {
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

ODD: list[Any] = [
    None, True, -1, 0, 0.5, 10**400, -(10**400), 2**64, float("nan"), float("inf"), 1j,
    np.longdouble(1), np.ma.masked, np.datetime64("NaT"), decimal.Decimal("1.5"), np.float16(0.5),
    "", "x", "\0", "\ud800", "a" * 5000, b"x", Path("/dev/null"),
    [], [None], [[None]], (), {}, {"young": 1.0}, {1, 2}, object(), int, types.SimpleNamespace(a=1),
    np.zeros(0), np.zeros((2, 3, 4)), np.array([None, 1], dtype=object), np.full((4, 4), np.nan), np.array(3.0),
    np.lib.stride_tricks.as_strided(np.ones(1), (10**9, 10**9), (0, 0)),
]  # fmt: skip

SPHERE = analytic.hertz(radius=1.0, force=1.0, modulus=1.0)
LINE = analytic.hertz_line(radius=1.0, line_force=1.0, modulus=1.0)
LAYER = {"thickness": 0.1, "young": 1.0, "poisson": 0.3}
GOOD: dict[str, Any] = {
    "sphere": SPHERE, "cylinder": LINE, "layer": LAYER, "lower": {"young": 1.0, "poisson": 0.3}, "radius": 1.0,
    "radius_x": 1.0, "radius_y": 2.0, "force": 1.0, "line_force": 1.0, "modulus": 1.0, "shear_modulus": 1.0,
    "friction_coefficient": 0.3, "tangential_force": 0.1, "tangential_forces": [0.1, 0.2], "strain": 0.01, "tilt": 0.01,
    "coupling": 0.3, "moment": 0.01, "slope": 0.1, "amplitude": 0.1, "wavelength": 1.0, "mean_pressure": 0.1,
    "half_width": 1.0, "flat_radius": 1.0, "edge_radius": 1.0, "contact_radius": 0.02, "k": [1.0, 2.0],
    "body": CASE["lower"], "cells": (4, 4), "spacing": (1.0, 1.0), "values": np.ones((4, 4)), "depths": [1e-5],
    "name": "pressure", "x": "x", "y": "y", "case": CASE, "log": "/dev/null",
}  # fmt: skip

ALWAYS = (fretting.FrettingError, ValueError, TypeError, MemoryError, ImportError)
SLOW = {"fretting.run", "fretting.sweep", "fretting.study", "History.animate_loop", "fretting.plot.animation"}


def public() -> Iterator[tuple[str, Callable[..., object]]]:
    """Every function of the package that solves nothing, and every method of a history."""
    history = fretting.run(CASE)
    GOOD["history"] = history
    for module in (fretting, analytic, plot):
        for name in module.__all__:
            found = getattr(module, name)
            if inspect.isfunction(found):
                yield f"{module.__name__}.{name}", found
    for name, method in inspect.getmembers(history, inspect.ismethod):
        if not name.startswith("_"):
            yield f"History.{name}", method
    yield "History", fretting.History
    yield "Identification", fretting.Identification
    yield "Convolution", fretting.Convolution


def documented(function: Callable[..., object], error: Exception) -> bool:
    """Whether a page says that a function may raise this."""
    if isinstance(error, ALWAYS):
        return bool(str(error))
    pages = (inspect.getdoc(function) or "") + (
        plot.__doc__ if "plot" in f"{function.__name__}{function.__module__}" else ""
    )
    return any(kind.__name__ in pages for kind in type(error).__mro__ if kind not in (Exception, BaseException, object))


@pytest.mark.filterwarnings("ignore")
def test_public_functions_raise_what_their_pages_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # some of the values are names of files and folders
    pytest.importorskip("matplotlib").use("Agg")
    pytest.importorskip("xarray")
    from matplotlib import pyplot as plt

    undocumented = []
    calls = 0
    for name, function in public():
        if name in SLOW:
            continue
        parameters = inspect.signature(function).parameters
        named = [entry.name for entry in parameters.values() if entry.kind is not entry.VAR_KEYWORD]
        needed = [entry.name for entry in parameters.values() if entry.default is entry.empty and entry.name in named]
        for odd_one in [*named, *(["no_such_keyword"] if len(named) < len(parameters) else [])]:
            for value in ODD:
                arguments = {other: GOOD.get(other) for other in needed} | {odd_one: value}
                calls += 1
                try:
                    with warnings.catch_warnings():
                        warnings.simplefilter("ignore")
                        function(**arguments)
                except Exception as error:
                    if not documented(function, error):
                        undocumented.append(f"{name}({odd_one}={value!r:.60}): {type(error).__name__}: {error}")
                plt.close("all")
    assert calls > 3000
    assert not undocumented, "\n".join(undocumented)


RAGGED: Any = [[1.0, 2.0], [3.0]]
THREE: Any = 3
WORD: Any = "x"
NOTHING: Any = None
WRONG: list[tuple[Callable[[Any], Any], type[Exception], str]] = [
    (lambda _: SPHERE.pressure(RAGGED), ValueError, "r: expected an array of real numbers"),
    (lambda _: fretting.Convolution(RAGGED), ValueError, "values: expected an array of real numbers"),
    (lambda history: history.subsurface(RAGGED), ValueError, "depths: expected an array of real numbers"),
    (lambda _: analytic.hertz_ellipse(radius_x=1.0, radius_y=2.0, force=1.0, modulus=1.0).pressure([1, 2], [1, 2, 3]),
     ValueError, r"x, y of shapes \(2,\), \(3,\): must fit each other"),
    (lambda _: fretting.gradient(CASE, of=[]), ValueError, "of: expected at least one result"),
    (lambda _: fretting.vjp(CASE, {"pressure": np.array([["a"]])}), TypeError, r"weights\['pressure'\]: expected real"),
    (lambda _: fretting.vjp(CASE, {THREE: 1.0}), TypeError, "weights: expected a str, found int"),
    (lambda _: fretting.plan(CASE)["cells"], KeyError, "a plan has no 'cells'; it has: .*grid"),
    (lambda _: fretting.sweep(CASE, [{THREE: 0.3}]), TypeError, "parameters: .* 3 is no key"),
    (lambda history: plot.scale(history.plot_loop(), THREE), TypeError, r"units\[0\]: expected a str, found int"),
    (lambda history: plot.section(history, []), ValueError, "fields: expected at least one"),
    (lambda history: plot.animation(history, interval=-1), ValueError, "interval = -1: must be at least 1 ms"),
    (lambda history: history.field(np.zeros(2)), TypeError, "name: expected a str, found ndarray"),
    (lambda history: history.fatigue([0.0], constants=3), TypeError, "constants: expected a mapping, found int"),
    (lambda history: history.crack(constants={"yield_strength": np.nan}), ValueError, "constants.yield_strength = nan"),
    (lambda history: fretting.run(CASE, start=(history, WORD)), TypeError, "start.* = 'x': must be a whole number"),
    (lambda _: fretting.identify("/dev/null", case=CASE, columns={THREE: "x"}), TypeError, "columns: expected a str"),
    (lambda _: fretting.identify("/dev/null", case=CASE, columns={"force": NOTHING}), TypeError, r"columns\[.force"),
    (lambda _: fretting.identify_indentation("/dev/null", case=CASE, frame=True, units={"force": THREE}), TypeError,
     r"units\['force'\]: expected a str, found int"),
]  # fmt: skip


@pytest.mark.parametrize(("call", "kind", "words"), WRONG)
def test_a_wrong_argument_is_named(call: Callable[[Any], Any], kind: type[Exception], words: str) -> None:
    pytest.importorskip("matplotlib").use("Agg")
    pytest.importorskip("xarray")
    with pytest.raises(kind, match=words) as raised:
        call(fretting.run(CASE))
    assert type(raised.value) in (kind, fretting.CaseError)


def test_tuples_and_arrays_are_lists_of_a_case_everywhere() -> None:
    """What a run takes, derivatives, first order and sweeps take too."""
    pytest.importorskip("xarray")
    case = {**CASE, "load": (CASE["load"][0], {**CASE["load"][1], "tangential_force": np.array([0.5, 0.0])})}
    key = "load[1].tangential_force[0]"
    spread = {key: fretting.Normal(0.5, 0.01)}
    lists, others = (fretting.first_order(one, spread, of="max_shear") for one in (CASE, case))
    assert lists.equals(others)
    swept = [fretting.sweep(one, {key: [0.4]})["max_shear"] for one in (CASE, case)]
    assert swept[0].equals(swept[1])


def test_histories_in_closed_form_can_be_compared() -> None:
    def history(force: float) -> analytic.TangentialHistory:
        given: dict[str, Any] = {"friction_coefficient": 0.3, "shear_modulus": 1.0, "tangential_forces": [0.1, force]}
        return analytic.tangential_history(SPHERE, **given)

    def line(force: float) -> analytic.LineHistory:
        return analytic.line_history(LINE, friction_coefficient=0.3, tangential_forces=[0.1, force])

    for made in (history, line):
        assert made(0.2) == made(0.2) != made(0.1)
        assert made(0.2) != "another"


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"friction": {"coefficient": np.ma.masked}}, "friction.coefficient: masked"),
        ({"title": np.datetime64("NaT")}, "title"),
        ({"profile": {"sphere": {"radius": 0.01}, "heights": {"values": [[None]]}}}, r"heights.values\[0\]\[0\]"),
        ({"grid": {"cells": [10**400, 8], "size": "auto"}}, r"grid.cells\[0\]: a whole number of more than 64 bits"),
    ],
)
def test_what_is_no_value_is_refused_with_its_place(change: dict[str, Any], words: str) -> None:
    with pytest.raises(fretting.CaseError, match=words):
        fretting.plan({**CASE, **change})


def test_a_long_double_is_a_number() -> None:
    longer = {"substrate": {"young": np.longdouble(2e11), "poisson": np.longdouble(0.3)}}
    assert fretting.plan({**CASE, "lower": longer}) == fretting.plan(
        {**CASE, "lower": {"substrate": {"young": 2e11, "poisson": float(np.longdouble(0.3))}}}
    )


@pytest.mark.parametrize("name", ["", "x" * 5000, "a\0b"])
def test_a_name_that_no_file_can_have_is_unreadable(name: str) -> None:
    for opens in (fretting.plan, fretting.open_results, lambda log: fretting.identify(log, case=CASE)):
        with pytest.raises(fretting.UnreadableError):
            opens(name)
    with pytest.raises(fretting.UnreadableError):
        fretting.run(CASE, folder=name)


def test_a_log_that_is_not_there_is_missing(tmp_path: Path) -> None:
    with pytest.raises(fretting.MissingFileError, match="no such file"):
        fretting.identify(tmp_path / "no.csv", case=CASE)
    with pytest.raises(fretting.UnreadableError, match="a folder, not a file"):
        fretting.identify(tmp_path, case=CASE)
