"""What an FMU, and what writes it, refuses: a sentence each, and nothing changes."""

import math
from pathlib import Path

import numpy as np
import pytest

import cdcr
from cdcr.export.fmu import LIBRARY

if not LIBRARY.is_file():
    pytest.skip("cdcr was built without its FMU", allow_module_level=True)
pytest.importorskip("fmpy", reason="FMUs are tested by fmpy")

from fmu import Fmu, fmpy, upright

BOTH = pytest.mark.parametrize("fmi", [2, 3])


def refuse_negative(fmu: Fmu) -> None:
    fmu.set({"tension[2]": -1.0})


def refuse_nan(fmu: Fmu) -> None:
    fmu.set({"tension[2]": math.nan})


def refuse_output(fmu: Fmu) -> None:
    fmu.set({"tip.orientation[1,2]": 1.0})


def refuse_late_parameter(fmu: Fmu) -> None:
    fmu.set({"gravity[1]": 1.0})


def refuse_other_time(fmu: Fmu) -> None:
    fmu.slave.doStep(0.5, 0.1)


def refuse_no_step(fmu: Fmu) -> None:
    fmu.slave.doStep(0.0, 0.0)


def refuse_beyond_stop(fmu: Fmu) -> None:
    fmu.slave.doStep(0.0, 2.5)


def refuse_second_start(fmu: Fmu) -> None:
    fmu.slave.exitInitializationMode()


def refuse_derivative_by_gravity(fmu: Fmu) -> None:
    fmu.jacobian(["qdd[1]"], ["gravity[1]"])


def refuse_unknown(fmu: Fmu) -> None:
    (fmu.slave.getReal if fmu.fmi == 2 else fmu.slave.getFloat64)([1000])


REFUSED = {
    refuse_negative: "tension[2] cannot be set: it must be >= 0 and finite, got -1",
    refuse_nan: "tension[2] cannot be set: it must be >= 0 and finite, got nan",
    refuse_output: "tip.orientation[1,2] cannot be set: it is neither an input nor a parameter",
    refuse_late_parameter: "gravity[1] cannot be set: a parameter is fixed once",
    refuse_other_time: "a step begins where the last one ended, at 0 s, not at 0.5",
    refuse_no_step: "a step must be > 0 s and finite, got 0",
    refuse_beyond_stop: "the step would end at 2.5 s, beyond the stop time 2",
    refuse_second_start: "initialization cannot end before it begins",
    refuse_derivative_by_gravity: "there are no derivatives by gravity[1] now",
    refuse_unknown: "there is no variable of value reference 1000",
}


@BOTH
def test_what_fails_says_why_and_changes_nothing(tmp_path: Path, fmi: int) -> None:
    fmu = Fmu(upright(), tmp_path, fmi=fmi)
    fmu.begin(startTime=0.0, stopTime=2.0)
    fmu.set({"tension[1]": 1.0})
    before = fmu.get(list(fmu.reference))
    for refuse, sentence in REFUSED.items():
        fmu.messages.clear()
        with pytest.raises(fmpy.fmi1.FMICallException, match="error"):
            refuse(fmu)
        (said,) = fmu.messages
        assert sentence in said
        assert said.startswith(f"fmi{fmi}")
    assert np.array_equal(fmu.get(list(fmu.reference)), before)


@BOTH
def test_a_run_that_fails_says_why(tmp_path: Path, fmi: int) -> None:
    fmu = Fmu(upright(), tmp_path, fmi=fmi)
    fmu.begin()
    fmu.set({"tension[1]": 5000.0})
    with pytest.raises(fmpy.fmi1.FMICallException):
        fmu.slave.doStep(0.0, 1.0)
    assert "DoStep: in the step from t = 0 s: " in fmu.messages[-1]
    assert fmu.get(["time"])[0] == 0.0

    bent = Fmu(upright(), tmp_path, fmi=fmi)
    with pytest.raises(fmpy.fmi1.FMICallException):
        bent.begin({"q_start[1]": 20.0})
    assert "ExitInitializationMode: q_start and qd_start: " in bent.messages[-1]


@BOTH
def test_a_foreign_description_is_refused(tmp_path: Path, fmi: int) -> None:
    fmu = Fmu(upright(), tmp_path, fmi=fmi)
    with pytest.raises(Exception, match="instantiate"):
        fmu.instantiate("another")
    assert "is of another FMU: its token is 'another'" in fmu.messages[-1]
    setup = fmu.unpacked / "resources" / "setup.txt"
    setup.write_text(setup.read_text() + "wings 2\n")
    with pytest.raises(Exception, match="instantiate"):
        fmu.instantiate(fmu.description.guid)
    assert "'wings 2': this version of cdcr knows no such key" in fmu.messages[-1]
    setup.unlink()
    with pytest.raises(Exception, match="instantiate"):
        fmu.instantiate(fmu.description.guid)
    assert "unpacked" in fmu.messages[-1]
    assert "there is no such file" in fmu.messages[-1]


def test_what_co_simulation_has_not_is_an_error(tmp_path: Path) -> None:
    fmu = Fmu(upright(), tmp_path)
    for call, sentence in {
        fmu.slave.enterEventMode: "fmi3EnterEventMode: this FMU has no event mode",
        fmu.slave.enterStepMode: "fmi3EnterStepMode: this FMU has no event mode",
    }.items():
        with pytest.raises(fmpy.fmi1.FMICallException):
            call()
        assert fmu.messages[-1] == sentence
    with pytest.raises(fmpy.fmi1.FMICallException):
        fmu.slave.getInt32([0])
    assert "all variables of this FMU are of type Float64" in fmu.messages[-1]


def test_refusals(tmp_path: Path) -> None:
    robot = upright()
    for options, sentence in [
        ({"fmi": 1}, r"fmi must be 2 or 3, got 1 \(int\)"),
        ({"step": 0.0}, r"step must be a number > 0 s and finite, got 0.0 \(float\)"),
    ]:
        with pytest.raises(ValueError, match=sentence):
            cdcr.export.write_fmu(robot, tmp_path / "arm.fmu", **options)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"the file name must end in \.fmu, got 'arm\.zip'"):
        cdcr.export.write_fmu(robot, tmp_path / "arm.zip")
    with pytest.raises(ValueError, match="the robot has no dynamics"):
        cdcr.export.write_fmu(cdcr.robots.rao2021(), tmp_path / "arm.fmu")
    (tmp_path / "arm.fmu").touch()
    with pytest.raises(FileExistsError, match="overwrite=True"):
        cdcr.export.write_fmu(robot, tmp_path / "arm.fmu")
