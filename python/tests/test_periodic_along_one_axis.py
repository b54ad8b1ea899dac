"""Contacts that repeat along one axis, and what Python makes of them."""

from typing import Any

import numpy as np
import pytest

import fretting


def cylinder(grid: dict[str, Any], length: float) -> fretting.History:
    """Return a coated cylinder pressed and pulled, per length."""
    return fretting.run(
        {
            "grid": {"datum": 3.0, **grid},
            "upper": {"rigid": True},
            "lower": {
                "coatings": [{"thickness": 0.05, "young": 2.0, "poisson": 0.3}],
                "substrate": {"young": 1.0, "poisson": 0.3},
            },
            "profile": {"cylinder": {"radius": 1.0, "axis": "y"}},
            "friction": {"coefficient": 0.5},
            "solver": {"tolerance": 1e-11},
            "load": [
                {"normal_force": 0.01 * length, "increments": 2},
                {"tangential_force": [0.002 * length, 0.0], "increments": 2},
            ],
        }
    )


def test_a_cylinder_that_repeats_along_its_axis_is_a_line_contact_below_the_surface_too() -> None:
    line = cylinder({"cells": 48, "size": 0.4}, 1.0)
    row = cylinder({"cells": [48, 6], "size": [0.4, 0.06], "periodic": "y"}, 0.06)
    depths = [0.0, 0.02, 0.1]
    exact = line.subsurface(depths)
    found = row.subsurface(depths)
    scale = float(abs(exact.zz).max())
    for name in ("xx", "yy", "zz", "xz", "von_mises"):
        # the tolerance of both runs
        assert abs(found[name] - exact[name]).max() < 1e-7 * scale, name
    np.testing.assert_allclose(row.increments["approach"], line.increments["approach"], rtol=1e-9)


def test_what_needs_a_zero_at_infinity_is_refused() -> None:
    row = cylinder({"cells": [16, 4], "size": [0.6, 0.15], "periodic": "y"}, 0.15)
    with pytest.raises(ValueError, match="without end along one axis"):
        row.subsurface([0.1], displacement=True)
    with pytest.raises(ValueError, match="true, false"):
        cylinder({"cells": [16, 4], "size": [0.6, 0.15], "periodic": "z"}, 0.15)
