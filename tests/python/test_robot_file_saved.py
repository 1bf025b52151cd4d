"""Robot files on the disk: nothing is lost, and nothing is loaded that is not needed."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import cdcr


def test_a_missing_file_and_a_folder(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    with pytest.raises(FileNotFoundError, match=f"^there is no robot file {re.escape(str(path))}$"):
        cdcr.Robot.load(path)
    with pytest.raises(ValueError, match=r"is a folder, not a robot file$"):
        cdcr.Robot.load(tmp_path)


def test_nothing_is_overwritten_unasked(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    path.write_text("mine")
    robot = cdcr.robots.amouri2020()
    sentence = f"{path} exists already; pass overwrite=True to replace it"
    with pytest.raises(FileExistsError, match=re.escape(sentence)):
        robot.save(path)
    assert path.read_text() == "mine"
    robot.save(path, overwrite=True)
    assert cdcr.Robot.load(path) == robot


def test_a_missing_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=re.escape(str(tmp_path / "nowhere"))):
        cdcr.robots.amouri2020().save(tmp_path / "nowhere" / "robot.toml")


def test_an_interrupted_save_leaves_the_old_file_and_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text("old")

    def interrupted(self: Path, target: Path) -> None:
        assert self.read_text().startswith("# A cable-driven")  # all written, not yet in place
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        cdcr.robots.amouri2020().save(path, overwrite=True)
    assert os.listdir(tmp_path) == ["robot.toml"]  # noqa: PTH208 - hidden files count
    assert path.read_text() == "old"


def test_pydantic_is_loaded_only_to_read_a_file(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    code = (
        "import sys, cdcr\n"
        f"cdcr.robots.amouri2020().save({str(path)!r})\n"
        "assert 'pydantic' not in sys.modules\n"
        f"cdcr.Robot.load({str(path)!r})\n"
        "assert 'pydantic' in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_what_one_guesses_is_hinted_at() -> None:
    with pytest.raises(AttributeError, match=r"no attribute 'load_robot'; use cdcr\.Robot\.load$"):
        _ = cdcr.load_robot
