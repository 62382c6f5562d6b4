"""All of examples/ as `edda run` runs them: from reading the model to the summary, rows and frames included."""
import dataclasses
import json
import os
import pathlib
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time

from speed.compare import both_numbers, in_turns, median_of_pairs
from speed.programs import ROOT, circumstances, commit, title_of_pair

LONGEST = 20.0  # processor seconds of a run
QUICKEST = 1.0  # the same of --quick
PAIRS = 9       # most of an example
LOOK = 0.05     # s between two looks at a run


@dataclasses.dataclass
class Run:
    """What a run came to, or why it did not."""

    blocks: int = 0
    steps: int = 0
    time: float = 0.0      # s, simulated
    part: float = 0.0      # of the duration
    status: str = "refused"
    processor: float = 0.0  # s
    wall: float = 0.0       # s
    stepping: float = 0.0   # s of the wall time
    trouble: str = ""

    def stopped(self):
        return self.status == "interrupted"

    def measured(self):
        return self.steps > 0 and not self.trouble

    def per_block_step(self, threads):
        """ns, by the clock that the number of threads asks for."""
        return 1e9 * (self.processor if threads == 1 else self.wall) / (self.blocks * self.steps)


def processor_seconds(pid):
    """Of a process so far."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def events_in(file):
    """Lines of a run so far, but for one that is being written."""
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines(keepends=True) if line.endswith("}\n")]


def simulated(file):
    """How far the run has come, s."""
    return max((e["time"] for e in events_in(file) if e["event"] == "progress"), default=0.0)


def watch(pid, done, file, most, until):
    """Interrupts a run after so many processor seconds or, where `until` is given, once it has come so far."""
    while not done.wait(LOOK):
        try:
            if processor_seconds(pid) >= most or (until is not None and simulated(file) >= until):
                os.kill(pid, signal.SIGINT)
                return
        except (OSError, IndexError):  # it has just ended
            return


def run(programs, model, most, until=None):
    """Runs the model in a folder of its own. Stopped as Ctrl-C would: without loss, and with a summary."""
    with tempfile.TemporaryDirectory(prefix="bench-") as name:
        folder, out = pathlib.Path(name) / "results", pathlib.Path(name) / "events"
        with out.open("wb") as file:
            start = time.monotonic()
            process = subprocess.Popen(programs.run(model, folder), env=programs.environment, stdin=subprocess.DEVNULL,
                                       stdout=file, stderr=subprocess.STDOUT)
        done = threading.Event()
        watcher = threading.Thread(target=watch, args=(process.pid, done, out, most, until))
        watcher.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
            wall = time.monotonic() - start
        finally:
            done.set()
            watcher.join()
        process.returncode = os.waitstatus_to_exitcode(status)
        return what_came_of(out, folder / "summary.json", usage.ru_utime + usage.ru_stime, wall)


def first_line(file):
    return file.read_text(encoding="utf-8", errors="replace").strip().partition("\n")[0]


def what_came_of(out, summary, processor, wall):
    try:
        events = events_in(out)
    except ValueError:
        return Run(trouble=first_line(out))
    found = {e["event"]: e for e in events}  # the last of each
    end = found.get("end", {})
    if "steps" not in end:
        fault = found.get("fault", {})
        return Run(trouble=fault.get("problem") or end.get("message") or first_line(out) or "ended before its first step")
    seconds = json.loads(summary.read_text(encoding="utf-8")).get("wall_seconds", {})
    return Run(blocks=found["start"]["blocks"], steps=end["steps"], time=end["time"],
               part=found.get("progress", {}).get("fraction", 0.0), status=end["status"], processor=processor, wall=wall,
               stepping=sum(seconds.get(key, 0.0) for key in ("search", "forces", "integrate")),
               trouble=end["message"] if end["status"] == "failed" else "")


def pair(k, programs, other, model, most):
    """Both builds; where the one that goes first is stopped, the other is stopped when it has come as far."""
    first = []

    def made_by(which):
        def make():
            until = first[0].time if first and first[0].stopped() else None
            found = run(which, model, most if until is None else 5.0 * most, until)
            first.append(found)
            return found
        return make
    return in_turns(k, made_by(other), made_by(programs))


def models(given):
    names = given.scene or sorted(p.stem for p in (ROOT / "examples").glob("*.toml"))
    found = [ROOT / "examples" / f"{name}.toml" for name in names]
    for model in found:
        if not model.is_file():
            sys.exit(f"tools/bench: {model}: no such example")
    return found


def part(*runs):
    """Of its duration that a run has made, or two of them; a star where one was stopped."""
    made = both_numbers(round(100 * runs[0].part), round(100 * runs[-1].part))
    return f"{made} %" + ("*" if any(r.stopped() for r in runs) else " ")


RULE = """\
Each run whole: reading, cutting, steps, rows, frames, tables. ns: per block and step, of {clock}. *: a run is
interrupted after {most:g} s of processor time (its checkpoint is part of them) and counts as far as it came{pairs}."""
RULE_OF_PAIRS = """;
the build that goes second is then interrupted when it has come as far, looked at once a second. Every example is run in
pairs, {pairs} at most, until one build has taken {most:g} s of processor time; figures are medians. Ratio: of the ns before
over after, median and quartiles of all pairs: above 1 the build after is faster"""


def rule(given, most, pairs=None):
    clock = "processor time" if given.threads == 1 else "wall time"
    more = RULE_OF_PAIRS.format(pairs=pairs, most=most) if pairs else ""
    return RULE.format(clock=clock, most=most, pairs=more)


def alone(given, programs):
    most = given.seconds or (QUICKEST if given.quick else LONGEST)
    load = os.getloadavg()[0]
    print(f"{commit()} on {circumstances(given.threads, load)}")
    print(rule(given, most))
    form = "{:16s} {:>6s} {:>9s} {:>7s} {:>8s} {:>8s} {:>9s} {:>8s}  {}"
    print(form.format("example", "blocks", "steps", "made", "CPU s", "wall s", "ns", "stepping", "ended"), flush=True)
    every = []
    for model in models(given):
        runs = [run(programs, model, most) for _ in range(given.repeat or 1)]
        found = sorted(runs, key=lambda r: r.processor)[len(runs) // 2]
        if not found.measured():
            print(f"{model.stem:16s} {found.trouble}", flush=True)
            continue
        every.append(found)
        print(form.format(model.stem, str(found.blocks), str(found.steps), part(found), f"{found.processor:.2f}",
                          f"{found.wall:.2f}", f"{found.per_block_step(given.threads):.0f}",
                          f"{100 * found.stepping / found.wall:.0f} %", found.status), flush=True)
    print(form.format("all", "", "", "", f"{sum(r.processor for r in every):.2f}", f"{sum(r.wall for r in every):.2f}", "",
                      "", "").rstrip())


def pairs_of(given, programs, other, model, most, pairs):
    """Runs before and after; ends early where a run has nothing to measure."""
    before, after = [], []
    for k in range(pairs):
        one, two = pair(k, programs, other, model, most)
        before.append(one)
        after.append(two)
        spent = max(sum(r.processor for r in before), sum(r.processor for r in after))
        if not one.measured() or not two.measured() or (spent >= most and not given.repeat):
            break
    return before, after


PAIR_FORM = "{:16s} {:>6s} {:>9s} {:>15s} {:>13s} {:>13s} {:>13s} {:>6s} {:>13s} {:>5s}"


def row_of_pairs(name, before, after, threads):
    def medians(value, form):
        return " > ".join(format(statistics.median(value(r) for r in runs), form) for runs in (before, after))

    def speeds(runs):
        return [1.0 / r.per_block_step(threads) for r in runs]
    middle, low, high = median_of_pairs(speeds(before), speeds(after))
    steps = both_numbers(*(round(statistics.median(r.steps for r in runs)) for runs in (before, after)))
    return PAIR_FORM.format(
        name, both_numbers(before[0].blocks, after[0].blocks), part(*before, *after), steps,
        medians(lambda r: r.processor, ".2f"), medians(lambda r: r.wall, ".2f"),
        medians(lambda r: r.per_block_step(threads), ".0f"), f"{middle:.3f}",
        f"{low:.3f}-{high:.3f}" if len(before) > 1 else "-", str(len(before)))


def compared(given, programs, other):
    most, pairs = given.seconds or (QUICKEST if given.quick else LONGEST), given.repeat or (1 if given.quick else PAIRS)
    load = os.getloadavg()[0]
    print(title_of_pair(programs, other))
    print(f"on {circumstances(given.threads, load)}")
    print(rule(given, most, pairs))
    print(PAIR_FORM.format("example", "blocks", "made", "steps", "CPU s", "wall s", "ns", "ratio", "quartiles", "pairs"),
          flush=True)
    for model in models(given):
        before, after = pairs_of(given, programs, other, model, most, pairs)
        missing = [f"{which}: {runs[-1].trouble}" for which, runs in (("before", before), ("after", after))
                   if not runs[-1].measured()]
        print(f"{model.stem:16s} {'; '.join(missing)}" if missing else
              row_of_pairs(model.stem, before, after, given.threads), flush=True)


def examples(given, programs, other):
    if other:
        compared(given, programs, other)
    else:
        alone(given, programs)
