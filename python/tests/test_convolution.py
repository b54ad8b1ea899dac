"""The free-space product, against a plain sum and numpy's transform."""

import numpy as np
import pytest
from numpy.typing import NDArray

import fretting

PARITIES = ["even-even", "odd-even", "even-odd", "odd-odd"]


def full_kernel(values: NDArray[np.float64], parity: str) -> NDArray[np.float64]:
    """Return the kernel over all offsets of either sign, shape (2 nx - 1, 2 ny - 1)."""
    for axis, word in enumerate(parity.split("-")):
        positive = np.moveaxis(values, axis, 0)
        if word == "odd":
            positive = np.concatenate([np.zeros_like(positive[:1]), positive[1:]])
        mirrored = positive[:0:-1] * (-1.0 if word == "odd" else 1.0)
        values = np.moveaxis(np.concatenate([mirrored, positive]), 0, axis)
    return values


def direct_sum(values: NDArray[np.float64], parity: str, field: NDArray[np.float64]) -> NDArray[np.float64]:
    nx, ny = field.shape
    kernel = full_kernel(values, parity)
    result = np.zeros_like(field)
    for i in range(nx):
        for j in range(ny):
            window = kernel[i : i + nx, j : j + ny][::-1, ::-1]  # K[i - m, j - n] over (m, n)
            result[i, j] = np.sum(window * field)
    return result


@pytest.mark.parametrize("parity", PARITIES)
@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (6, 1), (8, 8), (13, 10), (31, 18)])
def test_equals_the_plain_double_sum(shape: tuple[int, int], parity: str) -> None:
    random = np.random.default_rng(7)
    values, field = random.normal(size=shape), random.normal(size=shape)
    found = fretting.Convolution(values, parity=parity)(field)  # type: ignore[arg-type]
    scale = np.abs(values).sum() * np.abs(field).max()
    assert np.abs(found - direct_sum(values, parity, field)).max() < 1e-15 * scale


@pytest.mark.parametrize("parity", PARITIES)
def test_equals_numpys_transform_on_a_larger_grid(parity: str) -> None:
    random = np.random.default_rng(11)
    shape = (96, 130)
    values, field = random.normal(size=shape), random.normal(size=shape)
    kernel = full_kernel(values, parity)
    size = (kernel.shape[0] + shape[0], kernel.shape[1] + shape[1])
    spectrum = np.fft.rfft2(kernel, size) * np.fft.rfft2(field, size)
    expected = np.fft.irfft2(spectrum, size)[shape[0] - 1 :, shape[1] - 1 :][: shape[0], : shape[1]]
    found = fretting.Convolution(values, parity=parity)(field)  # type: ignore[arg-type]
    assert np.abs(found - expected).max() < 1e-14 * np.abs(values).sum() ** 0.5 * np.abs(field).max() * 10.0


def test_default_parity_is_even() -> None:
    values = np.array([[4.0, 2.0], [1.0, 0.5]])
    field = np.array([[0.0, 0.0], [0.0, 1.0]])
    np.testing.assert_allclose(fretting.Convolution(values)(field), [[0.5, 1.0], [2.0, 4.0]], atol=1e-14)


def test_any_memory_order_and_number_type_gives_the_same_answer() -> None:
    random = np.random.default_rng(3)
    values = random.integers(-4, 5, size=(9, 6)).astype(np.float64)
    field = random.integers(-4, 5, size=(9, 6)).astype(np.float64)
    product = fretting.Convolution(values)
    expected = product(field)
    wide = np.zeros((18, 12))
    wide[::2, ::2] = field
    for same in (
        field.astype(np.float32),
        field.astype(np.int64),
        np.asfortranarray(field),
        wide[::2, ::2],
        field[::-1][::-1],
        field.tolist(),
    ):
        np.testing.assert_array_equal(product(same), expected)
        np.testing.assert_array_equal(fretting.Convolution(np.asfortranarray(values))(same), expected)


def test_does_not_touch_its_arguments_and_repeats_itself() -> None:
    random = np.random.default_rng(5)
    values, field = random.normal(size=(12, 12)), random.normal(size=(12, 12))
    copies = values.copy(), field.copy()
    product = fretting.Convolution(values, parity="odd-even")
    first = product(field)
    np.testing.assert_array_equal(product(field), first)
    np.testing.assert_array_equal(values, copies[0])
    np.testing.assert_array_equal(field, copies[1])
    assert product.shape == (12, 12)
    assert product.parity == "odd-even"


def test_bad_arguments_are_refused() -> None:
    values = np.ones((4, 3))
    with pytest.raises(ValueError, match=r"parity = .even."):
        fretting.Convolution(values, parity="even")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"values of shape \(3,\)"):
        fretting.Convolution(np.ones(3))
    with pytest.raises(ValueError, match="needs at least one cell"):
        fretting.Convolution(np.ones((0, 3)))
    with pytest.raises(ValueError, match=r"values: value nan at \[1, 2\]"):
        fretting.Convolution(np.where(np.arange(12).reshape(4, 3) == 5, np.nan, 1.0))
    product = fretting.Convolution(values)
    with pytest.raises(ValueError, match=r"field of shape \[3, 4\]: the product was made for \(4, 3\)"):
        product(values.T)
    with pytest.raises(ValueError, match=r"field: value inf at \[0, 0\]"):
        product(np.full((4, 3), np.inf))
    with pytest.raises(TypeError, match="complex128"):
        product(values * 1j)
