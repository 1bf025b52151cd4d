"""The scenario file that ``cdcr new`` writes: it runs as it is and shows everything else.

Sentences begin with ``# ``; what can be switched on begins with ``#`` alone.
"""

from __future__ import annotations

from cdcr.robot.cable import Cable
from cdcr.robot.file import robot_lines
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section


def _robot() -> str:
    """Return a robot with every field there is, switched off."""
    section = Section(
        length=0.8,
        backbone_mass=0.03,
        backbone_diameter=0.005,
        youngs_modulus=9.5e9,
        disk_mass=0.01,
        disk_diameter=0.08,
        num_disks=10,
        cable_radius=0.035,
        cable_angles=(0.0, 2.0),
        damping=1e-3,
    )
    cable = Cable(radius=0.035, angle=4.0, end_section=0, friction=0.0)
    lines = robot_lines(Robot(sections=[section], cables=[cable]), all_fields=True)
    text = "".join(f"#{line}\n" for line in ["[robot]", *lines] if line)
    return text.replace("#[[", "#[[robot.")


TEMPLATE = (
    """\
# A scenario for `cdcr run`. SI units; angles in rad, or in deg where a name ends in _deg.
# Cables and sections are counted from 1. To switch a line on, take away the # before it.
# Everything that is switched off shows its default, unless it is an example.

#title = "A pull"                # example
#description = "Cable 1 pulls."  # example
#source = "my notes"             # example

# The robot: a name from `cdcr list`, or a robot file beside this one (see `cdcr info`), or a table
# [robot], further down.
robot = "amouri2020"
#robot = "robot.toml"

# The equations: "exact", or the origin paper's "taylor", "printed", "printed-taylor".
#formulation = "exact"

t_end = 10.0                     # [s]

# The integrator: "bdf", "adams" or "dopri5", which choose their steps, or "rk4", which does not.
#method = "bdf"
#rtol = 1e-10                    # relative tolerance of a step
#atol = 1e-12                    # absolute tolerance of a step [rad], [rad/s]
#max_step = 0.1                  # largest step [s]; example
#max_steps = 1000000             # after which the run is given up
#step = 0.001                    # of rk4 [s]

# What moves the robot: one of tension, trajectory, controller; or none, and it swings freely.
# Tensions that stay the same, one for each cable [N]:
tension = [5.0, 0.0, 0.0]

# What is written; "picture" is .png, "csv" and "nc" (netCDF) hold the numbers.
#[output]
#num_samples = 1001              # evenly spaced, both ends included
#files = ["picture", "csv", "nc"]

# The start; straight and at rest by default. An array has a number for each section.
#[initial]
#theta_deg = [45.0]              # bending angle; or theta [rad]; example
#phi_deg = [0.0]                 # orientation angle, 0 towards cable 1; or phi [rad]
#qd = [0.0, 0.0]                 # rates, two for each section [rad/s]

# The same start as bending vectors q = theta (cos phi, sin phi), two numbers for each section.
#[initial]
#q = [0.785, 0.0]                # [rad]; example

# The robot in this file, in place of its name above; the fields of a robot file, all values an
# example. Instead of angles in rad, cable_angles_deg and angle_deg may be given.
"""
    + _robot()
    + """
# Forces and moments on the backbone, any number of tables, beside whatever moves the robot. With
# times and factors they change in size; they are constant without.
#[[wrenches]]                    # example
#section = 1                     # where it acts, base to tip from 1
#fraction = 1.0                  # of the section's length, 0 to 1
#force = [0.1, 0.0, 0.0]         # [N]
#moment = [0.0, 0.0, 0.0]        # about the point where the force acts [N m]
#frame = "base"                  # or "local": turns with the backbone
#times = [0.0, 1.0, 2.0]         # [s]
#factors = [0.0, 1.0, 0.0]       # of force and moment, one for each time
#interpolation = "linear"        # or "previous": each factor holds until the next

# Tensions over time, in place of `tension` above. As rows:
#[tension]
#t = [0.0, 1.0, 2.0]             # [s]
#rows = [[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [5.0, 5.0, 0.0]]  # a number for each cable [N]
#interpolation = "linear"        # or "previous": each row holds until the next

# From a CSV file beside this one with the columns t, cable 1, cable 2, ...:
#[tension]
#file = "tension.csv"
#interpolation = "linear"

# As shapes, any number of tables; several on one cable add up, never to less than 0 N.
#[[tension]]
#cable = 1
#shape = "step"                  # 0, then value
#value = 5.0                     # [N]
#at = 0.0                        # [s]
#[[tension]]
#cable = 1
#shape = "ramp"                  # a line from start to end, constant before and after
#from = 0.0                      # [N]
#to = 2.0                        # [N]
#start = 0.0                     # [s]
#end = 1.0                       # [s]
#[[tension]]
#cable = 2
#shape = "pulse"                 # value from start to end, base before and after
#value = 3.0                     # [N]
#start = 2.0                     # [s]
#end = 2.5                       # [s]
#base = 0.0                      # [N]
#[[tension]]
#cable = 3
#shape = "sine"                  # mean + amplitude sin(2 pi frequency (t - start) + phase)
#mean = 2.0                      # also before start [N]
#amplitude = 1.5                 # [N]
#frequency = 0.5                 # [Hz]
#phase_deg = 0.0                 # or phase [rad]
#start = 0.0                     # [s]

# A motion to follow, in place of tension: the run finds the tensions that it needs, and feeds them
# to the robot where feed_back is true. Values are numbers for all sections or an array with one
# for each. A circle:
#[trajectory]
#shape = "circle"                # theta stays, phi goes round
#theta_deg = 15.0                # or theta [rad]
#turns_per_second = 0.1          # negative: clockwise
#phi_deg = 0.0                   # at the start; or phi [rad]
#feed_back = false               # true: simulate under the tensions, report the path error
#step = 0.2                      # time between tensions fed back [s]; exact without it; example
#min_tension = 0.0               # of every cable; above 0 keeps them taut [N]
#max_tension = inf               # [N]
#infeasible = "raise"            # "nearest": where the limits are too narrow, come near

# In a plane, bending more and more; starts in motion:
#[trajectory]
#shape = "line"
#theta_rate_deg = 10.0           # or theta_rate [rad/s]
#theta_deg = 0.0                 # at the start; or theta [rad]
#phi_deg = 30.0                  # or phi [rad]
#feed_back = true

# To and fro in a plane, theta = amplitude sin(2 pi frequency t):
#[trajectory]
#shape = "swing"
#amplitude_deg = 20.0            # or amplitude [rad]
#frequency = 0.2                 # [Hz]
#phi_deg = 30.0                  # or phi [rad]
#feed_back = true

# From straight to a place, gently, and rest there:
#[trajectory]
#shape = "move"
#theta_deg = 30.0                # or theta [rad]
#phi_deg = 90.0                  # or phi [rad]
#start = 0.0                     # [s]
#duration = 5.0                  # [s]
#feed_back = true

# Samples, at least 11, joined by splines (needs the extra `track`); they must reach to t_end. Also
# theta, phi [rad], or q with two numbers for each section; rows of numbers for several sections.
#[trajectory]
#t = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0]
#theta_deg = [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0]
#phi_deg = [0.0, 9.0, 18.0, 27.0, 36.0, 45.0, 54.0, 63.0, 72.0, 81.0, 90.0]

# Samples from a CSV file beside this one with the columns t, theta_deg 1, phi_deg 1, ... or
# t, theta 1, phi 1, ... or t, q 1 x, q 1 y, ...:
#[trajectory]
#file = "path.csv"

# A controller in place of tension: force = kp error + ki integral - kd rate, in bending vectors,
# shared among the cables with least tension.
#[controller]
#type = "pid"
#kp = 2.0                        # [N m/rad]; example
#ki = 0.5                        # [N m/(rad s)]; example
#kd = 0.3                        # [N m s/rad]; example
#period = 0.001                  # between updates, tensions are held [s]
#feed_forward = true             # adds the force that holds the reference still
#anti_windup = true              # stops integrating what the limits cannot give
#min_tension = 0.0               # of every cable [N]; -inf is an ideal actuator that can push
#max_tension = inf               # [N]
#cables = [1, 2, 3]              # that may be used, counted from 1; all by default
#[controller.reference]          # what to reach and hold; straight by default
#theta_deg = [15.0]              # of each section; or theta [rad], or q as in [initial]; example
#phi_deg = [60.0]                # or phi [rad]; example
"""
)
