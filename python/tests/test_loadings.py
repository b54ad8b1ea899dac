"""Cycles, tables and wear, seen from Python."""

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fretting


def test_cycles_are_columns_of_numbers_and_words(fretting_case: dict[str, Any]) -> None:
    history = fretting.run(fretting_case)
    cycles = history.cycles
    assert set(cycles["drive"]) == {"tangential"}
    assert set(cycles["regime"]) <= {"full_stick", "partial_slip", "mixed", "gross_slip"}
    total = history.increments["dissipated_energy"]
    before = total[cycles["first_increment"] - 1]
    # The energy of a cycle is what the record of its increments says, to rounding.
    np.testing.assert_allclose(cycles["dissipated_energy"], total[cycles["last_increment"]] - before, rtol=1e-12)
    assert history.running_conditions[-1] in {"partial", "mixed", "gross"}
    assert history.worn_through is None
    again = pickle.loads(pickle.dumps(history))
    np.testing.assert_array_equal(again.cycles["closure"], cycles["closure"])


def test_a_table_is_looked_for_beside_the_case(tmp_path: Path, fretting_case: dict[str, Any]) -> None:
    case = copy.deepcopy(fretting_case)
    table = tmp_path / "path.csv"
    table.write_text("tangential_force_x\n0.5\n-0.5\n")
    case["load"][1:] = [{"table": str(table), "increments": 2}]
    history = fretting.run(case)
    np.testing.assert_allclose(history.increments["tangential_force_x"][-4:], [0.25, 0.5, 0.0, -0.5], atol=1e-6)
    case["load"][1]["columns"] = {"shift_x": "u"}
    with pytest.raises(fretting.CaseError, match='no column "u"; it has: tangential_force_x'):
        fretting.run(case)
    case["load"][1]["table"] = str(tmp_path / "nowhere.csv")
    with pytest.raises(fretting.CaseError, match="no such file"):
        fretting.run(case)


def test_worn_depth_is_a_field(fretting_case: dict[str, Any]) -> None:
    case = copy.deepcopy(fretting_case)
    case["wear"] = {"coefficient": 1e-13}
    case["output"] = {"fields": ["worn_depth"]}
    history = fretting.run(case)
    area = (history.x[1] - history.x[0]) * (history.y[1] - history.y[0])
    volume = history.field("worn_depth").sum() * area
    np.testing.assert_allclose(volume, 1e-13 * history.increments["dissipated_energy"][-1], rtol=1e-10)
    np.testing.assert_allclose(volume, history.cycles["worn_volume"][-1], rtol=1e-12)


def test_volumes_of_the_layers_add_up(fretting_case: dict[str, Any], tmp_path: Path) -> None:
    case = fretting_case
    case["grid"]["cells"] = [24, 24]
    case["lower"]["coatings"] = [{"thickness": 1e-9, "young": 100e9, "poisson": 0.3, "wear_coefficient": 1e-12}]
    case["lower"]["substrate"]["wear_coefficient"] = 2e-13
    case["upper"]["substrate"]["wear_coefficient"] = 1e-13
    case["wear"] = {"tolerance": 0.1, "thinning_tolerance": 0.1}
    case["load"][1] = {"shift": [1e-6, 0.0], "cycles": 12, "increments": 8}
    history = fretting.run(case, folder=tmp_path / "worn")
    worn = history.worn_by_layer
    assert worn is not None and [len(worn["lower"]), len(worn["upper"])] == [2, 1]
    cycles = history.cycles
    assert sum(worn["lower"]) + sum(worn["upper"]) == pytest.approx(cycles["worn_volume"][-1], rel=1e-9)
    depths = cycles["lower_worn_depth"] + cycles["upper_worn_depth"]
    np.testing.assert_allclose(depths, cycles["max_worn_depth"], rtol=1e-12)
    opened = fretting.open_results(tmp_path / "worn")
    assert opened.worn_by_layer == worn
    # Stresses would be those of the unworn coating.
    for one in (history, opened):
        with pytest.raises(ValueError, match="thinner by wear"):
            one.subsurface([1e-6])
    with pytest.raises(ValueError, match="thinner by wear"):
        history.fatigue([1e-6])
    case["output"] = {"every": 1}
    case["wear"].pop("thinning_tolerance")
    assert fretting.run(case).worn_by_layer is not None
