"""Files of instruments: read by SurfaceTopography, handed to the core with the lengths that they state."""

import warnings
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from fretting._arrays import Reals

Scan: TypeAlias = tuple[Reals, tuple[float, float] | None, list[float] | None, str | None, str]
"""Heights with NaN for holes, side lengths, places of points not evenly spaced, unit, and who read the file."""


class NoScanError(Exception):
    """A file is no scan that can be read; its words become those of a ``CaseError``."""


def read(path: Path, channel: str | None) -> Scan:
    """Read the heights of a file, of the channel of a name or the first with heights.

    Raises
    ------
    NoScanError
        In words, why there are none.
    """
    try:
        open_topography = import_module("SurfaceTopography.IO").open_topography
    except ImportError as error:
        raise NoScanError(
            "a file of an instrument, perhaps: SurfaceTopography, which reads some 40 formats, "
            f"cannot be imported ({error}); pip install 'fretting[instruments]'"
        ) from None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of numbers that a file does not state: what is missing is asked for here
        try:
            with open_topography(str(path)) as reader:
                chosen = _channel(reader, channel)
                return _scan(reader, chosen)
        except NoScanError:
            raise
        except Exception as error:  # whatever a damaged or unknown file makes of forty readers
            words = str(error).strip().split("\n")[0] or type(error).__name__
            raise NoScanError(
                f"no numbers, and no file of an instrument that SurfaceTopography reads: {words}"
            ) from None


def _channel(reader: Any, name: str | None) -> Any:
    if name is None:
        return reader.default_channel
    named = [channel for channel in reader.channels if channel.name == name]
    if not named:
        names = ", ".join(f'"{channel.name}"' for channel in reader.channels)
        raise NoScanError(f'the file has no channel "{name}"; its channels are {names}')
    return named[0]


def _scan(reader: Any, channel: Any) -> Scan:
    states_size = channel.physical_sizes is not None
    asked = {} if states_size else {"physical_sizes": tuple(float(n) for n in channel.nb_grid_pts)}
    topography = channel.topography(**asked)
    words = f'SurfaceTopography {version("SurfaceTopography")}, format {reader.format()}, channel "{channel.name}"'
    places = None
    if topography.is_uniform:
        heights = topography.heights()
    else:
        x, heights = topography.positions_and_heights()
        x = np.asarray(x, dtype=np.float64)
        places = [float(place) for place in x - x[0]]
    # a copy: nothing may refer to the file when it is closed
    heights = np.array(np.ma.filled(np.ma.asarray(heights, dtype=np.float64), np.nan))
    if heights.size == 0:
        raise NoScanError("a file without a point")
    size = None
    if states_size:
        sides = [float(side) for side in topography.physical_sizes]
        size = (sides[0], sides[-1])
    unit = topography.unit
    return np.ascontiguousarray(heights.reshape(len(heights), -1)), size, places, unit, words
