"""Robot files: TOML with the fields of Robot, Section and Cable, units in comments."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, Field, fields, replace
from os import PathLike
from typing import TYPE_CHECKING, Any

from cdcr import _core
from cdcr.base.check import entry
from cdcr.files.new_file import file_path, new_file
from cdcr.files.refusals import with_lines
from cdcr.files.toml import format_toml, read_toml, refuse, schema_errors
from cdcr.robot.cable import Cable
from cdcr.robot.section import Section

if TYPE_CHECKING:
    from cdcr.robot.robot import Robot

_HEAD = """\
# A cable-driven continuum robot. SI units and radians.
# Base frame: origin at the base, Z along the straight robot, X towards cable angle 0.
# Instead of cable_angles, cable_angles_deg may be given, in degrees.
"""


def load_robot(kind: type[Robot], path: str | PathLike[str]) -> Robot:
    """Return the robot of a file; see Robot.load."""
    file = file_path(path)
    table = read_toml(file, "robot file")
    if "sections" not in table and {"robot", "t_end"} & table.keys():
        raise ValueError(f"{file} is a scenario file: `cdcr run` and `cdcr view` take it")
    with with_lines(file):
        return robot_from_table(kind, table, where=str(file))


def save_robot(robot: Robot, path: str | PathLike[str], *, overwrite: bool) -> None:
    """Write a robot file; see Robot.save."""
    with new_file(file_path(path), overwrite=overwrite) as part:
        part.write_text(robot_text(robot), encoding="utf-8", newline="\n")


def robot_from_table(kind: type[Robot], table: Mapping[str, Any], where: str) -> Robot:
    """Return the robot a TOML table describes; refusals begin with `where` it stands."""
    from cdcr.robot.schema import table_of

    # mypy asks of a class what it asks of its objects: that they can be hashed.
    schema = table_of(kind)  # type: ignore[arg-type]
    of_section = {one.name: "into a table [[sections]]" for one in fields(Section)}
    of_robot = {one.name: "above the first [[sections]]" for one in fields(kind)}
    refuse(where, schema_errors(schema, table, elsewhere=of_section))
    found: list[str] = []
    for i, section in enumerate(table["sections"]):
        found += _table_errors(Section, section, entry("sections", i), of_robot)
    num_sections = len(table["sections"])
    for j, cable in enumerate(table.get("cables", [])):
        at = entry("cables", j)
        wrong = _table_errors(Cable, cable, at, of_robot)
        if not wrong and cable["end_section"] > num_sections:
            requirement = f"the number of a section, 1 to {num_sections}"
            end = format_toml(cable["end_section"])
            wrong.append(f"{at}: end_section must be {requirement}, got {end}")
        if not wrong and cable.get("start_section", 1) > cable["end_section"]:
            requirement = f"at most end_section, {cable['end_section']}"
            wrong.append(f"{at}: start_section must be {requirement}, got {cable['start_section']}")
        if isinstance(cable, dict) and not {"angle", "angle_deg"} & cable.keys():
            wrong.append(f"{at} must have angle [rad] or angle_deg [deg]")
        found += wrong
    refuse(where, found)

    sections = [_fields_of(Section, one) for one in table["sections"]]
    cables = [_fields_of(Cable, one) for one in table.get("cables", [])]
    robot = _defaults(kind) | dict(table)
    core = {
        "sections": [_core.Section(**one) for one in sections],
        "cables": [_core.Cable(**one) for one in cables],
    }
    refuse(where, _core.Robot(**robot | core).violations())
    described = {
        "sections": [Section(**one) for one in sections],
        "cables": [Cable(**one) for one in cables],
    }
    return kind(**robot | described)


def _table_errors(
    kind: type[Section | Cable], table: Any, at: str, elsewhere: Mapping[str, str]
) -> list[str]:
    """Return a sentence for each thing that is wrong with the table of a section or a cable."""
    from cdcr.robot.schema import table_of

    if not isinstance(table, dict):
        return [f"{at} must be a table, got {format_toml(table)}"]
    # mypy asks of a class what it asks of its objects: that they can be hashed.
    schema = table_of(kind)  # type: ignore[arg-type]
    wrong = [f"{at}: {sentence}" for sentence in schema_errors(schema, table, "", elsewhere)]
    for item in fields(kind):
        wrong += doubled(table, at, item.name)
    return wrong


def doubled(table: Mapping[str, Any], at: str, name: str) -> list[str]:
    """Return a sentence where a table has a value in radians and in degrees."""
    both = name in table and f"{name}_deg" in table
    return [f"{at} must have {name} or {name}_deg, not both"] if both else []


def _fields_of(kind: type[Section | Cable], table: Mapping[str, Any]) -> dict[str, Any]:
    values = _defaults(kind) | in_radians(table)
    if kind is Cable:
        values["end_section"] -= 1  # counted from 1 in files
        values["start_section"] = table.get("start_section", 1) - 1
    for item in fields(kind):
        value = values[item.name]
        if item.metadata["kind"] == "order" and value == "locked":
            values[item.name] = None
        if item.metadata["kind"] == "route" and isinstance(value, list):
            alone = not any(isinstance(one, list) for one in value)
            values[item.name] = [value] if alone else value  # the pair of one section
    return values


def in_radians(table: Mapping[str, Any]) -> dict[str, Any]:
    """Return the keys of a section's or a cable's table, angles in radians."""
    values = dict(table)
    if "cable_angles_deg" in values:
        values["cable_angles"] = [math.radians(a) for a in values.pop("cable_angles_deg")]
    for name in ("angle", "rest_bending", "rest_twist"):
        if f"{name}_deg" in values:
            values[name] = _in_radians(values.pop(f"{name}_deg"))
    return values


def _in_radians(degrees: Any) -> Any:
    """Return an angle, or lists of angles, in radians."""
    return list(map(_in_radians, degrees)) if isinstance(degrees, list) else math.radians(degrees)


def _defaults(kind: type[Robot | Section | Cable]) -> dict[str, Any]:
    return {item.name: item.default for item in fields(kind) if item.default is not MISSING}


def robot_table(robot: Robot) -> dict[str, Any]:
    """Return the table of a robot as a file has it, with every field that has a value."""
    table = _table(robot) | {"sections": [_table(section) for section in robot.sections]}
    return table | {"cables": [_table(cable) for cable in robot.cables]}


def _table(thing: Robot | Section | Cable) -> dict[str, Any]:
    names = [item.name for item in fields(thing) if _is_written(thing, item, all_fields=True)]
    values = {name: _in_lists(_in_file(thing, name)) for name in names}
    return {name: value for name, value in values.items() if value is not None}


def _in_lists(value: Any) -> Any:
    return list(map(_in_lists, value)) if isinstance(value, tuple) else value


def robot_text(robot: Robot) -> str:
    """Return the robot as TOML; repr gives every float the digits it needs to come back exactly."""
    return _HEAD + "\n" + "\n".join(robot_lines(robot)) + "\n"


def switched_off(robot: Robot) -> str:
    """Return the fields that `robot_text` leaves out, in comments, with their defaults."""
    section, cable = robot.sections[0], Cable(radius=0.02, angle=0.0, end_section=0, friction=0.0)
    return "\n".join([
        "",
        "# What else there may be, with its default or, where it has none, an example. To switch a",
        "# line on, put it into its table and take away the # before it.",
        "# Of the robot, above its sections:",
        *_advanced(robot, robot),
        "# Of a section:",
        *_advanced(section, _with_examples(section)),
        "# Cables that no section lists; all values an example:",
        "#[[cables]]",
        *(f"#{line}" for line in _lines(cable, all_fields=True)),
        "",
    ])  # fmt: skip


def _with_examples(section: Section) -> Section:
    """Return a section with values for what has no default: of steel, or what its shape gives."""
    modulus, moment = section.youngs_modulus, section.second_moment_of_area
    base, inner = section.diameters[0], section.backbone_inner_diameter
    shear = section.shear_modulus or modulus / 2.6
    return replace(
        section,
        shear_modulus=shear,
        bending_stiffness=section.bending_stiffness or modulus * moment,
        twist_stiffness=section.twist_stiffness or 2.0 * shear * moment,
        stretch_stiffness=section.stretch_stiffness
        or modulus * math.pi / 4.0 * (base * base - inner * inner),
        nodes=section.nodes or 12,
    )


def _advanced(thing: Robot | Section, filled: Robot | Section) -> Iterator[str]:
    off = [item.name for item in fields(thing) if not _is_written(thing, item, all_fields=False)]
    for line in _lines(filled, all_fields=True):
        if line.split(" ")[0] in off:
            yield f"#{line}"


def robot_lines(robot: Robot, *, all_fields: bool = False) -> list[str]:
    """Return the tables of a robot by lines, also with the advanced fields that say nothing."""
    lines = list(_lines(robot, all_fields))
    for section in robot.sections:
        one = _with_examples(section) if all_fields else section
        lines += ["", "[[sections]]", *_lines(one, all_fields)]
    for cable in robot.cables:
        lines += ["", "[[cables]]", *_lines(cable, all_fields)]
    return lines


def _lines(thing: Robot | Section | Cable, all_fields: bool) -> Iterator[str]:
    """Yield 'key = value  # about [unit]' with the comments in one column."""
    written = {
        item.name: item.metadata for item in fields(thing) if _is_written(thing, item, all_fields)
    }
    pairs = {name: f"{name} = {_toml_value(_in_file(thing, name))}" for name in written}
    short = [len(pair) for pair in pairs.values() if len(pair) <= 40]
    for name, pair in pairs.items():
        about, unit = written[name]["about"], written[name]["unit"]
        comment = f"{about} [{unit}]" if unit else about
        yield f"{pair:<{max(short, default=0)}}  # {comment}"


def _in_file(thing: Robot | Section | Cable, name: str) -> Any:
    value = getattr(thing, name)
    if name in ("start_section", "end_section"):
        return value + 1
    return "locked" if value is None and name.endswith("_order") else value


def _is_written(thing: Robot | Section | Cable, item: Field[Any], all_fields: bool) -> bool:
    """Whether a field has a line: sections and cables are tables, and positions are a number."""
    if item.name in ("sections", "cables"):
        return False
    if item.name == "num_disks" and isinstance(thing, Section) and thing.disk_positions:
        return False
    value = getattr(thing, item.name)
    if value is None and item.metadata["kind"] != "order":
        return False  # which TOML has no word for
    if all_fields or not item.metadata["advanced"]:
        return True
    # repr tells -0.0 from 0.0, which are equal.
    return repr(value) != repr(item.default)


def _toml_value(value: object) -> str:
    if isinstance(value, tuple):
        return f"[{', '.join(map(_toml_value, value))}]"
    return repr(value)
