"""`cdcr export-c`, `export-fmu` and `export-mjcf`: files, and their refusals."""

import zipfile
from pathlib import Path

import pytest

import cdcr
from cdcr.export.fmu import LIBRARY

pytest.importorskip("typer")

from command import cdcr_, everything_in, refused


@pytest.mark.skipif(not LIBRARY.is_file(), reason="cdcr was built without its FMU")
@pytest.mark.parametrize("fmi", [2, 3])
def test_fmu(tmp_path: Path, fmi: int) -> None:
    file, robot = tmp_path / "arm.fmu", tmp_path / "arm.toml"
    cdcr.robots.amouri2020(payload=0.1).save(robot)
    result = cdcr_("export-fmu", robot, "--out", file, "--fmi", fmi, "--step", "1e-3")
    assert (result.exit_code, result.stdout) == (0, f"wrote {file}, for FMI {fmi}\n")
    with zipfile.ZipFile(file) as archive:
        description = archive.read("modelDescription.xml").decode()
        setup = archive.read("resources/setup.txt").decode().splitlines()
    assert f'fmiVersion="{fmi}.0" modelName="arm"' in description
    assert f"payload {(0.1).as_integer_ratio()[0]:#x}p-55" in setup
    assert "--overwrite" in refused(cdcr_("export-fmu", "amouri2020", "--out", file))
    assert cdcr_("export-fmu", "amouri2020", "--out", file, "--overwrite").exit_code == 0


@pytest.mark.skipif(not LIBRARY.is_file(), reason="cdcr was built without its FMU")
def test_fmu_refusals(tmp_path: Path) -> None:
    out = ["--out", tmp_path / "arm.fmu"]
    assert "--fmi must be 2 or 3, got 1" in refused(
        cdcr_("export-fmu", "amouri2020", *out, "--fmi", 1)
    )
    assert "--step must be" in refused(cdcr_("export-fmu", "amouri2020", *out, "--step", "-1"))
    assert "there is no robot" in refused(cdcr_("export-fmu", "amouri2019", *out))
    assert "no dynamics" in refused(cdcr_("export-fmu", "rao2021", *out))
    wrong = cdcr_("export-fmu", "amouri2020", "--out", tmp_path / "arm")
    assert refused(wrong) == "the file name must end in .fmu, got 'arm'"
    nowhere = cdcr_("export-fmu", "amouri2020", "--out", tmp_path / "no" / "arm.fmu")
    assert "does not exist" in refused(nowhere)
    assert everything_in(tmp_path) == []


def test_c(tmp_path: Path) -> None:
    out = ["--out", tmp_path / "c"]
    result = cdcr_("export-c", "three-sections", *out, "--name", "arm", "--max-bending", "3.1")
    files = [tmp_path / "c" / name for name in ("arm.h", "arm.c", "arm_derivatives.c")]
    assert (result.exit_code, result.stdout) == (0, f"wrote {', '.join(map(str, files))}\n")
    assert "#define ARM_SECTIONS 3" in files[0].read_text()
    assert "--overwrite" in refused(cdcr_("export-c", "amouri2020", *out, "--name", "arm"))
    assert "name must be an identifier" in refused(
        cdcr_("export-c", "amouri2020", *out, "--name", "1")
    )
    assert "max_bending must be at most" in refused(
        cdcr_("export-c", "amouri2020", *out, "--max-bending", "10")
    )
    for_others = ["--casadi", "--acados", "0.02", "--steps", "4", "--name", "leg"]
    assert cdcr_("export-c", "amouri2020", *out, *for_others).exit_code == 0
    assert {f"leg{end}" for end in ("_casadi.c", "_acados.c")} <= {
        path.name for path in (tmp_path / "c").iterdir()
    }
    assert "INTERVAL_STEPS = 4" in (tmp_path / "c" / "leg_acados.c").read_text()
    refusals = {"--acados": ("-1", "a number > 0 s"), "--steps": ("0", "a whole number 1 to")}
    for option, (value, allowed) in refusals.items():
        told = refused(cdcr_("export-c", "amouri2020", *out, option, value))
        assert told.startswith(f"{option} must be {allowed}")


def test_mjcf(tmp_path: Path) -> None:
    file = tmp_path / "arm.xml"
    result = cdcr_("export-mjcf", "three-sections", "--out", file, "--links", 4)
    assert (result.exit_code, result.stdout) == (0, f"wrote {file}\n")
    assert file.read_text().count("<spatial ") == 9
    assert "--overwrite" in refused(cdcr_("export-mjcf", "amouri2020", "--out", file))
    many = cdcr_("export-mjcf", "amouri2020", "--out", file, "--links", 1000, "--overwrite")
    assert refused(many).startswith(
        "--links must be a whole number 1 to 320 for 1 section, got 1000"
    )


@pytest.mark.filterwarnings("default")
def test_a_warning_is_a_sentence(tmp_path: Path) -> None:
    robot = cdcr.robots.amouri2020()
    cable = cdcr.Cable(radius=0.01, angle=0.0, end_section=0, friction=0.2)
    cdcr.Robot(sections=robot.sections, cables=[cable]).save(tmp_path / "arm.toml")
    result = cdcr_("export-mjcf", tmp_path / "arm.toml", "--out", tmp_path / "arm.xml")
    assert result.exit_code == 0
    assert result.stderr == "cdcr: warning: MuJoCo's model leaves the friction of cables out\n"
