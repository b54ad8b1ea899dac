"""The line that tells how far a run is."""

import sys
import time
from types import TracebackType
from typing import Any, Self


class ProgressLine:
    """Writes to stderr: one line rewritten in place on a terminal, otherwise a line every few seconds."""

    def __init__(self) -> None:
        self._terminal = sys.stderr.isatty()
        self._patience = 0.1 if self._terminal else 5.0
        self._start = self._last = time.monotonic()

    def __enter__(self) -> Self:
        """Start the clock."""
        return self

    def __call__(self, step: dict[str, Any], increments: int) -> None:
        """Tell about a step, unless the last one was told just now."""
        done = step["increment"] + 1
        now = time.monotonic()
        if done < increments and now - self._last < self._patience:
            return
        self._last = now
        left = (now - self._start) / done * (increments - done)
        text = (
            f"increment {done}/{increments}  {step['regime'].replace('_', ' ')}  residual {step['residual']:.1e}  "
            f"{left:.0f} s left"
        )
        end = "" if self._terminal else "\n"
        sys.stderr.write(f"\r{text}\x1b[K{end}" if self._terminal else f"{text}{end}")
        sys.stderr.flush()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Leave the line."""
        if self._terminal:
            sys.stderr.write("\n")
            sys.stderr.flush()
