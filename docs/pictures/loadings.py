"""Draw the pictures of docs/loadings.md: for each loading what it looks like, and how far it is from its reference.

    python examples/draw_loadings.py [FOLDER]

needs ``pip install fretting matplotlib`` and writes ``loading_*.png`` into FOLDER (``docs/pictures`` of the project when
not given). About a minute.
"""

import sys
from pathlib import Path

import fretting
import matplotlib
from fretting import analytic

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

MU = 0.3
RADIUS = 100.0
MODULUS = 0.5  # E*, two bodies of E = 1, nu = 0
SHEAR = 0.125  # G*
FORCE = 4 * MODULUS / (3 * RADIUS)  # contact radius 1
PEAK = 1.5 * FORCE / np.pi
ONSET = 3 * MU * FORCE / (16 * SHEAR)  # shift at which the whole contact slides


def scene(cells, stages, coating=None, **more):
    """Sphere of contact radius 1 on a like body with nu = 0, or rigid on a coated one with nu = 0.3."""
    body = {"substrate": {"young": 1.0, "poisson": 0.0}}
    upper = body
    if coating:
        body = {
            "coatings": [{"thickness": coating[1], "young": coating[0], "poisson": 0.3}],
            "substrate": {"young": 1.0, "poisson": 0.3},
        }
        upper = {"rigid": True}
    return {
        "grid": {"cells": [cells, cells], "size": [2.4, 2.4]},
        "upper": upper,
        "lower": body,
        "profile": {"sphere": {"radius": RADIUS}},
        "friction": {"coefficient": MU},
        "load": stages,
        "output": {"fields": ["pressure", "shear", "zone"], "every": 1},
        **more,
    }


def pressed(share=1.0, **more):
    """Stage that presses to a share of the force."""
    return {"normal_force": share * FORCE, "increments": 1, **more}


class Springs:
    """The sphere as a row of independent springs (Popov & Hess): exact for these bodies and any history along one line."""

    def __init__(self, count=4000, widest=1.2):
        """Springs at rest."""
        self.x = (np.arange(count) + 0.5) * widest / count
        self.step = widest / count
        self.pulled = np.zeros(count)
        self.shift = self.loss = 0.0

    def follow(self, normal, pull):
        """Go to a normal and a tangential force; the shift."""
        approach = (0.75 * normal / (MODULUS * RADIUS**0.5)) ** (2 / 3)
        bound = MU * MODULUS * np.maximum(approach - self.x**2 / RADIUS, 0) / (4 * SHEAR)
        force = lambda move: 2 * 4 * SHEAR * self.step * np.clip(self.pulled + move, -bound, bound).sum()
        low, high = -20 * ONSET, 20 * ONSET
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if force(middle) < pull else (low, middle)
        held = np.clip(self.pulled + low, -bound, bound)
        self.loss += 2 * 4 * SHEAR * self.step * (held * (self.pulled + low - held))[bound > 0].sum()
        self.pulled = held
        self.shift += low
        return self.shift


def along(history):
    """Shifts of the springs along the forces of a history."""
    springs = Springs()
    steps = history.steps
    shifts = [springs.follow(p, t) for p, t in zip(steps["normal_force"], steps["tangential_force_x"], strict=True)]
    return np.array(shifts), springs.loss


def panels(name, folder, draw):
    """A figure of two panels, drawn and saved."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")
    draw(*axes)
    figure.savefig(folder / f"loading_{name}.png", dpi=120)
    plt.close(figure)


def changing_force(left, right):
    """Mindlin and Deresiewicz's cases of a changing normal force."""
    cases = {
        "T up, P up slowly": [(0.5, 0.0), (0.5, 0.3), (1.0, 0.9)],
        "T up, P up fast": [(0.5, 0.0), (0.5, 0.3), (1.0, 0.45)],
        "T up, P down": [(1.0, 0.0), (1.0, 0.3), (0.6, 0.5)],
        "T down, P up": [(0.5, 0.0), (0.5, 0.4), (1.0, 0.1)],
        "T down, P down": [(1.0, 0.0), (1.0, 0.7), (0.6, 0.2)],
    }
    for label, points in cases.items():
        stages = [
            {"normal_force": p * FORCE, "tangential_force": [t * MU * FORCE, 0.0], "increments": 8} for p, t in points
        ]
        history = fretting.run(scene(48, stages))
        exact, _ = along(history)
        pull = history.steps["tangential_force_x"] / (MU * FORCE)
        (line,) = left.plot(exact / ONSET, pull, lw=3, alpha=0.35)
        left.plot(history.steps["shift_x"] / ONSET, pull, ".", color=line.get_color(), ms=4, label=label)
        right.plot(abs(history.steps["shift_x"] - exact) / abs(exact).max(), ".-", color=line.get_color())
    left.set(xlabel="shift / onset of sliding", ylabel=r"$T / \mu W$", title="lines: exact, dots: computed")
    left.legend(frameon=False, fontsize=7)
    right.set(xlabel="increment", ylabel="error of shift / its largest", yscale="log", ylim=(1e-5, 1e-1))


def phases(left, right):
    """Normal and tangential cycles, in phase and not."""
    for phase in [0, 90, 180]:
        stages = [
            pressed(0.7, increments=6),
            {
                "normal_force": 0.2 * FORCE,
                "tangential_force": [0.4 * MU * FORCE, 0.0],
                "phase": {"normal_force": phase},
                "waveform": "sine",
                "increments": 24,
                "cycles": 2,
            },
        ]
        history = fretting.run(scene(48, stages))
        exact, _ = along(history)
        pull = history.steps["tangential_force_x"][6:] / (MU * FORCE)
        (line,) = left.plot(exact[6:] / ONSET, pull, lw=3, alpha=0.35)
        left.plot(
            history.steps["shift_x"][6:] / ONSET, pull, ".", color=line.get_color(), ms=4, label=f"{phase} degrees ahead"
        )
        right.plot(abs(history.steps["shift_x"] - exact)[6:] / abs(exact).max(), ".-", color=line.get_color())
    left.set(xlabel="shift / onset of sliding", ylabel=r"$T / \mu W$", title="lines: exact, dots: computed")
    left.legend(frameon=False, fontsize=8)
    right.set(xlabel="increment of the cycles", ylabel="error of shift / its largest", yscale="log", ylim=(1e-5, 1e-1))


def turning(left, right):
    """A force that turns, and one on a spiral."""
    pull = 0.7 * MU * FORCE
    wave = {"tangential_force": [pull, pull], "phase": {"tangential_force": [90, 0]}, "waveform": "sine"}
    circle = [
        pressed(),
        {"tangential_force": [pull, 0.0], "increments": 4},
        {**wave, "increments": 24, "cycles": 3},
    ]
    spiral = [pressed(), {**wave, "increments": 24, "cycles": 3, "envelope": [0, 1]}]
    for label, stages in {"circle": circle, "spiral": spiral}.items():
        history = fretting.run(scene(32, stages))
        left.plot(history.steps["shift_x"] / ONSET, history.steps["shift_y"] / ONSET, ".-", ms=3, label=label)
        if label == "circle":
            turned = []
            for step in range(5, len(history) - 6):
                a = [history.field(f"shear_{axis}", step=step) for axis in "xy"]
                b = [history.field(f"shear_{axis}", step=step + 6) for axis in "xy"]
                quarter = [-np.rot90(a[1]), np.rot90(a[0])]
                turned.append(max(abs(b[0] - quarter[0]).max(), abs(b[1] - quarter[1]).max()) / (MU * PEAK))
            right.semilogy(np.arange(len(turned)) / 24, turned, ".-")
    left.set(xlabel="shift along x / onset", ylabel="shift along y / onset", aspect="equal")
    left.legend(frameon=False)
    right.set(xlabel="turns", ylabel=r"shear, a quarter turn later / $\mu p_0$")


def torsion(left, right):
    """Twist to and fro: Lubkin, and Masing's rule for the way back."""
    full = 3 * np.pi * MU * FORCE / 16
    first = lambda m: np.array([analytic.torsion(sphere_contact(), MU, 0.25, v).twist if v else 0.0 for v in m])
    for cells in [24, 48, 96]:
        stages = [pressed(), {"twist_moment": 0.9 * full, "increments": 16, "cycles": 1}]
        history = fretting.run(scene(cells, stages))
        moment, twist = history.steps["twist_moment"], history.steps["twist"]
        exact = first(moment[1:5])
        back = exact[-1] - 2 * first((moment[4] - moment[5:13]) / 2)
        again = back[-1] + 2 * first((moment[13:] - moment[12]) / 2)
        exact = np.concatenate([exact, back, again])
        if cells == 96:
            left.plot(exact, moment[1:] / full, lw=3, alpha=0.35, label="Lubkin, Masing")
            left.plot(twist[1:], moment[1:] / full, "k.", label="computed")
        right.semilogy(abs(twist[1:] - exact) / abs(exact).max(), ".-", label=f"{cells} x {cells} cells")
    left.set(xlabel="twist [rad]", ylabel="moment / full-slip moment")
    left.legend(frameon=False)
    right.set(xlabel="increment", ylabel="error of twist / its largest", ylim=(3e-6, 3e-2))
    right.legend(frameon=False, ncols=3, fontsize=7)


def sphere_contact():
    """Hertz contact of the scene."""
    return analytic.hertz(radius=RADIUS, force=FORCE, modulus=MODULUS)


def plane(left, right):
    """Superposition of Jaeger and Ciavarella for a long wave, nu = 0.3."""
    modulus, amplitude = 1 / (2 * (1 - 0.09)), 0.01
    full = np.pi * modulus * amplitude
    mean = 0.4 * full
    errors = []
    counts = [64, 128, 256, 512, 1024]
    for cells in counts:
        area = 4 / cells
        pull = 0.7 * MU * mean
        body = {"substrate": {"young": 1.0, "poisson": 0.3}}
        case = {
            "grid": {"cells": [cells, 4], "size": [1.0, 4 / cells], "periodic": True},
            "upper": body,
            "lower": body,
            "profile": {"wave": {"amplitude": amplitude, "wavelength_x": 1.0}},
            "friction": {"coefficient": MU},
            "load": [
                {"normal_force": mean * area, "increments": 1},
                {"tangential_force": [pull * area, 0.0], "increments": 6},
                {"tangential_force": [-0.2 * pull * area, 0.0], "increments": 6},
            ],
        }
        history = fretting.run(case)
        at = lambda p: analytic.westergaard(
            amplitude=amplitude, wavelength=1.0, mean_pressure=p, modulus=modulus
        ).pressure(history.x)
        whole = at(mean)
        exact = MU * (whole - at(mean - pull / MU)) - 2 * MU * (whole - at(mean - 1.2 * pull / (2 * MU)))
        shear = history.field("shear_x")[:, 1]
        errors.append(np.sqrt(((shear - exact) ** 2).sum() / ((MU * whole) ** 2).sum()))
        if cells == 256:
            left.plot(history.x, exact / full, lw=3, alpha=0.35, label="superposition")
            left.plot(history.x, shear / full, "k.", ms=3, label="computed")
    left.set(xlabel="x / wavelength", ylabel="$q / p^*$, unloaded to $-0.2 T$")
    left.legend(frameon=False, loc="lower center", fontsize=8)
    right.loglog(counts, errors, "o-")
    right.set(xlabel="cells a wavelength", ylabel=r"error of shear, rms / rms of $\mu p$")


def sliding(left, right):
    """Amplitudes from partial to gross slip."""
    amplitudes = np.array([0.3, 0.6, 0.9, 1.1, 1.5, 2.0, 3.0])
    ratios, exact = [], []
    for amplitude in amplitudes:
        stages = [pressed(), {"shift": [amplitude * ONSET, 0.0], "increments": 60, "cycles": 2}]
        history = fretting.run({**scene(48, stages), "output": {"fields": []}})
        ratios.append(history.cycles["energy_ratio"][1])
        if amplitude in (0.6, 1.1, 2.0):
            left.plot(history.steps["shift_x"][1:] / ONSET, history.steps["tangential_force_x"][1:] / (MU * FORCE))
        f = 1 - max(1 - amplitude, 0) ** 1.5
        loop = 0.9 * (MU * FORCE) ** 2 / SHEAR * (1 - (1 - f) ** (5 / 3) - 5 * f / 6 * (1 + (1 - f) ** (2 / 3)))
        loop += 4 * MU * FORCE * max(amplitude - 1, 0) * ONSET
        exact.append(loop / (4 * f * MU * FORCE * amplitude * ONSET))
    left.set(xlabel="shift / onset of sliding", ylabel=r"$T / \mu W$")
    left.axhline(0, color="0.8", lw=0.5)
    right.plot(amplitudes, exact, lw=3, alpha=0.35, label="closed form")
    right.plot(amplitudes, ratios, "k.", label="computed")
    right.axhline(0.2, color="0.6", ls=":")
    right.set(xlabel="amplitude / onset of sliding", ylabel="energy ratio (dotted: criterion)")
    twin = right.twinx()
    twin.semilogy(amplitudes, abs(np.array(ratios) / exact - 1), "r.-", lw=0.8, ms=3)
    twin.set_ylabel("relative error", color="r")
    right.legend(frameon=False)


def mixed(left, right):
    """Force along x, motion held along y; and the same path as a table of motions."""
    coating = (2.0, 0.5)
    pull = 0.6 * MU * FORCE
    stage = {"tangential_force": [pull, "held"], "shift": ["held", 0.3 * ONSET], "increments": 8, "cycles": 1}
    by_force = fretting.run(scene(32, [pressed(), stage], coating))
    path = Path("loading_path.csv")
    rows = zip(by_force.steps["shift_x"][1:], by_force.steps["shift_y"][1:], strict=True)
    path.write_text("shift_x,shift_y\n" + "".join(f"{x!r},{y!r}\n" for x, y in np.array(list(rows)).tolist()))
    try:
        by_motion = fretting.run(scene(32, [pressed(), {"table": str(path), "increments": 1}], coating))
    finally:
        path.unlink()
    for axis in "xy":
        forces = [run.steps[f"tangential_force_{axis}"] / (MU * FORCE) for run in (by_force, by_motion)]
        left.plot(by_force.steps[f"shift_{axis}"] / ONSET, forces[0], ".-", label=f"along {axis}")
        right.semilogy(np.maximum(abs(forces[0] - forces[1]), 1e-17), ".-", label=f"along {axis}")
    left.set(xlabel="shift / onset of sliding", ylabel=r"force / $\mu W$", title="force given along x, shift along y")
    right.set(xlabel="increment", ylabel=r"force asked for or found / $\mu W$")
    left.legend(frameon=False)
    right.legend(frameon=False)


def steady(left, right):
    """Closure of a coupled cycle."""
    stages = [
        pressed(increments=6, ramp="cubic"),
        {
            "tangential_force": [0.7 * MU * FORCE, 0.0],
            "increments": 12,
            "until_steady": {"tolerance": 1e-5, "most_cycles": 30},
        },
    ]
    for label, coating in {"like bodies": None, "stiff coating": (2.0, 1.0), "soft coating": (0.5, 1.0)}.items():
        history = fretting.run(scene(32, stages, coating))
        right.semilogy(history.cycles["cycle"], np.maximum(history.cycles["closure"], 1e-16), "o-", label=label)
        if coating:
            shift = history.steps["shift_x"][6:] / ONSET
            left.plot(shift, history.steps["tangential_force_x"][6:] / (MU * FORCE), label=label)
    left.set(xlabel="shift / onset of sliding", ylabel=r"$T / \mu W$")
    left.legend(frameon=False)
    right.axhline(1e-5, color="0.6", ls=":")
    right.set(xlabel="cycle", ylabel="closure (dotted: asked for)")
    right.legend(frameon=False)


def wear(left, right):
    """Partial slip wears to a punch of the radius that sticks."""
    c, approach = 0.6, 1 / RADIUS
    shift = MU * MODULUS * approach * (1 - c**2) / (4 * SHEAR)
    stages = [
        {"approach": approach, "increments": 1},
        {"shift": [shift, 0.0], "increments": 8, "cycles": 240},
    ]
    case = scene(48, stages, wear={"coefficient": 25.0})
    case["grid"]["size"] = [3.2, 3.2]  # the scar becomes wider than the first contact
    case["output"] = {"fields": ["pressure"], "every": 8}
    history = fretting.run(case)
    middle = len(history.x) // 2
    for cycle in [0, 3, 15, 60, 239]:
        step = int(history.cycles["last_increment"][cycle])
        left.plot(history.x, history.field("pressure", step=step)[:, middle] / PEAK, lw=1, label=f"after {cycle + 1}")
    r = np.linspace(0, 0.999 * c, 300)
    root = np.sqrt(c**2 - r**2)
    limit = MODULUS / np.pi * (2 * root / RADIUS + (approach - c**2 / RADIUS) / root) / PEAK
    left.plot(np.concatenate([-r[::-1], r]), np.concatenate([limit[::-1], limit]), "k", lw=3, alpha=0.3, label="limit")
    left.set(xlabel="x / a", ylabel="$p / p_0$", ylim=(0, 2.5))
    left.legend(frameon=False, fontsize=7, title="cycles", title_fontsize=7)
    force = history.steps["normal_force"][history.cycles["last_increment"]]
    final = 2 * MODULUS * (approach * c - c**3 / (3 * RADIUS))
    right.loglog(history.cycles["cycle"], (force - final) / (FORCE - final), label="force above its limit")
    energy = history.steps["dissipated_energy"][history.cycles["last_increment"]]
    off = np.maximum(abs(history.cycles["worn_volume"] / (25.0 * energy) - 1), 1e-17)
    right.loglog(history.cycles["cycle"], off, label="volume against energy")
    right.set(xlabel="cycles", ylabel="relative")
    right.legend(frameon=False)


LOADINGS = {
    "changing_force": changing_force,
    "phases": phases,
    "turning": turning,
    "torsion": torsion,
    "plane": plane,
    "sliding": sliding,
    "mixed": mixed,
    "steady": steady,
    "wear": wear,
}

if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1] / "docs" / "pictures"
    for name, draw in LOADINGS.items():
        panels(name, folder, draw)
        print(folder / f"loading_{name}.png")
