"""Error against time of the exact and of the sampled influence coefficients.

    cargo bench -p fret-core --bench influence_coefficients -- coefficients.csv
    python benches/draw_coefficients.py coefficients.csv docs/pictures/coefficients_error_time.png
"""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt

OFFSETS = {
    "error_own": ("own cell", "#0072b2", "o"),
    "error_near": ("cell (3, 2)", "#009e73", "s"),
    "error_quarter": ("a quarter of the grid away", "#e69f00", "^"),
    "error_end": ("at the other end", "#cc3311", "D"),
}
LEAST = 1e-16  # an error of no bit is drawn here


def main(table: str, picture: str) -> None:
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file))
    scenes = list(dict.fromkeys((row["contrast"], row["thickness"]) for row in rows))
    plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False})
    figure, panels = plt.subplots(2, 2, figsize=(8, 6.4), sharex=True, sharey=True, layout="constrained")
    for panel, scene in zip(panels.flat, scenes):
        here = [row for row in rows if (row["contrast"], row["thickness"]) == scene]
        draw(panel, here)
        panel.set_title(f"coating {scene[0]} times stiffer, {scene[1]} cell{'s' if scene[1] != '1' else ''} thick", fontsize=9)
    for panel in panels[-1]:
        panel.set_xlabel("time of 256 × 256 coefficients [ms]")
    for panel in panels[:, 0]:
        panel.set_ylabel("error over the coefficient")
    handles, labels = panels.flat[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, frameon=False)
    path = pathlib.Path(picture)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=150)


def draw(panel, rows) -> None:
    sampled = [row for row in rows if row["method"] == "sampled"]
    exact = next(row for row in rows if row["method"] == "exact")
    times = [1e3 * float(row["seconds"]) for row in sampled]
    for column, (label, colour, marker) in OFFSETS.items():
        errors = [max(float(row[column]), LEAST) for row in sampled]
        panel.plot(times, errors, marker=marker, color=colour, linewidth=1, markersize=4, label=label)
        panel.plot(1e3 * float(exact["seconds"]), max(float(exact[column]), LEAST), marker=marker, color=colour, markersize=6)
    for time, row in zip(times, sampled):
        highest = max(float(row[column]) for column in OFFSETS)
        panel.annotate(f"{row['extension']}×", (time, highest), xytext=(0, 6), textcoords="offset points", ha="center", fontsize=8)
    panel.annotate(
        "exact", (1e3 * float(exact["seconds"]), 1e-15), xytext=(8, 6), textcoords="offset points", fontsize=8
    )
    panel.annotate("sampled, grid extended by 1× to 8×", (times[0], 1e-5), fontsize=8)
    panel.set(xscale="log", yscale="log", ylim=(4e-17, 2e4))
    panel.set_yticks([1e-16, 1e-12, 1e-8, 1e-4, 1])
    panel.grid(color="#dddddd", linewidth=0.5)


if __name__ == "__main__":
    main(*sys.argv[1:])
