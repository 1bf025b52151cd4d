"""Rows of the audit: Table 1, section 4.2 and what the weight of the robot does."""

from __future__ import annotations

import numpy as np

from cdcr.model.coordinates import polar
from cdcr.model.model import Model
from cdcr.paper.claims.common import (
    DISK_INERTIA,
    EDGE,
    GRAVITY,
    PULL,
    ROBOT,
    SAME,
    SECTION,
    Claim,
    gap,
    holds_if,
    model,
    numbers,
    tiny,
)
from cdcr.robots import amouri2020

_NEARLY_STRAIGHT = 1e-3  # where a ratio of energies stands for its limit at theta = 0 [rad]
_ASIDE = (np.cos(0.7), np.sin(0.7))  # a direction without meaning


def table_1() -> Claim:
    """Derive from Table 1 what the equations need: E I_b, E I_b/l, I_xx, the mass."""
    bending_stiffness = SECTION.youngs_modulus * SECTION.second_moment_of_area
    return Claim(
        where="Table 1",
        claim="The parameters and geometric properties of the robot under consideration.",
        computed=(
            f"They give E I_b = {bending_stiffness:.6f} N m^2, E I_b/l = {SECTION.stiffness:.6f} "
            f"N m/rad, a thin disk's I_xx = {DISK_INERTIA:.1e} kg m^2 and {ROBOT.mass:.4f} kg in "
            "all: enough for (20). Damping, without which Figs. 8 and 9 do not settle, is not "
            "among them, nor the thickness of the disks."
        ),
        verdict="holds in part",
        values=numbers(
            ei=bending_stiffness, stiffness=SECTION.stiffness, i_xx=DISK_INERTIA, mass=ROBOT.mass
        ),
    )


def elastic_energy() -> Claim:
    """Compare (18) with the model's potential energy and its slope with K11 of (23)."""
    angles, step = np.linspace(0.2, EDGE, 9), 1e-4
    K = SECTION.stiffness
    energy = gap(model().potential_energies(np.outer(angles, _ASIDE)), K * angles**2 / 2.0)
    ahead, behind = (
        model().potential_energies(np.outer(angles + change, _ASIDE)) for change in (step, -step)
    )
    slope = gap((ahead - behind) / (2.0 * step), K * angles)
    return Claim(
        where="4.2, (18); (23)",
        claim="U = E I_b theta^2/(2 l), and so K11 = E I_b/l.",
        computed=(
            f"The model has (18) to {tiny(energy)} J, and the slope of (18) is K11 theta with K11 "
            f"= {K:.6f} N m/rad, to {tiny(slope)} N m by differences: (18) and (23) agree."
        ),
        verdict=holds_if(energy < SAME and slope < 1e-9),  # differences lose some digits
        values=numbers(energy_gap=energy, slope_gap=slope, k11=K),
    )


def weighed(up: float) -> Model:
    """Return the model of Table 1 with weight, standing (up = 1) or hanging (-1)."""
    return Model(amouri2020(gravity=(0.0, 0.0, -up * GRAVITY)))


def gravity_ratio() -> Claim:
    """Take the model's energies with and without gravity, both zero when straight."""
    standing = weighed(1.0)

    def percent(theta: float) -> float:
        elastic = model().potential_energy([theta, 0.0])
        straight, bent = standing.potential_energy([[0.0, 0.0], [theta, 0.0]])
        return float(100.0 * abs(bent - straight - elastic) / elastic)

    start, end = percent(_NEARLY_STRAIGHT), percent(EDGE)
    return Claim(
        where="4.2, Fig. 7; 6",
        claim="The gravitational energy is less than 0.27 % of the elastic energy.",
        computed=(
            f"{start:.1f} % at theta -> 0, {end:.1f} % at 3pi/5 (g = {GRAVITY} m/s^2, energies "
            f"from the straight shape). As a plain number the ratio is {start / 100:.2f}, so 0.27 "
            "may have been read as per cent."
        ),
        verdict=holds_if(max(start, end) < 0.27),
        values=numbers(straight_percent=start, edge_percent=end),
    )


def gravity_neglected() -> Claim:
    """Find the equilibria under 5 N on cable 1 with weight, linearised and in full."""
    torque = SECTION.cable_radius * PULL

    def degrees(m: Model) -> tuple[float, float]:
        energies = m.potential_energies([[angle, 0.0] for angle in (0.0, _NEARLY_STRAIGHT)])
        stiffness = 2.0 * (energies[1] - energies[0]) / _NEARLY_STRAIGHT**2
        theta, _ = polar(m.equilibrium([PULL, 0.0, 0.0]))
        return float(np.degrees(torque / stiffness)), float(np.degrees(theta))

    (none, _), (up, up_full), (down, down_full) = map(
        degrees, (model(), weighed(1.0), weighed(-1.0))
    )
    weight = ROBOT.mass * GRAVITY
    return Claim(
        where="Abstract; 3.1; 4.2; 6",
        claim="The robot is light, so gravity can be neglected.",
        computed=(
            f"It weighs {weight:.2f} N. With its weight, {PULL:.0f} N on cable 1 give {up:.1f} deg "
            f"standing or {down:.1f} deg hanging, linearised ({up_full:.1f} and {down_full:.1f} "
            f"deg in full), not {none:.1f} deg."
        ),
        verdict="does not hold",
        values=numbers(
            weight=weight,
            weightless_degrees=none,
            standing_degrees=up,
            hanging_degrees=down,
            standing_full_degrees=up_full,
            hanging_full_degrees=down_full,
        ),
    )
