"""Von Mises stress in a stiff-coated body through one fretting loop: four sections in one picture.

    fret run examples/stressed_coating.toml --out results/stressed_coating
    python examples/draw_stress_through_loop.py results/stressed_coating stress_through_loop.svg

Takes the sections that `fret stress DIR --every 3` draws (one scale of colours for all) and sets four of them side by side:
after the indentation, at the first peak, at zero force, at the other peak. Standard library only.
"""

import re
import subprocess
import sys
from pathlib import Path

folder, picture = Path(sys.argv[1]), Path(sys.argv[2])
subprocess.run(["fret", "stress", str(folder), "--every", "3", "--quiet"], check=True)
sections = sorted((folder / "stress").glob("von_mises-*.svg"))[-5:-1]
parts, width, height = [], 0.0, 0.0
for number, path in enumerate(sections):
    svg = path.read_text(encoding="utf-8")
    size = re.search(r'width="(\d+)" height="(\d+)"', svg)
    assert size, path
    width, height = float(size[1]), float(size[2])
    place = f'x="{width * (number % 2):.0f}" y="{height * (number // 2):.0f}" '
    parts.append(svg.replace("<svg ", "<svg " + place, 1))
rows = (len(parts) + 1) // 2
head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * width:.0f}" height="{rows * height:.0f}">\n'
picture.write_text(head + "".join(parts) + "</svg>\n", encoding="utf-8")
