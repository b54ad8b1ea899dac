"""What is known before a run."""

from collections.abc import Mapping
from typing import Any

import fretting


def test_plan_is_a_mapping_of_plain_values(fretting_case: dict[str, Any]) -> None:
    plan = fretting.plan(fretting_case)
    assert isinstance(plan, Mapping)
    assert plan["increments"] == 17
    assert plan["grid"]["cells"] == [48, 48]
    assert plan["memory_bytes"] > 48 * 48 * 8
    assert plan["convolutions_expected"] > 0
    assert plan["increments_expected"] == 17
    assert plan.seconds_expected is not None and plan.seconds_expected > 0
    assert set(plan) == set(dict(plan))
    assert "48 x 48" in repr(plan)


def test_what_is_left_out_says_why_and_what_it_saves(fretting_case: dict[str, Any]) -> None:
    """Two like bodies do not couple, and none has a coating."""
    plan = fretting.plan(fretting_case)
    assert plan["coupling"] == "uncoupled"
    assert plan.left_out
    for entry in plan.left_out:
        assert set(entry) == {"what", "why", "saves"}
    assert any("coupling" in entry["what"] for entry in plan.left_out)


def test_contact_without_friction_leaves_the_shear_out(sphere_case: dict[str, Any]) -> None:
    plan = fretting.plan(sphere_case)
    assert plan["coupling"] == "frictionless"
    assert any("shear" in entry["what"] for entry in plan.left_out)
