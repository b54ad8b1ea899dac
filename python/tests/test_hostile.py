"""Arrays of every kind from Python: the right answer, or an error that names the argument; never a crash or a NaN."""

import copy
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting
from fretting import analytic


def body(coatings: Any, substrate: Any) -> dict[str, Any]:
    """Return a body as in a case: coatings (young, poisson, thickness), substrate (young, poisson) or None for a rigid
    base.
    """
    layers = [dict(zip(("young", "poisson", "thickness"), coating, strict=True)) for coating in coatings]
    base = (
        {"base": "rigid"}
        if substrate is None
        else {"substrate": dict(zip(("young", "poisson"), substrate, strict=True))}
    )
    return {"coatings": layers, **base}


K = np.linspace(1.0, 4.0, 12)
FIELD = np.random.default_rng(7).normal(size=(6, 8))
KERNEL = 1.0 / (1.0 + np.add.outer(np.arange(6.0), np.arange(8.0)))
MODULI = analytic.effective_moduli(lower={"young": 1.0, "poisson": 0.3})
SPHERE = analytic.hertz(radius=1.0, force=1e-3, modulus=MODULI.normal)

CALLS: dict[str, tuple[Callable[[Any], Any], np.ndarray[Any, Any]]] = {
    "frequency_response": (lambda k: fretting.frequency_response(k, body([(2.0, 0.3, 0.1)], (1.0, 0.3)))["rz"], K),
    "Convolution values": (lambda values: fretting.Convolution(values)(FIELD), KERNEL),
    "Convolution field": (lambda field: fretting.Convolution(KERNEL)(field), FIELD),
    "Hertz.pressure": (lambda r: SPHERE.pressure(r), K * SPHERE.contact_radius / 5),
    "ellipse": (
        lambda x: analytic.hertz_ellipse(radius_x=1.0, radius_y=2.0, force=1e-3, modulus=1.0).pressure(x, 0.01),
        K / 100,
    ),
    "westergaard": (
        lambda x: analytic.westergaard(amplitude=0.01, wavelength=1.0, mean_pressure=1e-3, modulus=1.0).pressure(x),
        K,
    ),
    "cattaneo": (
        lambda r: analytic.cattaneo_mindlin(
            SPHERE, friction_coefficient=0.1, shear_modulus=MODULI.shear, tangential_force=5e-5
        ).shear(r),
        K * 0.02,
    ),
}
LAYOUTS: dict[str, Callable[[np.ndarray[Any, Any]], Any]] = {
    "fortran": lambda a: np.asfortranarray(a),
    "every other": lambda a: np.repeat(a, 2, axis=-1)[..., ::2],
    "negative strides": lambda a: a[::-1].copy()[::-1],
    "big endian": lambda a: a.astype(">f8"),
    "extended": lambda a: a.astype(np.longdouble),
    "list": lambda a: a.tolist(),
    "unaligned": lambda a: np.frombuffer(b"x" + a.tobytes(), dtype=np.uint8)[1:].view("f8").reshape(a.shape),
    "subclass": lambda a: np.ma.masked_array(a),
}


def read_only(a: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    a = a.copy()
    a.flags.writeable = False
    return a


@pytest.mark.parametrize("layout", [*LAYOUTS, "read-only"])
@pytest.mark.parametrize("name", CALLS)
def test_the_layout_of_an_array_does_not_matter(name: str, layout: str) -> None:
    call, values = CALLS[name]
    given = read_only(values) if layout == "read-only" else LAYOUTS[layout](values)
    np.testing.assert_array_equal(call(given), call(values))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("name", CALLS)
def test_numbers_that_are_not_finite_are_refused_with_their_place(name: str, bad: float) -> None:
    call, values = CALLS[name]
    spoilt = values.copy()
    spoilt.flat[-1] = bad
    with pytest.raises(ValueError, match=r"value .* at \[.*\] is not finite"):
        call(spoilt)


@pytest.mark.parametrize("dtype", [complex, str, object, "datetime64[s]", bool])
@pytest.mark.parametrize("name", CALLS)
def test_what_is_no_real_number_is_refused(name: str, dtype: str | type) -> None:
    call, values = CALLS[name]
    with pytest.raises(TypeError, match="expected real numbers, found"):
        call(np.zeros(values.shape, dtype=dtype))


def test_masked_values_are_refused() -> None:
    """What is under a mask is nobody's number."""
    with pytest.raises(ValueError, match="masked"):
        fretting.frequency_response(np.ma.masked_greater(K, 3.0), body([], (1.0, 0.3)))


@pytest.mark.parametrize("shape", [(), (0,), (2, 0, 3), (2, 3, 2)])
def test_any_shape_of_points_is_kept(shape: tuple[int, ...]) -> None:
    points = np.full(shape, 1.5)
    response = fretting.frequency_response(points, body([], (1.0, 0.3)))
    assert response["zz"].shape == shape
    # A half-space: k zz = 2 (1 - nu^2) / E.
    np.testing.assert_allclose(response["zz"], 2 * 0.91 / 1.5, rtol=1e-14)
    assert SPHERE.pressure(points).shape == shape


@pytest.mark.parametrize("shape", [(0, 0), (0, 4), (4, 0), (4,), (2, 2, 2), ()])
def test_kernels_and_fields_of_other_shapes_are_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"shape|cell|dimensions"):
        fretting.Convolution(np.zeros(shape))
    with pytest.raises(ValueError, match=r"shape|dimensions"):
        fretting.Convolution(KERNEL)(np.zeros(shape))


def test_arrays_far_larger_than_memory_are_refused_before_memory_is_asked_for() -> None:
    huge = np.broadcast_to(1.0, (1 << 20, 1 << 20))  # 8 TiB, were it real
    for call in (
        lambda: fretting.Convolution(huge),
        lambda: fretting.Convolution(KERNEL)(huge),
        lambda: fretting.frequency_response(huge, body([], (1.0, 0.3))),
        lambda: fretting.influence_coefficients(body([], (1.0, 0.3)), cells=(1 << 20, 1 << 20), spacing=(1.0, 1.0)),
        lambda: fretting.influence_coefficients(body([], (1.0, 0.3)), cells=(1 << 62, 1 << 62), spacing=(1.0, 1.0)),
    ):
        with pytest.raises((ValueError, MemoryError)):
            call()


@pytest.mark.parametrize(
    "call",
    [
        lambda: fretting.influence_coefficients(body([], (1.0, 0.3)), cells=(4, 4), spacing=(0.0, 1.0)),
        lambda: fretting.influence_coefficients(body([], (1.0, 0.3)), cells=(4, 4), spacing=(np.nan, 1.0)),
        lambda: fretting.influence_coefficients(body([], (1.0, 0.3)), cells=(-1, 4), spacing=(1.0, 1.0)),
        lambda: fretting.influence_coefficients(
            body([(1.0, 0.3, np.inf)], (1.0, 0.3)), cells=(4, 4), spacing=(1.0, 1.0)
        ),
        lambda: fretting.influence_coefficients(
            body([(np.nan, 0.3, 1.0)], (1.0, 0.3)), cells=(4, 4), spacing=(1.0, 1.0)
        ),
        lambda: fretting.influence_coefficients(body([], None), cells=(4, 4), spacing=(1.0, 1.0)),
        lambda: fretting.frequency_response(
            [1.0], {**body([], (1.0, 0.3)), "coatings": [{"young": 1.0, "poisson": 0.3}]}
        ),
        lambda: fretting.frequency_response([1.0], body([], (1.0, 0.6))),
        lambda: fretting.frequency_response([-1.0], body([], (1.0, 0.3))),
        lambda: fretting.Convolution(KERNEL, parity="even"),  # type: ignore[arg-type]
        lambda: analytic.hertz(radius=np.nan, force=1.0, modulus=1.0),
    ],
)
def test_numbers_out_of_their_range_are_refused(call: Callable[[], Any]) -> None:
    with pytest.raises(ValueError, match=r"."):
        call()


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (np.array([2.4, np.nan]), "must be finite"),
        (np.array([2.4 + 1j, 0.0]), "complex is not a number"),
        (np.zeros((2, 0)), ""),
        (b"2.4", "bytes is not a number"),
        ({1: 2}, "keys are words"),
        (10**400, ""),
        (float("inf"), "must be finite"),
    ],
)
def test_hostile_values_in_a_case_are_refused(fretting_case: dict[str, Any], value: object, words: str) -> None:
    fretting_case["load"][1]["tangential_force"] = value
    with pytest.raises(fretting.CaseError) as refused:
        fretting.plan(fretting_case)
    assert words in str(refused.value)


def test_arrays_in_a_case_may_have_any_layout(fretting_case: dict[str, Any]) -> None:
    plain = fretting.plan(fretting_case)
    fretting_case["load"][1]["tangential_force"] = np.array([0.0, 2.4])[::-1]
    fretting_case["grid"]["cells"] = np.array([48, 48], dtype=np.uint16)
    assert dict(fretting.plan(fretting_case)) == dict(plain)


def test_cases_plans_and_histories_can_be_copied_and_pickled(fretting_case: dict[str, Any]) -> None:
    from fretting import _case

    fretting_case["grid"]["cells"] = [16, 16]
    case = _case.read(fretting_case)
    for again in (copy.copy(case), copy.deepcopy(case), pickle.loads(pickle.dumps(case))):
        assert fretting._core.plan(again) == fretting._core.plan(case)
    plan = fretting.plan(fretting_case)
    for twin in (copy.copy(plan), copy.deepcopy(plan), pickle.loads(pickle.dumps(plan))):
        assert dict(twin) == dict(plan)
        assert repr(twin) == repr(plan)
    history = fretting.run(fretting_case)
    for other in (copy.copy(history), copy.deepcopy(history), pickle.loads(pickle.dumps(history))):
        np.testing.assert_array_equal(other.field("shear_x"), history.field("shear_x"))
        np.testing.assert_array_equal(other.cycles["closure"], history.cycles["closure"])
    assert "<table>" in history._repr_html_()
    assert "<script>" not in fretting.plan({**fretting_case, "title": "<script>"})._repr_html_()


@pytest.mark.parametrize("increment", [14.7, 14.0, "14", None, True, np.float64(1.0)])
def test_a_step_is_a_whole_number(sphere_case: dict[str, Any], increment: Any) -> None:
    history = fretting.run(sphere_case)
    with pytest.raises(TypeError, match=r"increment = .*must be a whole number"):
        history.field("pressure", increment=increment)
    last: Any = np.int32(-1)
    assert (history.field("pressure", increment=last) == history.field("pressure")).all()


def test_a_folder_is_no_case(tmp_path: Path) -> None:
    with pytest.raises(fretting.UnreadableError, match="a folder, not a file"):
        fretting.run(str(tmp_path))


def test_a_case_that_holds_itself_is_refused(sphere_case: dict[str, Any]) -> None:
    sphere_case["load"].append(sphere_case)
    with pytest.raises(fretting.CaseError, match="inside itself"):
        fretting.run(sphere_case)
    endless: list[Any] = []
    endless.append(endless)
    with pytest.raises(fretting.CaseError, match="inside itself"):
        fretting.run({**sphere_case, "load": endless})


def test_a_list_of_one_number_is_no_number(sphere_case: dict[str, Any]) -> None:
    """As in NumPy itself, which no longer turns arrays with a dimension into numbers."""
    sphere_case["load"][0]["normal_force"] = np.array([12.0])
    with pytest.raises(fretting.CaseError, match="found a list, expected a number"):
        fretting.run(sphere_case)
    sphere_case["load"][0]["normal_force"] = np.array(12.0)
    assert fretting.plan(sphere_case)["increments"] > 0
