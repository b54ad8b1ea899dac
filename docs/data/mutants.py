"""Mutation testing: every mutant of a set of files in one build, chosen when a test starts.

    cargo install cargo-mutants --locked; pip install tree-sitter tree-sitter-rust
    python docs/data/mutants.py build COPY 'crates/fret-core/src/kernel/*.rs' [--every 3]
    python docs/data/mutants.py run COPY [--minutes 7] [--only REGEX] [--tests REGEX] [--longest SECONDS] [--again]
    python docs/data/mutants.py whole-runs COPY [--minutes 7]
    python docs/data/mutants.py report COPY

``build`` copies the repository to ``COPY`` (outside of it), takes the list of `cargo mutants`, writes each mutant
beside the expression that it changes (``match mutant(7, 9) { 0 => a + b, 7 => a - b, ... }``), drops what the compiler
refuses and builds the tests of the package. ``run`` sees first which test reaches which mutant, then gives every mutant
to the tests that reach it, those of its own file and the quick ones first, until one fails; it goes on where it was
stopped. What a test may take is processor time, so a loaded machine fails none. ``whole-runs`` gives the survivors to
the tests of whole runs, too: `tests/`, then those of the command. ``report`` prints the figures of each
file, and the survivors.
"""

import argparse
import fnmatch
import json
import math
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections import Counter, defaultdict
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import tree_sitter_rust
from tree_sitter import Language, Node, Parser

ROOT = Path(__file__).parents[2]
PACKAGES = {"crates/fret-core": "fretting", "crates/fret-fft": "fretting-fft"}
WHOLE_RUNS = (("fret-validation", "tests"), ("fretting-cli", "crates/fret-cli"))
WORKERS = 2
CAUGHT = ("caught", "caught by tests/", "caught by the command's tests")
MISSED = ("missed", "missed by tests/", "missed by all")
MEMORY = 6 << 30
"""Bytes that one test process may take: a mutant may ask for anything."""

SWITCH = """
/// Number of the mutant that runs if it is one of `first..=last`, else 0.
#[doc(hidden)]
#[allow(missing_docs, clippy::all)]
#[inline(always)]
pub fn mutant(first: u32, last: u32) -> u32 {
    let chosen = MUTANT.load(std::sync::atomic::Ordering::Relaxed);
    if chosen >= u32::MAX - 1 {
        return seen(chosen, first, last);
    }
    if chosen.wrapping_sub(first) <= last - first { chosen } else { 0 }
}

static MUTANT: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(u32::MAX);
static REACHED: [std::sync::atomic::AtomicBool; 20000] = [const { std::sync::atomic::AtomicBool::new(false) }; 20000];

#[inline(never)]
fn seen(chosen: u32, first: u32, last: u32) -> u32 {
    use std::io::Write;
    use std::sync::atomic::Ordering::Relaxed;
    if chosen == u32::MAX {
        MUTANT.store(std::env::var("MUTANT").map_or(0, |text| text.parse().unwrap()), Relaxed);
        return mutant(first, last);
    }
    let reached = &REACHED[first as usize];
    if !reached.load(Relaxed) && !reached.swap(true, Relaxed) {
        let place = std::env::var("REACHED").unwrap();
        let mut file = std::fs::File::options().append(true).create(true).open(place).unwrap();
        file.write_all(format!("{first} {last}\\n").as_bytes()).unwrap();
    }
    0
}
"""
RECORD = str(2**32 - 2)


@dataclass
class Site:
    """What one node of the syntax tree becomes."""

    node: Node
    mutants: list[dict[str, Any]] = field(default_factory=list)


def environment(copy: Path, **variables: str) -> dict[str, str]:
    """Return the environment of a build or a test in the copy."""
    ours = {"CARGO_PROFILE_RELEASE_DEBUG": "0", "CARGO_INCREMENTAL": "1", "RUST_MIN_STACK": str(64 << 20)}
    return {"CARGO_TARGET_DIR": str(copy / "target")} | os.environ | ours | variables


def listed(words: list[str]) -> str:
    """Return what a command prints in the repository."""
    return subprocess.run(words, capture_output=True, text=True, check=True, cwd=ROOT).stdout


def built(copy: Path, package: str, tests: str) -> tuple[int, list[dict[str, Any]]]:
    """Build tests of a package in the copy: return the exit code and what cargo says."""
    words = ["cargo", "test", "--release", "--locked", "--package", package, tests, "--no-run", "--message-format=json"]
    done = subprocess.run(words, capture_output=True, text=True, check=False, cwd=copy, env=environment(copy))
    return done.returncode, [json.loads(line) for line in done.stdout.split("\n")[:-1]]


def flat(node: Node) -> str:
    """Return the text of a node in one line, without its comments."""
    if node.type in ("line_comment", "block_comment"):
        return " "
    if not node.children or node.type in ("string_literal", "raw_string_literal", "char_literal"):
        return node.text.decode()
    pieces, end = [], node.children[0].start_byte
    for child in node.children:
        pieces += [" " if child.start_byte > end else "", flat(child)]
        end = child.end_byte
    return "".join(pieces)


def is_constant(node: Node) -> bool:
    """Whether the compiler must know the value of a node: nothing can be chosen there at run time."""
    child = None
    while node is not None and node.type != "function_item":
        if node.type in ("const_item", "static_item", "array_type", "const_block", "type_arguments", "enum_variant"):
            return True
        length = node.child_by_field_name("length") if node.type == "array_expression" else None
        if length is not None and child is not None and length.id == child.id:
            return True
        child, node = node, node.parent
    return node is not None and node.text.split(b"fn ", 1)[0].find(b"const") >= 0


class Switched:
    """The source of one file with its mutants beside what they change."""

    def __init__(self, source: bytes, mutants: list[dict[str, Any]]) -> None:
        self.source = source
        self.tree = Parser(Language(tree_sitter_rust.language())).parse(source)
        starts = [0]
        for line in source.split(b"\n"):
            starts.append(starts[-1] + len(line) + 1)
        lines = source.decode().split("\n")
        self.sites: dict[int, Site] = {}
        self.unplaced = []
        for mutant in mutants:
            begin, end = (
                starts[at["line"] - 1] + len(lines[at["line"] - 1][: at["column"] - 1].encode())
                for at in (mutant["span"]["start"], mutant["span"]["end"])
            )
            node = self.place(mutant, begin, end)
            if node is None:
                self.unplaced.append(mutant)
            else:
                self.sites.setdefault(node.id, Site(node)).mutants.append(mutant)

    def place(self, mutant: dict[str, Any], begin: int, end: int) -> Node | None:
        """Return the node that a mutant changes."""
        node = self.tree.root_node.descendant_for_byte_range(begin, end)
        wanted = {
            "FnValue": ("function_item",),
            "BinaryOperator": ("binary_expression", "compound_assignment_expr"),
            "UnaryOperator": ("unary_expression",),
            "MatchArm": ("match_arm",),
            "MatchArmGuard": ("match_arm",),
            "StructField": ("struct_expression",),
        }[mutant["genre"]]
        while node is not None and node.type not in wanted:
            node = node.parent
        if node is None or is_constant(node) or (node.type == "binary_expression" and b"let " in node.text):
            return None  # a chain of `let`s is no value
        if mutant["genre"] == "FnValue" and "impl " in mutant["function"]["return_type"]:
            return None  # a second value has another type
        if mutant["genre"] == "MatchArm" and not any(
            (arm.child_by_field_name("pattern") or arm).text == b"_" for arm in node.parent.children
        ):
            return None  # without a last arm for the rest the compiler wants all of them
        mutant["begin"] = begin
        return node

    def render(self, node: Node) -> str:
        """Return the text of a node with the switches in it."""
        site = self.sites.get(node.id)
        inner = self.inner(node)
        if site is None or not site.mutants:
            return inner
        numbers = sorted(m["number"] for m in site.mutants)
        call = f"crate::mutant({numbers[0]}, {numbers[-1]})"
        if node.type == "function_item":
            at = inner.index("{", len(self.inner_until(node, node.child_by_field_name("body"))))
            values = [
                f"\n/*m{m['number']}*/ if {call} == {m['number']} {{ return {m['replacement']}; }}\n"
                for m in site.mutants
            ]
            return inner[: at + 1] + "".join(values).replace("\n\n", "\n") + inner[at + 1 :]
        if node.type == "match_arm":
            return self.arm(node, site, call)
        arms = [f"\n/*m{m['number']}*/ {m['number']} => ({self.changed(node, m)})," for m in site.mutants]
        return f"(match {call} {{ 0 => ({inner}),{''.join(arms)}\n _ => unreachable!() }})"

    def inner(self, node: Node) -> str:
        """Return the text of a node with the switches of its parts in it."""
        if not node.children:
            return node.text.decode()
        return self.inner_until(node, None) + self.source[node.children[-1].end_byte : node.end_byte].decode()

    def inner_until(self, node: Node, stop: Node | None) -> str:
        """Return the rendered text of a node up to one of its children."""
        pieces, at = [], node.start_byte
        for child in node.children:
            pieces.append(self.source[at : child.start_byte].decode())
            if stop is not None and child.id == stop.id:
                break
            pieces.append(self.render(child))
            at = child.end_byte
        return "".join(pieces)

    def changed(self, node: Node, mutant: dict[str, Any]) -> str:
        """Return the expression that a mutant puts in the place of a node."""
        if node.type == "unary_expression":
            return flat(node.children[-1])
        if node.type == "struct_expression":
            body = node.child_by_field_name("body")
            kept = [flat(c) for c in body.named_children if c.start_byte != mutant["begin"] and "comment" not in c.type]
            return f"{flat(node.child_by_field_name('name'))} {{ {', '.join(kept)} }}"
        left, right = (flat(node.child_by_field_name(side)) for side in ("left", "right"))
        if node.type == "compound_assignment_expr":
            return f"{left} {mutant['replacement']} ({right})"
        return f"({left}) {mutant['replacement']} ({right})"

    def arm(self, node: Node, site: Site, call: str) -> str:
        """Return an arm of a match that a mutant leaves out, or whose guard it decides."""
        pattern = node.child_by_field_name("pattern")
        condition = pattern.child_by_field_name("condition")
        guard = "true" if condition is None else self.render(condition)
        head = flat(pattern)
        if condition is not None:
            head = head.removesuffix(flat(condition)).rstrip().removesuffix("if")
        for m in site.mutants:
            value = m["replacement"] if m["genre"] == "MatchArmGuard" else "false"
            guard = f"\n/*m{m['number']}*/ (if {call} == {m['number']} {{ {value} }} else {{ {guard} }})"
        value = node.child_by_field_name("value")
        tail = self.source[value.end_byte : node.end_byte].decode()
        return f"{head} if {guard} => {self.render(value)}{tail}"

    def text(self, dropped: set[int]) -> str:
        """Return the whole file without the dropped mutants."""
        for site in self.sites.values():
            site.mutants = [m for m in site.mutants if m["number"] not in dropped]
        root = self.tree.root_node
        return self.source[: root.start_byte].decode() + self.render(root) + self.source[root.end_byte :].decode()


def build(copy: Path, patterns: list[str], every: int) -> None:
    """Make the copy with its mutants and build its tests."""
    paths = listed(["git", "ls-files", "--cached", "--others", "--exclude-standard"]).split("\n")
    for path in filter(None, paths):
        if (ROOT / path).exists():
            (copy / path).parent.mkdir(parents=True, exist_ok=True)
            if not (copy / path).exists() or (copy / path).read_bytes() != (ROOT / path).read_bytes():
                shutil.copy(ROOT / path, copy / path)
    files = [p for p in paths if any(fnmatch.fnmatchcase(p, pattern) for pattern in patterns)]
    package = next(root for root in PACKAGES if files[0].startswith(root))
    words = ["cargo", "mutants", "--list", "--json", "--package", PACKAGES[package], *(f"--file={p}" for p in files)]
    mutants = json.loads(listed(words))[::every]
    of_file = defaultdict(list)
    for number, mutant in enumerate(mutants, 1):
        mutant["number"] = number
        del mutant["diff"]
        of_file[mutant["file"]].append(mutant)
    sources = {path: Switched((ROOT / path).read_bytes(), of) for path, of in of_file.items()}
    dropped = {m["number"] for s in sources.values() for m in s.unplaced}
    root = copy / package / "src/lib.rs"
    root.write_text((ROOT / package / "src/lib.rs").read_text(encoding="utf-8") + SWITCH, encoding="utf-8")
    for _ in range(12):
        for path, source in sources.items():
            (copy / path).write_text(source.text(dropped), encoding="utf-8")
        binary, refused = compiled(copy, PACKAGES[package])
        if binary:
            break
        dropped |= refused
    for mutant in mutants:
        mutant["state"] = "refused" if mutant["number"] in dropped else "untried"
    write(copy, {"package": package, "binaries": [[binary, package]], "mutants": mutants})
    print(Counter(m["state"] for m in mutants))


def compiled(copy: Path, package: str) -> tuple[str | None, set[int]]:
    """Build the unit tests: return the binary, or the numbers of the mutants that the compiler refuses."""
    code, messages = built(copy, package, "--lib")
    if code == 0:
        return next(m["executable"] for m in messages if m.get("executable")), set()
    refused, strange = set(), []
    for inner in (m["message"] for m in messages if m["reason"] == "compiler-message"):
        if inner["level"] != "error":
            continue
        found = set()
        for span in sorted(inner["spans"], key=lambda s: not s["is_primary"]):
            line = (copy / span["file_name"]).read_text(encoding="utf-8").split("\n")[span["line_start"] - 1]
            found = {int(number) for number in re.findall(r"^/\*m(\d+)\*/", line)}
            if found:
                break
        else:
            text = "\n".join(row["text"] for span in inner["spans"] if span["is_primary"] for row in span["text"])
            for first, last in re.findall(r"crate::mutant\((\d+), (\d+)\)", text)[:1]:
                found = set(range(int(first), int(last) + 1))
        refused |= found
        if not found:
            strange.append(inner["rendered"])
    if not refused:
        sys.exit("the copy does not compile:\n" + "\n".join(strange[:5]))
    return None, refused


def write(copy: Path, state: dict[str, Any]) -> None:
    """Keep what is known."""
    (copy / "mutants.json.new").write_text(json.dumps(state), encoding="utf-8")
    (copy / "mutants.json.new").replace(copy / "mutants.json")


def tried(copy: Path, binary: list[str], tests: list[str], seconds: float, **variables: str) -> tuple[bool, float]:
    """Return whether the named tests pass in the processor time allowed, and the processor time that they took."""

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds), math.ceil(seconds) + 2))

    process = subprocess.Popen(
        [binary[0], "--exact", "--test-threads=1", *tests],
        env=environment(copy, RAYON_NUM_THREADS="2", **variables),
        cwd=copy / binary[1],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        preexec_fn=limited,
        start_new_session=True,
    )
    sleeper = threading.Timer(1800 + 100 * seconds, os.killpg, (process.pid, signal.SIGKILL))
    sleeper.start()
    _, status, used = os.wait4(process.pid, 0)
    sleeper.cancel()
    process.returncode = status
    return status == 0, used.ru_utime + used.ru_stime


def reach(copy: Path, binary: list[str], chosen: str) -> dict[str, Any]:
    """Return for every chosen test its time and the mutants that it reaches; tests that fail unchanged are left out."""
    lines = listed([binary[0], "--list"]).split("\n")
    names = [line.removesuffix(": test") for line in lines if line.endswith(": test")]
    names = [name for name in names if re.search(chosen, name)]

    def one(name: str) -> tuple[str, float, list[int]] | None:
        file = copy / f"reached-{abs(hash(name))}"
        passed, spent = tried(copy, binary, [name], 240, MUTANT=RECORD, REACHED=str(file))
        rows = file.read_text(encoding="utf-8").split("\n")[:-1] if file.exists() else []
        file.unlink(missing_ok=True)
        numbers = sorted({n for row in rows for n in range(int(row.split()[0]), int(row.split()[1]) + 1)})
        return (name, spent, numbers) if passed else None

    with ThreadPoolExecutor(WORKERS) as pool:
        found = [one_test for one_test in pool.map(one, names) if one_test]
    print(f"{len(names)} tests, {sum(bool(one_test[2]) for one_test in found)} of them reach a mutant")
    print("fail unchanged:", sorted(set(names) - {one_test[0] for one_test in found}))
    return {name: {"seconds": seconds, "reaches": numbers} for name, seconds, numbers in found if numbers}


def run(copy: Path, minutes: float, only: str, longest: float, tests: str, again: bool, place: int) -> None:
    """Try the mutants that are left with the tests of the package (0) or of whole runs (1, 2) that are not too long."""
    end = time.monotonic() + 60 * minutes
    state = json.loads((copy / "mutants.json").read_text(encoding="utf-8"))
    binary = state["binaries"][place]
    reached = state.setdefault("reached", {})
    if binary[0] not in reached:
        reached[binary[0]] = reach(copy, binary, tests)
        write(copy, state)
    tests_of = defaultdict(list)
    for name, test in sorted(reached[binary[0]].items(), key=lambda item: item[1]["seconds"]):
        for number in test["reaches"] if test["seconds"] <= longest and re.search(tests, name) else ():
            tests_of[number].append((name, test["seconds"]))

    def one(mutant: dict[str, Any]) -> dict[str, Any]:
        if time.monotonic() > end:
            return {}
        home = mutant["file"].partition("src/")[2].removesuffix(".rs").removesuffix("/mod").replace("/", "::")
        left = sorted(tests_of[mutant["number"]], key=lambda test: not test[0].startswith(home + "::"))
        portion = 1
        while left:
            now, left = left[:portion], left[portion:]
            seconds = 5 + 5 * sum(spent for _, spent in now)
            if not tried(copy, binary, [name for name, _ in now], seconds, MUTANT=str(mutant["number"]))[0]:
                return {"state": CAUGHT[place], "by": [name for name, _ in now]}
            portion *= 3
        return {"state": MISSED[place]}

    before = {MISSED[place - 1]} if place > 0 else {"untried", "missed"} if again else {"untried"}
    wanted = [m for m in state["mutants"] if m["state"] in before and re.search(only, m["file"])]
    wanted = [mutant for first in range(3) for mutant in wanted[first::3]]  # what is cut short is a sample
    written = time.monotonic()
    with ThreadPoolExecutor(WORKERS) as pool:
        for mutant, found in zip(wanted, pool.map(one, wanted), strict=True):
            mutant |= found
            if time.monotonic() > written + 20:
                write(copy, state)
                written = time.monotonic()
    write(copy, state)
    print(Counter(m["state"] for m in state["mutants"]))


def whole_runs(copy: Path) -> None:
    """Build the tests of whole runs if they are not."""
    state = json.loads((copy / "mutants.json").read_text(encoding="utf-8"))
    for package, folder in WHOLE_RUNS[len(state["binaries"]) - 1 :]:
        _, messages = built(copy, package, "--tests")
        executables = [m["executable"] for m in messages if m.get("executable") and m["target"]["kind"] == ["test"]]
        state["binaries"].append([executables[0], folder])
    write(copy, state)


def report(copy: Path) -> None:
    """Print a row per file, and the survivors."""
    mutants = json.loads((copy / "mutants.json").read_text(encoding="utf-8"))["mutants"]
    states = defaultdict(Counter)
    for mutant in mutants:
        states[mutant["file"]][mutant["state"]] += 1
    for path, counts in states.items():
        print(path, dict(counts))
    for mutant in mutants:
        if mutant["state"].startswith("missed"):
            print(mutant["name"])


def main() -> None:
    """Read the words of the command."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("what", choices=["build", "run", "whole-runs", "report"])
    words.add_argument("copy", type=lambda text: Path(text).resolve())
    words.add_argument("files", nargs="*")
    words.add_argument("--every", type=int, default=1)
    words.add_argument("--minutes", type=float, default=1e6)
    words.add_argument("--only", default="", help="files whose names match")
    words.add_argument("--tests", default="", help="tests whose names match")
    words.add_argument("--again", action="store_true", help="the missed ones, too: with more or longer tests")
    words.add_argument("--longest", type=float, default=1e6, help="seconds of a test")
    given = words.parse_args()
    if given.what == "build":
        build(given.copy, given.files, given.every)
    elif given.what == "run":
        run(given.copy, given.minutes, given.only, given.longest, given.tests, given.again, 0)
    elif given.what == "whole-runs":
        whole_runs(given.copy)
        for place in (1, 2):
            run(given.copy, given.minutes / 2, given.only, given.longest, given.tests, False, place)
    else:
        report(given.copy)


if __name__ == "__main__":
    main()
