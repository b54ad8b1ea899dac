"""Shear traction through a fretting loop of a coated contact.

Rigid sphere of radius 10 mm on a half-space (210 GPa) with a coating of thickness h = a_H = 0.1 mm, (a) E_c/E_s = 1/2,
(b) E_c/E_s = 2, nu = 0.3, mu = 0.1, P = 30.8 N, tangential amplitude 0.754 mu P, 128 x 128 cells, 100 increments of
indentation and 300 of the loop. Shear along x through the centre. Grey: the friction limit. Indentation alone causes
shear, since the bodies are elastically dissimilar.
"""

import copy

from _figures import figure, letters, middle, save
from _paper import case, hertz

import fretting

shown = case("paper_figure_3.toml")
radius, peak = hertz(shown)
limit = shown["friction"]["coefficient"] * shown["load"][0]["normal_force"]
drawn, panels = figure(2, height=75, sharey=True)
DASHES = (":", "-", "--", "-.", (0, (5, 1, 1, 1, 1, 1)))  # told apart in print, too
names = {99: "after indentation", 174: "first peak", 249: "unloading", 324: "minimum", 399: "reloading"}
for axes, ratio, words, size in [(panels[0], 0.5, "1/2", 2.9e-4), (panels[1], 2, "2", 1.98e-4)]:
    this = copy.deepcopy(shown)
    this["lower"]["coatings"][0]["young"] = ratio * shown["lower"]["substrate"]["young"]
    this["grid"]["size"] = [size, size]
    history = fretting.run(this)
    x = history.x / radius
    for step, name in names.items():
        force = history.increments["tangential_force_x"][step] / limit
        force = 0.0 if abs(force) < 0.005 else force
        course = middle(history, "shear_x", step) / peak
        axes.plot(x, course, ls=DASHES[len(axes.lines)], lw=1, label=f"$Q/\\mu P$ = {force:.2f}, {name}")
    for sign in (1, -1):
        axes.plot(x, sign * 0.1 * middle(history, "pressure") / peak, color="0.75", lw=0.8, zorder=0)
    axes.lines[-1].set_label("$\\pm\\mu p$")
    axes.set(xlabel="$x / a_H$", title=f"$E_c/E_s$ = {words}")
panels[0].set_ylabel("$q_x / p_H$")
letters(panels)
drawn.legend(*panels[1].get_legend_handles_labels(), loc="outside lower center", ncols=3)
save(drawn)
