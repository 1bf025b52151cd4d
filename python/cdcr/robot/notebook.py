"""What a notebook shows of a robot: a drawing to scale, and a table of its sections."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from cdcr.robot.robot import Robot

WIDTH = 480.0  # of a drawing [px]
# For pages that have no style of their own.
CELL = 'style="padding: 0.2em 0.8em; text-align: right; white-space: nowrap"'
COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7")


def robot_html(robot: Robot) -> str:
    """Return a drawing of the straight robot, base at the left, and a table of its sections."""
    head = ("section", "length [m]", "mass [kg]", "stiffness [N m/rad]", "disks", "cables")
    ends = [cable.end_section for cable in robot.all_cables]
    rows = [
        (i + 1, section.length, section.mass, section.stiffness, section.num_disks, ends.count(i))
        for i, section in enumerate(robot.sections)
    ]
    table = "".join(
        f"<tr>{''.join(f'<td {CELL}>{value:.4g}</td>' for value in row)}</tr>" for row in rows
    )
    heads = "".join(f"<th {CELL}>{name}</th>" for name in head)
    whole = f"{robot.length:.4g} m, {robot.mass:.4g} kg, payload {robot.payload:.4g} kg"
    return (
        f"{_drawing(robot)}<table><thead><tr>{heads}</tr>"
        f"</thead><tbody>{table}</tbody></table><div>{whole}</div>"
    )


def _drawing(robot: Robot) -> str:
    scale = WIDTH / robot.length
    half = (
        scale
        / 2.0
        * max(
            [max(section.diameters) for section in robot.sections]
            + [disk.diameter for section in robot.sections for disk in section.disks]
            + [2.0 * cable.farthest for cable in robot.all_cables]
        )
    )
    parts, start = [], 0.0
    for i, section in enumerate(robot.sections):
        color, end = COLORS[i % len(COLORS)], start + scale * section.length
        parts.append(_backbone(start, end, color, [scale * d for d in section.diameters]))
        for disk in section.disks:
            x, y = start + scale * section.length * disk.position, scale * disk.diameter / 2.0
            parts.append(_line(x, -y, x, y, color, 2.0))
        start = end
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH + 8:.0f}" '
        f'height="{2 * half + 8:.0f}" viewBox="-4 {-half - 4:.1f} {WIDTH + 8:.0f} '
        f'{2 * half + 8:.1f}" role="img"><title>the straight robot</title>{"".join(parts)}</svg>'
    )


def _backbone(start: float, end: float, color: str, diameters: list[float]) -> str:
    base, tip = (max(1.5, diameter) for diameter in diameters)
    if base == tip:
        return _line(start, 0.0, end, 0.0, color, base)
    corners = ((start, base), (end, tip), (end, -tip), (start, -base))
    points = " ".join(f"{x:.1f},{y / 2.0:.1f}" for x, y in corners)
    return f'<polygon points="{points}" fill="{color}"/>'


def _line(x1: float, y1: float, x2: float, y2: float, color: str, width: float) -> str:
    ends = f'x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}"'
    return f'<line {ends} stroke="{color}" stroke-width="{width:.1f}"/>'
