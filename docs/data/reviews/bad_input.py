"""Feed bad case files to `fret run`: each must be refused with exit code 1, quickly, without a crash and before
anything is written.

    python docs/data/reviews/bad_input.py

with `fret` on the path; prints how many were refused, and those that were not. Every file is a good case with one
thing spoilt.
"""

import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

GOOD = """[grid]
cells = [48, 48]
size = "auto"
[upper]
rigid = true
[lower]
coatings = [{ thickness = 7e-5, young = 420e9, poisson = 0.3 }]
substrate = { young = 210e9, poisson = 0.3 }
[profile.sphere]
radius = 10e-3
[friction]
coefficient = 0.3
[[load]]
name = "press"
normal_force = 12.0
increments = 2
[[load]]
tangential_force = [2.5, 0.0]
cycles = 1
increments = 8
"""

NUMBERS = [
    "nan",
    "inf",
    "-inf",
    "-1.0",
    "1e-320",
    "1e400",
    '"12 N"',
    "true",
    "[]",
    "{}",
    "[1.0, 2.0, 3.0]",
    "1979-05-27",
]
PLACES = {
    "young = 210e9": "young = {}",
    "poisson = 0.3 }\n[profile": "poisson = {} }}\n[profile",
    "thickness = 7e-5": "thickness = {}",
    "radius = 10e-3": "radius = {}",
    "normal_force = 12.0": "normal_force = {}",
    "coefficient = 0.3": "coefficient = {}",
    "[2.5, 0.0]": "[{}, 0.0]",
    "cells = [48, 48]": "cells = [{}, 48]",
    'size = "auto"': "size = [{}, 1e-3]",
    "increments = 8": "increments = {}",
    "cycles = 1": "cycles = {}",
}
"""What is spoilt, and how it is written with another number."""

# A force that wears zero, a cycle of no number and the like may have a meaning: these pairs are left out.
ALLOWED = {
    ("[2.5, 0.0]", "-1.0"),
    ("[2.5, 0.0]", "1e-320"),
    ("normal_force = 12.0", "1e-320"),
    ("coefficient = 0.3", "1e-320"),
    ("poisson = 0.3 }\n[profile", "1e-320"),
}


def spoilt() -> Iterator[tuple[str, bytes]]:
    """Return a name and the bytes of every bad file."""
    for place, text in PLACES.items():
        for number in NUMBERS:
            if (place, number) not in ALLOWED:
                yield f"{place} -> {number}", GOOD.replace(place, text.format(number)).encode()
    good = GOOD.encode()
    yield "empty", b""
    yield "nothing but blanks", b" \n\t\n"
    yield "binary", bytes(range(256)) * 20
    yield "UTF-16", GOOD.encode("utf-16")
    yield "Latin-1", good.replace(b"press", "pre\xdf".encode("latin-1"))
    yield "a NUL", good.replace(b"press", b"pr\0ss")
    yield "cut in the middle of a table", good[: len(good) // 2 - 3]
    yield "a doubled key", good.replace(b"radius = 10e-3", b"radius = 10e-3\nradius = 11e-3")
    yield "a misspelt key", good.replace(b"radius", b"raduis")
    yield "an unknown key in Greek", good.replace(b"[friction]", b'[friction]\n"\xce\xbc" = 0.3')
    yield "no load", good[: good.index(b"[[load]]")]
    yield "an empty stage", good + b"[[load]]\n"
    yield (
        "both bodies rigid",
        good.replace(b"coatings = [{ thickness = 7e-5, young = 420e9, poisson = 0.3 }]\nsubstrate", b"rigid = true #"),
    )
    yield "two controls of one motion", good.replace(b"normal_force = 12.0", b"normal_force = 12.0\napproach = 1e-6")
    yield "more force than friction carries", good.replace(b"[2.5, 0.0]", b"[3.7, 0.0]")
    yield "a contact beyond the grid", good.replace(b'"auto"', b"[4e-5, 4e-5]")
    yield "five thousand brackets", b"a = " + b"[" * 5000
    yield "two hundred thousand brackets", b"a = " + b"[" * 200000
    yield "a million by a million cells", good.replace(b"[48, 48]", b"[1000000, 1000000]")
    yield "10^18 increments", good.replace(b"increments = 8", b"increments = 1000000000000000000")
    yield "10^12 cycles", good.replace(b"cycles = 1", b"cycles = 1000000000000")
    yield (
        "a table that is not there",
        good.replace(b"cycles = 1\nincrements = 8", b'table = "nowhere.csv"\nincrements = 1').replace(
            b"tangential_force = [2.5, 0.0]\n", b""
        ),
    )
    yield (
        "heights that are not there",
        good.replace(b"[profile.sphere]\nradius = 10e-3", b'[profile.heights]\nfile = "nowhere.npy"'),
    )
    yield (
        "heights from a device",
        good.replace(b"[profile.sphere]\nradius = 10e-3", b'[profile.heights]\nfile = "/dev/zero"'),
    )
    yield (
        "heights from a folder",
        good.replace(b"[profile.sphere]\nradius = 10e-3", b'[profile.heights]\nfile = "/tmp"'),
    )
    yield (
        "heights from pickled code",
        good.replace(b"[profile.sphere]\nradius = 10e-3", b'[profile.heights]\nfile = "pickle.npy"'),
    )
    yield "a map of another shape", good.replace(b"coefficient = 0.3", b"map = [[0.1, 0.2], [0.3, 0.4]]")


if __name__ == "__main__":
    count, slowest, wrong = 0, 0.0, []
    with tempfile.TemporaryDirectory() as folder:
        case, out = Path(folder) / "case.toml", Path(folder) / "results"
        (Path(folder) / "pickle.npy").write_bytes(b"\x80\x04cposix\nsystem\n(S'touch pwned'\ntR.")
        for name, content in spoilt():
            case.write_bytes(content)
            begin = time.perf_counter()
            call = ["fret", "run", str(case), "--out", str(out)]
            done = subprocess.run(call, capture_output=True, text=True, timeout=60, check=False, cwd=folder)
            slowest = max(slowest, time.perf_counter() - begin)
            count += 1
            crashed = any(word in done.stderr for word in ("panicked", "Traceback", "RUST_BACKTRACE"))
            if done.returncode != 1 or crashed or out.exists() or not done.stderr.startswith("error"):
                wrong.append((name, done.returncode, done.stderr.splitlines()[:1]))
            if out.exists():
                out.rename(Path(folder) / f"kept{count}")
        assert not (Path(folder) / "pwned").exists()
    print(f"{count} files, {count - len(wrong)} refused with exit code 1 and a place; the slowest took {slowest:.2f} s")
    for row in wrong:
        print(*row)
