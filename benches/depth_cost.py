"""Processor time of a depth of subsurface stress over that of eight convolutions by scipy, both in one run.

    python benches/depth_cost.py $(cargo bench -p fretting --bench subsurface --no-run 2>&1 | grep -o '/[^)]*subsurface-[^)]*')

One thread each; the two take turns, and the median of the ratios is told, so that other work on the machine weighs on both.
"""

import resource
import statistics
import subprocess
import sys
import time

import numpy
from scipy import fft

CELLS, DEPTHS, ROUNDS, TURNS = 128, 64, 4, 7


def convolution_seconds(count=400):
    """Processor time of a zero-padded convolution of real fields with a kernel that is transformed already."""
    field = numpy.random.default_rng(1).random((CELLS, CELLS))
    size = (2 * CELLS, 2 * CELLS)
    kernel = fft.rfft2(numpy.random.default_rng(2).random(size))
    started = time.process_time()
    for _ in range(count):
        fft.irfft2(fft.rfft2(field, s=size) * kernel, s=size)[:CELLS, :CELLS].copy()
    return (time.process_time() - started) / count


def depth_seconds(binary):
    """Processor time of a depth: a run of some rounds less one of none, which makes the tables of the method."""

    def run(rounds):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([binary, "1", str(rounds)], check=True, capture_output=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    return (run(ROUNDS) - run(0)) / (ROUNDS * DEPTHS)


def main():
    ratios = []
    for _ in range(TURNS):
        unit, depth = convolution_seconds(), depth_seconds(sys.argv[1])
        ratios.append(depth / (8 * unit))
        print(f"convolution {1e3 * unit:.2f} ms, depth {1e3 * depth:.2f} ms, ratio {ratios[-1]:.2f}")
    print(f"median ratio of a depth to eight convolutions: {statistics.median(ratios):.2f}")


if __name__ == "__main__":
    main()
