"""Partial slip of a coated contact, from the sketch to the zones.

(a) A rigid ball, R = 10 mm, on a coated half-space: E_s = 210 GPa, nu = 0.3, coating thickness h = a_H = 73 um (Hertz
radius of the uncoated substrate), mu = 0.3, P = 12 N. (b) Fretting loops (second cycle) of amplitude 0.9 mu P for
three coatings; displacement relative to the onset of gross slip of the uncoated contact. (c) Stick and slip zones of
E_c/E_s = 2 at the points 1 to 4 of the loop. 96 x 96 cells, 20 + 96 increments.
"""

import matplotlib.pyplot as plt
from _coated import HERTZ, along, coated, cycle
from _figures import MM, WIDE, save, zone_legend, zones
from _sketch import contact

import fretting

drawn = plt.figure(figsize=(WIDE, 60 * MM))
grid = drawn.add_gridspec(2, 4, width_ratios=[2.3, 2.2, 1, 1])
sketch, loops = drawn.add_subplot(grid[:, 0]), drawn.add_subplot(grid[:, 1])
contact(sketch, labels=False)
marks = [67 + 12, 67 + 24, 67 + 36, 67 + 48]
for ratio, dashes in ((0.5, "--"), (1.0, "-."), (2.0, "-")):  # told apart in print, too
    history = fretting.run(coated(ratio, [cycle(0.9)], output={"fields": ["zone"], "every": 1}))
    x, y = along(history)
    label = {0.5: "1/2", 1.0: "1", 2.0: "2"}[ratio]
    (line,) = loops.plot(x[67:], y[67:], dashes, label=f"$E_c/E_s$ = {label}")
for number, step in enumerate(marks, 1):
    loops.plot(x[step], y[step], "o", color=line.get_color(), ms=4)
    side = 0.13 if number == 2 else -0.13
    loops.text(x[step] + side, y[step] - 0.03, str(number), ha="center", va="center", fontsize=7, fontweight="bold")
    axes = drawn.add_subplot(grid[(number - 1) // 2, 2 + (number - 1) % 2])
    zones(axes, history, step, HERTZ.contact_radius)
    axes.set(xticks=[], yticks=[])
    axes.text(0.04, 0.96, f"{number}", transform=axes.transAxes, fontsize=7, fontweight="bold", va="top")
zone_legend(drawn, loc="outside lower right", ncols=3)
loops.axhline(0, color="0.85", lw=0.6, zorder=0)
loops.axvline(0, color="0.85", lw=0.6, zorder=0)
loops.set(xlabel="$\\delta\\ /\\ \\delta_{onset}$", ylabel="$Q / \\mu P$")
loops.legend(loc="upper left", fontsize=6, handlelength=2.2)
for axes, letter in ((sketch, "(a)"), (loops, "(b)")):
    axes.set_title(letter, loc="left", fontweight="bold", fontsize=8)
drawn.axes[2].set_title("(c)", loc="left", fontweight="bold", fontsize=8)
save(drawn)
