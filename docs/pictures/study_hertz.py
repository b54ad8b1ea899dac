"""Refinement study of a Hertz contact, as drawn by fret study.

Steel ball of 10 mm radius on steel, frictionless, examples/hertz.toml, 16 to 256 cells per side, errors against the
closed form over the run time of one thread. Left: largest error of the quantities of interest. Right: three ways to
evaluate them.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from _figures import FOLDER, ROOT

with tempfile.TemporaryDirectory() as folder:
    words = ["--cells", "16,32,64,128,256", "--threads", "1", "--quiet", "--out", folder]
    subprocess.run(
        [sys.executable, "-m", "fretting", "study", ROOT / "examples" / "hertz.toml", *words],
        check=True,
        capture_output=True,
    )
    shutil.copy(Path(folder) / "study.svg", FOLDER / "study_hertz.svg")
