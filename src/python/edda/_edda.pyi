"""The compiled part of edda. nb: number of blocks, nv: number of their vertices; SI units."""

import os
from collections.abc import Callable, Mapping
from typing import Any, Literal, Optional, Union

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]
_Nodes = tuple[_Floats, _Floats, _Floats]
_Point = tuple[float, float]
_Field = Literal["centroid", "displacement", "rotation", "velocity", "omega", "stress", "overstress"]

def version() -> str: ...
def set_threads(threads: int) -> None: ...

class Model:
    """A checked model; never changes."""

    @staticmethod
    def read(path: Union[str, os.PathLike[str]], overrides: list[str] = []) -> Model:
        """Reads a TOML file; overrides as of --set, "solver.duration=0.2"."""
    @staticmethod
    def parse(toml: str, name: str = "model", overrides: list[str] = []) -> Model:
        """The same of a text; faults call it `name`."""
    @property
    def title(self) -> str: ...
    @property
    def file(self) -> str: ...
    @property
    def duration(self) -> float:
        """s"""
    @property
    def materials(self) -> list[str]: ...
    @property
    def joints(self) -> list[str]: ...
    @property
    def openings(self) -> list[str]: ...
    @property
    def stages(self) -> list[str]: ...
    def to_toml(self) -> str:
        """The model with every key and default filled in."""
    def cut(self) -> Cut:
        """Its blocks as polygons."""

class CutBlock:
    """One block as cut."""

    @property
    def name(self) -> str: ...
    @property
    def material(self) -> int:
        """Row of Model.materials, -1: none."""
    @property
    def fixed(self) -> bool: ...
    @property
    def area(self) -> float:
        """m2"""
    @property
    def rings(self) -> list[_Floats]:
        """Arrays (n, 2), m: the outer ring counter-clockwise, then holes, clockwise."""
    @property
    def joints(self) -> list[NDArray[np.int32]]:
        """Arrays (n,): row of Model.joints of the edge from each vertex to the next, -1: none."""

class Cut:
    """The model's blocks, and what the cut did to its lines."""

    @property
    def blocks(self) -> list[CutBlock]: ...
    @property
    def trimmed(self) -> int: ...
    @property
    def merged(self) -> int: ...
    @property
    def smallest_area(self) -> float:
        """m2"""
    @property
    def smallest_edge(self) -> float:
        """m"""
    @property
    def smallest_angle(self) -> float:
        """degrees"""
    @property
    def notes(self) -> list[str]: ...

class Outcome:
    """How a run ended."""

    @property
    def status(self) -> str:
        """completed, equilibrium, collapsed, interrupted or failed."""
    @property
    def message(self) -> str: ...
    @property
    def time(self) -> float:
        """s"""
    @property
    def steps(self) -> int: ...
    @property
    def contacts(self) -> int:
        """Closed at the end."""
    @property
    def drift(self) -> float:
        """Of the energy: the largest in size of all rows of the history, not the last one's."""
    @property
    def wall_seconds(self) -> float: ...

class Progress:
    """How far a run has come."""

    @property
    def fraction(self) -> float: ...
    @property
    def time(self) -> float:
        """s"""
    @property
    def steps(self) -> int: ...
    @property
    def rate(self) -> float:
        """Steps per second of wall time."""
    @property
    def seconds_left(self) -> float:
        """s of wall time; -1 while unknown."""
    @property
    def kinetic(self) -> float:
        """J"""
    @property
    def largest_overlap(self) -> float:
        """m"""
    @property
    def largest_velocity(self) -> float:
        """m/s, of the blocks' centroids."""
    @property
    def stage(self) -> int:
        """In hand, from 0."""
    @property
    def stages(self) -> int:
        """Of the model; 1 where it has none."""
    @property
    def stage_name(self) -> str:
        """Empty where it has none."""

class Ledger:
    """Energies since t = 0, J; drift is a ratio."""

    @property
    def kinetic(self) -> float: ...
    @property
    def strain(self) -> float: ...
    @property
    def contact(self) -> float: ...
    @property
    def gravity(self) -> float: ...
    @property
    def friction(self) -> float: ...
    @property
    def damping(self) -> float: ...
    @property
    def fracture(self) -> float: ...
    @property
    def external(self) -> float: ...
    @property
    def step_change(self) -> float: ...
    @property
    def drift(self) -> float: ...

class MonitorReading:
    """A material point and its block: m, m/s, Pa."""

    @property
    def ux(self) -> float: ...
    @property
    def uy(self) -> float: ...
    @property
    def vx(self) -> float: ...
    @property
    def vy(self) -> float: ...
    @property
    def sxx(self) -> float: ...
    @property
    def syy(self) -> float: ...
    @property
    def sxy(self) -> float: ...

class Simulation:
    """A model in motion. run(), step() and advance_to() are one run, in parts or at once."""

    def __init__(
        self,
        model: Union[Model, str, os.PathLike[str], Mapping[str, Any]],
        results: Union[str, os.PathLike[str], None] = None,
        resume: bool = False,
        from_stage: Optional[int] = None,
        progress: Optional[Callable[[Progress], Optional[bool]]] = None,
        progress_every: float = 0.2,
        warn: Optional[Callable[[str], None]] = None,
    ) -> None:
        """Cuts, builds and checks; nothing is written before the first step.

        model: a Model, or what edda.load() takes. results: folder, as of `edda run -o`.
        resume, from_stage: go on from its checkpoint, or from that of the end of a stage.
        progress: called about every progress_every s of wall time and at the end, when the run is
        over and can no longer be changed; False stops the run.
        """
    def run(self) -> Outcome:
        """To the end, through all stages."""
    def step(self, steps: int = 1) -> bool:
        """So many steps; False: the run is over."""
    def advance_to(self, time: float) -> bool:
        """To the first step at or past a time (s); False: the run is over."""
    def finish(self) -> Outcome:
        """Ends the run where it stands and writes what is due."""
    def pause(self) -> None:
        """From any thread: the call in hand returns."""
    def stop(self) -> None:
        """From any thread: the run ends as interrupted."""
    def every(self, steps: int, action: Callable[[Simulation], object]) -> int:
        """Calls action(simulation) after every so many steps; returns a number for forget()."""
    def forget(self, callback: int) -> None: ...
    @property
    def model(self) -> Model: ...
    @property
    def time(self) -> float:
        """s"""
    @property
    def steps(self) -> int: ...
    @property
    def time_step(self) -> float:
        """s, in force; 0 before the first step."""
    @property
    def critical_step(self) -> float:
        """s"""
    @property
    def governed_by(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def stage(self) -> int:
        """In hand, from 0."""
    @property
    def over(self) -> bool: ...
    @property
    def ledger(self) -> Ledger: ...
    @property
    def unbalanced(self) -> float: ...
    @property
    def block_count(self) -> int:
        """nb"""
    @property
    def vertex_count(self) -> int:
        """nv"""
    @property
    def monitors(self) -> list[str]: ...
    @property
    def origin(self) -> _Point:
        """m: node positions count from here."""
    @property
    def area(self) -> _Floats:
        """(nb,) m2 at the start; a view, not to be written to."""
    @property
    def mass(self) -> _Floats:
        """(nb,) kg; a view, not to be written to."""
    @property
    def material(self) -> NDArray[np.int32]:
        """(nb,) row of Model.materials, -1: none; a view, not to be written to."""
    @property
    def fixed(self) -> NDArray[np.uint8]:
        """(nb,) 1: held; a view, not to be written to."""
    @property
    def alive(self) -> NDArray[np.uint8]:
        """(nb,) 0: taken out; a view, not to be written to."""
    @property
    def node_x(self) -> _Nodes:
        """Three views (nb,), m from origin, not to be written to."""
    @property
    def node_y(self) -> _Nodes:
        """Three views (nb,), m from origin, not to be written to."""
    @property
    def node_vx(self) -> _Nodes:
        """Three views (nb,) to read and write, m/s, half a step before the positions.

        What is written for blocks that are not free is put back by the next call.
        """
    @property
    def node_vy(self) -> _Nodes:
        """Three views (nb,) to read and write, m/s, half a step before the positions."""
    def field(self, name: _Field, out: Optional[_Floats] = None) -> _Floats:
        """Of all blocks, into `out` where one is given.

        centroid, displacement (m), velocity (m/s): (nb, 2); stress (Pa): (nb, 4), xx yy zz xy;
        rotation (rad), omega (rad/s), overstress: (nb,).
        """
    def polygons(self) -> list[list[_Floats]]:
        """Per block its rings, arrays (n, 2), m, as they are now."""
    def contacts(self) -> np.ndarray[Any, np.dtype[np.void]]:
        """A structured array, as joints.csv.

        block_i, block_j, joint (row of Model.joints, -1: glued), state (0 open, 1 stick, 2 slide,
        3 bonded), x, y (m), normal_force, shear_force (N), opening, slip (m), mobilised,
        ever_slipped, ever_opened.
        """
    def name(self, block: int) -> str:
        """Empty where it has none; IndexError where there is no such block."""
    def block_called(self, name: str) -> int: ...
    def add_monitor(self, name: str, point: _Point) -> None:
        """Follows the material point at (x, y) of the start, m."""
    def read(self, monitor: str) -> MonitorReading: ...
    def set_velocity(self, block: Union[int, str], velocity: _Point, omega: float = 0.0) -> None:
        """(vx, vy) of its centroid, m/s, and rate of turn, rad/s."""
    def set_damping(self, mass: float = 0.0, local: float = 0.0, contact: float = 0.0) -> None:
        """1/s; a fraction; a fraction of critical."""
    def set_strength_factor(self, factor: float, joint: Optional[str] = None) -> None:
        """Strength of all joints, or of one, as the model gives it, divided by the factor."""
    def excavate(self, openings: list[str]) -> None: ...
    def relax(self, opening: str, part: float) -> None: ...
    def switch_over(self, deactivate: list[str] = [], activate: list[str] = []) -> None: ...
    def install(self, bolts: list[str]) -> None: ...
    def reset_displacements(self) -> None: ...
