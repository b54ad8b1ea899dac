"""Surface response of layered half-spaces, and convolutions of fields with it."""

from collections.abc import Sequence
from typing import Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from fretting import _core
from fretting._arrays import Reals, real_array, room_for

Parity: TypeAlias = Literal["even-even", "odd-even", "even-odd", "odd-odd"]


def frequency_response(
    k: npt.ArrayLike,
    coatings: Sequence[tuple[float, float, float]],
    substrate: tuple[float, float] | None,
) -> dict[str, Reals]:
    """Surface displacement per traction of a layered half-space, at wavenumbers.

    In the frame of the wavevector, with ``u_x = i U``, ``q_x = i Q`` and z into the body,
    ``(U, W) = [[rr, rz], [rz, zz]] (Q, P)`` and ``u_y = tt q_y``.

    Parameters
    ----------
    k : array_like
        Wavenumbers [rad/length], positive, any shape.
    coatings : sequence of (young, poisson, thickness)
        Bonded coatings, outermost first [pressure, -, length]; may be empty.
    substrate : (young, poisson) or None
        The half-space below [pressure, -]; ``None`` for a rigid foundation.

    Returns
    -------
    dict of str to ndarray
        ``zz``, ``rr``, ``rz``, ``tt`` [length/pressure], each of the shape of `k`.

    Raises
    ------
    ValueError
        When a wavenumber, modulus, ratio or thickness is out of its range.

    Examples
    --------
    >>> import fretting
    >>> response = fretting.frequency_response([1.0, 10.0], [(2.0, 0.3, 0.1)], (1.0, 0.3))
    >>> response["zz"].shape
    (2,)
    """
    wavenumbers = real_array("k", k)
    if not (wavenumbers > 0.0).all():
        raise ValueError(f"k = {wavenumbers.min()}: wavenumbers must be positive")
    answer = _core.frequency_response(wavenumbers.ravel(), _coatings(coatings), _substrate(substrate))
    return {name: values.reshape(wavenumbers.shape) for name, values in answer.items()}


def influence_coefficients(
    coatings: Sequence[tuple[float, float, float]],
    substrate: tuple[float, float] | None,
    cells: tuple[int, int],
    spacing: tuple[float, float],
) -> dict[str, Reals]:
    """Displacement of a cell by unit traction on another; non-periodic (infinite half-space).

    Entry ``[i, j]`` is the displacement at the centre of the cell at the offset ``(i dx, j dy)`` from the loaded one.
    Other signs of the offset follow by symmetry: ``zz``, ``xx``, ``yy`` are even in both, ``xy`` is odd in both, ``zx``
    is odd in x, ``zy`` in y.

    Parameters
    ----------
    coatings : sequence of (young, poisson, thickness)
        Bonded coatings, outermost first [pressure, -, length]; may be empty.
    substrate : (young, poisson) or None
        The half-space below [pressure, -]; ``None`` for a rigid foundation.
    cells : (int, int)
        Number of offsets along x and y.
    spacing : (float, float)
        Sides of a cell [length].

    Returns
    -------
    dict of str to ndarray
        ``zz`` (``u_z`` by pressure), ``xx``, ``yy``, ``xy`` (tangential displacement by shear), ``zx``, ``zy``
        (``u_z`` by shear; ``u_x`` by pressure is minus ``zx``), each of shape `cells` [length/pressure].

    Raises
    ------
    ValueError
        When a value is out of its range.
    """
    nx, ny = (int(count) for count in cells)
    dx, dy = (float(side) for side in spacing)
    if nx < 1 or ny < 1:
        raise ValueError(f"cells = {(nx, ny)}: each side needs at least one cell")
    if not (np.isfinite([dx, dy]).all() and dx > 0.0 and dy > 0.0):
        raise ValueError(f"spacing = {(dx, dy)}: must be positive finite lengths")
    room_for(f"cells = {(nx, ny)}", 18 * nx * ny)  # six tables, and the work on them
    return _core.influence_coefficients(_coatings(coatings), _substrate(substrate), (nx, ny), (dx, dy))


class Convolution:
    """Non-periodic product of a field with one translation-invariant kernel.

    ``result[i, j] = sum over (m, n) of K[i - m, j - n] field[m, n]``, with nothing outside the grid.

    Parameters
    ----------
    values : array_like
        Kernel over offsets ``i >= 0``, ``j >= 0``, shape (nx, ny), the shape of the fields.
    parity : {"even-even", "odd-even", "even-odd", "odd-odd"}
        Continuation to negative offsets along x, then y. Along an odd axis the values at offset 0 count as zero.

    Examples
    --------
    >>> import fretting
    >>> product = fretting.Convolution([[4.0, 2.0], [1.0, 0.5]])
    >>> product([[0.0, 0.0], [0.0, 1.0]]).round(12)
    array([[0.5, 1. ],
           [2. , 4. ]])
    """

    def __init__(self, values: npt.ArrayLike, parity: Parity = "even-even") -> None:
        kernel = real_array("values", values, dimensions=2)
        room_for(f"values of shape {kernel.shape}", 8 * kernel.size)  # the transformed kernel, and the work on a field
        self._product = _core.Convolution(kernel, parity)
        self._parity = parity

    @property
    def shape(self) -> tuple[int, int]:
        """Shape (nx, ny) of the fields."""
        return self._product.shape

    @property
    def parity(self) -> Parity:
        """Continuation of the kernel to negative offsets."""
        return self._parity

    def __call__(self, field: npt.ArrayLike) -> Reals:
        """Return the product with a field of shape (nx, ny), in the same shape."""
        return self._product(real_array("field", field, dimensions=2))

    def __repr__(self) -> str:
        """Shape and parity."""
        return f"Convolution(shape={self.shape}, parity={self.parity!r})"


def _coatings(coatings: Sequence[tuple[float, float, float]]) -> list[tuple[float, float, float]]:
    checked = []
    for index, coating in enumerate(coatings):
        numbers = [float(number) for number in coating]
        if len(numbers) != 3:
            raise ValueError(f"coatings[{index}] has {len(numbers)} numbers: must be (young, poisson, thickness)")
        checked.append((numbers[0], numbers[1], numbers[2]))
    return checked


def _substrate(substrate: tuple[float, float] | None) -> tuple[float, float] | None:
    if substrate is None:
        return None
    numbers = [float(number) for number in substrate]
    if len(numbers) != 2:
        raise ValueError(f"substrate has {len(numbers)} numbers: must be (young, poisson)")
    return numbers[0], numbers[1]
