"""Results folders as arrays."""

from __future__ import annotations

import csv
import io
import json
import os
import pathlib
import re
import xml.etree.ElementTree as ElementTree
import zlib
from collections.abc import Iterator, Sequence
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from ._errors import UnknownName


class Table(np.ndarray[Any, np.dtype[Any]]):
    """Structured, a field per column: table["time"] is a plain array."""

    def __getitem__(self, key: Any) -> Any:
        names = self.dtype.names
        if isinstance(key, str) and names is not None and key not in names:
            raise UnknownName("column", key, names)
        found = super().__getitem__(key)
        if isinstance(found, np.ndarray) and found.dtype.names is None:
            return found.view(np.ndarray)
        return found


class Results:
    """A folder that `edda run`, `edda fos` or a Simulation has written.

    Tables are structured arrays: results.history["time"] is a column of float64, to the bit what
    was computed. What a run did not write is an AttributeError that says so.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = pathlib.Path(folder)
        if not self.folder.is_dir():
            raise FileNotFoundError(f"{self.folder}: no such folder")
        if not any((self.folder / name).is_file() for name in ("history.csv", "fos.csv")):
            raise FileNotFoundError(f"{self.folder}: holds no history.csv: give a folder that edda run has written")

    def __repr__(self) -> str:
        return f"<edda.Results {self.folder}>"

    @property
    def summary(self) -> dict[str, Any]:
        """summary.json; there only when the run has ended."""
        with open(self._file("summary.json"), encoding="utf-8") as file:
            return dict(json.load(file))

    @property
    def history(self) -> Table:
        """A row per output.history_every.

        time (s); of each monitor NAME.ux, .uy (m), .vx, .vy (m/s), .ax, .ay (m/s2, in a frame at rest, mean since the row
        before), .sxx, .syy, .sxy (Pa), of each convergence line NAME.convergence (m), of each measured region
        NAME.mean_sxx, .mean_syy, .mean_szz, .mean_sxy (Pa), .mean_exx, .mean_eyy, .mean_exy; kinetic, strain, contact,
        gravity, friction, damping, fracture, external, step_change (J, as Ledger); drift, unbalanced (ratios); transfer
        (J, as Ledger); cracks_tension, cracks_shear (joints with fracture energy that are broken).
        """
        return read_table(self._file("history.csv"))

    @property
    def blocks(self) -> Table:
        """A row per block that is there at the end.

        id, name, material (its name); x, y (m) of the centroid, area (m2), ux, uy (m), rotation (rad), vx, vy (m/s),
        omega (rad/s), sxx, syy, szz, sxy (Pa, tension positive), overstress (part of the strength used).
        """
        return read_table(self._file("blocks.csv"))

    @property
    def joints(self) -> Table:
        """A row per contact at the end, open ones that were closed before among them.

        A row is a face, an edge of block_i against one of block_j; joint (name of its law); x, y (m, middle of
        the overlap), normal_force (N, compression positive), shear_force (N, positive where it drives block i from
        end a to end b), opening (m, negative: closed), slip (m, from a to b); state (open, stick, slide,
        bonded), ever_slipped, ever_opened (0 or 1), mobilised (shear over shear strength); length of the overlap,
        closed_length of its closed part, its ends x_a, y_a, x_b, y_b (m); normal_stress (Pa, compression positive;
        the mean over the overlap), normal_stress_a, normal_stress_b (at its ends), shear_stress (Pa); table (from which the
        line of the joint comes, as joint_set.bedding); damage and broken_by (tension or shear) of joints with fracture
        energy; aperture (m), discharge (m2/s, from a to b), water_pressure_a and water_pressure_b (Pa) of joints through
        which water flows. Forces are those of the model's thickness.
        """
        return read_table(self._file("joints.csv"))

    @property
    def stages(self) -> Table:
        """A row per stage that has ended; of a model with stages.

        stage (from 1), name, until, reached (0 or 1), start, end (s), steps; ratio, largest_ratio (resultant of
        blocks over contact force), largest_block (its id, -1: none); kinetic, strain, contact, gravity, friction,
        damping, fracture, external (J), drift as in history; how many contacts are closed (contacts), sliding, bonded,
        open, broken, how many blocks detached, yielded_bolts, how many blocks have come loose (loose);
        transfer (J, as in history); NAME.convergence (m).
        """
        return read_table(self._file("stages.csv"))

    @property
    def curve(self) -> Table:
        """A row per increment of a ramp; of a model with stages that have one.

        stage (from 1), vary (what the ramp varies), value, holds (0 or 1), time (s), steps; moved (m, largest
        displacement of a corner in the increment); fx, fy (N, sum of what is varied); reason; NAME.ux, NAME.uy (m) of
        each monitor.
        """
        return read_table(self._file("curve.csv"))

    def stage_joints(self, stage: int) -> Table:
        """The contacts at the end of a stage, by its number from 1; columns as of joints."""
        return read_table(self._file(f"joints_{stage}.csv"))

    @property
    def fos(self) -> Table:
        """The trials of `edda fos`.

        factor, outcome (holds, fails), displacement (m), block (its id, -1: none), time (s), velocity (m/s),
        unbalanced (ratio), steps, reason.
        """
        return read_table(self._file("fos.csv"))

    @property
    def reactions(self) -> Table:
        """A row per row of history; of a model with boundaries.

        time (s); NAME.fx, NAME.fy (N, of the model's thickness) of each boundary on the blocks, its number where it
        has no name.
        """
        return read_table(self._file("reactions.csv"))

    @property
    def bolts(self) -> Table:
        """A row per node of each bolt and frame; of a model with bolts.

        time (s), bolt (name), distance (m along it), x, y (m); axial_force (N, tension positive), bond_force (N/m),
        dowel_force (N), each of one bolt; utilisation (largest part of a strength), yielded, ruptured (0 or 1);
        dowel_utilisation, dowel_angle (rad by which the bar has turned in a joint).
        """
        return read_table(self._file("bolts.csv"))

    @property
    def bolt_summary(self) -> Table:
        """A row per bolt at the end of the run; of a model with bolts.

        bolt (name), largest_force (N, one bolt, tension positive) of all nodes and frames, with its time (s), distance (m from
        the head) and x, y (m); axial_force, dowel_force (N), bond_force (N/m) that are largest at the end; utilisation;
        bond_slipped, yielded, ruptured (1 or 0, anywhere); largest_dowel_force (N, of all frames), dowel_utilisation.
        """
        return read_table(self._file("bolt_summary.csv"))

    @property
    def linings(self) -> Table:
        """Two rows per piece of each lining and frame, its ends; of a model with linings.

        time (s), lining (name or number), piece, distance (m along it), x, y (m); thrust (N, compression positive), moment
        (N m, positive with tension at the wall), shear (N), each of the model's thickness; utilisation (part of the strength),
        hinge_rotation (rad), material (name of the one that the lining has by then), yielded (1 or 0, so far).
        """
        return read_table(self._file("linings.csv"))

    @property
    def columns(self) -> Table:
        """A row per column of each table in the folder.

        file, column (as in its header), unit (1: a number without dimension, text: words), meaning (with the sign).
        """
        return read_table(self._file("columns.csv"))

    @property
    def frames(self) -> Frames:
        """The blocks at each output.every, a Frame each; read when asked for."""
        return Frames(self.folder, "blocks.pvd")

    @property
    def contact_frames(self) -> Frames:
        """The contacts at each output.every, a Frame each; read when asked for."""
        return Frames(self.folder, "contacts.pvd")

    def _file(self, name: str) -> pathlib.Path:
        path = self.folder / name
        if not path.is_file():
            raise AttributeError(f"{self.folder}: this run has written no {name}")
        return path


class Frame:
    """All blocks, or all contacts, at one time.

    time: s. points: (n, 2) corners, m. cells: per block the rows of the corners of its outer ring. point_fields and
    cell_fields: arrays by name; frame["stress"] is a cell field. There is one row per block, or per contact, in the
    order of frame["id"]: blocks that have been excavated have none. Of a block with zones it has their mean over the area.

    Cell fields of blocks: id, material (row of Model.materials, -1: none), fixed (0 or 1), rotation (rad), omega
    (rad/s), overstress: (rows,); displacement (m), velocity (m/s): (rows, 3), x y z, of the centroid; stress (Pa,
    tension positive): (rows, 6), xx yy zz xy yz xz; principal_stress (Pa): (rows, 3), major (most tensile) and minor
    (most compressive) in the plane, and out of it; in a run with zones plastic_strain, pore_pressure (Pa), strength_factor (nan without a
    strength) and, of the first zone, yields: (rows,). Point fields: displacement (m), velocity (m/s): (n, 3).

    Cell fields of contacts: block_i, block_j, state (0 open, 1 stick, 2 slide, 3 bonded), normal_force,
    shear_force (N), opening, slip, length, closed_length (m), normal_stress (Pa, compression positive),
    normal_stress_a, normal_stress_b (at the ends), shear_stress (Pa), damage, broken_by (0 unbroken, 1 tension,
    2 shear), x_a, y_a, x_b, y_b (m): (rows,); force (N, on
    block i), displacement (m): (rows, 3).
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        arrays = _read_vtu(pathlib.Path(path))
        self.time = float(arrays["FieldData"]["TimeValue"][0])
        self.points: NDArray[np.float64] = arrays["Points"]["Points"][:, :2]
        cells = arrays["Cells"]
        pieces: list[NDArray[np.int64]] = np.split(cells["connectivity"], cells["offsets"][:-1])
        fields: dict[str, NDArray[Any]] = arrays["CellData"]
        first = _first_pieces(fields["id"]) if "id" in fields else np.arange(len(pieces))
        self._rings = [_rings_of(pieces[a:b]) for a, b in zip(first, [*first[1:], len(pieces)])]
        self.cells: list[NDArray[np.int64]] = [max(rings, key=self._area) for rings in self._rings]
        self.point_fields: dict[str, NDArray[Any]] = arrays["PointData"]
        self.cell_fields: dict[str, NDArray[Any]] = {name: values[first] for name, values in fields.items()}
        if "plastic_strain" in fields and len(first) < len(pieces):
            areas = np.array([self._area(piece) for piece in pieces])
            for name, values in fields.items():
                if np.issubdtype(values.dtype, np.floating):
                    weights = areas.reshape(-1, *[1] * (values.ndim - 1))
                    self.cell_fields[name] = np.add.reduceat(weights * values, first) / np.add.reduceat(weights, first)
            xx, yy, zz, xy = self.cell_fields["stress"][:, :4].T
            mean, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
            self.cell_fields["principal_stress"] = np.stack([mean + radius, mean - radius, zz], axis=1)

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self.cell_fields:
            raise UnknownName("cell field", name, self.cell_fields)
        return self.cell_fields[name]

    def __contains__(self, name: object) -> bool:
        return name in self.cell_fields

    def __iter__(self) -> Iterator[str]:
        return iter(self.cell_fields)

    def __repr__(self) -> str:
        return f"<edda.Frame at {self.time:g} s, {len(self.cells)} rows>"

    def polygons(self) -> list[NDArray[np.float64]]:
        """Per block the corners of its outer ring, (n, 2), m."""
        return [self.points[corners] for corners in self.cells]

    def rings(self) -> list[list[NDArray[np.float64]]]:
        """Per block its rings, (n, 2) each, m: those of a block with holes are several, in no order."""
        return [[self.points[corners] for corners in rings] for rings in self._rings]

    def _area(self, ring: NDArray[np.int64]) -> float:
        """Twice the area inside it, m2."""
        x, y = (self.points[ring] - self.points[ring[:1]]).T
        return abs(float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))))


def _first_pieces(ids: NDArray[Any]) -> NDArray[np.int64]:
    """A block that is not convex stands in the file as several pieces, one after the other, all with its id."""
    return np.flatnonzero(np.r_[True, ids[1:] != ids[:-1]]) if len(ids) else np.empty(0, dtype=np.int64)


def _rings_of(pieces: list[NDArray[np.int64]]) -> list[NDArray[np.int64]]:
    """The rings round pieces together: edges between two pieces are no outline."""
    if len(pieces) == 1:
        return list(pieces)
    cells = [piece.tolist() for piece in pieces]
    edges = dict.fromkeys(edge for cell in cells for edge in zip(cell, cell[1:] + cell[:1]))
    leaving: dict[int, list[int]] = {}
    for a, b in edges:
        if (b, a) not in edges:
            leaving.setdefault(a, []).append(b)
    rings = []
    while leaving:
        ring = []
        at = next(iter(leaving))
        while at in leaving:  # at a point that several edges leave, any will do
            ring.append(at)
            to = leaving[at].pop()
            if not leaving[at]:
                del leaving[at]
            at = to
        rings.append(np.array(ring, dtype=np.int64))
    return rings


class Frames(Sequence[Frame]):
    """The frames of a run. times: (n,) s."""

    def __init__(self, folder: pathlib.Path, series: str) -> None:
        self._folder = folder
        path = folder / series
        if not path.is_file():
            raise AttributeError(f"{folder}: this run has written no {series}")
        entries = ElementTree.parse(path).getroot().iter("DataSet")
        found = [(float(e.attrib["timestep"]), e.attrib["file"]) for e in entries]
        self.times: NDArray[np.float64] = np.array([time for time, _ in found])
        self._files = [file for _, file in found]

    def __len__(self) -> int:
        return len(self._files)

    @overload
    def __getitem__(self, index: int) -> Frame: ...

    @overload
    def __getitem__(self, index: slice) -> list[Frame]: ...

    def __getitem__(self, index: int | slice) -> Frame | list[Frame]:
        if isinstance(index, slice):
            return [Frame(self._folder / file) for file in self._files[index]]
        return Frame(self._folder / self._files[index])

    def __iter__(self) -> Iterator[Frame]:
        return (Frame(self._folder / file) for file in self._files)


def read_table(path: str | os.PathLike[str]) -> Table:
    """A .csv file of a results folder: numbers, counts and flags as int64, what is measured as float64, names as str.

    Where a cell is empty (largest_block of a stage in which no block rests) whole numbers are -1, others nan. A last
    line that a run is still writing, or has not finished, is left out.
    """
    with open(path, newline="", encoding="utf-8") as file:
        text = file.read()
    rows = list(csv.reader(io.StringIO(text[: _end_of_rows(text)], newline="")))
    if not rows:
        raise ValueError(f"{path}: has no line yet")
    names = rows.pop(0)
    for number, row in enumerate(rows, 2):
        if len(row) != len(names):
            raise ValueError(f"{path}: row {number} has {len(row)} columns, the first has {len(names)}")
    columns = list(zip(*rows)) or [()] * len(names)
    arrays = [_column(name, column) for name, column in zip(names, columns)]
    table = np.empty(len(columns[0]), dtype=[(n, a.dtype) for n, a in zip(names, arrays)])
    for name, array in zip(names, arrays):
        table[name] = array
    return table.view(Table)


def _end_of_rows(text: str) -> int:
    """Where the last whole row ends: behind a line break that is not inside quotes."""
    end = text.rfind("\n") + 1
    while end > 0 and text.count('"', 0, end) % 2:
        end = text.rfind("\n", 0, end - 1) + 1
    return end


_WHOLE = {
    *("id", "block", "block_i", "block_j", "ring", "ever_slipped", "ever_opened", "yielded", "ruptured", "piece"),
    *("stage", "reached", "holds", "steps", "largest_block", "contacts", "sliding", "bonded", "detached", "open", "broken"),
    *("yielded_bolts", "loose"),
}
_TEXT = {
    *("name", "material", "joint", "table", "state", "bolt", "lining", "until", "motion", "outcome", "reason"),
    *("file", "column", "unit", "meaning", "vary"),
}


def _column(name: str, texts: Sequence[str]) -> NDArray[Any]:
    if name in _TEXT:
        return np.array(texts, dtype=str) if texts else np.empty(0, dtype="U1")
    if name in _WHOLE:
        try:
            return np.array([int(text) if text else -1 for text in texts], dtype=np.int64)
        except ValueError:
            pass
    try:
        return np.array([float(text) if text else np.nan for text in texts], dtype=np.float64)
    except ValueError:
        return np.array(texts, dtype=str)


_TYPES = {"Float64": np.float64, "Int32": np.int32, "Int64": np.int64, "UInt8": np.uint8}


def _read_vtu(path: pathlib.Path) -> dict[str, dict[str, NDArray[Any]]]:
    """Arrays of a .vtu file by section and name: XML, then their bytes, deflated in blocks."""
    content = path.read_bytes()
    head = re.search(rb"<AppendedData[^>]*>\s*_", content)
    if head is None:
        raise ValueError(f"{path}: is no frame that edda has written")
    if b"vtkZLibDataCompressor" not in content[: head.start()]:
        raise ValueError(f"{path}: is of an earlier version of edda: run the model again")
    xml = content[: head.start()].rsplit(b"</UnstructuredGrid>", 1)[0] + b"</UnstructuredGrid></VTKFile>"
    sections: dict[str, dict[str, NDArray[Any]]] = {}
    for section in ElementTree.fromstring(xml).iter():
        for array in section.findall("DataArray"):
            name = array.attrib.get("Name", section.tag)
            sections.setdefault(section.tag, {})[name] = _appended(content, head.end(), array.attrib)
    return sections


def _appended(content: bytes, start: int, attributes: dict[str, str]) -> NDArray[Any]:
    at = start + int(attributes["offset"])
    blocks = int.from_bytes(content[at : at + 8], "little")
    sizes = np.frombuffer(content, np.uint64, blocks, at + 24).astype(np.int64)
    ends = at + 24 + 8 * blocks + np.cumsum(sizes)
    whole = b"".join(zlib.decompress(content[end - size : end]) for end, size in zip(ends, sizes))
    values = np.frombuffer(whole, np.dtype(_TYPES[attributes["type"]]))
    width = int(attributes.get("NumberOfComponents", "1"))
    return values.reshape(-1, width) if width > 1 else values
