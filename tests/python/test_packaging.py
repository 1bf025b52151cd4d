"""The package as installed: one version, typed, light to import, and told truly by its README."""

import re
import subprocess
import sys
from enum import Enum
from importlib import metadata
from pathlib import Path

import pytest

import cdcr
from cdcr import _core
from cdcr.files.toml import read_toml

ROOT = Path(__file__).parents[2]
LICENSES = ROOT / "licenses"
README = (ROOT / "README.md").read_text()
# What a plain import must not load: extras, and pydantic, which only reading a file needs.
HEAVY = [
    "control",
    "distributed",
    "gymnasium",
    "h5netcdf",
    "matplotlib",
    "mcap",
    "PIL",
    "pandas",
    "pydantic",
    "rich",
    "scipy",
    "typer",
    "xarray",
    "zarr",
]


def installed_files() -> list[str]:
    files = metadata.files("cdcr")
    assert files is not None
    return [file.as_posix() for file in files if file.suffix != ".pyc"]


def cpp_enumerators(header: str, enum: str) -> list[str]:
    text = (ROOT / "cpp" / "include" / "cdcr" / header).read_text()
    text = re.sub(r"//.*", "", text)
    body = re.search(rf"enum class {enum} {{(.*?)}}", text, re.DOTALL)
    assert body is not None, f"no enum {enum} in {header}"
    return re.findall(r"\w+", body.group(1))


def test_version_comes_from_cmake() -> None:
    project = re.search(r"project\(cdcr VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert project is not None
    assert metadata.version("cdcr") == project.group(1)
    assert cdcr.__version__ == project.group(1)


def test_the_conda_recipe_has_this_version_and_needs_what_the_package_needs() -> None:
    recipe = (ROOT / "packaging" / "conda" / "recipe.yaml").read_text()
    assert f'version: "{cdcr.__version__}"' in recipe
    project = read_toml(ROOT / "pyproject.toml", "project file")["project"]
    extras = project["optional-dependencies"]
    needed = [*project["dependencies"], *extras["plot"], *extras["data"], *extras["cli"]]
    renamed = {"matplotlib": "matplotlib-base"}
    for name, version in re.findall(r"([\w-]+)(?:\[\w+\])?(>=[\d.]+)", "\n".join(needed)):
        if name != "tomli":  # of Pythons that are older than conda-forge's
            assert f"- {renamed.get(name, name)} {version}\n" in recipe, name


def test_changelog_opens_with_this_version() -> None:
    versions = re.findall(r"^## \[(.+?)\]", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert versions[0] in {cdcr.__version__, "Unreleased"}
    assert cdcr.__version__ in versions


@pytest.mark.parametrize("file", ["cdcr/py.typed", "cdcr/_core.pyi", "cdcr/__init__.py"])
def test_installed_with_its_types(file: str) -> None:
    assert file in installed_files()


@pytest.mark.skipif(sys.platform != "linux", reason="FMUs are for Linux")
def test_installed_with_the_shared_object_of_fmus() -> None:
    assert "cdcr/_fmu.so" in installed_files()


def test_installs_the_package_and_nothing_else() -> None:
    belongs = re.compile(
        r"cdcr/([\w/-]+\.(c|h|html|json|py|pyi|toml)|py\.typed|_core\.[\w.-]+\.so|_fmu\.so)"
        r"|cdcr-[\d.]+\.dist-info/.*"
        r"|(\.\./)+bin/cdcr"
    )
    assert [file for file in installed_files() if not belongs.fullmatch(file)] == []


def test_every_file_is_installed() -> None:
    source = ROOT / "python"
    files = {
        path.relative_to(source).as_posix()
        for path in source.rglob("*")
        if path.suffix in (".c", ".h", ".html", ".py", ".pyi", ".toml")
    }
    assert files - set(installed_files()) == set()


def test_import_is_light() -> None:
    code = f"import sys, cdcr; print(sorted(set({HEAVY!r}) & set(sys.modules)))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


@pytest.mark.parametrize(
    ("header", "enum"),
    [
        ("status.hpp", _core.Status),
        ("method.hpp", _core.Method),
        ("formulation.hpp", _core.Formulation),
    ],
)
def test_enumerators_are_those_of_cpp(header: str, enum: type[Enum]) -> None:
    names = [{"auto": "automatic"}.get(member.name, member.name) for member in enum]  # a keyword
    assert names == cpp_enumerators(header, enum.__name__)


def test_readme_names_the_python_that_is_needed() -> None:
    needed = metadata.metadata("cdcr")["Requires-Python"].removeprefix(">=")
    assert set(re.findall(r"(3\.\d+) or newer", README)) == {needed}


def test_readme_names_the_extras_there_are() -> None:
    extras = metadata.metadata("cdcr").get_all("Provides-Extra")
    assert extras is not None
    listed = re.search(r"^.*\bExtras: (.*?)\.$", README, re.MULTILINE | re.DOTALL)
    assert listed is not None
    assert set(re.findall(r"`(\w+)`", re.sub(r"\(.*?\)", "", listed.group(1)))) >= set(extras)
    named = {name for group in re.findall(r"\.\[(.+?)\]", README) for name in group.split(",")}
    assert named <= set(extras)


def test_the_page_of_installation_names_extras_and_options() -> None:
    page = (ROOT / "docs" / "install.md").read_text()
    project = read_toml(ROOT / "pyproject.toml", "project file")["project"]
    rows = re.findall(r"^\| `(\w+)` \|", page, re.MULTILINE)
    assert set(project["optional-dependencies"]) <= set(rows)
    cmake = (ROOT / "CMakeLists.txt").read_text()
    options = set(re.findall(r"(CDCR_(?:WITH_|INSTALL|BUILD_TESTS)\w*)", cmake))
    assert options == {row for row in rows if row.startswith("CDCR_")}


def test_readme_names_the_libraries_that_the_build_asks_for() -> None:
    text = (ROOT / "cmake" / "dependencies.cmake").read_text()
    libraries = set(re.findall(r"apt-get install (lib[\w-]+)", text))
    assert len(libraries) == 3
    assert [library for library in libraries if library not in README] == []


def test_text_for_an_index_has_no_link_into_the_source() -> None:
    text = metadata.distribution("cdcr").read_text("METADATA")
    assert text is not None
    assert "## What it does" in text
    assert re.findall(r"\]\((?!https?:).*?\)", text) == []


def test_licences_of_what_is_inside_are_installed() -> None:
    files = [file for file in installed_files() if ".dist-info/licenses/" in file]
    names = {file.partition("/licenses/")[2] for file in files}
    assert names == {"LICENSE", *(f"licenses/{path.name}" for path in LICENSES.glob("*.txt"))}
    assert names > {"licenses/Eigen.txt", "licenses/SUNDIALS.txt", "licenses/pybind11.txt"}


def test_lock_has_the_versions_of_our_tools() -> None:
    project = read_toml(ROOT / "pyproject.toml", "project file")
    locked = "".join(path.read_text() for path in (ROOT / "tools" / "lock").glob("*.txt"))
    for group in ("build", "test", "lint", "docs"):
        for pinned in project["dependency-groups"][group]:
            assert f"\n{pinned.partition(';')[0].strip()} " in f"\n{locked}", pinned


def test_lock_has_a_hash_for_everything() -> None:
    for path in (ROOT / "tools" / "lock").glob("*.txt"):
        for entry in re.split(r"\n(?=\S)", path.read_text().strip()):
            assert re.match(r"[\w.\-]+==\S+ .*\\\n +--hash=sha256:", entry), entry


def test_public_headers_export_what_they_declare() -> None:
    for header in (ROOT / "cpp" / "include" / "cdcr").glob("*.hpp*"):
        opened = re.findall(r"^namespace (.*) \{$", header.read_text(), re.MULTILINE)
        assert set(opened) <= {"CDCR_EXPORT cdcr", "cdcr::detail"}, header


def test_method_of_cvode_is_refused_without_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_core, "with_cvode", False)
    model = cdcr.Model(cdcr.robots.amouri2020())
    for method in ("bdf", "adams"):
        with pytest.raises(ValueError, match=f"^method '{method}' needs CVODE, .* use 'dopri5' or"):
            cdcr.simulate(model, [0, 0], [0, 0], t=[0, 1], method=method)
    assert cdcr.simulate(model, [0, 0], [0, 0], t=[0, 1], method="dopri5").success


def test_readme_example_prints_what_the_readme_says(tmp_path: Path) -> None:
    example = re.search(r"```python\n(.*?)```.*?```text\n(.*?)```", README, re.DOTALL)
    assert example is not None
    code, output = example.groups()
    run = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert run.stdout == output
