"""Files that are no text files of ours: refused quickly, without what is in them."""

import os
import re
from collections.abc import Callable
from pathlib import Path

import pytest

import cdcr
from cdcr.files import text
from cdcr.scenarios.file.reader import load_scenario

RUN = 'robot = "amouri2020"\nt_end = 1\n'


def refusal(call: Callable[[], object]) -> str:
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - the text is what the caller asserts
        call()
    return str(caught.value)


@pytest.mark.parametrize("kind", ["toml", "csv"])
def test_pipes_and_devices(tmp_path: Path, kind: str) -> None:
    os.mkfifo(tmp_path / "pipe")
    path = tmp_path / "x.toml"
    for name in (tmp_path / "pipe", Path("/dev/zero")):
        path.write_text(f'{RUN}tension.file = "{name}"\n')
        told = refusal(lambda: load_scenario(path if kind == "csv" else name))  # noqa: B023
        what = "tension" if kind == "csv" else "scenario"
        where = f"{path}, line 3, tension.file: " if kind == "csv" else ""
        assert told == f"{where}{name} is a pipe or a device, not a {what} file"


def test_a_file_that_does_not_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(text, "MAX_MEGABYTES", 1)
    path = tmp_path / "robot.toml"
    with path.open("wb") as file:
        file.truncate(10**12)  # nothing but holes
    assert refusal(lambda: cdcr.Robot.load(path)) == f"{path} must have at most 1 MB, and has more"


def test_what_is_none_of_ours_is_not_repeated(tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("root:$6$salt$hash:19000:0\n")
    path = tmp_path / "x.toml"
    path.write_text(f'{RUN}tension.file = "secret"\n')
    told = refusal(lambda: load_scenario(path))
    assert "hash" not in told
    assert told.endswith("line 1: the columns must be t, cable 1, cable 2, cable 3, got others")


def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    path.write_text(RUN, encoding="utf-8-sig")
    assert load_scenario(path).t_end == 1.0
    cdcr.robots.amouri2020().save(tmp_path / "robot.toml")
    content = (tmp_path / "robot.toml").read_text()
    path.write_text(content, encoding="utf-8-sig")
    assert cdcr.Robot.load(path) == cdcr.robots.amouri2020()


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("t_end = " + 5000 * "1", ", line 2: an integer must have 64 bits"),
        ("x = " + 3000 * "[" + 3000 * "]", " must be nested at most 50 deep"),
        ("x." + ".".join(3000 * "a") + " = 1", ": x must be nested at most 50 deep"),
        ("title = 'a\0b'", ", line 2: not UTF-8 text"),
        ('tension.file = "a\\u0000b"', "/a\\x00b' is no name of a tension file"),
        ("initial.theta_deg = [600]", ": initial.theta_deg must bend each section by at most"),
        ("integrator.rtol = 2.0", ", [integrator]: rtol must be at least 1e-14 and below 1, got 2"),
        ("integrator.max_steps = 9223372036854775808", ": integrator.max_steps must be"),
        ('"a\\nb" = 1', ": 'a\\nb' is not a known key"),
    ],
)
def test_numbers_nesting_and_names(tmp_path: Path, line: str, sentence: str) -> None:
    path = tmp_path / "x.toml"
    path.write_text(f'robot = "amouri2020"\n{line}\n' + ("" if "t_end" in line else "t_end = 1\n"))
    told = refusal(lambda: load_scenario(path))
    assert "\n" not in told
    assert sentence in told
    assert str(tmp_path) in told


def test_a_value_as_large_as_one_likes_is_a_number(tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    path.write_text(f'{RUN}[[tension]]\ncable = 1\nshape = "step"\nvalue = {10**26}\n')
    run = load_scenario(path).simulate(t_end=0.1)
    assert run.status in (cdcr.Status.bending_limit, cdcr.Status.non_finite_state)


def test_a_runs_own_csv_is_an_input(tmp_path: Path) -> None:
    table = ([0.0, 1.0, 2.0], [[0.0, 0.0, 0.0], [3.0, 1.0, 0.0], [3.0, 1.0, 2.0]])
    model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    t = [k / 10 for k in range(21)]
    run = cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=t, tension=table)
    run.save(tmp_path / "run.csv")
    robot = 'robot = {name = "amouri2020", each_section = {damping = 0.01}}\nt_end = 2\n'
    path = tmp_path / "x.toml"
    path.write_text(f'{robot}tension.file = "run.csv"\noutput.num_samples = 21\n')
    again = load_scenario(path).simulate()
    assert abs(again.q - run.q).max() < 1e-6
    path.write_text(f'{robot}trajectory.file = "run.csv"\n')
    motion = load_scenario(path).simulate(num_samples=21)
    assert abs(motion.q - run.q).max() < 1e-12


def test_a_run_in_place_of_a_text_is_told_so(tmp_path: Path) -> None:
    path = tmp_path / "run.nc"
    path.write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    told = f"{path} is a netCDF file, not a robot file: `cdcr view` plays a run"
    with pytest.raises(ValueError, match=f"^{re.escape(told)}$"):
        cdcr.Robot.load(path)
