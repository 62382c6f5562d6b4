"""The compiled part of edda. nb: number of blocks, nv: number of their vertices; SI units."""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, Optional, SupportsIndex, Union

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]
_Nodes = tuple[_Floats, _Floats, _Floats]
_Point = Union[Sequence[float], NDArray[np.floating[Any]], NDArray[np.integer[Any]]]  # x, y
_Field = Literal["centroid", "displacement", "rotation", "velocity", "omega", "stress", "overstress"]

def version() -> str:
    """The version, "0.1.0"."""
def set_threads(threads: SupportsIndex) -> None:
    """Threads that simulations of this process use; results do not depend on it."""

def check(model: Model) -> ModelCheck:
    """What edda check reports about a model."""
def fos(model: Model) -> FactorOfSafety:
    """The factor of safety, as [fos] of the model defines it."""
def limit(model: Model) -> LimitLoad:
    """The limit load of the blocks, taken as rigid, of what [fos] of the model varies."""
def verify(model: Model) -> Verification:
    """The error bars of the model's monitors."""

class Model:
    """A checked model; never changes."""

    @staticmethod
    def read(path: Union[str, os.PathLike[str]], overrides: Sequence[str] = []) -> Model:
        """Reads a TOML file; overrides as of --set, "solver.duration=0.2"."""
    @staticmethod
    def parse(toml: str, name: str = "model", overrides: Sequence[str] = []) -> Model:
        """The same of a text; faults call it `name`, and paths in it count from that file."""
    @property
    def title(self) -> str:
        """As the model says."""
    @property
    def file(self) -> str:
        """Path or name that it was read from."""
    @property
    def duration(self) -> float:
        """s; 0: none is given"""
    @property
    def materials(self) -> list[str]:
        """Names, in order."""
    @property
    def joints(self) -> list[str]:
        """Names of the laws, in order."""
    @property
    def openings(self) -> list[str]:
        """Names, in order."""
    @property
    def stages(self) -> list[str]:
        """Names, in order."""
    @property
    def warnings(self) -> list[str]:
        """Warnings of edda check, a sentence each; the model is cut when they are first asked for."""
    def to_toml(self) -> str:
        """The model with every key and default filled in."""
    def cut(self) -> Cut:
        """Its blocks as polygons."""

class CutBlock:
    """One block as cut."""

    @property
    def name(self) -> str:
        """Of a [[block]], else empty."""
    @property
    def material(self) -> int:
        """Row of Model.materials, -1: none."""
    @property
    def fixed(self) -> bool:
        """Whether it is fixed."""
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
    def blocks(self) -> list[CutBlock]:
        """In the order of their ids."""
    @property
    def trimmed(self) -> int:
        """Ends of joints inside a block."""
    @property
    def merged(self) -> int:
        """Slivers joined to a neighbour."""
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
    def notes(self) -> list[str]:
        """What was imported, drawn at random, left out, and which joints cut nothing."""

class Outcome:
    """How a run ended."""

    @property
    def status(self) -> str:
        """completed, equilibrium, collapsed, interrupted or failed."""
    @property
    def message(self) -> str:
        """One sentence."""
    @property
    def time(self) -> float:
        """s, reached."""
    @property
    def steps(self) -> int:
        """Steps made."""
    @property
    def contacts(self) -> int:
        """Closed at the end."""
    @property
    def drift(self) -> float:
        """Error of the energy balance, a ratio: the largest in size of all rows of the history, not the last one's."""
    @property
    def wall_seconds(self) -> float:
        """s"""
    @property
    def at_rest(self) -> bool:
        """Whether the model is in equilibrium at the end; also for a run that has completed."""
    @property
    def fastest(self) -> int:
        """Block with the fastest corner at the end, -1: none is free."""
    @property
    def speed(self) -> float:
        """m/s, of that corner."""
    @property
    def failed_checks(self) -> list[str]:
        """Checks of summary.json that do not hold, a sentence each."""

class ModelCheck:
    """What edda.check() finds."""

    @property
    def blocks(self) -> int:
        """How many there are."""
    @property
    def held(self) -> int:
        """How many of them are fixed."""
    @property
    def contacts(self) -> int:
        """Closed at the start."""
    @property
    def critical_step(self) -> float:
        """s"""
    @property
    def time_step(self) -> float:
        """s, the first."""
    @property
    def steps(self) -> float:
        """To expect."""
    @property
    def at_most(self) -> bool:
        """Whether stages may end before."""
    @property
    def steps_per_second(self) -> float:
        """Of wall time."""
    @property
    def governed_by(self) -> str:
        """What governs the time step."""
    @property
    def loads(self) -> list[str]:
        """A sentence each."""
    @property
    def initial_stress(self) -> list[str]:
        """A sentence each."""
    @property
    def strain_damping(self) -> list[str]:
        """A sentence each."""
    @property
    def warnings(self) -> list[str]:
        """Warnings, a sentence each."""

class FosTrial:
    """One factor that was tried."""

    @property
    def factor(self) -> float:
        """What was tried."""
    @property
    def holds(self) -> bool:
        """Whether the model reached equilibrium."""
    @property
    def reason(self) -> str:
        """A few words."""
    @property
    def displacement(self) -> float:
        """m, largest of a corner since the start of the trial."""
    @property
    def block(self) -> int:
        """Whose corner that is, -1: none."""
    @property
    def velocity(self) -> float:
        """m/s, at its end."""
    @property
    def time(self) -> float:
        """s that it took."""

class FactorOfSafety:
    """What edda.fos() finds."""

    @property
    def status(self) -> str:
        """found, below, above, unstable or interrupted."""
    @property
    def message(self) -> str:
        """One sentence."""
    @property
    def factor(self) -> Optional[float]:
        """The middle of the bracket; None where there is no bracket."""
    @property
    def holds(self) -> Optional[float]:
        """The largest factor that holds, or None."""
    @property
    def fails(self) -> Optional[float]:
        """The smallest factor that fails, or None."""
    @property
    def mechanism(self) -> str:
        """What moves at this factor, a sentence; empty where nothing failed."""
    @property
    def trials(self) -> list[FosTrial]:
        """Every factor that was tried."""
    @property
    def warnings(self) -> list[str]:
        """A sentence each."""
    @property
    def wall_seconds(self) -> float:
        """s"""

class LimitJoint:
    """The force of a joint between two blocks at their limit load."""

    @property
    def block_i(self) -> int:
        """Id of one block."""
    @property
    def block_j(self) -> int:
        """Id of the other block."""
    @property
    def joint(self) -> str:
        """Name of its law."""
    @property
    def x(self) -> float:
        """m, of the point through which its resultant goes."""
    @property
    def y(self) -> float:
        """m, of the same point."""
    @property
    def fx(self) -> float:
        """N, on block_i to the right."""
    @property
    def fy(self) -> float:
        """N, on block_i upwards."""
    @property
    def normal_force(self) -> float:
        """N, positive in compression."""
    @property
    def mobilised(self) -> float:
        """Shear force over shear strength."""

class LimitLoad:
    """What edda.limit() finds."""

    @property
    def status(self) -> str:
        """found, unlimited, unstable or unsolved."""
    @property
    def message(self) -> str:
        """One sentence."""
    @property
    def limit(self) -> Optional[float]:
        """The largest value with an equilibrium (static theorem), or None."""
    @property
    def upper(self) -> Optional[float]:
        """The same by the kinematic theorem, or None."""
    @property
    def other_end(self) -> Optional[float]:
        """The smallest value with an equilibrium, or None."""
    @property
    def without_dilation(self) -> Optional[float]:
        """The limit of joints that slide without dilating, or None."""
    @property
    def residual(self) -> Optional[float]:
        """The limit of joints with their residual strength, or None."""
    @property
    def mechanism(self) -> str:
        """What moves at the limit, a sentence; empty: none."""
    @property
    def joints(self) -> list[LimitJoint]:
        """A LimitJoint for each that carries a force."""
    @property
    def warnings(self) -> list[str]:
        """A sentence each."""
    @property
    def wall_seconds(self) -> float:
        """s"""

class ErrorBar:
    """A monitor's displacement at the end, and how far other runs end from it, m."""

    @property
    def monitor(self) -> str:
        """Its name."""
    @property
    def ux(self) -> float:
        """m"""
    @property
    def uy(self) -> float:
        """m"""
    @property
    def step(self) -> float:
        """m, at half the step."""
    @property
    def stiffness(self) -> float:
        """m, with springs three times as stiff."""
    @property
    def order(self) -> float:
        """m, with the blocks in the other order."""

class Verification:
    """What edda.verify() finds."""

    @property
    def monitors(self) -> list[ErrorBar]:
        """An ErrorBar for each monitor."""
    @property
    def time(self) -> float:
        """s, of the model."""
    @property
    def largest_drift(self) -> float:
        """Of the energy, over all runs."""
    @property
    def failed(self) -> str:
        """Which run did not reach its end, and why; empty: none."""

class Progress:
    """How far a run has come."""

    @property
    def fraction(self) -> float:
        """Of the duration."""
    @property
    def time(self) -> float:
        """s, simulated."""
    @property
    def steps(self) -> int:
        """Steps made."""
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
        """The current one, from 1."""
    @property
    def stages(self) -> int:
        """Of the model; 1 where it has none."""
    @property
    def stage_name(self) -> str:
        """Empty where it has none."""

class Ledger:
    """Energies since t = 0, J; drift is a ratio."""

    @property
    def kinetic(self) -> float:
        """J"""
    @property
    def strain(self) -> float:
        """J"""
    @property
    def contact(self) -> float:
        """J"""
    @property
    def gravity(self) -> float:
        """J"""
    @property
    def friction(self) -> float:
        """J, dissipated."""
    @property
    def damping(self) -> float:
        """J, dissipated."""
    @property
    def fracture(self) -> float:
        """J, dissipated."""
    @property
    def external(self) -> float:
        """J, work done on the blocks."""
    @property
    def step_change(self) -> float:
        """J, removed by changes of the time step."""
    @property
    def drift(self) -> float:
        """Error of the energy balance, over the largest energy."""
    @property
    def transfer(self) -> float:
        """J, removed by numerical rules without physical meaning; negative: added."""

class MonitorReading:
    """A material point and its block: m, m/s, Pa (tension positive)."""

    @property
    def ux(self) -> float:
        """m"""
    @property
    def uy(self) -> float:
        """m"""
    @property
    def vx(self) -> float:
        """m/s"""
    @property
    def vy(self) -> float:
        """m/s"""
    @property
    def sxx(self) -> float:
        """Pa"""
    @property
    def syy(self) -> float:
        """Pa"""
    @property
    def sxy(self) -> float:
        """Pa"""

class Simulation:
    """A model in motion. run(), step() and advance_to() are one run, in parts or at once."""

    def __init__(
        self,
        model: Union[Model, str, os.PathLike[str], Mapping[str, Any]],
        results: Union[str, os.PathLike[str], None] = None,
        resume: bool = False,
        from_stage: Optional[SupportsIndex] = None,
        progress: Optional[Callable[[Progress], object]] = None,
        progress_every: float = 0.2,
        warn: Optional[Callable[[str], object]] = None,
    ) -> None:
        """Cuts, builds and checks; nothing is written before the first step.

        model: a Model, or what edda.load() takes.
        results: folder for results, as of `edda run -o`; None: none are written.
        resume: continue from the checkpoint in that folder.
        from_stage: continue from the checkpoint of the end of this stage (from 1).
        progress: called with a Progress about every progress_every s, and at the end, when the
            run is over and can no longer be changed; False stops the run.
        progress_every: s of wall time.
        warn: called with a text for what does not end the run, such as a damaged checkpoint.

        Raises ModelError for what cannot be computed, and for a folder that cannot be used.
        """
    def run(self) -> Outcome:
        """To the end, through all stages, or to a pause()."""
    def step(self, steps: SupportsIndex = 1) -> bool:
        """So many steps, fewer at the end; False: the run is over."""
    def advance_to(self, time: float) -> bool:
        """To the first step at or past a time (s); False: the run is over."""
    def finish(self) -> Outcome:
        """Ends the run where it stands and writes what is due."""
    def pause(self) -> None:
        """From any thread: the current call returns."""
    def stop(self) -> None:
        """From any thread: the run ends as interrupted."""
    def every(self, steps: SupportsIndex, action: Callable[[Simulation], object]) -> int:
        """Calls action(simulation) after every so many steps; returns a number for forget()."""
    def forget(self, callback: SupportsIndex) -> None:
        """Drops what every() has returned this number for."""
    @property
    def model(self) -> Model:
        """The model."""
    @property
    def time(self) -> float:
        """s"""
    @property
    def steps(self) -> int:
        """Steps made."""
    @property
    def time_step(self) -> float:
        """s, the current one; 0 before the first step."""
    @property
    def critical_step(self) -> float:
        """s, the largest that is stable now."""
    @property
    def governed_by(self) -> str:
        """What governs the time step."""
    @property
    def warnings(self) -> list[str]:
        """What to look at before running."""
    @property
    def stage(self) -> int:
        """The current one, from 1."""
    @property
    def over(self) -> bool:
        """Whether the run has ended."""
    @property
    def ledger(self) -> Ledger:
        """Energies now, J."""
    @property
    def unbalanced(self) -> float:
        """Mean resultant over mean contact force."""
    @property
    def block_count(self) -> int:
        """nb, with those that have been excavated."""
    @property
    def vertex_count(self) -> int:
        """nv, of all blocks."""
    @property
    def monitors(self) -> list[str]:
        """Names, those of the model first."""
    @property
    def origin(self) -> tuple[float, float]:
        """(x, y), m: node positions count from here."""
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
        """(nb,) 1: fixed; a view, not to be written to."""
    @property
    def alive(self) -> NDArray[np.uint8]:
        """(nb,) 0: excavated; a view, not to be written to."""
    @property
    def node_x(self) -> _Nodes:
        """Three views (nb,), m from origin, not to be written to."""
    @property
    def node_y(self) -> _Nodes:
        """Three views (nb,), m from origin, not to be written to."""
    @property
    def node_vx(self) -> _Nodes:
        """Three views (nb,) to read and write, m/s, half a step before the positions.

        What is written for blocks that are not free is put back by the next call; what is no finite
        number, or written once the run is over, is its ModelError.
        """
    @property
    def node_vy(self) -> _Nodes:
        """Three views (nb,) to read and write, m/s, half a step before the positions.

        What is written for blocks that are not free is put back by the next call; what is no finite
        number, or written once the run is over, is its ModelError.
        """
    def field(self, name: _Field, out: Optional[_Floats] = None) -> _Floats:
        """Of all blocks, into `out` where one is given.

        centroid, displacement (m), velocity (m/s): (nb, 2), x y; stress (Pa, tension positive):
        (nb, 4), xx yy zz xy; rotation (rad), omega (rad/s), overstress (part of the strength used):
        (nb,). Of excavated blocks as they were then.
        """
    def polygons(self) -> list[list[_Floats]]:
        """Per block its rings, arrays (n, 2), m, as they are now."""
    def contacts(self) -> np.ndarray[Any, np.dtype[np.void]]:
        """A structured array (n,) of contacts that are closed or were before, as joints.csv.

        A row is a face, an edge of block_i against one of block_j; joint (row of Model.joints,
        -1: glued), state (0 open, 1 stick, 2 slide, 3 bonded); x, y (m), middle of the overlap;
        normal_force (N, compression positive), shear_force (N, positive where it drives block i
        from end a to end b); opening (m, negative: closed), slip (m, from a to b);
        mobilised (shear over shear strength); ever_slipped, ever_opened (0 or 1); length of the
        overlap, closed_length of its closed part, its ends x_a, y_a, x_b, y_b (m); normal_stress (Pa,
        compression positive), the mean over the overlap, normal_stress_a and normal_stress_b at its
        ends, shear_stress (Pa). Forces are those of the model's thickness.
        """
    def name(self, block: SupportsIndex) -> str:
        """Of a block by its number, empty where it has none; IndexError: no such block."""
    def block_called(self, name: str) -> int:
        """The number of a block; KeyError: no such name."""
    def add_monitor(self, name: str, point: _Point) -> None:
        """Follows the material point at (x, y) of the start, m."""
    def read(self, monitor: str) -> MonitorReading:
        """The present values of a monitor."""
    def set_velocity(self, block: Union[SupportsIndex, str], velocity: _Point, omega: float = 0.0) -> None:
        """Of a free block by number or name: (vx, vy) of its centroid, m/s, and rate of rotation, rad/s."""
    def set_damping(self, mass: float = 0.0, local: float = 0.0, contact: float = 0.0) -> None:
        """From now on.

        mass: mass-proportional, 1/s. local: part of the unbalanced force, 0 to 1. contact: part of
        critical, 0 to 10. Adaptive damping and Rayleigh's stay as they are.
        """
    def set_strength_factor(self, factor: float, joint: Optional[str] = None) -> None:
        """Strength of all joints, or of one, as the model gives it, divided by the factor."""
    def excavate(self, openings: Sequence[str]) -> None:
        """Excavates openings that a stage of the model names."""
    def relax(self, opening: str, part: float) -> None:
        """Releases a part (0 to 1, all calls and stages together) of the wall forces of excavated rock."""
    def switch_over(self, deactivate: Sequence[str] = [], activate: Sequence[str] = []) -> None:
        """Loads, water, boundaries and ground motions by name, as in a stage."""
    def install(self, bolts: Sequence[str]) -> None:
        """Installs bolts and patterns by name."""
    def reset_displacements(self) -> None:
        """Displacements count from here."""

def study_sample(study: str, model: str, point: Sequence[float], scratch: str) -> tuple[list[str], str]:
    """The answers of one sample as study.csv has them, and why there is none."""

class StudyWorker:
    """A worker in the folder of a study."""

    def __init__(self, folder: str) -> None:
        """In a folder that edda study leads."""
    @property
    def study(self) -> str:
        """Text of study.toml."""
    @property
    def model(self) -> str:
        """Text of the model."""
    def take(self) -> Optional[tuple[int, list[float]]]:
        """The next sample and its values; None where none is free now."""
    def finish(self, number: SupportsIndex, cells: Sequence[str], message: str) -> None:
        """Writes a sample's answers."""
