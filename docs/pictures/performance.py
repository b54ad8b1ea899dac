"""Wall time of large contacts on two threads.

(a) Frictionless: a sphere, a rigid flat on a rough surface in a period with 1 % of it in contact;
fretting, aspher and tamaas (the sphere in a period). (b) With friction: Cattaneo and Mindlin in one step, coated loop
of 8 + 8 increments with pressure and shear coupled. Dashed: fretting without simplifications (no symmetry, the whole
grid, double precision). The data are those of the table below.
"""

import json
from typing import Any

from _figures import BLUE, GREEN, ORANGE, PINK, ROOT, figure, letters, save

ROWS: list[dict[str, Any]] = json.loads((ROOT / "docs/data" / "large.json").read_text(encoding="utf-8"))["rows"]
GRIDS = [256, 512, 1024, 2048, 4096]


def line(axes: Any, scene: str, program: str, look: str, label: str | None, **more: Any) -> None:
    """Draw the times of a program over the cells per side."""
    points = [
        (row["cells"], row["wall_s"] if "wall_s" in row else row["solver_s"])
        for row in ROWS
        if row["scene"] == scene and row["program"] == program
    ]
    axes.loglog(*zip(*sorted(points), strict=True), look, label=label, lw=0.9, ms=4, **more)


drawn, (left, right) = figure(2, height=70)
for scene, colour, name in (("hertz", BLUE, "sphere"), ("rough 1 %", ORANGE, "rough, 1 %")):
    line(left, scene, "fretting", "o-", f"{name}, fretting", color=colour)
    line(left, scene, "aspher", "s:", f"{name}, aspher", color=colour, mfc="w")
    line(left, scene, "tamaas", "v:", f"{name}, tamaas", color=colour, mfc="w")
line(left, "hertz", "fretting, nothing left out", "o--", "sphere, without simplifications", color=BLUE, mfc="w")
for scene, colour, name in (("cattaneo", GREEN, "Cattaneo and Mindlin"), ("loop", PINK, "coated loop")):
    line(right, scene, "fretting", "o-", name, color=colour)
    line(right, scene, "fretting, nothing left out", "o--", f"{name}, without simplifications", color=colour, mfc="w")
for axes, grids in ((left, GRIDS[2:]), (right, GRIDS)):
    axes.minorticks_off()
    axes.set(xlabel="cells per side", xticks=grids, xticklabels=grids)
left.set(ylabel="wall time [s]", ylim=(0.03, 150))
left.legend(fontsize=6, ncols=2, loc="lower right")
right.legend(fontsize=6)
letters((left, right))
save(drawn)
