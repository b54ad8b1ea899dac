"""Time the redraws of ``fret explore``: a slider dragged through the HTTP interface, one question after the other, as the page asks them.

    python benches/explore.py [CASE ...] [--cells 64]

Prints for every slider how often a second the contact is solved and drawn again (median of 20 redraws), and the processor time of
one redraw, which other programs on the machine change less (Linux). The aim is 15 a second at 64 x 64 cells. Wants ``fret`` on the path,
and nothing else.
"""

import argparse
import json
import os
import re
import statistics
import subprocess
import time
import urllib.request
from pathlib import Path

ROOT = Path(__file__).parents[1]
CASES = ["coated_sphere", "hertz", "gross_slip", "cylinder_with_bulk_stress", "torsional_fretting"]
REDRAWS = 20
AIM = 15


def ask(address: str, values: dict[str, float]) -> float:
    """Return the seconds from the question to the last byte of its answer."""
    question = urllib.request.Request(address + "solve", json.dumps({"values": values}).encode(), method="POST")
    started = time.perf_counter()
    with urllib.request.urlopen(question) as answer:
        told = json.load(answer)
    if told["status"] != "solved":
        raise SystemExit(f"{values}: {told}")
    return time.perf_counter() - started


def processor_ms(process: int) -> float:
    """Return the processor time of a process so far in milliseconds; not a number where the system does not tell."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return float("nan")
    return 1000 * (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def sliders(address: str) -> list[dict[str, float]]:
    """Return the sliders of the page."""
    with urllib.request.urlopen(address) as answer:
        page = answer.read().decode()
    found = re.search(r'id="setting">(.*?)</script>', page, re.DOTALL)
    assert found
    return list(json.loads(found[1])[0]["sliders"])


def main() -> None:
    """Drag every slider by a third of its way around the value of the case."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="*", default=[str(ROOT / "examples" / f"{name}.toml") for name in CASES])
    parser.add_argument("--cells", default="64")
    parser.add_argument("--fret", default="fret")
    arguments = parser.parse_args()
    if hasattr(os, "getloadavg"):
        print(f"load of the machine at the start: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    for case in arguments.cases:
        call = [arguments.fret, "explore", case, "--cells", arguments.cells]
        with subprocess.Popen(call, stdout=subprocess.PIPE, text=True) as served:
            assert served.stdout
            address = served.stdout.readline().split()[-1]
            print(Path(case).name)
            ask(address, {})
            for slider in sliders(address):
                low, high, value = slider["low"], slider["high"], slider["value"]
                ways = [value + (n / REDRAWS - 0.5) / 3 * min(high - value, value - low) for n in range(REDRAWS)]
                before = processor_ms(served.pid)
                rate = 1 / statistics.median([ask(address, {slider["key"]: way}) for way in ways])
                each = (processor_ms(served.pid) - before) / REDRAWS
                note = "" if rate >= AIM else "below the aim"
                print(f"  {slider['key']:<40} {rate:6.1f} a second {each:6.1f} ms of processor time {note}".rstrip())
            served.terminate()


if __name__ == "__main__":
    main()
