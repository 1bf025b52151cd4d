"""cdcr doctor: what is installed, and a self-test that can fail."""

import json
from itertools import islice
from pathlib import Path
from typing import Any

import pytest

import cdcr

pytest.importorskip("typer")
pytest.importorskip("matplotlib")
pytest.importorskip("h5netcdf")

from rich.console import Console

from cdcr.cli import doctor, self_test
from command import cdcr_

DATA = Path(__file__).parents[1] / "data"
MARGIN = 0.1  # of the tolerances, that residuals keep


@pytest.fixture(scope="module")
def told() -> dict[str, Any]:
    return doctor.examine(Console(quiet=True))


def test_all_is_well_with_margin(told: dict[str, Any]) -> None:
    assert told["ok"]
    for check in told["self_test"]:
        assert check["ok"], check
        assert check["residual"] <= MARGIN * check["tolerance"], check
    names = [check["name"] for check in told["self_test"]]
    assert len(names) == len(set(names)) >= 10
    assert "a picture" in names


def test_the_stored_numbers_are_those_of_the_independent_model() -> None:
    stored = json.loads(Path(self_test.__file__).with_suffix(".json").read_text(encoding="utf-8"))
    known = [
        case
        for name in ("dynamics_cases.json", "general_sections.json")
        for case in json.loads((DATA / name).read_text(encoding="utf-8"))
    ]
    assert [len(case["sections"]) for case in stored] == [1, 3, 2]
    for case in stored:
        assert any(case.items() <= other.items() for other in known)


def test_it_tells_versions_processor_and_extras(
    told: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert told["versions"]["cdcr"] == cdcr.__version__
    assert told["processor"]["usable"] >= 1
    assert told["blas"]
    assert told["simulator_step_s"] > 0.0
    asked = ["numpy>=1", 'matplotlib>=3; extra == "plot"', 'nothing-of-that>=1; extra == "new"']
    monkeypatch.setattr("importlib.metadata.requires", lambda name: asked)
    assert doctor._extras() == {"plot": ["matplotlib"], "new": ["nothing-of-that"]}
    extra = doctor._extra("new", ["nothing-of-that"])
    assert (extra["missing"], extra["gives"]) == (["nothing-of-that"], "")
    lines = dict(doctor._told_extras({"new": extra}))
    assert lines == {"new": 'nothing-of-that missing; pip install "cdcr[new]"'}


def quick(**_: bool) -> list[self_test.Outcome]:
    return [self_test.Outcome("arithmetic", 1e-9, 1e-15)]


def test_json_and_tables_say_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "self_test", quick)
    result = cdcr_("doctor", "--json")
    found = json.loads(result.stdout)
    assert (result.exit_code, found["ok"]) == (0, True)
    tables = cdcr_("doctor")
    assert tables.exit_code == 0
    assert "All is well." in tables.stdout
    for word in (found["versions"]["NumPy"], "SUNDIALS", "arithmetic"):
        assert word in tables.stdout


@pytest.mark.parametrize(
    ("residual", "words"), [(1e-3, "1.0e-03"), (None, "gives what is not finite")]
)
def test_exit_code_1_where_something_is_wrong(
    monkeypatch: pytest.MonkeyPatch, residual: float | None, words: str
) -> None:
    off = float("nan") if residual is None else residual
    wrong = self_test._outcome("arithmetic", 1e-9, lambda: off)
    monkeypatch.setattr(doctor, "self_test", lambda **_: [wrong])
    result = cdcr_("doctor")
    assert result.exit_code == 1
    assert "Something is wrong." in result.stdout
    assert words in " ".join(result.stdout.split())
    assert cdcr_("doctor", "--json").exit_code == 1


def test_the_self_test_notices_a_library_that_computes_otherwise(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    original = cdcr.Model.forward_dynamics

    def slightly_off(self: Any, *arguments: Any) -> Any:
        return original(self, *arguments) * (1.0 + 1e-7)

    monkeypatch.setattr(cdcr.Model, "forward_dynamics", slightly_off)
    outcomes = islice(self_test.self_test(pictures=False, netcdf=False), 4)
    assert [one.ok for one in outcomes] == [False, False, False, True]
