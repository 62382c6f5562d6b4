"""Two builds on the same scenes, in turns, so that a machine whose speed changes from minute to minute changes both."""
import os
import statistics

from speed import scenes
from speed.programs import Ended, Running, circumstances, title_of_pair

PAIRS = 15


def median_of_pairs(before, after):
    """Median and both quartiles of the ratios of adjacent repetitions, after over before."""
    ratios = [a / b for b, a in zip(before, after)]
    if len(ratios) == 1:
        return ratios * 3
    low, middle, high = statistics.quantiles(ratios, n=4, method="inclusive")
    return middle, low, high


def in_turns(k, before, after):
    """Calls both, the one first in even turns and the other in odd ones: what comes after the kernel finds its caches."""
    if k % 2 == 0:
        first = before()
        return first, after()
    second = after()
    return before(), second


def both_numbers(before, after):
    return str(after) if before == after else f"{before}>{after}"


def ratio_of(key, before, after, form):
    """Of a number that an older program may not report."""
    return format(after[key] / before[key], form) if before.get(key) and after.get(key) else "-"


def per_block(memory, scene):
    return f"{memory['bytes'] / scene['blocks']:.0f}" if "bytes" in memory else "-"


def steps_of(given, name, times):
    """Of a repetition: all together are those that a measurement of one build makes, in shorter turns."""
    steps = scenes.steps_of(name, scenes.block_steps(given))
    return steps if given.quick else max(1, scenes.TIMES * steps // times)


class Pair:
    """One scene in both builds. Both processes are there all the time, one works while the other waits for its line."""

    def __init__(self, programs, other, name, times, steps):
        options = (name, "--wait", "--repeat", times, "--steps", steps)
        self.kernel_of = programs
        # What goes first is started last: the other has made its first steps by then.
        self.after = Running(programs.scene(*options), programs.environment)
        self.scene_after = self.after.line()
        self.before = Running(other.scene(*options), other.environment)
        self.scene_before = self.before.line()
        self.rates_before, self.rates_after, self.kernel = [], [], []
        self.memory_before = self.memory_after = {}

    def measure(self, name, times, block_steps):
        columns, rows = scenes.beside(name, self.scene_after["blocks"])
        for k in range(times):
            run_before, run_after = in_turns(k, self.before.go, self.after.go)
            self.rates_before.append(scenes.rate(self.scene_before, run_before))
            self.rates_after.append(scenes.rate(self.scene_after, run_after))
            self.kernel.append(self.kernel_of.kernel(columns, rows, max(10, block_steps // (columns * rows))))
        self.memory_before, self.memory_after = self.before.line(), self.after.line()

    def cells(self):
        middle, low, high = median_of_pairs(self.rates_before, self.rates_after)
        faster = sum(a > b for b, a in zip(self.rates_before, self.rates_after))
        kernel = statistics.median(self.kernel)
        return (both_numbers(self.scene_before["blocks"], self.scene_after["blocks"]),
                f"{statistics.median(self.rates_before):.3f}", f"{statistics.median(self.rates_after):.3f}", f"{middle:.3f}",
                f"{low:.3f}-{high:.3f}", f"{faster}/{len(self.rates_after)}", f"{kernel:.2f}",
                f"{statistics.median(self.rates_after) / kernel:.3f}",
                ratio_of("step", self.scene_before, self.scene_after, ".3f"),
                per_block(self.memory_before, self.scene_before), per_block(self.memory_after, self.scene_after))


def row(given, programs, other, name, times):
    """Of the table. A scene that ends early, as a heap does that has flowed for too long, counts with the pairs before."""
    steps = steps_of(given, name, times)
    pair = Pair(programs, other, name, times, steps)
    why = ""
    try:
        pair.measure(name, times, steps * scenes.blocks_of(name))
    except Ended as ended:
        if not pair.kernel:
            raise
        why = f"\n{'':16s} ended early: {ended}"
    return FORM.format(name, *pair.cells()) + why


HEAD = ("scene", "blocks", "before", "after", "ratio", "quartiles", "faster", "kernel", "of it", "step", "bytes before",
        "after")
FORM = "{:16s} {:>9s} {:>8s} {:>8s} {:>6s} {:>13s} {:>6s} {:>7s} {:>6s} {:>6s} {:>12s} {:>6s}"


def speed(given, programs, other):
    load = os.getloadavg()[0]
    times = scenes.repetitions(given, PAIRS)
    print(title_of_pair(programs, other))
    print(f"on {circumstances(given.threads, load)}; {times} pair{'s' * (times > 1)}\n"
          "Rates before and after, and of the kernel, in million block-steps/s. Ratio: of the rates, after over before, median "
          "and\nquartiles of all pairs; faster: in how many of them; step: time step after over before; bytes per block.")
    print(FORM.format(*HEAD), flush=True)
    for name in scenes.names(given):
        print(row(given, programs, other, name, times), flush=True)
