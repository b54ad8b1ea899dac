"""The command ``fret`` of the wheel, the same to the letter as the program; also ``python -m fretting``."""

import signal
import sys
from collections.abc import Sequence

from fretting import _core


def main(words: Sequence[str] | None = None) -> int:
    """Do what the words after ``fret`` ask for (default: those of the process), and return the exit code."""
    if words is None:
        # As in a program of its own: until the command listens itself, Ctrl-C ends it at once.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        words = sys.argv[1:]
    return _core.command_line(["fret", *words])


if __name__ == "__main__":
    sys.exit(main())
