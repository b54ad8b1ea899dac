"""Heights and friction maps of the example cases: `python examples/make_arrays.py` writes them beside the cases."""

from pathlib import Path

import numpy as np

HERE = Path(__file__).parent


def roughness(cells: int, longest: float, exponent: float, seed: int) -> np.ndarray:
    """Periodic heights with unit root mean square: random phases, amplitudes falling as a power of the wavenumber."""
    k = np.hypot(*np.meshgrid(np.fft.fftfreq(cells) * cells, np.fft.rfftfreq(cells) * cells, indexing="ij"))
    cut = (k >= 1 / longest) & (k <= cells / 4)
    amplitudes = np.where(cut, np.maximum(k, 1) ** -exponent, 0.0)
    phases = np.exp(2j * np.pi * np.random.default_rng(seed).random(k.shape))
    heights = np.fft.irfft2(amplitudes * phases, s=(cells, cells))
    return heights / heights.std()


# Ground steel, in micrometres, rms 0.2, with the tilt of a sample that did not lie flat.
tilt = np.linspace(-0.5, 0.5, 48)[:, None] + np.linspace(-0.2, 0.2, 48)[None, :]
np.save(HERE / "surfaces/ground.npy", (0.2 * roughness(48, 0.5, 1.8, 1) + tilt).astype(np.float32))
# A lapped surface, in micrometres, rms 0.05, as text.
lapped = 0.05 * roughness(48, 0.25, 1.8, 2)
np.savetxt(HERE / "surfaces/lapped.txt", lapped, fmt="%.4f", header="heights in um, 48 x 48; a line is one x")
# A lubricated stripe, |x| < 0.2 of the side: friction falls from 0.6 to 0.1 there.
x = np.linspace(-0.5, 0.5, 48)[:, None] + np.zeros((1, 48))
np.save(HERE / "friction/stripe.npy", (0.35 + 0.25 * np.tanh((np.abs(x) - 0.2) / 0.03)).astype(np.float32))
# A film worn through in a disc: bare metal 0.8, film 0.1.
worn = np.where(np.hypot(x, x.T) < 0.18, 0.8, 0.1)
np.savetxt(
    HERE / "friction/worn_disc.txt", worn, fmt="%.1f", header="coefficient of friction, 48 x 48; a line is one x"
)
# No friction on the half x < 0.
np.savetxt(HERE / "friction/half.txt", np.where(x < 0, 0.0, 0.5), fmt="%.1f", header="coefficient of friction, 48 x 48")
