"""edda: how jointed rock moves, by explicit discontinuous deformation analysis.

    >>> import edda
    >>> model = edda.load("ramp.toml", {"solver.duration": 0.05})
    >>> simulation = edda.Simulation(model, results="ramp")
    >>> simulation.run().status
    'completed'
    >>> edda.Results("ramp").history["centre.uy"][-1] < 0.0
    True

Units are SI, angles in rad. Stresses of blocks are positive in tension, normal forces and normal stresses of joints in
compression. nb is the number of blocks.
"""

from __future__ import annotations

import contextlib
import os
import warnings
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Union

from . import _edda, _toml
from ._edda import (
    Cut,
    CutBlock,
    ErrorBar,
    FactorOfSafety,
    FosTrial,
    Ledger,
    LimitJoint,
    LimitLoad,
    Model,
    ModelCheck,
    MonitorReading,
    Outcome,
    Progress,
    Simulation,
    Verification,
    set_threads,
    version,
)
from ._errors import Fault, ModelError, ModelWarning
from .plotting import plot_blocks, plot_history
from .results import Frame, Results
from .studies import Study, study

__all__ = [
    "Cut",
    "CutBlock",
    "ErrorBar",
    "FactorOfSafety",
    "Fault",
    "FosTrial",
    "Frame",
    "Ledger",
    "LimitJoint",
    "LimitLoad",
    "Model",
    "ModelCheck",
    "ModelError",
    "ModelWarning",
    "MonitorReading",
    "Outcome",
    "Progress",
    "Results",
    "Simulation",
    "Study",
    "Verification",
    "check",
    "fos",
    "limit",
    "load",
    "parse",
    "plot_blocks",
    "plot_history",
    "run",
    "set_threads",
    "study",
    "verify",
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
    that ends badly is no error: Outcome.status states it, and Outcome.at_rest whether the model is in equilibrium.
    A warning about the model is a ModelWarning of Python's module warnings, which shows each once.
    """
    model = _loaded(model, overrides)
    with _keys_named(overrides):
        simulation = Simulation(model, results=results)
    for text in simulation.warnings:
        warnings.warn(text, ModelWarning, stacklevel=2)
    return simulation.run()


def check(model: Model | Source, overrides: Overrides = None) -> ModelCheck:
    """What `edda check` reports about a model: blocks, steps to expect, warnings.

    model and overrides: as of run(). It makes a few steps, of which nothing is kept. Raises ModelError for a model that
    cannot be computed. The warnings alone are Model.warnings.
    """
    model = _loaded(model, overrides)
    with _keys_named(overrides):
        return _edda.check(model)


def fos(model: Model | Source, overrides: Overrides = None) -> FactorOfSafety:
    """The factor of safety, as `edda fos` finds it, as [fos] of the model defines it.

    model and overrides: as of run(). Nothing is written. FactorOfSafety.factor is None where all factors tried hold, or
    all fail: status tells. Ctrl-C ends it. Raises ModelError for a model that cannot be computed.
    """
    model = _loaded(model, overrides)
    with _keys_named(overrides):
        return _edda.fos(model)


def limit(model: Model | Source, overrides: Overrides = None) -> LimitLoad:
    """The limit load of the blocks, taken as rigid, as `edda limit` finds it.

    model and overrides: as of run(); [fos] of the model says what is varied. LimitLoad.limit is None where nothing moves the
    blocks, or they have no equilibrium: status tells. Raises ModelError for a model that cannot be computed.
    """
    model = _loaded(model, overrides)
    with _keys_named(overrides):
        return _edda.limit(model)


def verify(model: Model | Source, overrides: Overrides = None) -> Verification:
    """Error bars of the model's monitors, as `edda verify` finds them, by four runs.

    model and overrides: as of run(). Ctrl-C ends it. Raises ModelError for a model that cannot be computed or has no
    monitors.
    """
    model = _loaded(model, overrides)
    with _keys_named(overrides):
        return _edda.verify(model)


def _loaded(model: Model | Source, overrides: Overrides) -> Model:
    if not isinstance(model, Model):
        return load(model, overrides)
    if overrides:
        raise TypeError("overrides change a model when it is loaded: give them to edda.load()")
    return model


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
