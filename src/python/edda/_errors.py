"""Faults in what a user gives."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from typing import NamedTuple


class Fault(NamedTuple):
    """One thing wrong with what was given."""

    key: str  #: dotted path in the model ("block.slider.polygon"), or the function called
    problem: str  #: what is wrong
    remedy: str  #: what to do
    file: str = ""  #: "--set" for an override (line = its number, from 1), overrides["KEY"] of a dict; empty for a dict
    line: int = 0  #: from 1; 0 where unknown
    column: int = 0

    def __str__(self) -> str:
        place = self.file
        if self.line > 0:
            place += f":{self.line}"
            if self.column > 0 and self.file != "--set":
                place += f":{self.column}"
        return ": ".join(part for part in (place, self.key, self.problem, self.remedy) if part)


class UnknownName(KeyError, ValueError):
    """No column, field or array of that name."""

    def __init__(self, what: str, name: str, known: Iterable[str]) -> None:
        super().__init__(what, name, list(known))

    def __str__(self) -> str:
        what, name, known = self.args
        near = difflib.get_close_matches(str(name), known, 1)
        hint = f"did you mean {near[0]!r}? " if near else ""
        return f"no {what} is called {name!r}: {hint}known are {', '.join(known) or 'none'}"


class ModelError(ValueError):
    """What was given cannot be computed: `faults` lists all that is wrong with it."""

    def __init__(self, faults: list[Fault]) -> None:
        super().__init__("\n".join(str(fault) for fault in faults))
        self.faults = list(faults)

    def __reduce__(self) -> tuple[type[ModelError], tuple[list[Fault]]]:
        return type(self), (self.faults,)


class ModelWarning(UserWarning):
    """A warning about a model, as edda check prints it."""
