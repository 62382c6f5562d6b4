"""edda.study(): studies of many samples, on this machine or by an executor."""

from __future__ import annotations

import concurrent.futures
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from . import _edda
from ._errors import Fault, ModelError
from .results import Table, read_table


@dataclass(frozen=True)
class Study:
    """A study that is complete: `summary` is its summary.json, `table` the columns of study.csv by their names."""

    folder: pathlib.Path
    summary: Mapping[str, Any] = field(repr=False)

    @property
    def message(self) -> str:
        """The answer in one sentence."""
        return str(self.summary["message"])

    @property
    def probability(self) -> float | None:
        """Probability of failure; None where the study asks for none."""
        failure = self.summary.get("failure")
        return None if failure is None else float(failure["probability"])

    @property
    def interval(self) -> tuple[float, float] | None:
        """Its confidence interval; None where the method gives none."""
        failure = self.summary.get("failure") or {}
        return (float(failure["low"]), float(failure["high"])) if "low" in failure else None

    @property
    def table(self) -> Table:
        """A row for each sample: its values, its answers, whether it failed."""
        return read_table(self.folder / "study.csv")


def study(
    file: str | os.PathLike[str],
    folder: str | os.PathLike[str] | None = None,
    overrides: Mapping[str, Any] | Sequence[str] | None = None,
    executor: concurrent.futures.Executor | None = None,
    jobs: int | None = None,
    at_once: int = 256,
) -> Study:
    """Runs a study, or goes on with it, as `edda study FILE -o FOLDER` does.

    executor: any executor of concurrent.futures' kind, which then runs the samples, such as
    dask.distributed's Client.get_executor() or mpi4py.futures.MPIPoolExecutor; None: processes of this machine, `jobs`
    of them. The outcome is the same bytes. at_once: samples that are given to the executor at a time. Its processes
    need edda, and files that the model names, but no access to the folder. Raises ModelError for a study that cannot be
    run, RuntimeError where the program edda is missing.
    """
    from . import _settings  # which is defined in the package

    target = pathlib.Path(folder) if folder is not None else pathlib.Path(pathlib.Path(file).stem)
    command = [_program(), "study", os.fspath(file), "-o", os.fspath(target), "--json"]
    for setting in _settings(overrides):
        command += ["--set", setting]
    if executor is not None:
        jobs = 0
    if jobs is not None:
        command += ["--jobs", str(jobs)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as leader:
        try:
            if executor is not None:
                _work(leader, target, executor, at_once)
            out, err = leader.communicate()
        except BaseException:
            leader.kill()
            raise
    if leader.returncode != 0:
        raise _error(out, err)
    return Study(target, json.loads((target / "summary.json").read_text(encoding="utf-8")))


def _work(leader: subprocess.Popen[str], target: pathlib.Path, executor: concurrent.futures.Executor, at_once: int) -> None:
    """Gives free samples to the executor, as long as the leader has not ended."""
    while leader.poll() is None and not ((target / "study.toml").exists() and (target / "workers").is_dir()):
        time.sleep(0.01)
    if leader.poll() is not None:
        return
    worker = _edda.StudyWorker(os.fspath(target))
    pending: dict[concurrent.futures.Future[tuple[list[str], str]], int] = {}
    while leader.poll() is None:
        while len(pending) < at_once:
            taken = worker.take()
            if taken is None:
                break
            number, point = taken
            pending[executor.submit(sample, worker.study, worker.model, point)] = number
        done, _ = concurrent.futures.wait(pending, timeout=0.05, return_when=concurrent.futures.FIRST_COMPLETED)
        for future in done:
            cells, message = future.result()
            worker.finish(pending.pop(future), cells, message)
        if not pending:
            time.sleep(0.01)
    for future in pending:
        future.cancel()


def sample(study_text: str, model_text: str, point: Sequence[float]) -> tuple[list[str], str]:
    """What an executor's process runs: the answers of one sample."""
    with tempfile.TemporaryDirectory(prefix="edda-") as scratch:
        return _edda.study_sample(study_text, model_text, list(point), os.path.join(scratch, "run"))


def _program() -> str:
    """The program edda: where EDDA_PROGRAM says, on the path, or beside the package as it is built."""
    built = pathlib.Path(__file__).absolute().parents[2] / "edda"
    for candidate in (os.environ.get("EDDA_PROGRAM"), shutil.which("edda"), os.fspath(built)):
        if candidate and os.path.isfile(candidate):
            return candidate
    raise RuntimeError("edda.study() needs the program edda: put it on the PATH, or say where it is in EDDA_PROGRAM")


def _error(out: str, err: str) -> Exception:
    faults = []
    for line in out.splitlines():
        try:
            record = json.loads(line)
        except ValueError:
            continue
        if record.get("event") == "fault":
            faults.append(Fault(*(record[key] for key in ("key", "problem", "remedy", "file", "line", "column"))))
    return ModelError(faults) if faults else RuntimeError(f"edda study ended early: {(err or out).strip()}")
