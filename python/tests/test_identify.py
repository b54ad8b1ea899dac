"""What identify promises in Python: bad cycles, strictness, errors of its own kind."""

from pathlib import Path

import numpy as np
import pytest

import fretting

ROOT = Path(__file__).parents[2]
CASE = ROOT / "examples" / "rig" / "ball_on_ball.toml"
LOG = (ROOT / "examples" / "rig" / "test_12.csv").read_text(encoding="utf-8")


def written(folder: Path, text: str) -> Path:
    log = folder / "log.csv"
    log.write_text(text, encoding="utf-8")
    return log


def test_a_lone_row_of_another_cycle_is_skipped_and_named(tmp_path: Path) -> None:
    log = written(tmp_path, LOG + "99;10,1;60,1\n")
    found = fretting.identify(log, case=CASE)
    assert found.skipped == {99.0: "1 point"}
    # The log was made with a friction coefficient of 0.6.
    assert abs(found.constants["friction coefficient"].value / 0.6 - 1.0) < 0.01
    assert np.isnan(found.cycles["energy_friction"][-1])
    assert abs(found.cycles["energy_friction"][:-1] / 0.6 - 1.0).max() < 0.03
    with pytest.raises(ValueError, match="cycle 99"):
        fretting.identify(log, case=CASE, strict=True)


def test_columns_by_number_and_shuffled_rows(tmp_path: Path) -> None:
    rows = LOG.splitlines()[5:]
    found = fretting.identify(
        written(tmp_path, "\n".join(rows)),
        case=CASE,
        columns={"cycle": 1, "displacement": 2, "force": 3},
        units={"displacement": "um"},
    )
    assert abs(found.constants["friction coefficient"].value / 0.6 - 1.0) < 0.01
    shuffled = [rows[k] for k in np.random.default_rng(1).permutation(len(rows))]
    with pytest.raises(ValueError, match="is whole"):
        fretting.identify(written(tmp_path, "\n".join(LOG.splitlines()[:5] + shuffled)), case=CASE)


def test_the_fit_is_repeated_over_the_test() -> None:
    log = ROOT / "examples" / "rig" / "test_12.csv"
    found = fretting.identify(log, case=CASE, every=2)
    cycles = found.cycles["cycle"]
    assert [fit["cycle"] for fit in found.fits] == list(cycles[::2])
    # As the one fit above: the log was made with a friction coefficient of 0.6.
    assert all(abs(fit["constants"]["friction coefficient"].value / 0.6 - 1.0) < 0.01 for fit in found.fits)
    assert fretting.identify(log, case=CASE).fits == []
    with pytest.raises(ValueError, match="must be at least 1"):
        fretting.identify(log, case=CASE, every=0)


def test_a_log_that_is_no_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(fretting.MissingFileError):
        fretting.identify(tmp_path / "none.csv", case=CASE)
    with pytest.raises(fretting.UnreadableError, match="a folder, not a file"):
        fretting.identify(tmp_path, case=CASE)
