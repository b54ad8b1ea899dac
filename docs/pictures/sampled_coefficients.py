"""Influence coefficients by sampling the frequency response, and their error.

Normal displacement of a cell by unit pressure on the origin cell, coated half-space, E_c/E_s = 2, coating 10 cells
thick, nu = 0.3, 256 x 256 cells. Sampled: response at the wavenumbers of a zero-padded grid (twice the domain) that is
further extended 1, 2, 4 and 8 times, value at k = 0 from the mean of 1/k over the frequency cell. Error
relative to the coefficient itself against 62-digit arithmetic (tests/golden/normal_coefficients.json). Dashed: this
program.
"""

import json

import numpy as np
from _figures import BLACK, ROOT, figure, save

import fretting

golden = json.loads((ROOT / "tests/golden" / "normal_coefficients.json").read_text(encoding="utf-8"))
CELLS = 256
BODY = {
    "coatings": [{"thickness": 10.0, "young": 2.0, "poisson": 0.3}],
    "substrate": {"young": 1.0, "poisson": 0.3},
}
offsets = [(0, 0), (3, 2), (64, 0), (255, 0)]


def reference() -> list[float]:
    """Values of the reference table for this coating."""
    rows = [row for row in golden["rows"] if row["layers"] == [[2.0, 0.3, 10.0]]]
    return [float(next(row["zz"] for row in rows if (row["i"], row["j"]) == offset)) for offset in offsets]


def sampled(extension: int) -> list[float]:
    """Coefficients from the response sampled on an extended grid."""
    n = CELLS * 2 * extension
    k = 2 * np.pi * np.fft.fftfreq(n)
    kx, ky = np.meshgrid(k, 2 * np.pi * np.fft.rfftfreq(n), indexing="ij")
    size = np.hypot(kx, ky)
    lattice = np.geomspace(size[size > 0].min(), size.max(), 4000)
    response = lattice * fretting.frequency_response(lattice, BODY)["zz"]
    symbol = np.zeros_like(size)
    symbol[size > 0] = np.interp(np.log(size[size > 0]), np.log(lattice), response) / size[size > 0]
    symbol[0, 0] = 4 * np.log(1 + np.sqrt(2)) / (2 * np.pi / n) * response[0]
    cells = np.fft.irfft2(symbol * np.sinc(kx / 2 / np.pi) * np.sinc(ky / 2 / np.pi), s=(n, n))
    return [cells[i, j] for i, j in offsets]


exact = reference()
drawn, axes = figure(height=70, wide=False)
extensions = [1, 2, 4, 8]
found = np.array([sampled(e) for e in extensions])
for number, (offset, mark) in enumerate(zip(offsets, "osv^", strict=True)):
    axes.loglog(extensions, abs(found[:, number] / exact[number] - 1), mark + "-", lw=0.9, label=f"offset {offset}")
ours = fretting.influence_coefficients(BODY, cells=(CELLS, 1), spacing=(1.0, 1.0))["zz"]
near = fretting.influence_coefficients(BODY, cells=(4, 3), spacing=(1.0, 1.0))["zz"]
worst = max(abs(v / e - 1) for v, e in zip((near[0, 0], near[3, 2], ours[64, 0], ours[255, 0]), exact, strict=True))
axes.axhline(max(worst, 1e-16), color=BLACK, ls="--", lw=0.9, label="this program, largest")
axes.set(
    xlabel="extension of the grid",
    ylabel="relative error",
    xticks=extensions,
    xticklabels=extensions,
    ylim=(1e-16, 1e3),
)
axes.minorticks_off()
axes.legend(fontsize=6, loc="center right")
save(drawn)
