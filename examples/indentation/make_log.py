"""Write film_test.csv: what an instrument would export of an indentation of the case film.toml.

The film has 180 GPa, its touch lies at 35 nm; computed on 128 x 128 cells at 40 depths, through which a polynomial is
laid. Noise: 0.15 nm in the depth, 0.01 mN in the load. An example that was computed, not a measurement.
"""

import tomllib
from pathlib import Path

import numpy as np

import fretting

YOUNG, TOUCH, FRAME = 180.0, 0.035, 1 / 5e3
DEEPEST, POINTS = 0.08, 200
HERE = Path(__file__).parent

case = tomllib.loads((HERE / "film.toml").read_text(encoding="utf-8"))
case["lower"]["coatings"][0]["young"] = YOUNG
case["grid"]["cells"] = [128, 128]
case.pop("rig")
depths = DEEPEST * np.linspace(0.1, 1.0, 40)
case["load"] = [{"approach": float(depth), "increments": 1} for depth in depths]
loads = fretting.run(case).increments["normal_force"]
# Load over depth to the power of 1.5 changes slowly.
slow = np.polynomial.Polynomial.fit(depths, loads / depths**1.5, 5)

random = np.random.default_rng(43)
along = 1.1 * (1 - np.abs(np.linspace(-1, 1, 2 * POINTS))) - 0.1
own = np.maximum(along, 0.0) * DEEPEST
load = slow(np.maximum(own, depths[0])) * own**1.5
depth = along * DEEPEST + FRAME * load + TOUCH + 0.15e-3 * random.standard_normal(2 * POINTS)
load = load + 0.01 * random.standard_normal(2 * POINTS)
lines = ["Test 7", "Sample: film on silicon", "", "Displacement Into Surface;Load On Sample", "nm;mN"]
lines += [f"{1e3 * d:.2f};{p:.4f}" for d, p in zip(depth, load, strict=True)]
(HERE / "film_test.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
