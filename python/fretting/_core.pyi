from collections.abc import Callable
from typing import Any, final

import numpy as np
import numpy.typing as npt

__all__ = [
    "Case",
    "Convolution",
    "History",
    "Solution",
    "__version__",
    "cattaneo_mindlin",
    "cone",
    "effective_moduli",
    "flat_punch",
    "frequency_response",
    "hertz",
    "hertz_ellipse",
    "hertz_line",
    "influence_coefficients",
    "mindlin_deresiewicz",
    "mindlin_deresiewicz_at",
    "plan",
    "run",
    "torsion",
    "westergaard",
]

__version__: str

@final
class Case:
    @staticmethod
    def from_toml(text: str, name: str, attachment: Callable[[str], bytes]) -> Case: ...
    @staticmethod
    def from_json(text: str, name: str, attachment: Callable[[str], bytes]) -> Case: ...

@final
class History:
    def steps(self) -> dict[str, npt.NDArray[Any] | list[str]]: ...
    def stages(self) -> list[str]: ...
    def centres(self, axis: int) -> npt.NDArray[np.float64]: ...
    def kept_steps(self) -> list[int]: ...
    def kept_fields(self, increment: int) -> list[str]: ...
    def field(self, name: str, increment: int) -> npt.NDArray[Any]: ...

@final
class Convolution:
    def __new__(cls, values: npt.NDArray[np.float64], parity: str) -> Convolution: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    def __call__(self, field: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...

def plan(case: Case) -> str: ...
def run(case: Case, threads: int | None, on_step: Callable[[dict[str, Any], int], object] | None) -> History: ...
def frequency_response(
    k: npt.NDArray[np.float64],
    coatings: list[tuple[float, float, float]],
    substrate: tuple[float, float] | None,
) -> dict[str, npt.NDArray[np.float64]]: ...
def influence_coefficients(
    coatings: list[tuple[float, float, float]],
    substrate: tuple[float, float] | None,
    cells: tuple[int, int],
    spacing: tuple[float, float],
) -> dict[str, npt.NDArray[np.float64]]: ...

@final
class Solution:
    def numbers(self) -> str: ...
    def curve(self, name: str, at: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...

def effective_moduli(lower: tuple[float, float], upper: tuple[float, float] | None) -> Solution: ...
def hertz(sphere: tuple[float, float, float]) -> Solution: ...
def hertz_ellipse(radii: tuple[float, float], force: float, modulus: float) -> Solution: ...
def hertz_line(radius: float, line_force: float, modulus: float) -> Solution: ...
def flat_punch(radius: float, force: float, modulus: float) -> Solution: ...
def cone(slope: float, force: float, modulus: float) -> Solution: ...
def westergaard(amplitude: float, wavelength: float, mean_pressure: float, modulus: float) -> Solution: ...
def cattaneo_mindlin(
    sphere: tuple[float, float, float], friction: float, shear_modulus: float, tangential_force: float
) -> Solution: ...
def mindlin_deresiewicz(
    sphere: tuple[float, float, float], friction: float, shear_modulus: float, amplitude: float
) -> tuple[Solution, Solution]: ...
def mindlin_deresiewicz_at(
    sphere: tuple[float, float, float],
    friction: float,
    shear_modulus: float,
    amplitude: float,
    branch: str,
    tangential_force: float,
) -> Solution: ...
def torsion(sphere: tuple[float, float, float], friction: float, shear_modulus: float, moment: float) -> Solution: ...
