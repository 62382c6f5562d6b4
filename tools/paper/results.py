"""A results folder, read once: summary, history, monitors."""
import csv
import dataclasses
import json

import numpy as np

BUSY = 0.95   # processor seconds over wall seconds below which something else kept the processor from a run,
START = 0.02  # s: unless they differ by no more than starting a process takes


@dataclasses.dataclass
class Results:
    """What one run left behind. `history` maps a column's name to its values, one per row."""

    name: str
    summary: dict
    history: dict
    wall: float = 0.0       # s, of the whole process
    processor: float = 0.0  # s, of the whole process
    peak: int = 0           # bytes

    @property
    def completed(self):
        return self.summary["status"] == "completed"

    @property
    def blocks(self):
        return self.summary["blocks"]

    @property
    def steps(self):
        return self.summary["steps"]

    @property
    def time(self):
        return self.history["time"]

    @property
    def mean_step(self):
        return self.summary["time_step"]["mean"]

    @property
    def disturbed(self):
        """Whether something else kept the processor from this run."""
        return self.processor < min(BUSY * self.wall, self.wall - START)

    @property
    def stepping(self):
        """Wall seconds of the steps alone: without cutting, reading and writing. Of a run that was disturbed, the
        processor's: the same but for the time in which it had to wait."""
        seconds = self.summary["wall_seconds"]
        share = self.processor / self.wall if self.disturbed else 1.0
        return share * (seconds["total"] - seconds["cut"] - seconds["output"])

    @property
    def per_second(self):
        """Wall seconds per simulated second."""
        return self.stepping / self.summary["time"]

    def monitor(self, name):
        """Displacement of a monitor, [rows, 2], m."""
        return np.column_stack([self.history[name + ".ux"], self.history[name + ".uy"]])

    def displacements(self):
        """Of all monitors, [rows, monitors, 2], m."""
        names = [column[:-3] for column in self.history if column.endswith(".ux")]
        return np.stack([self.monitor(name) for name in names], axis=1)

    def at(self, times):
        """Displacements of all monitors at other times, linear between rows."""
        mine = self.displacements()
        flat = mine.reshape(len(self.time), -1)
        columns = [np.interp(times, self.time, flat[:, k]) for k in range(flat.shape[1])]
        return np.stack(columns, axis=1).reshape(len(times), *mine.shape[1:])


def read(folder, name):
    """The results in `folder`, a pathlib.Path."""
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    with open(folder / "history.csv", encoding="utf-8") as file:
        columns = next(csv.reader(file))
        rows = np.loadtxt(file, delimiter=",", ndmin=2)
    return Results(name, summary, {column: rows[:, k] for k, column in enumerate(columns)})


def largest_difference(run, reference):
    """Largest difference of any monitor at any row of `run`, over the reference's largest displacement."""
    exact = reference.at(run.time)
    apart = np.linalg.norm(run.displacements() - exact, axis=2)
    return apart.max() / np.linalg.norm(exact, axis=2).max()


def mean_difference(run, reference):
    """Root mean square of the difference over monitors and rows, over that of the reference."""
    exact = reference.at(run.time)
    return float(np.sqrt(((run.displacements() - exact) ** 2).sum() / (exact ** 2).sum()))
