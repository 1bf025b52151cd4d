"""Robots as C99 that depends on nothing, for the loop of a controller."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from importlib.resources import files
from os import PathLike

import numpy as np

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, count, entry, format_value, require_kind, require_truth
from cdcr.files.new_file import file_path, new_files
from cdcr.model.model import Model
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot

# What the powers left out may add, beside the largest value of a function in a piece.
_TAIL = {"powers": 1e-17, "float_powers": 3e-9}
# The template of what a cable does, without friction or with it.
PULL, PLAIN, CAPSTAN = "pull", "plain.c", "capstan.c"
MOST_DECAY = 40.0  # friction times angle that capstan.c reckons with
# What the files' names end in, and the templates that each is made of.
_PARTS = {
    ".h": ("robot.h",),
    ".c": ("vectors.c", PULL, "chain.c", "robot.c"),
    "_derivatives.c": ("derivatives_head.c", "derivatives.c"),
}
_CASADI = {"_casadi.c": ("casadi.c",)}
# acados compiles one file alone.
_ALONE = ("acados_head.c", "robot.h", "vectors.c", PULL, "chain.c", "derivatives.c", "acados.c")
_ACADOS = {"_acados.c": _ALONE}
MOST_STEPS = 1000  # in an interval of acados
_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


def write_c(
    robot: Robot,
    folder: str | PathLike[str],
    *,
    name: str = "robot",
    max_bending: float = _core.max_bending,
    casadi: bool = False,
    acados: float | None = None,
    steps: int = 1,
    overwrite: bool = False,
) -> None:
    """Write a robot of arcs as C99: a header and sources that need no library and no heap.

    They give accelerations and their derivatives, steps of Runge-Kutta 4, cable lengths and the
    tip's frame, in double or, compiled with ``-DNAME_REAL=float``, in single precision.

    Parameters
    ----------
    robot : Robot
        Of constant curvature, with straight cables, whose friction has no memory.
    folder : str or path
        Where NAME.h, NAME.c and NAME_derivatives.c go; it is made where there is none.
    name : str, default "robot"
        Of the files, and what each name in them begins with.
    max_bending : float, optional
        Largest bending angle of a section [rad], up to ``cdcr.max_bending``. The tables grow with
        its square: up to pi they take a ninth.
    casadi : bool, default False
        Whether to write NAME_casadi.c too: functions for ``casadi.external``, with Jacobians.
    acados : float, optional
        Length of a shooting interval [s], to write NAME_acados.c too: discrete dynamics for acados
        as its ``external_function_param_generic``.
    steps : int, default 1
        Of Runge-Kutta 4 in such an interval.
    overwrite : bool, default False
        Whether files of these names may be replaced.

    Raises
    ------
    ValueError
        For a robot that it is not for, and for a `name` or a `max_bending` that is none.
    OSError
        Where a file exists and is not to be replaced.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import cdcr
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     cdcr.export.write_c(cdcr.robots.three_sections(), folder, name="arm")
    ...     sorted(file.name for file in Path(folder).iterdir())
    ['arm.c', 'arm.h', 'arm_derivatives.c']
    """
    texts = c_texts(
        robot, name=name, max_bending=max_bending, casadi=casadi, acados=acados, steps=steps
    )
    files = [file_path(folder) / file for file in texts]
    with new_files(files, overwrite=overwrite) as parts:
        for part, text in zip(parts, texts.values(), strict=True):
            part.write_text(text, encoding="utf-8", newline="\n")


def c_texts(
    robot: Robot,
    *,
    name: str = "robot",
    max_bending: float = _core.max_bending,
    casadi: bool = False,
    acados: float | None = None,
    steps: int = 1,
) -> dict[str, str]:
    """Return the header and the sources that `write_c` writes, by the names of their files."""
    require_kind("robot", robot, Robot)
    given: object = name
    if not (isinstance(given, str) and _IDENTIFIER.fullmatch(given)):
        raise ValueError(f"name must be an identifier of C, got {format_value(name)}")
    check = Check()
    limit = check.number("max_bending", max_bending, "a number > 0 rad and finite", above=0.0)
    interval = 0.0
    if acados is not None:
        interval = check.number("acados", acados, "a number > 0 s and finite", above=0.0)
    many = f"a whole number 1 to {MOST_STEPS}"
    stages = check.whole("steps", steps, many, low=1, high=MOST_STEPS)
    check.done()
    require_truth("casadi", casadi)
    if limit > _core.max_bending:
        raise ValueError(f"max_bending must be at most 3 pi rad, got {max_bending:g}")
    _refuse_others(robot, limit)
    model = Model(robot)
    _core.Simulator(model)  # refuses a robot without inertia

    arcs, shapes = model._tables()
    pieces = min(max(math.ceil(limit**2 / math.pi**2), 1), len(arcs))
    arcs, shapes = arcs[:pieces], [table[:pieces] for table in shapes]
    what = f"{count(len(robot.sections), 'section')} and {count(robot.num_cables, 'cable')}"
    values: dict[str, object] = {
        "about": f"Cable-driven continuum robot of {what}.",
        "version": _core.__version__,
        "name": name,
        "NAME": name.upper(),
        "sections": len(robot.sections),
        "coordinates": model.num_coordinates,
        "cables": model.num_cables,
        "max_bending": repr(limit),
        "pieces": pieces,
        "interval": repr(interval),
        "step_count": stages,
        "steps": count(stages, "step"),
        **{key: _powers_needed([arcs, *shapes], tail) for key, tail in _TAIL.items()},
    }
    tables = [*_constants(robot, model, arcs, shapes, limit)]
    if model.has_friction:
        tables += _constants_of_friction(robot)
    values["tables"] = "\n".join(tables)
    pull = CAPSTAN if model.has_friction else PLAIN
    template = files("cdcr.export") / "c_template"
    wanted = _PARTS | (_CASADI if casadi else {}) | ({} if acados is None else _ACADOS)
    found = {}
    for end, names in wanted.items():
        parts = [pull if part == PULL else part for part in names]
        source = "\n".join((template / part).read_text(encoding="utf-8") for part in parts)
        text = _filled(source, values)
        found[name + end] = text.replace(f'#include "{name}.h"\n', "") if end in _ACADOS else text
    return found


def _refuse_others(robot: Robot, max_bending: float) -> None:
    for i, section in enumerate(robot.sections):
        if section.is_rod:
            raise ValueError(
                "C can be made of sections of constant curvature, untapered, straight at rest, "
                f"without twist and stretch; {entry('sections', i)} is more than that"
            )
    for j, cable in enumerate(robot.cables):
        if not cable.straight or cable.start_section > 0:
            raise ValueError(
                "C can be made with straight cables that begin at the base; "
                f"{entry('cables', j)} does not run so"
            )
    for j, cable in enumerate(robot.all_cables):
        if cable.backlash > 0.0:
            raise ValueError(
                "C can be made without backlash, which has memory; "
                f"cable {j + 1} has {cable.backlash:g} m of it"
            )
        friction = _friction(robot, cable)
        most = max(max(friction) * max_bending, cable.sheath_friction)
        if most > MOST_DECAY:
            raise ValueError(
                f"C can be made with friction times angle up to {MOST_DECAY:g}; "
                f"cable {j + 1} may have {most:.3g}"
            )
    if robot.presliding_stiffness > 0.0 and Model(robot).has_friction:
        raise ValueError(
            "C can be made of friction without memory, presliding_stiffness = 0; "
            f"got {robot.presliding_stiffness:g} N/m"
        )


def _friction(robot: Robot, cable: Cable) -> list[float]:
    """Return the coefficient of each section that a cable passes."""
    passed = robot.sections[: cable.end_section + 1]
    own = cable.friction
    return [section.cable_friction if own is None else own for section in passed]


def _powers_needed(tables: Sequence[FloatArray], tail: float) -> int:
    """Return how many powers hold all functions but for `tail` of their largest value."""
    needed = 1
    for table in tables:
        largest = np.abs(table).sum(axis=1, keepdims=True)  # bounds the values in each piece
        share = np.abs(table) / np.where(largest > 0.0, largest, 1.0)
        rest = share[:, ::-1].cumsum(axis=1)[:, ::-1].max(axis=(0, 2))
        needed = max(needed, int(np.count_nonzero(rest > tail)))
    return needed


def _constants(
    robot: Robot, model: Model, arcs: FloatArray, shapes: list[FloatArray], limit: float
) -> Iterator[str]:
    """Yield the numbers of a robot, as C."""
    powers = _powers_needed([arcs, *shapes], _TAIL["powers"])
    distinct: dict[bytes, int] = {}
    shape_of = [distinct.setdefault(table.tobytes(), len(distinct)) for table in shapes]
    kept = [shapes[shape_of.index(k)][:, :powers] for k in range(len(distinct))]

    pieces_per_sigma = 1.0 / math.pi**2
    payload, position = robot.payload, np.array(robot.payload_position)
    about_tip = np.array(robot.payload_inertia) + payload * (
        position @ position * np.eye(3) - np.outer(position, position)
    )
    tool = np.array(robot.tool)
    cables = robot.all_cables
    yield _scalar("LARGEST_SIGMA", limit**2)
    yield _scalar("PIECES_PER_SIGMA", pieces_per_sigma)
    yield _array("ARCS", arcs[:, :powers])
    yield _array("SHAPES", np.array(kept))
    yield f"static const unsigned char SHAPE_OF[] = {{{', '.join(map(str, shape_of))}}};"
    sections = robot.sections
    yield _array("LENGTH", [section.length for section in sections])
    yield _array("MASS", [section.mass for section in sections])
    yield _array("STIFFNESS", [section.stiffness for section in sections])
    damping = [one.damping + one.material_damping * one.stiffness for one in sections]
    yield _array("DAMPING", damping)
    yield "/* Axes of the first section, by columns, and where it begins. */"
    yield _array("ROOT", np.transpose(robot.base_orientation))
    yield _array("BASE_POSITION", robot.base_position)
    yield _array("GRAVITY", robot.gravity)
    yield "/* Of the payload, in the frame of the tip; its inertia about the tip. */"
    yield _scalar("PAYLOAD", payload)
    yield _array("PAYLOAD_POSITION", position)
    yield _array("PAYLOAD_INERTIA", about_tip)
    yield _array("TOOL", tool[:3, :3].T)
    yield _array("TOOL_POSITION", tool[:3, 3])
    yield "/* Of each cable: b of Q = b F, and its length in the straight robot. */"
    yield _array("ACTUATION", model.actuation_matrix().T if cables else [[0.0] * len(shapes) * 2])
    straight = model.cable_lengths(np.zeros(model.num_coordinates))
    yield _array("STRAIGHT", straight if cables else [0.0])
    yield _array("CABLE_STIFFNESS", [cable.stiffness for cable in cables] or [0.0])
    yield _array("CABLE_PRETENSION", [cable.pretension for cable in cables] or [0.0])
    yield _array("CABLE_DAMPING", [cable.damping for cable in cables] or [0.0])


def _constants_of_friction(robot: Robot) -> Iterator[str]:
    """Yield what cables rub with, as C."""
    cables = robot.all_cables
    friction = np.zeros((len(cables), len(robot.sections)))
    for j, cable in enumerate(cables):
        friction[j, : cable.end_section + 1] = _friction(robot, cable)
    ends = ", ".join(str(cable.end_section + 1) for cable in cables)
    yield "/* Of each cable: sections that it passes, its friction there, and at the entry. */"
    yield f"static const unsigned char SECTIONS_OF[] = {{{ends}}};"
    yield _array("FRICTION", friction)
    yield _array("ENTRY", [cable.entry_friction for cable in cables])
    yield _array("SHEATH", [cable.sheath_friction for cable in cables])
    yield _array("VISCOSITY", [cable.viscosity for cable in cables])
    yield _scalar("SLIDING_SPEED", robot.sliding_speed)


def _scalar(name: str, value: float) -> str:
    return f"static const number {name} = N({float(value)!r});"


def _array(name: str, values: object) -> str:
    array = np.asarray(values, dtype=np.float64)
    sizes = "".join(f"[{size}]" for size in array.shape)
    return f"static const number {name}{sizes} = {_initialiser(array)};"


def _initialiser(array: FloatArray) -> str:
    if array.ndim > 1:
        return "{\n" + ",\n".join(map(_initialiser, array)) + "}"
    numbers = [f"N({number!r})" for number in array.tolist()]
    lines = [", ".join(numbers[k : k + 4]) for k in range(0, len(numbers), 4)]
    return "{" + ",\n ".join(lines) + "}"


def _filled(template: str, values: dict[str, object]) -> str:
    return re.sub(r"@(\w+)@", lambda found: str(values[found[1]]), template)
