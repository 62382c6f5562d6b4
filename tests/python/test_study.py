"""edda.study(): the same bytes by this machine's processes and by executors, Dask's and MPI's among them."""

import concurrent.futures
import importlib.util
import math
import os
import pathlib
import shutil
import subprocess
import sys

import edda
import numpy as np
import pytest

SLIDE = """
[materials.rock]
density = 2600
young = "10 GPa"
poisson = 0.25
[joints.plane]
friction_angle = 25
cohesion = "10 kPa"
[[block]]
fixed = true
polygon = [[0, 0], [20, 0], [20, 11.547005383792516]]
[[block]]
name = "slab"
polygon = [[2, 1.154700538379252], [18, 10.392304845413264], [17, 12.124355652982141], [1, 2.886751345948129]]
"""
STUDY = """
model = "slide.toml"
[sampling]
method = "monte-carlo"
samples = 60
[vary.cohesion]
key = "joints.plane.cohesion"
distribution = "lognormal"
mean = 10
sd = 4
unit = "kPa"
[ask.factor]
of = "limit"
[failure]
below = 1.0
"""
OUTCOME = ("study.csv", "summary.json", "points.csv", "study.toml", "report.html")


@pytest.fixture
def study_file(tmp_path: pathlib.Path) -> pathlib.Path:
    (tmp_path / "slide.toml").write_text(SLIDE)
    file = tmp_path / "s.toml"
    file.write_text(STUDY)
    return file


def outcome(folder: pathlib.Path) -> list[bytes]:
    return [(folder / name).read_bytes() for name in OUTCOME]


@pytest.fixture
def alone(study_file: pathlib.Path, tmp_path: pathlib.Path) -> list[bytes]:
    """The outcome of one process."""
    edda.study(study_file, tmp_path / "alone", jobs=1)
    return outcome(tmp_path / "alone")


def test_answers(study_file: pathlib.Path, tmp_path: pathlib.Path) -> None:
    found = edda.study(study_file, tmp_path / "out", overrides={"sampling.samples": 50})
    table = found.table
    assert len(table) == 50
    slope = math.radians(30)
    cohesion_part = 1e3 * table["cohesion"] / (2600 * 9.81 * 2 * math.sin(slope))
    exact = cohesion_part + math.tan(math.radians(25)) / math.tan(slope)
    np.testing.assert_allclose(table["factor"], exact, rtol=2e-6)
    assert found.probability == np.mean(table["failed"])
    low, high = found.interval or (1.0, 0.0)
    assert low <= found.probability <= high
    assert found.message.startswith("probability of failure")


def run_script(folder: pathlib.Path, program: str, *command: object, environment: dict[str, str] | None = None) -> None:
    """A program of its own, as users write it: processes begin with its file."""
    script = folder / "program.py"
    script.write_text(program)
    arguments = [script if word is SCRIPT else word for word in command]
    subprocess.run(arguments, check=True, timeout=200, cwd=folder, env=os.environ | (environment or {}))


SCRIPT = object()


def test_threads(study_file: pathlib.Path, tmp_path: pathlib.Path, alone: list[bytes]) -> None:
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        edda.study(study_file, tmp_path / "threads", executor=executor)
    assert outcome(tmp_path / "threads") == alone


def test_processes(study_file: pathlib.Path, tmp_path: pathlib.Path, alone: list[bytes]) -> None:
    program = """
import concurrent.futures, multiprocessing, sys
import edda

if __name__ == "__main__":
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as executor:
        edda.study(sys.argv[1], sys.argv[2], executor=executor)
"""
    run_script(tmp_path, program, sys.executable, SCRIPT, study_file, tmp_path / "processes")
    assert outcome(tmp_path / "processes") == alone


def test_reliability_by_an_executor(study_file: pathlib.Path, tmp_path: pathlib.Path) -> None:
    study_file.write_text(STUDY.replace('"monte-carlo"\nsamples = 60', '"form"'))
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        by_executor = edda.study(study_file, tmp_path / "threads", executor=executor)
    edda.study(study_file, tmp_path / "alone")
    assert outcome(tmp_path / "threads") == outcome(tmp_path / "alone")
    assert by_executor.probability == pytest.approx(0.0488564, rel=2e-3)


@pytest.mark.skipif(importlib.util.find_spec("distributed") is None, reason="python3-distributed is not here")
def test_dask(study_file: pathlib.Path, tmp_path: pathlib.Path, alone: list[bytes]) -> None:
    program = """
import sys
from distributed import Client, LocalCluster
import edda

def main():
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        edda.study(sys.argv[1], sys.argv[2], executor=client.get_executor())

if __name__ == "__main__":
    main()
"""
    run_script(tmp_path, program, sys.executable, SCRIPT, study_file, tmp_path / "dask")
    assert outcome(tmp_path / "dask") == alone


@pytest.mark.skipif(
    importlib.util.find_spec("mpi4py") is None or shutil.which("mpiexec") is None, reason="python3-mpi4py is not here"
)
def test_mpi(study_file: pathlib.Path, tmp_path: pathlib.Path, alone: list[bytes]) -> None:
    program = """
import sys
from mpi4py.futures import MPIPoolExecutor
import edda

if __name__ == "__main__":
    with MPIPoolExecutor() as executor:
        edda.study(sys.argv[1], sys.argv[2], executor=executor)
"""
    may = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
    command = ("mpiexec", "-n", "2", sys.executable, "-m", "mpi4py.futures", SCRIPT, study_file, tmp_path / "mpi")
    run_script(tmp_path, program, *command, environment=may)
    assert outcome(tmp_path / "mpi") == alone


def test_faults(study_file: pathlib.Path, tmp_path: pathlib.Path) -> None:
    with pytest.raises(edda.ModelError) as caught:
        edda.study(study_file, tmp_path / "out", overrides={"sampling.samples": 0})
    assert "sampling.samples" in str(caught.value)
    with concurrent.futures.ThreadPoolExecutor(1) as executor, pytest.raises(edda.ModelError):
        edda.study(study_file, tmp_path / "out", overrides={"sampling.samples": 0}, executor=executor)
    assert not (tmp_path / "out").exists()


def test_an_error_of_the_executor_ends_the_study(study_file: pathlib.Path, tmp_path: pathlib.Path) -> None:
    class Broken(concurrent.futures.Executor):
        def submit(self, function, /, *arguments, **named):  # type: ignore[no-untyped-def]
            raise RuntimeError("no more workers")

    with pytest.raises(RuntimeError, match="no more workers"):
        edda.study(study_file, tmp_path / "out", executor=Broken())
    # And goes on by others.
    assert edda.study(study_file, tmp_path / "out").table["sample"][-1] == 59
