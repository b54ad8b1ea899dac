"""What the README shows in Python runs as it stands there."""

import re
from pathlib import Path

import pytest


def test_python_snippets_run_in_their_order(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    readme = root / "README.md"
    if not readme.exists():
        pytest.skip("no README.md")
    snippets = re.findall(r"^```python\n(.*?)^```", readme.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    assert snippets, "the README shows no Python"
    monkeypatch.chdir(root)
    names: dict[str, object] = {}
    for number, snippet in enumerate(snippets):
        exec(compile(snippet, f"README.md, python snippet {number + 1}", "exec"), names)
