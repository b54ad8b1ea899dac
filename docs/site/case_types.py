"""Write python/fretting/case_types.py, the typed dictionaries of a case, from the JSON Schema.

    python docs/site/case_types.py        (pip install datamodel-code-generator)

The generator is `datamodel-code-generator`; afterwards the names lose their endings, and arrays of NumPy are let in
where rows of numbers are.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HEAD = '''"""The case as typed dictionaries, for completion and static checks: ``case: fretting.Case = {...}``.

Generated from examples/fret.schema.json by docs/site/case_types.py; a test compares the two.
"""

'''


def generated() -> str:
    """Return the module's text."""
    schema = ROOT / "examples" / "fret.schema.json"
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "types.py"
        call = [
            sys.executable, "-W", "ignore", "-m", "datamodel_code_generator", "--input", str(schema),
            "--input-file-type", "jsonschema", "--output-model-type", "typing.TypedDict", "--target-python-version", "3.11",
            "--use-schema-description", "--use-field-description", "--disable-timestamp", "--class-name", "Case",
            "--output", str(output),
        ]  # fmt: skip
        subprocess.run(call, check=True)
        text = output.read_text(encoding="utf-8")
    text = text[text.index("from typing import Any") :]
    text = text.replace("AxisSchema", "ComponentFile").replace("InterfaceWord", "NamedInterface")
    text = text.replace("list[", "Sequence[")
    text = text.replace("from typing import Any, Literal, NotRequired, TypeAlias\n\nfrom typing_extensions import TypedDict\n",
                        "from typing import Any, Literal, NotRequired, TypeAlias, TypedDict\n\nimport numpy.typing as npt\n")  # fmt: skip
    text = re.sub(r"\(TypedDict, closed=True\)", "(TypedDict)", text)
    text = re.sub(r"\b([A-Z]\w+?)(?:File|Schema|Word)(Item)?\b", r"\1\2", text)
    text = text.replace(
        "Array: TypeAlias = Sequence[Sequence[float] | float]",
        "Array: TypeAlias = Sequence[Sequence[float] | float] | npt.NDArray[Any]",
    )
    text = text.replace(
        "str | Sequence[Sequence[float] | float]", "str | Sequence[Sequence[float] | float] | npt.NDArray[Any]"
    )
    text = re.sub(r"'([a-z_]*)'", r'"\1"', text)
    return HEAD + "from collections.abc import Sequence\n" + text.replace(" | None]", "]")


if __name__ == "__main__":
    (ROOT / "python" / "fretting" / "case_types.py").write_text(generated(), encoding="utf-8")
