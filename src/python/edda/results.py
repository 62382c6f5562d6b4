"""Results folders as arrays."""

from __future__ import annotations

import csv
import io
import json
import os
import pathlib
import re
import xml.etree.ElementTree as ElementTree
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
        """A row per output.history_every: time (s), monitors, energies (J)."""
        return read_table(self._file("history.csv"))

    @property
    def blocks(self) -> Table:
        """The blocks at the end: id, name, material, x, y, ux, uy, ..."""
        return read_table(self._file("blocks.csv"))

    @property
    def joints(self) -> Table:
        """The contacts at the end: block_i, block_j, joint, normal_force, ..."""
        return read_table(self._file("joints.csv"))

    @property
    def stages(self) -> Table:
        """A row per stage; of a model with stages."""
        return read_table(self._file("stages.csv"))

    def stage_joints(self, stage: int) -> Table:
        """The contacts at the end of a stage, by its number from 0."""
        return read_table(self._file(f"joints_{stage}.csv"))

    @property
    def fos(self) -> Table:
        """The trials of `edda fos`."""
        return read_table(self._file("fos.csv"))

    @property
    def reactions(self) -> Table:
        """Forces of the boundaries over time; of a model with boundaries."""
        return read_table(self._file("reactions.csv"))

    @property
    def bolts(self) -> Table:
        """Forces along the bolts at each frame; of a model with bolts."""
        return read_table(self._file("bolts.csv"))

    @property
    def frames(self) -> Frames:
        """The blocks at each output.every; read when asked for."""
        return Frames(self.folder, "blocks.pvd")

    @property
    def contact_frames(self) -> Frames:
        """The contacts at each output.every."""
        return Frames(self.folder, "contacts.pvd")

    def _file(self, name: str) -> pathlib.Path:
        path = self.folder / name
        if not path.is_file():
            raise AttributeError(f"{self.folder}: this run has written no {name}")
        return path


class Frame:
    """All blocks, or all contacts, at one time.

    time: s. points: (n, 2) corners, m. cells: per cell the rows of its corners. point_fields and
    cell_fields: arrays by name; frame["stress"] is a cell field, (cells, 6). A block that is not
    convex has several cells, all with its id.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        arrays = _read_vtu(pathlib.Path(path))
        self.time = float(arrays["FieldData"]["TimeValue"][0])
        self.points: NDArray[np.float64] = arrays["Points"]["Points"][:, :2]
        cells = arrays["Cells"]
        self.cells: list[NDArray[np.int64]] = np.split(cells["connectivity"], cells["offsets"][:-1])
        self.point_fields: dict[str, NDArray[Any]] = arrays["PointData"]
        self.cell_fields: dict[str, NDArray[Any]] = arrays["CellData"]

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self.cell_fields:
            raise UnknownName("cell field", name, self.cell_fields)
        return self.cell_fields[name]

    def __contains__(self, name: object) -> bool:
        return name in self.cell_fields

    def __iter__(self) -> Iterator[str]:
        return iter(self.cell_fields)

    def __repr__(self) -> str:
        return f"<edda.Frame at {self.time:g} s, {len(self.cells)} cells>"

    def polygons(self) -> list[NDArray[np.float64]]:
        """Per cell its corners, (n, 2), m."""
        return [self.points[corners] for corners in self.cells]


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
    """A .csv file of a results folder: whole numbers as int64, others as float64, the rest as str.

    A last line that a run is still writing, or has not finished, is left out.
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


_WHOLE = {"id", "block_i", "block_j", "ever_slipped", "ever_opened", "steps", "block"}
_TEXT = {"name", "material", "joint", "state", "bolt", "until", "motion", "outcome", "reason"}


def _column(name: str, texts: Sequence[str]) -> NDArray[Any]:
    if name in _TEXT:
        return np.array(texts, dtype=str) if texts else np.empty(0, dtype="U1")
    if name in _WHOLE:
        try:
            return np.array([int(text) for text in texts], dtype=np.int64)
        except ValueError:
            pass
    try:
        return np.array([float(text) if text else np.nan for text in texts], dtype=np.float64)
    except ValueError:
        return np.array(texts, dtype=str)


_TYPES = {"Float64": np.float64, "Int32": np.int32, "Int64": np.int64, "UInt8": np.uint8}


def _read_vtu(path: pathlib.Path) -> dict[str, dict[str, NDArray[Any]]]:
    """Arrays of a .vtu file by section and name: XML, then raw bytes, each behind its length."""
    content = path.read_bytes()
    head = re.search(rb"<AppendedData[^>]*>\s*_", content)
    if head is None:
        raise ValueError(f"{path}: is no frame that edda has written")
    xml = content[: head.start()].rsplit(b"</UnstructuredGrid>", 1)[0] + b"</UnstructuredGrid></VTKFile>"
    sections: dict[str, dict[str, NDArray[Any]]] = {}
    for section in ElementTree.fromstring(xml).iter():
        for array in section.findall("DataArray"):
            name = array.attrib.get("Name", section.tag)
            sections.setdefault(section.tag, {})[name] = _appended(content, head.end(), array.attrib)
    return sections


def _appended(content: bytes, start: int, attributes: dict[str, str]) -> NDArray[Any]:
    at = start + int(attributes["offset"])
    size = int.from_bytes(content[at : at + 8], "little")
    dtype = np.dtype(_TYPES[attributes["type"]])
    values = np.frombuffer(content, dtype, size // dtype.itemsize, at + 8)
    width = int(attributes.get("NumberOfComponents", "1"))
    return values.reshape(-1, width) if width > 1 else values
