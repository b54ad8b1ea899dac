"""Results of a case as a function for PyTorch, with their derivatives by numbers of the case. Needs ``torch``."""

from collections.abc import Callable, Iterable
from typing import Any

try:
    import torch
    from torch.autograd.function import once_differentiable
except ImportError as error:
    raise ImportError("fretting.torch needs PyTorch: pip install torch") from error

from fretting import _case
from fretting._function import Results

__all__ = ["results"]


class _Run(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, numbers: Any, host: Results) -> Any:
        values, matrix = host.differentiated(numbers.detach().cpu().numpy())
        ctx.save_for_backward(torch.as_tensor(matrix).to(numbers))
        return torch.as_tensor(values).to(numbers)

    @staticmethod
    @once_differentiable  # type: ignore[untyped-decorator]
    def backward(ctx: Any, *weights: Any) -> Any:
        (matrix,) = ctx.saved_tensors
        return weights[0] @ matrix, None


def results(
    case: _case.CaseLike, *, of: str | Iterable[str], by: str | Iterable[str], threads: int | None = None
) -> Callable[[Any], Any]:
    """Return a function of numbers of a case that runs it and gives its results, for ``backward()``.

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
        From a tensor of the numbers, in the order of `by`, to a tensor of the results, in the order of `of`, of the
        same precision (double or single) and on the same device. Has first derivatives.

    Raises
    ------
    CaseError
        When the case cannot be read.
    ValueError
        Without a result or a number, or of a result that has no derivatives.
    """
    host = Results(case, of, by, threads)

    def function(numbers: Any) -> Any:
        if numbers.dtype not in (torch.float64, torch.float32):
            raise TypeError(f"numbers: expected a tensor of float64 or float32, found {numbers.dtype}")
        if torch.is_grad_enabled() and numbers.requires_grad:
            return _Run.apply(numbers, host)
        return torch.as_tensor(host.values(numbers.detach().cpu().numpy())).to(numbers)

    return function
