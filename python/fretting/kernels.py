"""Surface response of layered half-spaces, and convolutions of fields with it."""

from collections.abc import Mapping
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from fretting import _case, _core
from fretting._arguments import checked, reals, wholes
from fretting._arrays import Reals, real_array, room_for

Body: TypeAlias = Mapping[str, object]
"""A body as a case describes it."""
Parity: TypeAlias = Literal["even-even", "odd-even", "even-odd", "odd-odd"]


def frequency_response(
    k: npt.ArrayLike,
    body: Body,
) -> dict[str, Reals]:
    """Surface displacement per traction of a layered half-space, at wavenumbers.

    In the frame of the wavevector, with ``u_x = i U``, ``q_x = i Q`` and z into the body,
    ``(U, W) = [[rr, rz], [rz, zz]] (Q, P)`` and ``u_y = tt q_y``.

    Parameters
    ----------
    k : array_like
        Wavenumbers [rad/length], positive, any shape.
    body : mapping
        The body as in a case: ``{"coatings": [{"thickness": ..., "young": ..., "poisson": ...}], "substrate":
        {"young": ..., "poisson": ...}}``, ``"base": "rigid"`` in place of a substrate, graded coatings too.

    Returns
    -------
    dict of str to ndarray
        ``zz``, ``rr``, ``rz``, ``tt`` [length/pressure], each of the shape of `k`.

    Raises
    ------
    ValueError
        When a wavenumber is not positive. A body is refused as in a case, with a ``CaseError`` (a ``ValueError``).

    Examples
    --------
    >>> import fretting
    >>> response = fretting.frequency_response([1.0, 10.0], {
    ...     "coatings": [{"thickness": 0.1, "young": 2.0, "poisson": 0.3}],
    ...     "substrate": {"young": 1.0, "poisson": 0.3},
    ... })
    >>> response["zz"].shape
    (2,)
    """
    wavenumbers = real_array("k", k)
    if not (wavenumbers > 0.0).all():
        raise ValueError(f"k = {wavenumbers.min()}: wavenumbers must be positive")
    answer = _core.frequency_response(wavenumbers.ravel(), _case_of(body))
    return {name: values.reshape(wavenumbers.shape) for name, values in answer.items()}


def influence_coefficients(
    body: Body,
    *,
    cells: tuple[int, int],
    spacing: tuple[float, float],
) -> dict[str, Reals]:
    """Displacement of a cell by unit traction on another; non-periodic (infinite half-space).

    Entry ``[i, j]`` is the displacement at the centre of the cell at the offset ``(i dx, j dy)`` from the loaded one.
    Other signs of the offset follow by symmetry: ``zz``, ``xx``, ``yy`` are even in both, ``xy`` is odd in both, ``zx``
    is odd in x, ``zy`` in y.

    Parameters
    ----------
    body : mapping
        The body as in a case: ``{"coatings": [{"thickness": ..., "young": ..., "poisson": ...}], "substrate":
        {"young": ..., "poisson": ...}}``, ``"base": "rigid"`` in place of a substrate, graded coatings too.
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
        When a number of cells or a side is not positive. A body is refused as in a case, with a ``CaseError``.
    """
    found, sides = wholes("cells", cells), reals("spacing", spacing)
    if len(found) != 2 or len(sides) != 2:
        raise ValueError(f"cells = {found}, spacing = {sides}: must have two numbers each")
    (nx, ny), (dx, dy) = found, sides
    if nx < 1 or ny < 1:
        raise ValueError(f"cells = {(nx, ny)}: each side needs at least one cell")
    if not (np.isfinite([dx, dy]).all() and dx > 0.0 and dy > 0.0):
        raise ValueError(f"spacing = {(dx, dy)}: must be positive finite lengths")
    room_for(f"cells = {(nx, ny)}", 18 * nx * ny)  # six tables, and the work on them
    return _core.influence_coefficients(_case_of(body), (nx, ny), (dx, dy))


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

    @checked
    def __init__(self, values: npt.ArrayLike, *, parity: Parity = "even-even") -> None:
        kernel = real_array("values", values, dimensions=2)
        room_for(f"values of shape {kernel.shape}", 9 * kernel.size)  # kernel, its transform, and the work on a field
        self._product = _core.Convolution(kernel, parity)
        self._values, self._parity = kernel.copy(), parity

    def __getstate__(self) -> dict[str, Any]:
        """Return what it was made of."""
        return {"values": self._values, "parity": self._parity}

    def __setstate__(self, made_of: dict[str, Any]) -> None:
        """Make it again."""
        self.__init__(**made_of)  # type: ignore[misc]

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


def _case_of(body: Body) -> _core.Case:
    """Return a case whose lower body is this one: it is read and checked as in a case."""
    if not isinstance(body, Mapping):
        raise TypeError(
            "body: expected a mapping as in a case, {'coatings': [...], 'substrate': {...}}, "
            f"found {type(body).__name__}"
        )
    return _case.read(
        {
            "grid": {"cells": [4, 4], "size": "auto"},
            "upper": {"rigid": True},
            "lower": body,
            "profile": {"sphere": {"radius": 1.0}},
            "load": [{"normal_force": 1.0, "increments": 1}],
        }
    )
