"""The integrators: each prepares itself once, and then gives runs of the swing at any tolerance.

`prepare(swing)` returns `at(rtol)`, which sets a run up and returns `run()`, which computes the
bending vectors (N, 2) at the times of the swing. Where a run has to be set up or compiled for its
tolerance, that is not in its time. The absolute tolerance is a hundredth of the relative one.
"""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from swing import Q0, QD0, TIMES, Y0, Swing

Run = Callable[[], NDArray[np.float64]]
At = Callable[[float], Run]


class Peer(NamedTuple):
    """An integrator and how many tolerances it is run at."""

    name: str
    prepare: Callable[[Swing], At]
    package: str
    exponents: range = range(5, 13)  # rtol = 10^-k


def _cdcr(method: Any, swing: Swing) -> At:
    import cdcr

    model = cdcr.Model(cdcr.robots.amouri2020())  # has its own equations of the swing

    def at(rtol: float) -> Run:
        options: dict[str, Any] = {"method": method, "rtol": rtol, "atol": rtol / 100}
        return lambda: cdcr.simulate(model, Q0, QD0, t=TIMES, **options).q

    return at


def _scipy(method: str, compiled: bool, swing: Swing) -> At:
    from scipy.integrate import solve_ivp

    if compiled:
        derivative = _numba(swing)

        def function(t: float, y: NDArray[np.float64]) -> Any:
            return derivative(y)

    else:
        from scipy_reference import RightHandSide

        function: Any = RightHandSide(swing.table, swing.stiffness)

    def at(rtol: float) -> Run:
        options = {"t_eval": TIMES, "rtol": rtol, "atol": rtol / 100, "method": method}
        return lambda: solve_ivp(function, (0.0, TIMES[-1]), Y0, **options).y[:2].T

    return at


def _numba(swing: Swing) -> Callable[[Any], Any]:
    """Return y' of y, compiled."""
    import numba

    compiled = numba.njit(swing.rates())

    @numba.njit
    def derivative(y: Any) -> Any:
        xdd, ydd = compiled(y[0], y[1], y[2], y[3])
        return np.array([y[2], y[3], xdd, ydd])

    derivative(Y0)
    return derivative


def _numbalsoda(name: str, swing: Swing) -> At:
    import numba
    import numbalsoda

    compiled = numba.njit(swing.rates())

    @numba.cfunc(numbalsoda.lsoda_sig)
    def callback(t: Any, y: Any, yd: Any, data: Any) -> None:
        yd[0], yd[1] = y[2], y[3]
        yd[2], yd[3] = compiled(y[0], y[1], y[2], y[3])

    solve, address = getattr(numbalsoda, name), callback.address

    def at(rtol: float) -> Run:
        options = {"rtol": rtol, "atol": rtol / 100, "mxstep": 1_000_000}
        return lambda: solve(address, Y0, TIMES, **options)[0][:, :2]

    return at


def _heyoka(swing: Swing) -> At:
    import heyoka

    x, y, xd, yd = heyoka.make_vars("x", "y", "xd", "yd")
    xdd, ydd = swing.rates()(x, y, xd, yd)
    system = [(x, xd), (y, yd), (xd, xdd), (yd, ydd)]

    def at(rtol: float) -> Run:
        integrator = heyoka.taylor_adaptive(system, Y0, tol=rtol)

        def run() -> NDArray[np.float64]:
            integrator.time = 0.0
            integrator.state[:] = Y0
            sampled: NDArray[np.float64] = integrator.propagate_grid(TIMES)[5]
            return sampled[:, :2]

        return run

    return at


def _casadi(multistep: str, compiled: bool, swing: Swing) -> At:
    import casadi

    y = casadi.SX.sym("y", 4)
    acceleration = swing.rates()(*(y[k] for k in range(4)))
    function = casadi.Function("f", [y], [casadi.vertcat(y[2], y[3], *acceleration)])
    if compiled:
        function = _compiled(casadi, function)
    symbol: Any = casadi.MX.sym("y", 4) if compiled else y
    problem = {"x": symbol, "ode": function(symbol)}

    def at(rtol: float) -> Run:
        options: dict[str, Any] = {
            "reltol": rtol,
            "abstol": rtol / 100,
            "linear_multistep_method": multistep,
            "max_num_steps": 1_000_000,
        }
        if multistep == "adams":
            options["nonlinear_solver_iteration"] = "functional"
        integrator = casadi.integrator("F", "cvodes", problem, 0.0, list(TIMES[1:]), options)

        def run() -> NDArray[np.float64]:
            later = np.array(integrator(x0=Y0)["xf"])
            return np.vstack((Q0, later[:2].T))

        return run

    return at


def _compiled(casadi: Any, function: Any) -> Any:
    """Return the function and its Jacobian as C, compiled with -O3."""
    folder = Path(tempfile.mkdtemp())
    generator = casadi.CodeGenerator("f.c")
    generator.add(function)
    generator.add(function.jacobian())
    generator.generate(f"{folder}/")
    library = folder / "f.so"
    command = ["cc", "-O3", "-shared", "-fPIC", str(folder / "f.c"), "-o", str(library)]
    subprocess.run(command, check=True)
    return casadi.external("f", str(library))


def _sundae(method: str, swing: Swing) -> At:
    from sksundae.cvode import CVODE

    derivative = _numba(swing)

    def function(t: float, y: NDArray[np.float64], yp: NDArray[np.float64]) -> None:
        yp[:] = derivative(y)

    def at(rtol: float) -> Run:
        solver = CVODE(function, method=method, rtol=rtol, atol=rtol / 100, max_num_steps=1_000_000)
        return lambda: solver.solve(TIMES, Y0).y[:, :2]

    return at


PEERS = [
    *(
        Peer(f"cdcr {name}", partial(_cdcr, name), "cdcr")
        for name in ("dop853", "dopri5", "adams", "bdf")
    ),
    Peer("numbalsoda DOP853", partial(_numbalsoda, "dop853"), "numbalsoda"),
    Peer("numbalsoda LSODA", partial(_numbalsoda, "lsoda"), "numbalsoda"),
    Peer("heyoka Taylor", _heyoka, "heyoka"),
    Peer("CasADi CVODES Adams, compiled C", partial(_casadi, "adams", True), "casadi"),
    Peer("CasADi CVODES Adams, SX", partial(_casadi, "adams", False), "casadi"),
    Peer("CasADi CVODES BDF, compiled C", partial(_casadi, "bdf", True), "casadi"),
    Peer("scikit-sundae Adams, numba", partial(_sundae, "Adams"), "scikit-sundae"),
    Peer("SciPy DOP853, numba", partial(_scipy, "DOP853", True), "scipy"),
    Peer("SciPy DOP853, NumPy", partial(_scipy, "DOP853", False), "scipy"),
    Peer("SciPy LSODA, numba", partial(_scipy, "LSODA", True), "scipy"),
]
