"""Results of a case as a function for JAX, with their derivatives by numbers of the case. Needs ``jax``."""

from collections.abc import Callable, Iterable
from typing import Any

try:
    import jax
    import jax.numpy as jnp
except ImportError as error:
    raise ImportError("fretting.jax needs JAX: pip install jax") from error

from fretting import _case
from fretting._function import Results

__all__ = ["results"]


def results(
    case: _case.CaseLike, *, of: str | Iterable[str], by: str | Iterable[str], threads: int | None = None
) -> Callable[[Any], Any]:
    """Return a function of numbers of a case that runs it and gives its results, for ``jax.grad`` and ``jax.jit``.

    Parameters
    ----------
    case : path, str or mapping
        As for :func:`fretting.run`; with a ``size`` of the grid in numbers, which does not move with the case.
    of : str or iterable of str
        Results, as for :func:`fretting.gradient`.
    by : str or iterable of str
        Numbers of the case, as for :func:`fretting.gradient`.
    threads : int, optional
        Worker threads. Default: all cores.

    Returns
    -------
    callable
        From an array of the numbers, in the order of `by`, to an array of the results, in the order of `of`; both of
        the precision of JAX, single without ``jax.config.update("jax_enable_x64", True)``. Has first derivatives.

    Raises
    ------
    CaseError
        When the case cannot be read.
    ValueError
        Without a result or a number, or of a result that has no derivatives.
    """
    host = Results(case, of, by, threads)
    rows, columns = len(host.of), len(host.by)

    def shape(numbers: Any, *sides: int) -> jax.ShapeDtypeStruct:
        return jax.ShapeDtypeStruct(sides, numbers.dtype)

    def at(numbers: Any) -> Any:
        values = lambda given: host.values(given).astype(given.dtype)  # noqa: E731
        return jax.pure_callback(values, shape(numbers, rows), numbers, vmap_method="sequential")

    def forward(numbers: Any) -> tuple[Any, Any]:
        def found(given: Any) -> tuple[Any, Any]:
            values, matrix = host.differentiated(given)
            return values.astype(given.dtype), matrix.astype(given.dtype)

        shapes = (shape(numbers, rows), shape(numbers, rows, columns))
        values, matrix = jax.pure_callback(found, shapes, numbers, vmap_method="sequential")
        return values, matrix

    def backward(matrix: Any, weights: Any) -> tuple[Any]:
        return (weights @ matrix,)

    function = jax.custom_vjp(at)
    function.defvjp(forward, backward)
    return lambda numbers: function(jnp.asarray(numbers, dtype=jnp.result_type(float)))
