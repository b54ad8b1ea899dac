"""Stiff wavy films with friction, periodic, pressed until patches merge and the contact is full: the increments that
were hardest to solve.
"""

import numpy as np
import pytest

import fretting


def wavy_film(ratio: float, thickness: float, friction: float, force: float, increments: int) -> fretting.History:
    """Return the indentation of a sinusoidal film on 32 x 32 cells."""
    film = {"thickness": thickness, "young": ratio, "poisson": 0.3}
    return fretting.run(
        {
            "grid": {"cells": [32, 32], "size": [1.0, 1.0], "periodic": True},
            "upper": {"rigid": True},
            "lower": {"coatings": [film], "substrate": {"young": 1.0, "poisson": 0.3}},
            "profile": {"wave": {"amplitude": 1e-3, "wavelength_x": 1.0, "wavelength_y": 1.0}},
            "friction": {"coefficient": friction},
            "load": [{"normal_force": force, "increments": increments}],
            "output": {"fields": ["pressure"]},
        }
    )


@pytest.mark.long
@pytest.mark.parametrize("ratio", [300.0, 1000.0, 3000.0])
@pytest.mark.parametrize("thickness", [0.01, 0.03])
@pytest.mark.parametrize("friction", [0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8])
@pytest.mark.filterwarnings("ignore::fretting.FrettingWarning")
def test_a_stiff_wavy_film_is_pressed_into_full_contact(ratio: float, thickness: float, friction: float) -> None:
    """Forty-two films, four increments to 1.1 of full contact; certified by the residual of every increment."""
    pressure = wavy_film(ratio, thickness, 0.0, ratio, 1).field("pressure")
    full = float(pressure.mean() - pressure.min())
    history = wavy_film(ratio, thickness, friction, 1.1 * full, 4)
    assert (history.increments["residual"] <= 1e-8).all()
    assert history.increments["contact_area"][-1] == pytest.approx(1.0)
    assert np.isfinite(history.field("pressure")).all()
