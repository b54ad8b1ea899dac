"""The response of layered half-spaces, against numbers made by other means."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting


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


def test_agrees_with_numbers_of_120_digit_arithmetic(root: Path) -> None:
    golden = root / "tests" / "golden" / "frequency_response.json"
    rows = json.loads(golden.read_text())["rows"]
    assert len(rows) >= 50
    for row in rows:
        coatings = [(young, poisson, thickness) for young, poisson, thickness in row["layers"]]
        substrate = None if row["substrate"] is None else tuple(row["substrate"])
        found = fretting.frequency_response(row["k"], body(coatings, substrate))
        expected = {name: float(row[name]) for name in ("zz", "rr", "rz", "tt")}
        for name in ("zz", "rr", "tt"):  # 2e-15 promised; the decimal strings are good to 20 digits
            assert float(found[name]) == pytest.approx(expected[name], rel=1e-14), (row["case"], row["k"], name)
        # The coupling changes sign: its error is measured against what it couples.
        scale = math.sqrt(expected["rr"] * expected["zz"])
        assert abs(float(found["rz"]) - expected["rz"]) < 1e-14 * scale, (row["case"], row["k"])


@pytest.mark.parametrize("poisson", [-0.5, 0.0, 0.3, 0.5])
def test_homogeneous_half_space_follows_its_closed_form(poisson: float) -> None:
    young = 210e9
    shear_modulus = young / (2.0 * (1.0 + poisson))
    k = np.geomspace(1e-3, 1e9, 25)
    found = fretting.frequency_response(k, body([], (young, poisson)))
    np.testing.assert_allclose(found["zz"], (1.0 - poisson) / (shear_modulus * k), rtol=4e-15)
    np.testing.assert_allclose(found["rr"], (1.0 - poisson) / (shear_modulus * k), rtol=4e-15)
    np.testing.assert_allclose(found["tt"], 1.0 / (shear_modulus * k), rtol=4e-15)
    coupling = (1.0 - 2.0 * poisson) / (2.0 * shear_modulus * k)
    np.testing.assert_allclose(found["rz"], coupling, rtol=1e-14, atol=0.0)


def test_coating_of_the_substrates_own_material_changes_nothing() -> None:
    k = np.geomspace(1e-4, 1e4, 17)
    bare = fretting.frequency_response(k, body([], (3.0, 0.25)))
    coated = fretting.frequency_response(k, body([(3.0, 0.25, 1.0), (3.0, 0.25, 2.0)], (3.0, 0.25)))
    for name in bare:
        np.testing.assert_allclose(coated[name], bare[name], rtol=1e-14)


def test_short_waves_see_the_coating_and_long_waves_the_substrate() -> None:
    stack = [(400.0, 0.2, 1.0)], (100.0, 0.3)
    k = np.array([1e-9, 200.0])
    found = fretting.frequency_response(k, body(*stack))["zz"] * k
    substrate = fretting.frequency_response(1.0, body([], (100.0, 0.3)))["zz"]
    coating = fretting.frequency_response(1.0, body([], (400.0, 0.2)))["zz"]
    np.testing.assert_allclose(found, [substrate, coating], rtol=1e-7)  # of order k h at the long end


@pytest.mark.parametrize("shape", [(), (1,), (5,), (2, 3), (0,)])
def test_answers_have_the_shape_of_the_wavenumbers(shape: tuple[int, ...]) -> None:
    found = fretting.frequency_response(np.ones(shape), body([(2.0, 0.3, 0.1)], (1.0, 0.3)))
    assert list(found) == ["zz", "rr", "rz", "tt"]
    for values in found.values():
        assert values.shape == shape
        assert values.dtype == np.float64


@pytest.mark.parametrize(
    ("k", "coatings", "substrate", "said"),
    [
        ([1.0, 0.0], [], (1.0, 0.3), "k = 0.0"),
        ([1.0, math.nan], [], (1.0, 0.3), r"k: value nan at \[1\]"),
        (1.0, [(1.0, 0.7, 1.0)], (1.0, 0.3), "Poisson's ratio 0.7"),
        (1.0, [(1.0, 0.3, -1.0)], (1.0, 0.3), "thickness -1"),
        (1.0, [], (0.0, 0.3), "Young's modulus 0"),
        (1.0, [], None, "rigid"),
    ],
)
def test_bad_arguments_are_refused_with_their_value(k: Any, coatings: Any, substrate: Any, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        fretting.frequency_response(k, body(coatings, substrate))


def test_a_body_is_refused_as_in_a_case() -> None:
    coating = {"young": 1.0, "poisson": 0.3}
    with pytest.raises(fretting.CaseError, match="thickness"):
        fretting.frequency_response(1.0, {"coatings": [coating], "substrate": coating})
    with pytest.raises(fretting.CaseError, match="poison"):
        fretting.frequency_response(1.0, {"substrate": {"young": 1.0, "poison": 0.3}})
    with pytest.raises(ValueError, match="rigid"):
        fretting.frequency_response(1.0, {"rigid": True})
    with pytest.raises(TypeError, match="mapping"):
        fretting.frequency_response(1.0, [(1.0, 0.3, 1.0)])  # type: ignore[arg-type]


def test_a_graded_coating_is_a_body_too() -> None:
    """A gradient between two equal moduli is a uniform coating."""
    k = np.geomspace(0.1, 30.0, 5)
    graded = {"thickness": 0.5, "gradient": {"young": [3.0, 3.0], "law": "linear"}, "poisson": 0.25}
    found = fretting.frequency_response(k, {"coatings": [graded], "substrate": {"young": 1.0, "poisson": 0.3}})
    plain = fretting.frequency_response(k, body([(3.0, 0.25, 0.5)], (1.0, 0.3)))
    for name in found:
        np.testing.assert_allclose(found[name], plain[name], rtol=1e-12)  # rounding of the layer recursion
