"""Refinement study of a coated contact through a fretting loop, as drawn by fret study.

Silicon nitride ball on alumina-coated steel, examples/coated_sphere.toml, mu = 0.2, 16 to 64 cells per side and 8 to
32 increments per stage or cycle, errors against the Richardson extrapolation of the study over the run time of one
thread.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from _figures import FOLDER, ROOT

with tempfile.TemporaryDirectory() as folder:
    words = ["--cells", "16,32,64", "--increments", "8,16,32", "--threads", "1", "--quiet", "--out", folder]
    subprocess.run(
        [sys.executable, "-m", "fretting", "study", ROOT / "examples" / "coated_sphere.toml", *words],
        check=True,
        capture_output=True,
    )
    shutil.copy(Path(folder) / "study.svg", FOLDER / "study_coated.svg")
