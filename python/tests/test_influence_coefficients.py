"""Influence coefficients, against closed forms written here."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

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


CELLS = (17, 12)
SPACING = (1.5, 1.0)


def cell_integral_of_inverse_distance(dx: float, dy: float) -> NDArray[np.float64]:
    """Return ``∬ dA / r`` over a cell, seen from the centres of the cells at all offsets (Love 1929)."""
    x = np.arange(CELLS[0], dtype=np.float64)[:, None] * dx
    y = np.arange(CELLS[1], dtype=np.float64)[None, :] * dy

    def corner(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(a * np.arcsinh(b / np.abs(a)) + b * np.arcsinh(a / np.abs(b)), dtype=np.float64)

    right, left = x + dx / 2, x - dx / 2
    top, bottom = y + dy / 2, y - dy / 2
    return corner(right, top) - corner(left, top) - corner(right, bottom) + corner(left, bottom)


@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.5])
def test_normal_displacement_by_pressure_is_loves(poisson: float) -> None:
    young = 70e9
    found = fretting.influence_coefficients(body([], (young, poisson)), cells=CELLS, spacing=SPACING)["zz"]
    expected = (1.0 - poisson**2) / (np.pi * young) * cell_integral_of_inverse_distance(*SPACING)
    # The four corner terms above cancel far away: their rounding is 1e-15 of the largest of them.
    np.testing.assert_allclose(found, expected, rtol=2e-13)


def test_shear_of_a_half_space_without_contraction_is_loves_too() -> None:
    """For nu = 0 the Cerruti kernel is (1/r)/(2 pi G) along either direction, and nothing across."""
    young = 1.0
    found = fretting.influence_coefficients(body([], (young, 0.0)), cells=CELLS, spacing=SPACING)
    expected = 1.0 / (np.pi * young) * cell_integral_of_inverse_distance(*SPACING)
    np.testing.assert_allclose(found["xx"], expected, rtol=2e-13)
    np.testing.assert_allclose(found["yy"], expected, rtol=2e-13)
    assert np.abs(found["xy"]).max() < 1e-14 * expected.max()


def test_incompressible_half_space_does_not_couple() -> None:
    found = fretting.influence_coefficients(body([], (1.0, 0.5)), cells=CELLS, spacing=SPACING)
    for name in ("zx", "zy"):
        assert np.abs(found[name]).max() < 1e-14 * found["zz"].max()


def test_agrees_with_numbers_made_by_other_means(root: Path) -> None:
    golden = root / "tests" / "golden" / "influence_coefficients.json"
    for row in json.loads(golden.read_text())["rows"]:
        i, j = row["i"], row["j"]
        layers = [(young, poisson, thickness) for young, poisson, thickness in row["layers"]]
        found = fretting.influence_coefficients(
            body(layers, tuple(row["substrate"])), cells=(i + 1, j + 1), spacing=(1.0, 1.0)
        )
        for name in ("zz", "xx", "yy", "xy", "zx", "zy"):  # the numbers are good to about 1e-11 of zz
            assert abs(found[name][i, j] - row[name]) < 5e-11 * abs(row["zz"]), (row["layers"], i, j, name)


def test_zero_lines_of_the_odd_components() -> None:
    found = fretting.influence_coefficients(body([(2.0, 0.3, 1.0)], (1.0, 0.3)), cells=CELLS, spacing=SPACING)
    scale = 1e-14 * found["zz"].max()
    assert np.abs(found["zx"][0, :]).max() < scale
    assert np.abs(found["zy"][:, 0]).max() < scale
    assert np.abs(found["xy"][0, :]).max() < scale
    assert np.abs(found["xy"][:, 0]).max() < scale


def test_arrays_are_double_and_of_the_shape_asked_for() -> None:
    found = fretting.influence_coefficients(body([(2.0, 0.3, 1.0)], None), cells=(5, 3), spacing=(0.1, 0.2))
    assert list(found) == ["zz", "xx", "yy", "xy", "zx", "zy"]
    for values in found.values():
        assert values.shape == (5, 3)
        assert values.dtype == np.float64
        assert np.isfinite(values).all()


@pytest.mark.parametrize(
    ("cells", "spacing", "said"),
    [
        ((0, 4), (1.0, 1.0), "cells = "),
        ((4, 4), (1.0, 0.0), "spacing = "),
        ((4, 4), (float("nan"), 1.0), "spacing = "),
    ],
)
def test_bad_grids_are_refused(cells: tuple[int, int], spacing: tuple[float, float], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        fretting.influence_coefficients(body([], (1.0, 0.3)), cells=cells, spacing=spacing)
