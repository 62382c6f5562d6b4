"""Runs the program on models given as text, and reads what it leaves."""
import concurrent.futures
import itertools
import pathlib
import re
import shutil
import subprocess
import sys

from paper import results

LONGEST_RUN = 1800   # s; a run that takes longer is ended, and has failed
LONG = 30.0          # s: a timed run that was disturbed is made again unless it took this long
SHORT = 2.0          # s: timed runs shorter than this are made TRIES times in any case
TRIES = 3
AT_A_TIME = 2


class RunFailed(Exception):
    """A run that should have completed did not; the text says which and why."""


class Program:
    """The executable and a folder for its runs. Results are read and removed at once."""

    def __init__(self, executable, folder):
        self.executable = pathlib.Path(executable).resolve()
        self.folder = pathlib.Path(folder).resolve()
        self.folder.mkdir(parents=True, exist_ok=True)
        self.numbers = itertools.count()
        self.runs = self.timed = self.disturbed = 0

    def quiet(self):
        """How far the times may be trusted, in a sentence."""
        if self.disturbed == 0:
            return f"Nothing else on the machine disturbed any of the {self.timed} timed runs."
        return (f"Of the {self.timed} timed runs {self.disturbed} were disturbed by other load on the machine; for those,"
                " processor seconds are given.")

    def run(self, name, model, sets=(), timed=False, may_fail=False):
        """Runs `model` (text) with `--set` overrides and one thread.

        timed: made again where it is short, or something else kept the processor busy; the quickest counts.
        may_fail: a run that diverges is a result; one that is refused is None.
        """
        best = None
        for _ in range(TRIES if timed else 1):
            found = self._once(name, model, sets, may_fail)
            if found is None:
                return None
            if best is None or found.stepping < best.stepping:
                best = found
            if found.wall > LONG or (found.wall > SHORT and not found.disturbed):
                break
        self.timed += timed
        self.disturbed += timed and best.disturbed
        return best

    def run_all(self, jobs):
        """Runs several, two at a time; each job is the arguments of run() as a dict. Their results in order."""
        with concurrent.futures.ThreadPoolExecutor(AT_A_TIME) as pool:
            return list(pool.map(lambda job: self.run(**job), jobs))

    def check(self, name, model, sets=()):
        """What `edda check` says: blocks, and the critical step in s (None for the implicit method)."""
        file = self._write(name, model)
        answer = subprocess.run([str(self.executable), "check", str(file), *_sets(sets)], capture_output=True,
                                text=True, check=False, timeout=LONGEST_RUN)
        file.unlink()
        if answer.returncode != 0:
            raise RunFailed(f"check of {name}: {answer.stderr.strip()}")
        step = re.search(r"^critical step\s+(\S+) s", answer.stdout, re.M)
        blocks = re.search(r"^blocks\s+(\d+)", answer.stdout, re.M)
        return {"blocks": int(blocks.group(1)), "critical_step": float(step.group(1)) if step else None}

    def refusal(self, name, model, sets=()):
        """The fault for which a model is refused, or None where it is taken."""
        file = self._write(name, model)
        answer = subprocess.run([str(self.executable), "check", str(file), *_sets(sets)], capture_output=True,
                                text=True, check=False, timeout=LONGEST_RUN)
        file.unlink()
        return None if answer.returncode == 0 else answer.stderr.strip()

    def _write(self, name, model):
        file = self.folder / f"{name}-{next(self.numbers)}.toml"
        file.write_text(model, encoding="utf-8")
        return file

    def _once(self, name, model, sets, may_fail):
        file = self._write(name, model)
        folder = file.with_suffix("")
        command = [str(self.executable), "run", str(file), "-o", str(folder), "--threads", "1", "--quiet",
                   *_sets(sets)]
        measure = [sys.executable, "-I", "-S", str(pathlib.Path(__file__).with_name("measure.py")), str(LONGEST_RUN)]
        answer = subprocess.run(measure + command, capture_output=True, text=True, check=True)
        self.runs += 1
        code, wall, processor, peak = answer.stdout.split()
        try:
            if not (folder / "summary.json").exists():
                if may_fail:
                    return None
                raise RunFailed(f"{name}: exit code {code}: {answer.stderr.strip()}")
            found = results.read(folder, name)
        finally:
            shutil.rmtree(folder, ignore_errors=True)
            file.unlink()
        if not found.completed and not may_fail:
            raise RunFailed(f"{name}: {found.summary['message']}")
        found.wall, found.processor, found.peak = float(wall), float(processor), int(peak)
        return found


def _sets(sets):
    # The paper's blocks have one strain each.
    return [word for item in ("deformation=uniform", *sets) for word in ("--set", item)]
