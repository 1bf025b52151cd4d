"""Models of MuJoCo: a robot as a chain of rigid links, with its cables."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable, Sequence
from itertools import pairwise
from os import PathLike
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from cdcr import _core
from cdcr.base.check import Check, count, require_kind
from cdcr.export.arcs import as_solid_arcs, twist_of
from cdcr.export.links import Chain, Joint, Link
from cdcr.files.new_file import file_path, new_file
from cdcr.model.model import Model
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot

_CABLE = "tendon"  # MuJoCo's word
_MOST_LINKS = 320  # of all sections together: bodies are nested in each other
_STEP = 0.5  # of MuJoCo, times the fastest frequency; it is unstable beyond 2
_LONGEST_STEP = 2e-3  # [s]
_RANGE = 10.0  # largest command over the tension that bends a section by 180 degrees
_WIDTH = 0.001  # of a cable, over the robot's length
_HIDDEN = {"contype": "0", "conaffinity": "0"}  # from collisions
_COLORS = ("0.00 0.45 0.70 1", "0.84 0.37 0.00 1", "0.00 0.62 0.45 1", "0.80 0.47 0.65 1")


class Site(NamedTuple):
    """A point of a link, where a cable passes."""

    name: str
    place: tuple[float, float, float]  # in the link's frame [m]


def write_mjcf(
    robot: Robot, path: str | PathLike[str], *, links: int = 10, overwrite: bool = False
) -> None:
    """Write a robot as a model of MuJoCo.

    Each section becomes rigid links, with a joint in the middle of each of `links` equal parts that
    bends by two hinges; the angles of the hinges add up to the section's part of q. A third turns
    about the axis where the section twists. The links bend and twist freely, as a rod of any
    `bending_order` and `twist_order` does, so without twist this is the robot of
    ``robot.subdivide(links)``. One arc a section is stiffer: the first frequency of
    ``cdcr.robots.amouri2020()`` is a quarter higher as one arc.

    With ten links a section, tips at rest are within 0.5 % of the robot's length of those of
    ``robot.subdivide(10)``, cable lengths within 0.05 %, and its first four frequencies within 1 %.
    Twice the links have a quarter of these errors, and need a much shorter time step.

    Cables run through a site on both sides of each joint. An actuator for each, in the order of the
    commands, takes its tension [N], up to ten times what bends a section by 180 degrees, or its
    length [m] where it is driven by length; key frame 0 has the commands of the straight robot.
    Sensors give position and orientation of the tip and the cables' lengths.

    Gravity, payload, damping and the orientation of the base are carried over. Friction of cables
    and play of drives are not, and a warning says so. Sections bend up to 180 degrees; links do not
    collide.

    Parameters
    ----------
    robot : Robot
        The robot; every link must have a mass.
    path : str or path
        The file, whose name ends in .xml; it appears whole or not at all.
    links : int, default 10
        Joints of each section, from 1, and no more than 320 of all sections together.
    overwrite : bool, default False
        Whether a file of that name may be replaced.

    Raises
    ------
    ValueError
        For other `links`, for a name that ends otherwise, for links without mass, and for a robot
        that does more than bend and twist (stretch, taper, bends at rest), or whose cables wind.
    OSError
        Where the file exists and is not to be replaced, or there is no such folder.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import cdcr
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "arm.xml")
    ...     cdcr.export.write_mjcf(cdcr.robots.amouri2020(), file, links=5)
    ...     file.read_text().count("<joint ")
    10
    """
    text = mjcf_text(robot, file_path(path), links=links)
    with new_file(file_path(path), overwrite=overwrite) as part:
        part.write_text(text, encoding="utf-8", newline="\n")


def mjcf_text(robot: Robot, file: Path, *, links: int = 10) -> str:
    """Return what `write_mjcf` writes; the name of the file is that of the model."""
    require_kind("robot", robot, Robot)
    Model(robot)  # refuses one beyond all sizes
    if file.suffix != ".xml":
        raise ValueError(f"the file name must end in .xml, got {file.name!r}")
    check, most = Check(), _MOST_LINKS // len(robot.sections)
    requirement = f"a whole number 1 to {most} for {count(len(robot.sections), 'section')}"
    links = check.whole("links", links, requirement, 1, most)
    check.done()
    twists = [twist_of(section) for section in robot.sections]
    robot = as_solid_arcs(robot, "a chain of rigid links")
    model = Model(robot)
    losses = {"friction of cables": model.has_friction, "play of drives": model.has_backlash}
    if any(losses.values()):
        left = " and the ".join(name for name, has in losses.items() if has)
        warnings.warn(f"MuJoCo's model leaves the {left} out", stacklevel=3)
    chain = Chain(robot, links, twists)
    _require_mass(chain)
    bends = [_bend(chain, i, links) for i in range(len(robot.sections))]
    sites = _sites(chain, bends)

    root = ElementTree.Element("mujoco", model=file.stem)
    about = f" by cdcr {_core.__version__}; SI units; commands: tension [N], or length [m] "
    root.append(ElementTree.Comment(about))
    ElementTree.SubElement(root, "compiler", angle="radian", inertiafromgeom="false")
    step = min(_LONGEST_STEP, _STEP / chain.fastest())
    options = {"timestep": f"{step:.2g}", "integrator": "implicitfast"}
    ElementTree.SubElement(root, "option", options, gravity=_numbers(robot.gravity))
    _add_looks(root, chain)
    _add_bodies(root, chain, bends, sites)
    _add_cables(root, chain, sites)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def _numbers(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _require_mass(chain: Chain) -> None:
    for joint, link in zip(chain.joints, chain.links[1:], strict=True):
        if not (link.mass > 0.0 and np.linalg.eigvalsh(link.inertia)[0] > 0.0):
            raise ValueError(
                f"each link must have a mass and an inertia, as MuJoCo's bodies have; that beyond "
                f"joint {joint.part + 1} of section {joint.section + 1} has none; "
                "give the section a backbone_mass, or disks with a disk_mass"
            )


def _add_looks(root: ElementTree.Element, chain: Chain) -> None:
    """Add a light, a white background, and what a camera looks at."""
    axis = np.array(chain.robot.base_orientation)[:, 2]
    middle = _numbers(np.array(chain.robot.base_position) + 0.5 * chain.ends[-1] * axis)
    ElementTree.SubElement(root, "statistic", center=middle, extent=repr(chain.ends[-1]))
    visual = ElementTree.SubElement(root, "visual")
    ElementTree.SubElement(visual, "headlight", ambient="0.5 0.5 0.5", diffuse="0.5 0.5 0.5")
    white = {"builtin": "flat", "rgb1": "1 1 1", "rgb2": "1 1 1", "width": "8", "height": "8"}
    ElementTree.SubElement(ElementTree.SubElement(root, "asset"), "texture", white, type="skybox")


# Bodies ------------------------------------------------------------------------------------------


def _add_bodies(
    root: ElementTree.Element, chain: Chain, bends: Sequence[float], sites: Sequence[Sequence[Site]]
) -> None:
    world = ElementTree.SubElement(root, "worldbody")
    axes = np.array(chain.robot.base_orientation).T[:2].ravel()
    base = {"xyaxes": _numbers(axes)}
    if any(chain.robot.base_position):
        base["pos"] = _numbers(chain.robot.base_position)
    body = ElementTree.SubElement(world, "body", base, name="base")
    _add_geoms(body, chain, chain.links[0])
    _add_sites(body, sites[0])
    for joint, (below, link), holes in zip(
        chain.joints, pairwise(chain.links), sites[1:], strict=True
    ):
        place = (0.0, 0.0, link.start - below.start)
        name = f"link{joint.section + 1}_{joint.part + 1}"
        body = ElementTree.SubElement(body, "body", name=name, pos=_numbers(place))
        inertia = link.inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        ElementTree.SubElement(
            body,
            "inertial",
            pos=_numbers(link.center),
            mass=repr(link.mass),
            fullinertia=_numbers(inertia),
        )
        _add_hinges(body, joint, bends[joint.section])
        _add_geoms(body, chain, link)
        _add_sites(body, holes)
    _add_tip(body, chain)


def _add_sites(body: ElementTree.Element, sites: Sequence[Site]) -> None:
    for name, place in sites:
        ElementTree.SubElement(body, "site", name=name, pos=_numbers(place), size="0.0005")


def _add_tip(body: ElementTree.Element, chain: Chain) -> None:
    """Add a site where the tool is; it is turned as the tool is."""
    tool, last = np.array(chain.robot.tool), chain.links[-1]
    place = tool[:3, 3] + np.array([0.0, 0.0, last.end - last.start])
    _add_sites(body, [Site("tip", (place[0], place[1], place[2]))])
    if not np.array_equal(tool[:3, :3], np.eye(3)):
        body[-1].set("xyaxes", _numbers(tool[:3, :2].T.ravel()))


def _add_hinges(body: ElementTree.Element, joint: Joint, bend: float) -> None:
    """Add the components of bending, in turn the one and the other first, and twist.

    So the twist of a chain bent askew cancels, from joint to joint.
    """
    axes = [("x", "0 1 0"), ("y", "-1 0 0")]
    for component, axis in axes if joint.part % 2 == 0 else reversed(axes):
        ElementTree.SubElement(
            body,
            "joint",
            name=f"bend{joint.section + 1}_{joint.part + 1}{component}",
            axis=axis,
            range=_numbers((-bend, bend)),
            limited="true",
            stiffness=repr(joint.stiffness),
            damping=repr(joint.damping),
        )
    if joint.twist:
        ElementTree.SubElement(
            body,
            "joint",
            name=f"twist{joint.section + 1}_{joint.part + 1}",
            axis="0 0 1",
            stiffness=repr(joint.twist.stiffness),
            damping=repr(joint.twist.damping),
        )


def _add_geoms(body: ElementTree.Element, chain: Chain, link: Link) -> None:
    for section, (bottom, top) in zip(chain.robot.sections, pairwise(chain.ends), strict=True):
        low, high = max(bottom, link.start), min(top, link.end)
        if low < high:
            ElementTree.SubElement(
                body,
                "geom",
                _HIDDEN,
                type="capsule",
                fromto=_numbers((0.0, 0.0, low - link.start, 0.0, 0.0, high - link.start)),
                size=repr(section.diameters[0] / 2.0),
                rgba="0.2 0.2 0.2 1",
            )
    for height, diameter in link.disks:
        if diameter > 0.0:
            size = (diameter / 2.0, 0.001)
            pos = _numbers((0.0, 0.0, height))
            about = {"pos": pos, "size": _numbers(size), "rgba": "0.6 0.6 0.6 0.6"}
            ElementTree.SubElement(body, "geom", _HIDDEN | about, type="cylinder")


# Cables ------------------------------------------------------------------------------------------


def _bend(chain: Chain, section: int, links: int) -> float:
    """Return how far a hinge of a section may turn [rad].

    No further than to where the sites of a cable at both its sides meet.
    """
    half = chain.robot.sections[section].length / links / 2.0
    radii = [cable.farthest for cable in chain.cables if cable.end_section >= section]
    return min([math.pi / links, *(math.sqrt(2.0) * math.atan(half / r) for r in radii)])


def _sites(chain: Chain, bends: Sequence[float]) -> list[list[Site]]:
    """Return the sites of each link, each cable's in their order along it.

    Across a joint that bends by theta towards a cable at radius r, with sites at a distance a, the
    cable shortens by 2 r sin(theta/2) + 2 a (1 - cos(theta/2)); the nearer the sites, the nearer
    to r theta. Where the joint is bent as far as it goes they must not have met. A cable under
    tension that is wound by alpha across a joint turns it back by F r^2 alpha/(2 a), as a rod if
    the sites are a part of the section apart.
    """
    parts = len(chain.joints) // len(chain.robot.sections)
    found: list[list[Site]] = [[] for _ in chain.links]
    for j, cable in enumerate(chain.cables):
        (radius, _), (angle, _) = cable.route(cable.end_section)
        x, y = radius * math.cos(angle), radius * math.sin(angle)
        heights = [(0, 0.0)]
        for k, joint in enumerate(chain.joints):
            if joint.section <= cable.end_section:
                if joint.twist:
                    apart = chain.robot.sections[joint.section].length / parts / 2.0
                else:
                    apart = radius * math.tan(bends[joint.section] / math.sqrt(2.0))
                heights += [(k, joint.height - apart), (k + 1, joint.height + apart)]
        heights.append((heights[-1][0], chain.ends[cable.end_section + 1]))
        for number, (i, height) in enumerate(heights):
            place = (x, y, height - chain.links[i].start)
            found[i].append(Site(f"hole{j + 1}_{number + 1}", place))
    return found


def _add_cables(root: ElementTree.Element, chain: Chain, sites: Sequence[Sequence[Site]]) -> None:
    paths = ElementTree.SubElement(root, _CABLE)
    actuators = ElementTree.SubElement(root, "actuator")
    sensors = ElementTree.SubElement(root, "sensor")
    for kind in ("framepos", "framequat"):
        ElementTree.SubElement(sensors, kind, name=f"tip_{kind}", objtype="site", objname="tip")
    width = repr(chain.ends[-1] * _WIDTH)
    names = [site.name for holes in sites for site in holes]
    for j, cable in enumerate(chain.cables):
        name = f"cable{j + 1}"
        color = _COLORS[cable.end_section % len(_COLORS)]
        path = ElementTree.SubElement(paths, "spatial", name=name, width=width, rgba=color)
        for site in names:
            if site.startswith(f"hole{j + 1}_"):
                ElementTree.SubElement(path, "site", site=site)
        actuator = _actuator(chain, cable)
        actuator.attrib |= {"name": name, _CABLE: name}
        actuators.append(actuator)
        ElementTree.SubElement(sensors, f"{_CABLE}pos", {"name": f"{name}_length", _CABLE: name})
    rest = [chain.ends[c.end_section + 1] if c.length_driven else 0.0 for c in chain.cables]
    keys = ElementTree.SubElement(root, "keyframe")
    ElementTree.SubElement(keys, "key", name="rest", ctrl=_numbers(rest))


def _actuator(chain: Chain, cable: Cable) -> ElementTree.Element:
    """Return what pulls a cable: a force along its path would push, so the sign is turned."""
    if not cable.length_driven:
        passed = chain.robot.sections[: cable.end_section + 1]
        stiffest = max(section.stiffness for section in passed)
        most = _RANGE * math.pi * stiffest / cable.farthest
        return ElementTree.Element("motor", gear="-1", ctrlrange=_numbers((0.0, most)))
    straight = chain.ends[cable.end_section + 1]
    strongest = cable.stiffness * straight + cable.pretension
    return ElementTree.Element(
        "general",
        biastype="affine",
        gainprm=repr(cable.stiffness),
        biasprm=_numbers((-cable.pretension, -cable.stiffness, -cable.damping)),
        ctrlrange=_numbers((0.0, 2.0 * straight)),
        forcerange=_numbers((-strongest, 0.0)),
    )
