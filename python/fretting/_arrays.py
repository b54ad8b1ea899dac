"""Arrays as the compiled module wants them: double precision, contiguous, finite."""

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from fretting import _core

Reals: TypeAlias = npt.NDArray[np.float64]


_LARGE = 1_000_000
"""Arrays of more numbers are asked about before they are copied: a view may stand for any number of them."""


def real_array(name: str, values: npt.ArrayLike, dimensions: int | None = None, *, kinds: str = "fiu") -> Reals:
    """Turn `values` into a contiguous array of finite doubles; without a copy when it is one already.

    `kinds` are the letters of the kinds of numbers that are taken; ``b`` are masks.

    Raises
    ------
    TypeError
        When the values are not real numbers.
    ValueError
        When the number of dimensions is another one, or a value is not finite.
    """
    try:
        given = np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{name}: expected an array of real numbers; {error}") from None
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        raise ValueError(f"{name}: has masked values; what is under a mask is no number")
    if given.dtype.kind not in kinds:
        raise TypeError(f"{name}: expected real numbers, found an array of {given.dtype}")
    if dimensions is not None and given.ndim != dimensions:
        raise ValueError(f"{name} of shape {given.shape}: must have {dimensions} dimensions")
    if given.size > _LARGE:
        room_for(f"{name} of shape {given.shape}", given.size)
    array: Reals = np.require(given, np.float64, ["C_CONTIGUOUS", "ALIGNED"])
    if not np.isfinite(array).all():
        place = tuple(int(index) for index in np.argwhere(~np.isfinite(array))[0])
        raise ValueError(f"{name}: value {array[place]} at {list(place)} is not finite")
    return array


def room_for(what: str, reals: int) -> None:
    """Refuse what would not fit into memory, before any of it is asked for.

    Raises
    ------
    OutOfMemoryError
        A ``MemoryError``: when the machine and the limits of this process leave less than so many real numbers need.
    """
    _core.check_memory(what, min(8 * reals, 2**63 - 1))
