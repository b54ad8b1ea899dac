from collections.abc import Callable
from pathlib import Path
from typing import Any, final

import numpy as np
import numpy.typing as npt

__all__ = [
    "Case",
    "Convolution",
    "History",
    "InCommon",
    "Solution",
    "Start",
    "StoredRun",
    "__version__",
    "check_derivatives",
    "check_memory",
    "check_results",
    "check_threads",
    "closed_form",
    "closed_forms",
    "coating_fracture",
    "command_line",
    "contact_resistance",
    "crack",
    "expected",
    "fatigue",
    "first_order",
    "frequency_response",
    "gradient",
    "identify",
    "identify_indentation",
    "influence_coefficients",
    "kind_of_key",
    "line_history",
    "memory_needed",
    "mindlin_deresiewicz",
    "mindlin_deresiewicz_at",
    "moments",
    "plan",
    "pulled_back",
    "quantile_fractions",
    "run",
    "run_into",
    "sample_rows",
    "sobol_indices",
    "spence_table",
    "statistics",
    "study",
    "subsurface_displacement",
    "subsurface_stress",
    "surface_temperature",
    "tangential_history",
    "vocabulary",
]

__version__: str

# Pressure, shear, slip and bulk stress of every kept increment of a cycle; the residual stress, as JSON.
_Loading = tuple[
    list[
        tuple[
            npt.NDArray[np.float64],
            tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]] | None,
            tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]] | None,
            tuple[float, float],
        ]
    ],
    str,
]

@final
class Case:
    @staticmethod
    def from_toml(text: str, name: str, folder: Path, start: Start | None = None) -> Case: ...
    @staticmethod
    def from_json(
        text: str, name: str, folder: Path, arrays: list[npt.NDArray[np.float64]], start: Start | None = None
    ) -> Case: ...
    def beginnings(self) -> list[str]: ...
    def __reduce__(self) -> tuple[Callable[..., Case], tuple[Any, ...]]: ...

@final
class InCommon:
    def __new__(cls, histories: list[tuple[int, list[str]]]) -> InCommon: ...
    def increments(self) -> int: ...

def vocabulary() -> str: ...
def kind_of_key(key: str) -> str | None: ...

@final
class History:
    def increments(self) -> dict[str, npt.NDArray[Any] | list[str]]: ...
    def cycles(self) -> str: ...
    def worn_through(self) -> str: ...
    def worn_by_layer(self) -> str: ...
    def warnings(self) -> str: ...
    def running_conditions(self) -> str: ...
    def plan(self) -> str: ...
    def error_bars(self) -> str | None: ...
    def save(self, folder: Path, replace: bool, early: tuple[str, str] | None) -> None: ...
    def centres(self, axis: int) -> npt.NDArray[np.float64]: ...
    def kept_increments(self) -> list[int]: ...
    def kept_fields(self, increment: int) -> list[str]: ...
    def field(self, name: str, increment: int) -> npt.NDArray[Any]: ...

@final
class Start:
    @staticmethod
    def from_folder(folder: Path, increment: int | None) -> Start: ...
    @staticmethod
    def from_history(history: History, increment: int) -> Start: ...
    @staticmethod
    def from_bytes(content: bytes) -> Start: ...
    def digest(self) -> str: ...
    def __reduce__(self) -> tuple[Callable[..., Start], tuple[Any, ...]]: ...

@final
class StoredRun:
    def __new__(cls, folder: Path) -> StoredRun: ...
    def record(self) -> str: ...
    def increments(self) -> dict[str, Any]: ...
    def cycles(self) -> str: ...
    def running_conditions(self) -> str: ...
    def centres(self, axis: int) -> npt.NDArray[np.float64]: ...
    def kept_increments(self) -> list[int]: ...
    def kept_fields(self, increment: int) -> list[str]: ...
    def field(self, name: str, increment: int) -> npt.NDArray[Any]: ...

@final
class Convolution:
    def __new__(cls, values: npt.NDArray[np.float64], parity: str) -> Convolution: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    def __call__(self, field: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...

def command_line(words: list[str]) -> int: ...
def plan(case: Case) -> str: ...
def run(
    case: Case,
    threads: int | None,
    on_step: Callable[[dict[str, Any], int, int], object] | None,
    estimate_error: bool,
    point: tuple[InCommon, int] | None = None,
) -> tuple[History, BaseException | None]: ...
def run_into(
    case: Case,
    folder: Path,
    how: tuple[bool, bool, bool],
    threads: int | None,
    on_step: Callable[[dict[str, Any], int, int], object] | None,
) -> BaseException | None: ...
def gradient(
    case: Case,
    of: list[str],
    by: list[str],
    threads: int | None,
) -> tuple[
    list[tuple[str, float, dict[str, float], dict[str, float] | None]],
    tuple[int, int, int] | None,
]: ...
def check_results(of: list[str]) -> None: ...
def check_derivatives(case: Case, of: list[str], by: list[str]) -> None: ...
def pulled_back(
    case: Case,
    results: list[tuple[str, float]],
    fields: list[tuple[str, npt.NDArray[np.float64]]],
    by: list[str],
    threads: int | None,
) -> list[tuple[str, float]]: ...
def identify(
    log: tuple[str, bytes],
    case: Case,
    asked: tuple[list[tuple[str, str]], list[tuple[str, str]], float | None, int | None, str | None, bool],
    threads: int | None,
) -> tuple[str, str]: ...
def identify_indentation(
    log: tuple[str, bytes],
    case: Case,
    asked: tuple[list[tuple[str, str]], list[tuple[str, str]], list[str], str, float | None, bool, bool],
    threads: int | None,
) -> tuple[str, str]: ...
def study(
    case: Case,
    resolutions: tuple[list[int], list[int], list[float], str | None],
    threads: int | None,
    progress: bool,
) -> str: ...
def frequency_response(
    k: npt.NDArray[np.float64],
    case: Case,
) -> dict[str, npt.NDArray[np.float64]]: ...
def influence_coefficients(
    case: Case,
    cells: tuple[int, int],
    spacing: tuple[float, float],
) -> dict[str, npt.NDArray[np.float64]]: ...
def sample_rows(design: str) -> list[list[float]]: ...
def moments(distributions: str) -> list[list[float]]: ...
def first_order(derivatives: list[float], deviations: list[float]) -> tuple[float, list[float]]: ...
def quantile_fractions() -> list[float]: ...
def statistics(values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...
def sobol_indices(values: npt.NDArray[np.float64], count: int) -> npt.NDArray[np.float64]: ...
def surface_temperature(
    conductors: str,
    setting: tuple[tuple[float, float], bool | str],
    increments: list[
        tuple[
            npt.NDArray[np.float64],
            tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]],
            tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]],
        ]
    ],
    loading: tuple[float, float],
    threads: int | None,
) -> dict[str, Any]: ...
def contact_resistance(
    conductors: str,
    setting: tuple[tuple[float, float], bool | str],
    pressure: npt.NDArray[np.float64],
    threads: int | None,
) -> float: ...
def subsurface_displacement(
    bodies: tuple[str, bool],
    setting: tuple[tuple[float, float], bool | str],
    tractions: tuple[npt.NDArray[np.float64], tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]] | None],
    depths: list[float],
    threads: int | None,
) -> dict[str, npt.NDArray[Any]]: ...
def subsurface_stress(
    bodies: tuple[str, bool],
    setting: tuple[tuple[float, float], bool | str],
    tractions: tuple[npt.NDArray[np.float64], tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]] | None],
    depths: list[float],
    even: tuple[tuple[float, float], str],
    threads: int | None,
) -> dict[str, npt.NDArray[Any]]: ...

@final
class Solution:
    def numbers(self) -> str: ...
    def function(self, name: str, at: list[npt.NDArray[np.float64]]) -> npt.NDArray[np.float64]: ...

def closed_form(name: str, given: list[float]) -> Solution: ...
def closed_forms() -> str: ...
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
def tangential_history(
    sphere: tuple[float, float, float], friction: float, shear_modulus: float, forces: list[float]
) -> Solution: ...
def line_history(
    cylinder: tuple[float, float, float],
    friction: float,
    compliance: float,
    forces: list[float],
    datum: tuple[float, float] | None,
) -> Solution: ...
def fatigue(
    bodies: tuple[str, bool],
    setting: tuple[tuple[float, float], bool | str],
    loading: _Loading,
    depths: list[float],
    constants: str,
    threads: int | None,
) -> dict[str, Any]: ...
def crack(
    bodies: tuple[str, bool],
    setting: tuple[tuple[float, float], bool | str],
    loading: _Loading,
    constants: str,
    threads: int | None,
) -> str: ...
def coating_fracture(
    bodies: tuple[str, bool],
    setting: tuple[tuple[float, float], bool | str],
    loading: tuple[
        list[
            tuple[
                npt.NDArray[np.float64],
                tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]] | None,
                tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]] | None,
                tuple[float, float],
            ]
        ],
        str,
    ],
    constants: str,
    threads: int | None,
) -> str: ...
def spence_table() -> str: ...
def check_memory(what: str, bytes: int) -> None: ...  # noqa: A002  the name in the compiled module
def expected(case: Case) -> str: ...
def memory_needed(case: Case) -> int: ...
def check_threads(threads: int | None) -> None: ...
