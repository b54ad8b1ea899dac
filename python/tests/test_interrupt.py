"""Ctrl-C ends a run, soon."""

import signal
import subprocess
import sys
import time

import pytest

LONG_RUN = """
import fretting, signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell starts what runs behind it without
print("ready", flush=True)
told = False
def on_step(step):
    global told
    if not told:
        print("running", flush=True)
        told = True
try:
    fretting.run({
        "grid": {"cells": [64, 64], "size": "auto"},
        "upper": {"rigid": True},
        "lower": {"coatings": [{"thickness": 1e-4, "young": 420e9, "poisson": 0.3}],
                  "substrate": {"young": 210e9, "poisson": 0.3}},
        "profile": {"sphere": {"radius": 10e-3}},
        "friction": {"coefficient": 0.3},
        "load": [{"normal_force": 12.0, "increments": 100000}],
    }, progress=on_step)
except KeyboardInterrupt:
    print("interrupted", flush=True)
    sys.exit(7)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to one process")
def test_sigint_raises_keyboard_interrupt_within_a_second() -> None:
    with subprocess.Popen([sys.executable, "-c", LONG_RUN], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            assert process.stdout.readline() == "ready\n"
            assert process.stdout.readline() == "running\n"
            time.sleep(0.2)
            sent = time.monotonic()
            process.send_signal(signal.SIGINT)
            assert process.stdout.readline() == "interrupted\n"
            assert time.monotonic() - sent < 1.0
            assert process.wait(timeout=30) == 7
        finally:
            process.kill()
