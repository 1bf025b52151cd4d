"""What shells complete."""

import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

import cdcr

pytest.importorskip("typer")

DEADLINE = 100.0  # after which something hangs [s]


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """Make a folder with the command, some files and nothing else."""
    command = tmp_path / "bin" / "cdcr"
    command.parent.mkdir()
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m cdcr "$@"\n')
    command.chmod(command.stat().st_mode | stat.S_IXUSR)
    work = tmp_path / "work"
    (work / "mine").mkdir(parents=True)
    for name in ("my.toml", "other.toml", "my.csv", ".hidden.toml", "mine/deep.toml"):
        (work / name).write_text("")
    return tmp_path


def shell(home: Path, script: str) -> str:
    """Return what a shell prints that begins in the folder."""
    environment = os.environ | {"HOME": str(home), "PATH": f"{home / 'bin'}:{os.environ['PATH']}"}
    done = subprocess.run(
        ["bash", "--norc", "-c", script],
        capture_output=True,
        text=True,
        cwd=home / "work",
        env=environment,
        timeout=DEADLINE,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def offered(home: Path, *lines: str) -> list[list[str]]:
    """Return what bash offers for the last word of each line, which may be empty."""
    script = 'eval "$(_CDCR_COMPLETE=source_bash cdcr)"\n'
    for line in lines:
        words = line.split(" ")
        script += f"""
COMP_WORDS=({" ".join(f"'{word}'" for word in words)}); COMP_CWORD={len(words) - 1}
_cdcr_completion cdcr
echo "${{COMPREPLY[*]}}"
"""
    return [line.split() for line in shell(home, script).splitlines()]


def test_scenarios_files_options_and_values_are_offered(home: Path) -> None:
    everything, deep, options, values = offered(
        home, "cdcr run ", "cdcr run mine/", "cdcr run --w", "cdcr run pid --method d"
    )
    assert everything == [*cdcr.scenarios.names(), "mine/", "my.toml", "other.toml"]
    assert deep == ["mine/deep.toml"]
    assert options == ["--watch"]
    assert values == ["dopri5", "dop853"]


def test_metrics_parameters_and_samples_of_a_sweep_are_offered(home: Path) -> None:
    metrics, parameters, samples = offered(
        home,
        "cdcr sweep step-tension --metric steps,peak_ti",
        "cdcr sweep step-tension --param sections.1.cable_ang",
        "cdcr sweep step-tension --samples so",
    )
    assert metrics == ["steps,peak_tip_speed"]
    assert parameters == [f"sections.1.cable_angles.{k}" for k in (1, 2, 3)]
    assert samples == ["sobol:"]


def test_the_shell_is_found_and_told(home: Path) -> None:
    pytest.importorskip("shellingham")
    script = shell(home, "cdcr --show-completion; true")
    assert "complete -o default -F _cdcr_completion cdcr" in script
    shell(home, "cdcr --install-completion; true")
    assert "_cdcr_completion" in (home / ".bash_completions" / "cdcr.sh").read_text()
    assert "cdcr.sh" in (home / ".bashrc").read_text()
