"""Draw the three figures of the paper on the fretting contact of coated bodies.

    python examples/draw_paper_figures.py [FOLDER]

needs ``pip install fretting matplotlib`` and writes ``paper_figure_1.png`` to ``paper_figure_3.png`` into FOLDER
(``docs/pictures`` of the project when not given). About two minutes.
"""

import copy
import sys
import tomllib
from pathlib import Path

import fretting
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).parent


def case(name):
    """Case of an example file as a dict."""
    return tomllib.loads((HERE / name).read_text())


def hertz(scene):
    """Hertz contact of the substrate alone under the force of the first stage."""
    upper, lower = scene["upper"].get("substrate"), scene["lower"]["substrate"]
    compliance = (1 - lower["poisson"] ** 2) / lower["young"]
    if upper:
        compliance += (1 - upper["poisson"] ** 2) / upper["young"]
    force = scene["load"][0]["normal_force"]
    radius = (0.75 * force * scene["profile"]["sphere"]["radius"] * compliance) ** (1 / 3)
    return radius, 1.5 * force / (np.pi * radius**2)


def middle(history, name, step):
    """Field along x through the middle: mean of the two middle rows."""
    field = history.field(name, step=step)
    half = field.shape[1] // 2
    return 0.5 * (field[:, half - 1] + field[:, half])


def figure_1(folder):
    """Pressure profiles over the ratio of Young's moduli."""
    figure, axes = plt.subplots(figsize=(5.4, 4.2), layout="constrained")
    scene = case("paper_figure_1.toml")
    radius, peak = hertz(scene)
    r = np.linspace(-1, 1, 400)
    axes.plot(r, np.sqrt(1 - r**2), color="0.7", lw=4, label="Hertz, no coating")
    for ratio, label in [(0.25, "1/4"), (0.5, "1/2"), (1, "1"), (2, "2"), (4, "4")]:
        scene["lower"]["coatings"][0]["young"] = ratio * scene["lower"]["substrate"]["young"]
        history = fretting.run(scene)
        axes.plot(history.x / radius, middle(history, "pressure", -1) / peak, label=f"$E_1/E_2$ = {label}")
    axes.set(xlabel="$x / a_H$", ylabel="$p / p_H$", xlim=(-1.6, 1.6), ylim=(0, None))
    axes.legend(frameon=False)
    figure.savefig(folder / "paper_figure_1.png", dpi=150)


def figure_2(folder):
    """Shear between the first and the third null of T, with the closed form."""
    scene = case("paper_figure_2.toml")
    radius, peak = hertz(scene)
    history = fretting.run(scene)
    friction, force = scene["friction"]["coefficient"], scene["load"][0]["normal_force"]
    amplitude = scene["load"][1]["tangential_force"][0]
    cap = np.vectorize(lambda x, c: friction * peak * np.sqrt(max(c * c - x * x, 0.0)) / radius)
    x = np.linspace(-1.05, 1.05, 801) * radius

    def exact(step):
        """Closed form on the way down (steps 20 to 60) and up again."""
        tangential = history.steps["tangential_force_x"][step]
        sign = 1 if step <= 60 else -1
        c0 = radius * (1 - amplitude / (friction * force)) ** (1 / 3)
        c1 = radius * (1 - (amplitude - sign * tangential) / (2 * friction * force)) ** (1 / 3)
        return -sign * (cap(x, radius) - 2 * cap(x, c1) + cap(x, c0))

    figure, axes = plt.subplots(figsize=(5.4, 4.2), layout="constrained")
    for number, step in enumerate(range(40, 81, 10)):
        share = history.steps["tangential_force_x"][step] / (friction * force)
        axes.plot(x / radius, exact(step) / peak, color="0.75", lw=4, zorder=1)
        axes.plot(history.x / radius, middle(history, "shear_x", step) / peak, lw=1.2, color=f"C{number}",
                  label=f"$T/\\mu W$ = {abs(share) if abs(share) < 0.005 else share:.2f}")
    axes.set(xlabel="$x / a_H$", ylabel="$q_x / p_H$", xlim=(-1.1, 1.1))
    axes.legend(frameon=False, fontsize="small")
    figure.savefig(folder / "paper_figure_2.png", dpi=150)


def figure_3(folder):
    """Shear through the loop of a soft and of a stiff coating."""
    scene = case("paper_figure_3.toml")
    radius, peak = hertz(scene)
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    for axes, ratio, title, size in [(panels[0], 0.5, "(a) $E_1/E_2$ = 1/2", 2.9e-4), (panels[1], 2, "(b) $E_1/E_2$ = 2", 1.98e-4)]:
        this = copy.deepcopy(scene)
        this["lower"]["coatings"][0]["young"] = ratio * scene["lower"]["substrate"]["young"]
        this["grid"]["size"] = [size, size]
        history = fretting.run(this)
        mu_w = scene["friction"]["coefficient"] * scene["load"][0]["normal_force"]
        for number, step in enumerate([99, 174, 249, 324, 399]):
            share = history.steps["tangential_force_x"][step] / mu_w
            label = "pressed" if step == 99 else f"$T/\\mu W$ = {abs(share) if abs(share) < 0.005 else share:.2f}"
            axes.plot(history.x / radius, middle(history, "shear_x", step) / peak, color=f"C{number}", label=label)
        axes.plot(history.x / radius, 0.1 * middle(history, "pressure", -1) / peak, color="0.75", lw=1, zorder=0)
        axes.plot(history.x / radius, -0.1 * middle(history, "pressure", -1) / peak, color="0.75", lw=1, zorder=0,
                  label="$\\pm \\mu p$")
        axes.set(xlabel="$x / a_H$", ylabel="$q_x / p_H$", title=title)
    figure.legend(*panels[1].get_legend_handles_labels(), loc="outside right center", frameon=False, fontsize="small")
    figure.savefig(folder / "paper_figure_3.png", dpi=150)


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE.parent / "docs" / "pictures"
    target.mkdir(parents=True, exist_ok=True)
    for draw in (figure_1, figure_2, figure_3):
        draw(target)
        print(f"{draw.__name__}: {target / ('paper_' + draw.__name__)}.png")
