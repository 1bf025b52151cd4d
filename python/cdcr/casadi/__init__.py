"""Models as functions of CasADi, for Opti and nlpsol. Extra ``casadi``.

First derivatives are exact, by `Model.derivatives`; there are no second ones, so give solvers that
ask for a Hessian an approximation of it: ``{"ipopt.hessian_approximation": "limited-memory"}``.

Examples
--------
>>> import casadi
>>> import cdcr
>>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
>>> lengths = cdcr.casadi.cable_lengths(model)
>>> qdd = cdcr.casadi.dynamics(model)
>>> opti = casadi.Opti()
>>> q, tension = opti.variable(2), opti.variable(3)
>>> opti.subject_to(qdd(q, [0.0, 0.0], tension) == 0.0)  # at rest
>>> opti.subject_to(lengths(q)[0] == 0.79)  # with cable 1 so long [m]
>>> opti.subject_to(opti.bounded(0.0, tension, 20.0))
>>> opti.minimize(casadi.sumsqr(tension))
>>> quiet = {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes"}
>>> opti.solver("ipopt", {**quiet, "ipopt.hessian_approximation": "limited-memory"})
>>> opti.solve().value(tension).round(2) + 0.0
array([12.08,  0.  ,  0.  ])
"""
# ruff: noqa: E402 - the extra is asked for before its first import, so that one sentence says so

from cdcr.base.extras import require

require("casadi", "casadi")

from cdcr.casadi._functions import cable_lengths, dynamics, step, tip

__all__ = ["cable_lengths", "dynamics", "step", "tip"]
