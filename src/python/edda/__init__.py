"""edda: how jointed rock moves, by explicit discontinuous deformation analysis.

    >>> import edda
    >>> model = edda.load("ramp.toml", {"solver.duration": 0.05})
    >>> simulation = edda.Simulation(model, results="ramp")
    >>> simulation.run().status
    'completed'
    >>> edda.Results("ramp").history["centre.uy"][-1] < 0.0
    True

Units are SI, angles in rad, stresses positive in tension; nb is the number of blocks.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Union

from . import _toml
from ._edda import (
    Cut,
    CutBlock,
    Ledger,
    Model,
    MonitorReading,
    Outcome,
    Progress,
    Simulation,
    set_threads,
    version,
)
from ._errors import Fault, ModelError
from .plotting import plot_blocks, plot_history
from .results import Frame, Results

__all__ = [
    "Cut",
    "CutBlock",
    "Fault",
    "Frame",
    "Ledger",
    "Model",
    "ModelError",
    "MonitorReading",
    "Outcome",
    "Progress",
    "Results",
    "Simulation",
    "load",
    "parse",
    "plot_blocks",
    "plot_history",
    "run",
    "set_threads",
    "version",
]
__version__ = version()

for _name in __all__:  # where users find them, not where they are written
    if isinstance(globals().get(_name), type):
        globals()[_name].__module__ = __name__

Source = Union[str, "os.PathLike[str]", Mapping[str, Any]]
Overrides = Union[Mapping[str, Any], Iterable[str], None]


def load(source: Source, overrides: Overrides = None) -> Model:
    """A model from a TOML file, or from a dict with the same keys.

    `overrides` is a dict {"solver.duration": 0.2} or a list of texts as after --set. Raises
    ModelError with all faults at once.
    """
    settings = _settings(overrides)
    with _keys_named(overrides):
        if not isinstance(source, Mapping):
            return Model.read(source, settings)
        text = _toml.dumps(source)
        try:
            return Model.parse(text, "dict", settings)
        except ModelError as error:
            raise ModelError([_placeless(fault) for fault in error.faults]) from None


def parse(toml: str, overrides: Overrides = None, name: str = "model") -> Model:
    """A model from TOML text; faults call it `name`."""
    settings = _settings(overrides)
    with _keys_named(overrides):
        return Model.parse(toml, name, settings)


def run(
    model: Model | Source,
    results: str | os.PathLike[str] | None = None,
    overrides: Overrides = None,
) -> Outcome:
    """Runs a model to its end.

    model: a Model, or what load() takes, with overrides as there. results: folder, as of `edda run -o`; None: no
    results are written. Raises ModelError for a model that cannot be computed and a folder that cannot be used; a run
    that ends badly is no error: Outcome.status tells.
    """
    if not isinstance(model, Model):
        model = load(model, overrides)
    elif overrides:
        raise TypeError("overrides change a model when it is loaded: give them to edda.load()")
    with _keys_named(overrides):
        simulation = Simulation(model, results=results)
    return simulation.run()


def _settings(overrides: Overrides) -> list[str]:
    if overrides is None:
        return []
    if isinstance(overrides, str):
        raise TypeError("overrides is one text: give a list of them, or a dict")
    if isinstance(overrides, Mapping):
        return [_toml.setting(key, value) for key, value in overrides.items()]
    return list(overrides)


@contextlib.contextmanager
def _keys_named(overrides: Overrides) -> Iterator[None]:
    """Faults of overrides that are a dict name its key: nobody has numbered them."""
    try:
        yield
    except ModelError as error:
        if not isinstance(overrides, Mapping):
            raise
        keys = list(overrides)
        faults = [
            fault._replace(file=f'overrides["{keys[fault.line - 1]}"]', line=0, column=0)
            if fault.file == "--set" and 0 < fault.line <= len(keys)
            else fault
            for fault in error.faults
        ]
        raise ModelError(faults) from None


def _placeless(fault: Fault) -> Fault:
    """Lines of a text that nobody has seen tell nothing."""
    return fault if fault.file == "--set" else fault._replace(file="", line=0, column=0)
