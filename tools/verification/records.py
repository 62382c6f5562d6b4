"""What the tests recorded (tests/verification/record.hpp), read back."""
import dataclasses
import json
import math
import re

import numpy as np


@dataclasses.dataclass(frozen=True)
class Check:
    """A number and the bound that its test asserts. exact: None where there is but a limit."""

    row: int
    which: str
    what: str
    unit: str
    test: str
    file: str
    computed: float
    exact: float
    error: float
    low: float
    high: float

    @property
    def holds(self):
        return self.low <= self.error <= self.high

    @property
    def part(self):
        """How much of its bound is used up, 1 being all of it."""
        if self.error == 0.0 and self.low <= 0.0 <= self.high:
            return 0.0
        if math.isinf(self.high):
            return self.low / self.error if self.error > 0.0 else math.inf
        bound = self.high if self.error > 0.0 else self.low
        return self.error / bound if bound != 0.0 else math.inf


class Records:
    """All that is in a folder of .jsonl files."""

    def __init__(self, folder):
        self.checks, self.models, self.series = [], [], []
        for file in sorted(folder.glob("*.jsonl")):
            for line in file.read_text(encoding="utf-8").splitlines():
                self._take(json.loads(line))
        for kept in (self.checks, self.models):
            kept.sort(key=lambda item: "implicit" in _which(item))

    def _take(self, line):
        if line["kind"] == "check":
            self.checks.append(_check(line))
        elif line["kind"] == "model":
            self.models.append(line)
        else:
            lines = np.array(line["lines"], dtype=float).reshape(-1, len(line["columns"]))
            self.series.append((line["row"], line["which"], dict(zip(line["columns"], lines.T))))

    def checks_of(self, row):
        return [check for check in self.checks if check.row == row]

    def models_of(self, row):
        return [model for model in self.models if model["row"] == row]

    def model(self, row, which):
        """The one recorded under this name."""
        return next(model for model in self.models_of(row) if model["which"] == which)

    def series_of(self, row, pattern=""):
        """{name: {column: values}} of those whose name matches."""
        return {which: columns for of, which, columns in self.series if of == row and re.search(pattern, which)}


def _which(item):
    return item.which if isinstance(item, Check) else item["which"]


def _check(line):
    """Numbers that JSON cannot say are null: none where something was computed, infinity in bounds."""
    def number(key, instead):
        return instead if line[key] is None else line[key]

    exact = line["exact"] if line["measure"] == "relative" else None
    return Check(line["row"], line["which"], line["what"], line["unit"], plain_name(line["test"]), place(line["file"]),
                 number("computed", math.nan), exact, number("error", math.nan), number("low", -math.inf),
                 number("high", math.inf))


def plain_name(test):
    """A test's name without what GoogleTest adds for its parameters."""
    suite, _, name = test.rpartition(".")
    return f"{suite.split('/')[-1]}.{name.split('/')[0]}" if suite else name


def place(file):
    """A source's path from the repository's root on."""
    return "tests/" + file.split("/tests/")[-1] if "/tests/" in file else file
