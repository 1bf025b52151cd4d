"""Files as nobody should write them: each is read, or refused in sentences, and nothing else."""

import json
import math
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import cdcr
from cdcr.files.toml import read_toml
from cdcr.scenarios.file.reader import load_scenario

NUMBERS = st.one_of(
    st.integers(-3, 5),
    st.sampled_from([2**31, 2**63 - 1, 2**63, -(2**64), 10**30, 10**400]),
    st.floats(-2.0, 2.0),
    st.sampled_from([math.inf, -math.inf, math.nan, 1e308, -1e308, 5e-324, 600.0]),
)
SCALARS = st.one_of(NUMBERS, st.booleans(), st.text(max_size=4), st.just("amouri2020"))
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.text(max_size=3), inner, max_size=2)
    ),
    max_leaves=6,
)

# Files that are right, of which one thing at a time is made wrong.
SECTION = {
    "length": 0.8,
    "backbone_mass": 0.03,
    "backbone_diameter": 0.005,
    "youngs_modulus": 9.5e9,
    "disk_mass": 0.008,
    "disk_diameter": 0.04,
    "num_disks": 10,
    "cable_radius": 0.02,
    "cable_angles": [0.0, 2.0, 4.0],
}
ROBOT: dict[str, Any] = {
    "sections": [SECTION],
    "cables": [{"radius": 0.01, "angle_deg": 30.0, "end_section": 1}],
    "gravity": [0, 0, -9.81],
    "payload": 0.1,
    "payload_inertia": [[2e-5, 0, 0], [0, 2e-5, 0], [0, 0, 3e-5]],
}
HEAD: dict[str, Any] = {"robot": "amouri2020", "t_end": 0.01, "output": {"num_samples": 3}}
SCENARIOS: list[dict[str, Any]] = [
    HEAD | {"tension": [1, 0, 0], "integrator": {"method": "dopri5", "max_steps": 500}},
    HEAD | {"initial": {"theta_deg": [10.0], "phi": [0.5], "qd": [0, 0]}, "formulation": "taylor"},
    HEAD | {"tension": {"t": [0, 1], "rows": [[0, 0, 0], [1, 0, 0]], "interpolation": "previous"}},
    HEAD | {"tension": {"hold": {"theta_deg": [10.0], "payload": 0.1}}},
    HEAD | {"tension": {"step": 0.01, "shapes": [{"cable": 1, "shape": "step", "value": 1}]}},
    HEAD
    | {
        "tension": [
            {"cable": 1, "shape": "ramp", "from": 0, "to": 1, "start": 0, "end": 0.1},
            {"cable": 2, "shape": "sine", "mean": 2, "amplitude": 1, "frequency": 1, "phase": 0.1},
            {"cable": 3, "shape": "pulse", "value": 1, "start": 0, "end": 0.01, "base": 0.5},
        ]
    },
    HEAD | {"wrenches": [{"section": 1, "force": [1, 0, 0], "times": [0, 1], "factors": [0, 1]}]},
    HEAD
    | {
        "trajectory": {
            "shape": "circle",
            "theta_deg": 10,
            "turns_per_second": 1,
            "step": 0.005,
            "simulate": True,
        }
    },
    HEAD | {"trajectory": {"shape": "move", "theta": 0.3, "phi_deg": 10, "duration": 0.01}},
    HEAD | {"trajectory": {"shape": "swing", "amplitude": 0.3, "frequency": 1.0}},
    HEAD | {"trajectory": {"shape": "line", "theta_rate": 0.3, "max_tension": 30.0}},
    HEAD
    | {
        "controller": {
            "type": "pid",
            "kp": 1.0,
            "cables": [1, 2],
            "reference": {"theta_deg": [10.0]},
        }
    },
    HEAD | {"robot": {"name": "amouri2020", "payload": 0.1, "each_section": {"damping": 1e-3}}},
]


def toml(value: Any) -> str:
    """A value as TOML writes it, tables in a line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{toml(key)} = {toml(one)}" for key, one in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, str):
        return json.dumps(value).replace("\x7f", "\\u007f")
    return str(value).lower() if isinstance(value, (bool, float)) else str(value)


def text_of(table: dict[str, Any]) -> str:
    return "".join(f"{toml(key)} = {toml(value)}\n" for key, value in table.items())


@st.composite
def spoilt(draw: st.DrawFn, table: dict[str, Any]) -> dict[str, Any]:
    """A table with one value at any depth replaced, left out or added."""
    changed = json.loads(json.dumps(table))
    place: Any = changed
    while True:
        keys = list(place) if isinstance(place, dict) else list(range(len(place)))
        key = draw(st.sampled_from(keys)) if keys else None
        deeper = key is not None and isinstance(place[key], (dict, list)) and place[key]
        if deeper and draw(st.integers(0, 3)):
            place = place[key]
            continue
        what = draw(st.sampled_from(["replace", "replace", "replace", "drop", "add"]))
        if what == "replace" and key is not None:
            place[key] = draw(VALUES)
        elif what == "drop" and key is not None:
            del place[key]
        elif isinstance(place, dict):
            place[draw(st.text(max_size=5))] = draw(VALUES)
        else:
            place.append(draw(VALUES))
        return dict(changed)


def check(refused: Exception, path: Path) -> None:
    """Each line is a sentence that begins with the file."""
    lines = str(refused).split("\n")
    assert all(line.startswith((str(path), "there is no ")) for line in lines), lines
    assert all(len(line) < 1000 for line in lines), lines


@given(data=st.data())
def test_robot_files(data: st.DataObject, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.getbasetemp() / "fuzz-robot.toml"
    path.write_text(text_of(data.draw(spoilt(ROBOT))), encoding="utf-8")
    try:
        cdcr.Robot.load(path)
    except (ValueError, FileNotFoundError) as error:
        check(error, path)


@pytest.mark.parametrize("which", range(len(SCENARIOS)))
@pytest.mark.filterwarnings("ignore")
@given(data=st.data())
def test_scenario_files(
    which: int, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.getbasetemp() / "fuzz-scenario.toml"
    path.write_text(text_of(data.draw(spoilt(SCENARIOS[which]))), encoding="utf-8")
    try:
        scenario = load_scenario(path)
    except (ValueError, FileNotFoundError) as error:
        check(error, path)
        return
    few = scenario.input_source is None or scenario.input_source.integrates
    try:
        run = scenario.simulate(t_end=0.01, num_samples=3, max_steps=500 if few else None)
    except ValueError as error:
        sentence = str(error)
        assert "\n" not in sentence
    else:
        assert run.success or run.message.startswith("Stopped at t = ")


@given(
    data=st.one_of(
        st.binary(max_size=60),
        st.text(max_size=60).map(str.encode),
        st.lists(st.sampled_from(["a", "=", "[", "]", "{", "}", '"', ".", "1", "\n", "#", ","]))
        .map("".join)
        .map(str.encode),
    )
)
def test_bytes_of_any_kind(data: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.getbasetemp() / "fuzz-bytes.toml"
    path.write_bytes(data)
    try:
        read_toml(path, "robot file")
    except ValueError as error:
        check(error, path)


CELLS = st.one_of(
    NUMBERS.map(str), st.sampled_from(["", "1_0", "١", "0x1", "1e", "1.", ".5", " 2 ", "+3", '"'])
)


@given(rows=st.lists(st.lists(CELLS, min_size=3, max_size=5), min_size=1, max_size=4))
def test_tension_files(rows: list[list[str]], tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.getbasetemp()
    path, numbers = folder / "fuzz-csv.toml", folder / "fuzz.csv"
    path.write_text(text_of(HEAD | {"tension": {"file": "fuzz.csv"}}), encoding="utf-8")
    lines = ["t,cable 1,cable 2,cable 3", *(",".join(row) for row in rows)]
    numbers.write_text("\n".join(lines), encoding="utf-8")
    try:
        scenario = load_scenario(path)
    except ValueError as error:
        check(error, path)
        return
    for row in rows:
        assert all(cell.isascii() and "_" not in cell for cell in row)
    assert isinstance(scenario.tension, cdcr.TensionTable)


@pytest.mark.parametrize(
    ("text", "value"), [("1_0", None), ("١٢", None), ("+1.5e-3", 1.5e-3), (" 2\t", 2.0)]
)
def test_numbers_of_csv_files_are_of_ascii_digits(
    text: str, value: float | None, tmp_path: Path
) -> None:
    path = tmp_path / "x.toml"
    path.write_text(text_of(HEAD | {"tension": {"file": "x.csv"}}))
    (tmp_path / "x.csv").write_text(f"t,cable 1,cable 2,cable 3\n0,{text},0,0\n", encoding="utf-8")
    if value is None:
        with pytest.raises(ValueError, match=r"cable 1 must be a number >= 0 \[N\], got '"):
            load_scenario(path)
    else:
        assert load_scenario(path).tension.tension == [[value, 0.0, 0.0]]  # type: ignore[union-attr]


@pytest.mark.parametrize("value", [[[]], [[10.0]], [[10.0], [20.0]]])
def test_rows_without_times_are_refused(value: list[list[float]], tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    path.write_text(text_of(HEAD | {"tension": {"hold": {"theta_deg": value}}}))
    with pytest.raises(ValueError, match=r"tension\.hold\.theta_deg must have 1 number for"):
        load_scenario(path)
