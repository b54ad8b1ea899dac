"""Draw the figures of the pages.

    python docs/pictures/draw.py [NAME ...]

runs the scripts ``docs/pictures/NAME.py`` (all of them without a name; ``--stale`` those that have changed since they
were run) and notes in ``drawn.json`` the hash of what drew each picture, the date, the version and the commit. A test
compares the hashes: no picture is older than its script. Needs fretting, numpy, scipy and matplotlib; some minutes.
"""

import datetime
import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
RECORD = HERE / "drawn.json"


def scripts() -> dict[str, Path]:
    """Return the scripts by the name of their picture."""
    return {path.stem: path for path in sorted(HERE.glob("[a-z]*.py")) if path.name != Path(__file__).name}


def picture(name: str) -> Path:
    """Return the picture of a script."""
    return next((path for path in (HERE / f"{name}.svg", HERE / f"{name}.png") if path.exists()), HERE / f"{name}.png")


def fingerprint(script: Path) -> str:
    """Return the hash of a script, of what it imports from here and from the data, of what it names, of the style.

    Of scripts the words count, not how they are laid out.
    """
    seen = {HERE / "style.mplstyle"}
    todo = [script]
    while todo:
        path = todo.pop()
        seen.add(path)
        text = path.read_text(encoding="utf-8")
        todo += [
            p for n in re.findall(r"from (_\w+) import", text) if (p := HERE / f"{n}.py").exists() and p not in seen
        ]
        todo += [
            p
            for n in re.findall(r"^import (\w+) as", text, re.MULTILINE)
            if (p := HERE.parent / "data" / f"{n}.py").exists() and p not in seen
        ]
        seen |= {p for n in re.findall(r'"([\w/]+\.(?:toml|json))"', text) for p in _named(n)}
    digest = hashlib.sha256()
    for path in sorted(seen):
        text = path.read_text(encoding="utf-8")
        digest.update((re.sub(r"[\s,()]+", "", text) if path.suffix == ".py" else text).encode())
    return digest.hexdigest()[:16]


def _named(name: str) -> list[Path]:
    root = HERE.parents[1]
    places = (root / "examples" / name, root / "docs" / "data" / name, root / "tests" / "golden" / name, root / name)
    return [place for place in places if place.is_file()]


def stale() -> list[str]:
    """Return the names of pictures that are missing or older than their scripts."""
    record = json.loads(RECORD.read_text(encoding="utf-8")) if RECORD.exists() else {}
    return [
        name
        for name, script in scripts().items()
        if not picture(name).exists() or record.get(name, {}).get("script") != fingerprint(script)
    ]


def draw(name: str) -> None:
    """Draw one picture and note what drew it."""
    import fretting

    script = scripts()[name]
    subprocess.run([sys.executable, script], check=True, cwd=HERE, env={**os.environ, "PYTHONWARNINGS": "ignore"})
    commit = subprocess.run(
        ["git", "log", "-1", "--format=%h", "--", "crates"],
        capture_output=True,
        text=True,
        check=False,
        cwd=HERE.parents[1],
    )
    record = json.loads(RECORD.read_text(encoding="utf-8")) if RECORD.exists() else {}
    record[name] = {
        "script": fingerprint(script),
        "date": datetime.datetime.now(tz=datetime.UTC).date().isoformat(),
        "version": fretting.__version__,
        "commit": commit.stdout.strip(),
    }
    known = {key: record[key] for key in sorted(record) if key in scripts()}
    RECORD.write_text(json.dumps(known, indent=1) + "\n", encoding="utf-8")
    print(picture(name).relative_to(HERE.parents[1]))


if __name__ == "__main__":
    words = sys.argv[1:]
    for name in stale() if words == ["--stale"] else words or scripts():
        draw(name)
