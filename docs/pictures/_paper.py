"""The cases of the three reproduced figures."""

import tomllib
from typing import Any

import numpy as np
from _figures import ROOT


def case(name: str) -> dict[str, Any]:
    """Return an example file as a dict."""
    return tomllib.loads((ROOT / "examples" / name).read_text(encoding="utf-8"))


def hertz(shown: dict[str, Any]) -> tuple[float, float]:
    """Return contact radius and maximum contact pressure of the substrate alone under the force of the first stage."""
    upper, lower = shown["upper"].get("substrate"), shown["lower"]["substrate"]
    compliance = (1 - lower["poisson"] ** 2) / lower["young"]
    if upper:
        compliance += (1 - upper["poisson"] ** 2) / upper["young"]
    force = shown["load"][0]["normal_force"]
    radius = (0.75 * force * shown["profile"]["sphere"]["radius"] * compliance) ** (1 / 3)
    return radius, 1.5 * force / (np.pi * radius**2)
