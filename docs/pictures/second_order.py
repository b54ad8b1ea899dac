"""Error of the dissipated energy over the cost of a history.

End-point rule and rule of second order with 8, 16, 32, 64 and 128 increments, against 512 of the second order on the
same grid; operator applications of the whole history. (a) Loop of a rigid sphere on a coated body, E_c/E_s = 2, h =
a_H, nu = 0.3, mu = 0.3, Q = 0.7 mu P, 32 x 32 cells, after 40 cubic increments of indentation. (b) Indentation by a
rigid sphere, nu = 0.3, mu = 0.3 (Spence's problem), cubic ramp, 128 x 128 cells. (c) Rotating force of 0.7 mu P,
identical bodies with nu = 0, 32 x 32 cells, one turn.
"""

from typing import Any

from _figures import BLUE, ORANGE, figure, letters, save
from _loadings import FORCE, MU, indentation, problem

import fretting

Q = 0.7 * MU * FORCE
COATED = (2.0, 1.0)


def loop(increments: int) -> list[dict[str, Any]]:
    """Return the stage of one cycle."""
    return [{"tangential_force": [Q, 0.0], "increments": increments, "cycles": 1}]


def turn(increments: int) -> list[dict[str, Any]]:
    """Return a force that is built up along x and goes around once."""
    around = {"tangential_force": [Q, Q], "phase": {"tangential_force": [90, 0]}, "waveform": "sine"}
    return [{"tangential_force": [Q, 0.0], "increments": 4}, {**around, "increments": increments, "cycles": 1}]


press = [indentation(increments=40, ramp="cubic")]
HISTORIES = {
    "coated loop": lambda n: problem(32, [*press, *loop(n)], COATED),
    "indentation": lambda n: problem(128, [indentation(increments=n, ramp="cubic")], (1.0, 1.0)),
    "rotating force": lambda n: problem(32, [indentation(), *turn(n)]),
}


def cost_and_energy(case: dict[str, Any], integration: str) -> tuple[float, float]:
    """Return the applications and the dissipated energy of a history."""
    steps = fretting.run({**case, "output": {"fields": []}, "solver": {"integration": integration}}).increments
    start = 40 if len(steps) > 40 and case["load"][0].get("ramp") and len(case["load"]) > 1 else 1
    energy = steps["dissipated_energy"]
    return steps["convolutions"].sum(), energy[-1] - (energy[start - 1] if len(case["load"]) > 1 else 0.0)


drawn, panels = figure(3, height=62)
for axes, (name, history) in zip(panels, HISTORIES.items(), strict=True):
    _, limit = cost_and_energy(history(512), "second_order")
    for integration, label, colour, mark in (
        ("end_point", "end point", BLUE, "o"),
        ("second_order", "second order", ORANGE, "s"),
    ):
        found = [cost_and_energy(history(n), integration) for n in (8, 16, 32, 64, 128)]
        axes.plot(
            [cost for cost, _ in found],
            [abs(energy / limit - 1.0) for _, energy in found],
            mark + "-",
            color=colour,
            lw=0.9,
            label=label,
        )
    axes.set(xscale="log", yscale="log", xlabel="operator applications", title=name)
    ticks = [tick for tick in (250, 500, 1000, 2000) if axes.get_xlim()[0] < tick < axes.get_xlim()[1]]
    axes.set_xticks(ticks, [str(tick) for tick in ticks])
    axes.minorticks_off()
    axes.title.set_fontsize(7)
panels[0].set_ylabel("error of the dissipated energy")
drawn.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
letters(panels)
save(drawn)
