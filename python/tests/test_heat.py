"""Temperature rise by friction and contact resistance, against closed forms."""

import pickle
from typing import Any

import numpy as np
import pytest

import fretting

pytest.importorskip("xarray")


def conducting(case: dict[str, Any]) -> dict[str, Any]:
    case["upper"] = {"rigid": True, "thermal_conductivity": 15.0, "electrical_resistivity": 6e-7}
    case["lower"]["substrate"] |= {"thermal_conductivity": 45.0, "electrical_resistivity": 2e-7}
    case["output"] = {"every": 1}
    return case


def test_homogeneous_bodies_share_heat_as_they_conduct(fretting_case: dict[str, Any]) -> None:
    history = fretting.run(conducting(fretting_case))
    rise = history.temperature(frequency=20.0)
    # the fields account for the energy, which is the power over the frequency
    area = (history.x[1] - history.x[0]) * (history.y[1] - history.y[0])
    energy = history.cycles["dissipated_energy"][-1]
    assert abs(float(rise.heat.sum()) * area / (20.0 * energy) - 1.0) < 1e-12
    assert abs(rise.attrs["kept_fields_account_for"] - 1.0) < 1e-2
    # kappa_1 : kappa_2 in every cell, to the solver's 1e-11
    assert abs(float(rise.heat_into_lower.sum() / rise.heat.sum()) - 0.75) < 1e-9
    contact = (history.field("pressure") > 0.0).T
    assert np.allclose(rise.rise_lower.values[contact], rise.rise_upper.values[contact], rtol=1e-8)
    again = pickle.loads(pickle.dumps(history)).temperature(frequency=20.0, threads=1)
    assert again.identical(rise)


def test_contact_resistance_is_holms(sphere_case: dict[str, Any]) -> None:
    history = fretting.run(conducting(sphere_case))
    radius = float(np.sqrt(history.increments["contact_area"][-1] / np.pi))
    # a fifth of a cell over the radius
    assert abs(history.contact_resistance() / (8e-7 / (4.0 * radius)) - 1.0) < 0.05
    thermal = history.contact_resistance(kind="thermal")
    # one operator: the ratio of both is that of the sums of resistivities
    assert abs(thermal / history.contact_resistance() / ((1 / 15 + 1 / 45) / 8e-7) - 1.0) < 1e-9


def test_a_shear_strength_is_refused(fretting_case: dict[str, Any]) -> None:
    case = conducting(fretting_case)
    case["friction"]["max_shear"] = 1e12
    history = fretting.run(case)
    with pytest.raises(ValueError, match=r"friction\.max_shear"):
        history.temperature(frequency=20.0)


def test_what_is_missing_is_said(fretting_case: dict[str, Any]) -> None:
    history = fretting.run(fretting_case)
    with pytest.raises(ValueError, match="frequency"):
        history.temperature()
    with pytest.raises(ValueError, match="does not conduct"):
        history.contact_resistance()
    with pytest.raises(ValueError, match="kind"):
        history.contact_resistance(kind="magnetic")  # type: ignore[arg-type]
    with pytest.raises(IndexError, match="computed cycles"):
        history.temperature(cycle=99, frequency=1.0)
