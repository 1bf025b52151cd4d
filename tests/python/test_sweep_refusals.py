"""What a sweep cannot do is told in one sentence, before anything runs."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.sweeps import METRICS
from swept import end_x, pulled

pytest.importorskip("xarray")

GRID = {"payload": [0.0, 0.01]}
ONE = {"a": [1.0]}


@pytest.mark.parametrize(
    ("parameters", "told"),
    [
        ({"paylod": [1.0]}, "there is no parameter 'paylod'. Did you mean 'payload'? Known"),
        ({"sections.2.damping": [1.0]}, "no parameter 'sections.2.damping'. Did you mean 'sect"),
        ({"sections.0.damping": [1.0]}, "there is no parameter 'sections.0.damping'. Did you"),
        ({"sections.*.dampng": [1.0]}, "Did you mean 'sections.*.damping'?"),
        ({"gravity": [1.0]}, "there is no parameter 'gravity'. Did you mean 'gravity."),
        ({"tension.4": [1.0]}, "there is no parameter 'tension.4'. Did you mean 'tension.3'?"),
        ({"title": [1.0]}, "there is no parameter 'title'."),
        ({"integrator.rtol": [1e-9]}, "'integrator.rtol' says how a run is computed, not what"),
        ({"payload": [-1.0, 0.0]}, "parameter 'payload' cannot be -1: step-tension.toml, [robot"),
        ({"t_end": [0.0, 1.0]}, "parameter 't_end' cannot be 0: step-tension.toml: t_end must"),
        ({"sections.1.num_disks": [2.5]}, "num_disks must be a whole number 0 to 64, got 2.5"),
        ({"payload": [0.1, 0.1]}, "parameter 'payload' must have each value once, got [0.1, 0.1]"),
        ({"payload": 0.1}, "parameter 'payload' must have a sequence of values, got 0.1 (float)"),
        ({"payload": [np.nan]}, "parameter 'payload'"),
        ({}, "a sweep must have a parameter, got none"),
        ("payload", "parameters must be a mapping from names to values, got 'payload'"),
        (None, "parameters must be a mapping from names to values, got None (NoneType)"),
        (["payload"], "parameters must be a mapping from names to values, got ['payload'] (list)"),
        ({3: [1.0]}, "a parameter must have a name, got 3 (int)"),
        (
            {"sections.1.damping": [0.01], "sections.*.damping": [0.02]},
            "'sections.1.damping' and 'sections.*.damping' lead to the same number: give one",
        ),
        ({"payload": [0.1], "robot.payload": [0.2]}, "lead to the same number: give one of them"),
    ],
)
def test_parameters(parameters: Any, told: str) -> None:
    with pytest.raises((ValueError, TypeError), match=re.escape(told)):
        cdcr.sweep("step-tension", parameters, metrics="peak_theta")


@pytest.mark.parametrize(
    ("samples", "values", "told"),
    [
        ("sobol:100", (0, 1), "samples of sobol must be a power of 2, got 100; 64 and 128 are the"),
        ("sobul:64", (0, 1), "of sobol, lhs, random, saltelli, got 'sobul:64'. Did you mean 'so"),
        ("lhs", (0, 1), "samples must be KIND:NUMBER, of sobol, lhs, random, saltelli, got 'lhs'"),
        ("lhs:-3", (0, 1), "samples must be KIND:NUMBER"),
        ("normal:4", (0, 1), "of sobol, lhs, random, saltelli, got 'normal:4'"),
        ("lhs:3", (1, 0), "parameter 'a' must have two numbers, from low to high, or a distribu"),
        ("lhs:3", [0, 1, 2], "parameter 'a' must have two numbers, from low to high"),
        ("lhs:99999999", (0, 1), "a sweep must have at most 10000000 runs, got 99999999"),
        ([1.0, 2.0], None, "samples must have a row of 1 values for each run, one of each param"),
    ],
)
def test_samples(samples: Any, values: Any, told: str) -> None:
    with pytest.raises(ValueError, match=re.escape(told)):
        cdcr.sweep(pulled, {"a": values}, samples=samples, metrics=end_x)


def test_unknown_metrics_list_those_there_are() -> None:
    with pytest.raises(ValueError, match=r"^there is no metric 'peak_tehta'\.") as caught:
        cdcr.sweep("step-tension", GRID, metrics=["peak_theta", "peak_tehta"])
    told = str(caught.value)
    assert "Did you mean 'peak_theta'?" in told
    assert f"Known: {', '.join(METRICS)}; of this scenario also theta_static_deg, " in told


@pytest.mark.parametrize(
    ("metrics", "told"),
    [
        ([], "a sweep must have a metric, got none. Known: settling_time, "),
        (["steps", "steps"], "metric 'steps' must be given once, got it twice"),
        (lambda run: 1.0, 'a function without a name must be given one, as {"name": function}'),
        ({"x": 3}, "metric 'x' must be a function of a run, got 3"),
        ([3], "a metric must be a name or a function of a run, got 3"),
        (3, "metrics must be names or functions of a run, got 3 (int)"),
        ("final_tip", "there is no metric 'final_tip'. Did you mean 'final_tip_"),
    ],
)
def test_metrics(metrics: Any, told: str) -> None:
    with pytest.raises(ValueError, match=re.escape(told)):
        cdcr.sweep(pulled, {"pull": [1.0]}, metrics=metrics)


@pytest.mark.parametrize(
    ("source", "parameters", "error", "told"),
    [
        (pulled, {"pul": [1]}, ValueError, "no parameter 'pul'. Did you mean 'pull'? Known: pull"),
        (pulled, {"damping": [1]}, ValueError, "needs a parameter 'pull' that is not swept"),
        (lambda a: a, ONE, TypeError, "what is swept must return a run, got float"),
        (3, ONE, TypeError, "what is swept must be the name of a scenario, a scenario file or a"),
        ("nowhere.toml", ONE, FileNotFoundError, "there is no scenario file nowhere.toml"),
        ("step-tensio", ONE, ValueError, "no scenario 'step-tensio'. Did you mean 'step-tension'?"),
        (lambda: None, ONE, ValueError, "there is no parameter 'a'. The function takes none"),
        ("gravity-ratio", ONE, ValueError, "nothing runs in the scenario 'gravity-ratio'"),
    ],
)
def test_sources(source: Any, parameters: Any, error: type[Exception], told: str) -> None:
    with pytest.raises(error) as caught:
        cdcr.sweep(source, parameters, metrics="steps")
    assert told in str(caught.value)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"jobs": 0}, "jobs must be a whole number >= 1, got 0 (int)"),
        ({"chunk": 0}, "chunk must be a whole number 1 to 1000, got 0 (int)"),
        ({"samples": "lhs:2", "seed": -1}, "seed must be a whole number >= 0, got -1 (int)"),
        ({"executor": 3}, "executor must be a concurrent.futures.Executor or a dask.distributed"),
        (
            {"scheduler": 3},
            "scheduler must be an address, such as 'tcp://10.0.0.1:8786', or 'local",
        ),
        ({"progress": 3}, "progress must be a function of two numbers, got 3 (int)"),
        (
            {"seed": 2**40, "samples": "lhs:2"},
            "seed must be a whole number >= 0 and at most 2147483647",
        ),
        ({"executor": 3, "jobs": 2}, "give either an executor, or scheduler and jobs"),
        ({"scheduler": "tcp://a:1", "jobs": 2}, "jobs are for this machine, and tcp://a:1 has"),
        ({"progress": 5}, "progress must be a function of two numbers, got 5 (int)"),
        ({"path": "sweep.csv"}, "the file name must end in .nc or .zarr, got 'sweep.csv'"),
        ({"path": "nowhere/sweep.nc"}, "the folder nowhere does not exist; make it first"),
    ],
)
def test_options(options: Any, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises((ValueError, TypeError, OSError)) as caught:
        cdcr.sweep(pulled, {"pull": (1.0, 2.0)}, metrics=end_x, **options)
    assert told in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_what_is_no_sweep() -> None:
    for function in (cdcr.sweeps.plot, cdcr.sweeps.sobol_indices):
        with pytest.raises(
            TypeError,
            match=r"^result must be a Dataset of cdcr\.sweep, or one read from its file, got dict$",
        ):
            function({})  # type: ignore[arg-type]


def test_another_version_of_cdcr_elsewhere_is_told() -> None:
    from dataclasses import replace

    from cdcr.sweeps.jobs import Chunk, FunctionSource, Job, compute

    job = replace(Job(FunctionSource(pulled, ("pull",)), ()), version="9.9")
    with pytest.raises(RuntimeError, match=r"the sweep is of cdcr 9\.9, and .* is installed where"):
        compute(job, Chunk((0,), np.array([[1.0]])))
