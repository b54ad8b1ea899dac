"""The line that tells how far a run is."""

import sys
import time
from contextlib import suppress
from types import TracebackType
from typing import Any, Self


class _Line:
    """Writes to stderr: one line rewritten in place on a terminal, otherwise a line every few seconds."""

    def __init__(self) -> None:
        self._to = sys.stderr  # None in a program without a terminal, such as pythonw
        self._terminal = False
        with suppress(AttributeError, ValueError):  # there is none, or it is closed
            self._terminal = self._to.isatty()
        self._patience = 0.1 if self._terminal else 5.0
        self._start = self._last = time.monotonic()

    def due(self, done: int, count: int) -> float | None:
        """Return the seconds that are left when it is time to tell, else nothing."""
        now = time.monotonic()
        if done < count and now - self._last < self._patience:
            return None
        self._last = now
        return (now - self._start) / done * (count - done)

    def write(self, text: str) -> None:
        """Write the line."""
        self._send(f"\r{text}\x1b[K" if self._terminal else f"{text}\n")

    def end(self) -> None:
        """Leave the line."""
        if self._terminal:
            self._send("\n")

    def _send(self, text: str) -> None:
        """Send it to stderr; a terminal that has gone away ends no run."""
        with suppress(AttributeError, OSError, ValueError):
            self._to.write(text)
            self._to.flush()


class PointLine(_Line):
    """Tells how far a sweep is."""

    def __call__(self, news: dict[str, Any]) -> None:
        """Tell about a point, unless the last one was told just now."""
        left = self.due(news["done"], news["points"])
        if left is not None:
            failed = f"  {news['failed']} failed" if news["failed"] else ""
            self.write(f"point {news['done']}/{news['points']}{failed}  {left:.0f} s left")


class ProgressLine(_Line):
    """Tells how far a run is."""

    def __enter__(self) -> Self:
        """Start the clock."""
        return self

    def __call__(self, step: dict[str, Any], increments: int, passed: int) -> None:
        """Tell about a step, unless the last one was told just now."""
        done = step["increment"] + 1
        left = self.due(passed, increments)
        if left is not None:
            regime = step["regime"].replace("_", " ")
            solved = (
                f"{done} of {increments} solved" if passed == done else f"{done} solved for {passed} of {increments}"
            )
            number, residual = step["increment"], f"residual {step['residual']:.1e}"
            self.write(f"increment {number}  {regime}  {residual}  {solved}, {left:.0f} s left")

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Leave the line."""
        self.end()
