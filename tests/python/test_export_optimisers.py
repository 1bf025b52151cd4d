"""Exported C in the forms of CasADi and acados: values and Jacobians are those of the library."""

import ctypes
import os
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import cdcr
from c_library import FLAGS

pytestmark = pytest.mark.skipif(shutil.which("cc") is None, reason="there is no compiler of C")

MODEL = cdcr.Model(cdcr.robots.three_sections())
D, C = MODEL.num_coordinates, MODEL.num_cables
X = np.array([0.1, 0.2, -0.3, 0.1, 0.05, 0.2, 1.0, -1.0, 0.5, 0.2, 0.3, -0.4])
U = np.linspace(1.0, 2.0, C)
STEP = 1e-3

# Relative to the largest number: residuals seen are below a tenth.
ROUNDING = 1e-12
OF_DIFFERENCES = 1e-9

# As much of acados and BLASFEO as the file calls, in the place of theirs.
STAND_IN = """
struct blasfeo_dvec { double* pa; };
struct blasfeo_dmat { double* pA; int m; };
struct blasfeo_dvec_args { struct blasfeo_dvec* x; int xi; };
struct blasfeo_dmat_args { struct blasfeo_dmat* A; int ai; int aj; };
static double blasfeo_dvecex1(struct blasfeo_dvec* x, int i) { return x->pa[i]; }
static void blasfeo_dvecin1(double value, struct blasfeo_dvec* x, int i) { x->pa[i] = value; }
static void blasfeo_dgein1(double value, struct blasfeo_dmat* A, int i, int j) {
  A->pA[j * A->m + i] = value;
}
"""


class Vector(ctypes.Structure):
    _fields_ = (("pa", ctypes.c_void_p),)


class Matrix(ctypes.Structure):
    _fields_ = (("pA", ctypes.c_void_p), ("m", ctypes.c_int))


class Place(ctypes.Structure):
    """Of a vector or a matrix, from a row and a column on."""

    _fields_ = (("of", ctypes.c_void_p), ("row", ctypes.c_int), ("column", ctypes.c_int))


def compiled(folder: Path, *sources: str, flags: tuple[str, ...] = ()) -> Path:
    shared = folder / f"lib{sources[-1][:-2]}.so"
    paths = [folder / source for source in sources]
    how = ["-fcx-limited-range", "-shared", "-fPIC", *flags]
    subprocess.run(["cc", *FLAGS, *how, "-o", shared, *paths], check=True)
    return shared


def after(x: NDArray[np.float64], u: NDArray[np.float64], steps: int = 1) -> NDArray[np.float64]:
    simulator = cdcr.Simulator(MODEL, step=STEP)
    simulator.reset(x[:D], x[D:])
    for _ in range(steps):
        assert simulator.step(u) == cdcr.Status.ok
    return np.concatenate([simulator.q, simulator.qd])


def slopes_after(steps: int) -> NDArray[np.float64]:
    """Central differences of the library by x and u, of fourth order."""
    at, h, columns = np.concatenate([X, U]), 1e-4, []
    for k in range(2 * D + C):
        moved = [at + size * h * np.eye(2 * D + C)[k] for size in (-2, -1, 1, 2)]
        far, near, ahead, beyond = (after(one[: 2 * D], one[2 * D :], steps) for one in moved)
        columns.append((far - 8 * near + 8 * ahead - beyond) / (12 * h))
    return np.transpose(columns)


def error(got: Any, wanted: NDArray[np.float64]) -> float:
    return float(np.abs(np.asarray(got) - wanted).max() / np.abs(wanted).max())


def test_casadi_calls_the_robot_and_its_derivatives(tmp_path: Path) -> None:
    casadi = pytest.importorskip("casadi", reason="the extra casadi is not installed")
    cdcr.export.write_c(MODEL.robot, tmp_path, name="arm", casadi=True)
    library = str(compiled(tmp_path, "arm.c", "arm_derivatives.c", "arm_casadi.c"))
    ode, advance = (casadi.external(name, library) for name in ("arm_ode", "arm_advance"))
    assert (ode.n_in(), ode.size_in(0), ode.size_in(1)) == (2, (2 * D, 1), (C, 1))

    qdd = MODEL.forward_dynamics(X[:D], X[D:], U)
    assert error(np.array(ode(X, U))[:, 0], np.concatenate([X[D:], qdd])) < ROUNDING
    assert error(np.array(advance(X, U, STEP))[:, 0], after(X, U)) < ROUNDING

    x, u, h = (casadi.MX.sym(name, size) for name, size in (("x", 2 * D), ("u", C), ("h", 1)))
    both = casadi.vertcat(x, u)
    slopes = casadi.Function("slopes", [x, u], [casadi.jacobian(ode(x, u), both)])(X, U)
    by_q, by_qd, by_command = MODEL.derivatives(X[:D], X[D:], U)[:3]
    wanted = np.zeros((2 * D, 2 * D + C))
    wanted[:D, D : 2 * D] = np.eye(D)
    wanted[D:] = np.hstack([by_q, by_qd, by_command])
    assert error(slopes, wanted) < ROUNDING

    next_ = advance(x, u, h)
    found = casadi.Function(
        "found", [x, u, h], [casadi.jacobian(next_, both), casadi.jacobian(next_, h)]
    )
    on_both, on_step = map(np.array, found(X, U, STEP))
    assert error(on_both, slopes_after(1)) < OF_DIFFERENCES
    # At the end of a step the state changes with the step as it does in time, but for its order.
    rate = np.array(ode(after(X, U), U))
    assert error(on_step, rate) < 100.0 * STEP

    far = X.copy()
    far[0] = 10.0
    for answer in (*map(np.array, found(far, U, STEP)), np.array(ode(far, U))):
        assert np.isnan(answer).any()


def test_acados_gets_the_next_state_and_its_derivatives(tmp_path: Path) -> None:
    steps = 4
    cdcr.export.write_c(MODEL.robot, tmp_path, name="arm", acados=steps * STEP, steps=steps)
    for header in ("acados/utils/external_function_generic.h", "blasfeo_d_aux.h"):
        (tmp_path / header).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / header).write_text("#pragma once\n" + STAND_IN * header.startswith("acados"))
    flags = (f"-I{tmp_path}", "-Wno-unused-const-variable")
    library = ctypes.CDLL(str(compiled(tmp_path, "arm_acados.c", flags=flags)))
    offset = 3  # acados gives places in longer vectors
    x, u = np.concatenate([np.ones(offset), X]), U.copy()
    after_it, slopes = np.zeros(2 * D), np.zeros((2 * D, C + 2 * D))  # columns of BLASFEO are rows

    def place(structure: ctypes.Structure, row: int = 0) -> ctypes.c_void_p:
        kept.append(structure)
        kept.append(Place(ctypes.addressof(structure), row, 0))
        return ctypes.c_void_p(ctypes.addressof(kept[-1]))

    kept: list[ctypes.Structure] = []
    inputs = (ctypes.c_void_p * 2)(
        place(Vector(x.ctypes.data), offset).value, place(Vector(u.ctypes.data)).value
    )
    outputs = (ctypes.c_void_p * 2)(
        place(Vector(after_it.ctypes.data)).value,
        place(Matrix(slopes.ctypes.data, C + 2 * D)).value,
    )
    wanted = after(X, U, steps)
    for name in ("arm_next", "arm_next_jac"):
        after_it[:] = 0.0
        assert getattr(library, name)(inputs, outputs, None) == 0
        assert error(after_it, wanted) < ROUNDING
    by_both = slopes_after(steps)
    assert error(slopes[:, :C], by_both[:, 2 * D :]) < OF_DIFFERENCES
    assert error(slopes[:, C:], by_both[:, : 2 * D]) < OF_DIFFERENCES
    x[offset] = 10.0
    for name in ("arm_next", "arm_next_jac"):
        after_it[:] = 0.0
        assert getattr(library, name)(inputs, outputs, None) == 1
        assert np.isnan(after_it).all()
    assert np.isnan(slopes).all()


@pytest.mark.skipif("ACADOS_SOURCE_DIR" not in os.environ, reason="there is no acados")
def test_acados_itself_solves_with_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """To be run with ACADOS_SOURCE_DIR, LD_LIBRARY_PATH and acados_template on the path."""
    acados: Any = pytest.importorskip("acados_template")
    casadi = pytest.importorskip("casadi")
    model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    monkeypatch.chdir(tmp_path)
    intervals, interval, goal = 20, 0.02, np.array([0.2, 0.1, 0.0, 0.0])
    cdcr.export.write_c(model.robot, tmp_path, name="arm", acados=interval, steps=4)
    ocp = acados.AcadosOcp()
    ocp.model.name = "arm"
    ocp.model.x, ocp.model.u = casadi.SX.sym("x", 4), casadi.SX.sym("u", 3)
    ocp.model.p = []
    ocp.model.dyn_ext_fun_type = "generic"
    ocp.model.dyn_generic_source = "arm_acados.c"
    ocp.model.dyn_disc_fun, ocp.model.dyn_disc_fun_jac = "arm_next", "arm_next_jac"
    ocp.dims.N = intervals
    ocp.cost.cost_type = ocp.cost.cost_type_e = "LINEAR_LS"
    ocp.cost.Vx, ocp.cost.Vu = np.eye(7, 4), np.eye(7, 3, -4)
    ocp.cost.W, ocp.cost.W_e = np.diag([10.0, 10, 0.1, 0.1, 1e-3, 1e-3, 1e-3]), np.eye(4)
    ocp.cost.Vx_e, ocp.cost.yref_e = np.eye(4), goal
    ocp.cost.yref = np.concatenate([goal, np.ones(3)])
    ocp.constraints.idxbu = np.arange(3)
    ocp.constraints.lbu, ocp.constraints.ubu = np.full(3, 0.5), np.full(3, 20.0)
    ocp.constraints.x0 = np.zeros(4)
    ocp.solver_options.tf = intervals * interval
    ocp.solver_options.integrator_type = "DISCRETE"
    ocp.solver_options.nlp_solver_type = "SQP"
    ocp.solver_options.hessian_approx = "GAUSS_NEWTON"
    solver = acados.AcadosOcpSolver(ocp, json_file="arm.json")
    assert solver.solve() == 0
    for k in range(intervals):
        simulator = cdcr.Simulator(model, step=interval, substeps=4)
        x = solver.get(k, "x")
        simulator.reset(x[:2], x[2:])
        simulator.step(solver.get(k, "u"))
        reached = np.concatenate([simulator.q, simulator.qd])
        np.testing.assert_allclose(solver.get(k + 1, "x"), reached, rtol=0.0, atol=1e-6)
    assert np.abs(solver.get(intervals, "x") - goal).max() < 0.02


def test_refusals(tmp_path: Path) -> None:
    for wrong in (0.0, -1.0, np.inf):
        with pytest.raises(ValueError, match="acados must be a number > 0 s and finite, got"):
            cdcr.export.write_c(MODEL.robot, tmp_path, acados=wrong)
    with pytest.raises(ValueError, match="steps must be a whole number 1 to 1000, got 0"):
        cdcr.export.write_c(MODEL.robot, tmp_path, acados=0.02, steps=0)
    assert list(tmp_path.iterdir()) == []
