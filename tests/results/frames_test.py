"""Frames as ParaView reads them (VTK): polygons, fields and times against blocks.csv. Usage: frames_test.py EDDA"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    print("python3-vtk9 is not there: nothing was tested")
    sys.exit(77)

MODEL = """[materials.rock]
density = 2000.0
young = 1e8
poisson = 0.25
[joints.j]
friction_angle = 30.0
[[block]]
name = "floor"
fixed = true
polygon = [[-5, -1], [9, -1], [9, 0], [-5, 0]]
[[block]]
name = "box"
polygon = [[0, 0], [2, 0], [2, 1], [0, 1]]
velocity = [1.0, 0.0]
[[block]]
name = "L"
polygon = [[4, 0], [7, 0], [7, 1], [5, 1], [5, 3], [4, 3]]
velocity = [0.5, 1.0]
angular_velocity = 0.5
[solver]
duration = 0.1
[output]
every = 0.05
"""


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(path))
    reader.SetFileName(str(path))
    reader.Update()
    assert not errors, path
    return reader.GetOutput()


def area_and_centre(cell):
    p = [cell.GetPoints().GetPoint(k) for k in range(cell.GetNumberOfPoints())]
    twice = x = y = 0.0
    for (ax, ay, _), (bx, by, _) in zip(p, p[1:] + p[:1]):
        w = ax * by - bx * ay
        twice, x, y = twice + w, x + w * (ax + bx) / 3, y + w * (ay + by) / 3
    return twice / 2, x / 2, y / 2  # area, first moments


def close(a, b, scale=1.0):
    assert abs(a - b) <= 1e-9 * max(scale, abs(b)), (a, b)


def series(path):
    return [(float(d.get("timestep")), d.get("file")) for d in xml.etree.ElementTree.parse(path).iter("DataSet")]


def check_blocks(folder):
    frames = series(folder / "blocks.pvd")
    assert [t for t, _ in frames] == [0.0, 0.05, 0.1], frames
    grid = read(folder / frames[-1][1])
    names = "id material displacement velocity rotation stress principal_stress".split()
    data = grid.GetCellData()
    arrays = {n: vtk_to_numpy(data.GetArray(n)) for n in names}
    assert grid.GetCellType(0) == vtk.VTK_POLYGON
    totals = {}
    for c in range(grid.GetNumberOfCells()):
        totals.setdefault(int(arrays["id"][c]), []).append(c)
    with open(folder / "blocks.csv") as file:
        rows = list(csv.DictReader(file))
    assert sorted(totals) == [int(r["id"]) for r in rows] == [0, 1, 2]
    assert len(totals[2]) == 4, "the L is split into triangles"
    for row in rows:
        cells = totals[int(row["id"])]
        parts = [area_and_centre(grid.GetCell(c)) for c in cells]
        area = sum(p[0] for p in parts)
        assert abs(area - float(row["area"])) <= 1e-6 * area  # that of the mean strain
        # Of the mass; that of the area moves with corners that deviate from the uniform strain.
        assert abs(sum(p[1] for p in parts) / area - float(row["x"])) < 1e-3
        assert abs(sum(p[2] for p in parts) / area - float(row["y"])) < 1e-3
        for c in cells:
            s = {k: float(row[k]) for k in ("sxx", "syy", "szz", "sxy")}
            assert list(arrays["displacement"][c]) == [float(row["ux"]), float(row["uy"]), 0.0]
            assert list(arrays["velocity"][c]) == [float(row["vx"]), float(row["vy"]), 0.0]
            assert arrays["rotation"][c] == float(row["rotation"])
            assert list(arrays["stress"][c]) == [s["sxx"], s["syy"], s["szz"], s["sxy"], 0.0, 0.0]
            mean, radius = (s["sxx"] + s["syy"]) / 2, math.hypot((s["sxx"] - s["syy"]) / 2, s["sxy"])
            close(arrays["principal_stress"][c][0], mean + radius, 1e3)
            close(arrays["principal_stress"][c][1], mean - radius, 1e3)
    assert float(rows[1]["ux"]) > 0.05, "nothing has moved: the comparison says nothing"
    points = grid.GetPointData()
    for name in ("displacement", "velocity"):
        assert points.GetArray(name).GetNumberOfComponents() == 3
    start = read(folder / frames[0][1])
    moved = vtk_to_numpy(grid.GetPoints().GetData()) - vtk_to_numpy(start.GetPoints().GetData())
    assert abs(moved - vtk_to_numpy(points.GetArray("displacement"))).max() < 1e-12


def check_contacts(folder):
    frames = series(folder / "contacts.pvd")
    grid = read(folder / frames[-1][1])
    with open(folder / "joints.csv") as file:
        rows = list(csv.DictReader(file))
    assert grid.GetNumberOfCells() == len(rows) > 0
    states = ["open", "stick", "slide", "bonded"]
    data = grid.GetCellData()
    for c, row in enumerate(rows):
        for name in ("normal_force", "shear_force", "opening", "slip", "length", "closed_length", "normal_stress", "shear_stress",
                     "normal_stress_a", "normal_stress_b", "x_a", "y_a", "x_b", "y_b"):
            assert data.GetArray(name).GetTuple1(c) == float(row[name]), name
        assert states[int(data.GetArray("state").GetTuple1(c))] == row["state"]
        close(grid.GetPoint(c)[0], float(row["x"]))
    assert data.GetArray("force").GetNumberOfComponents() == 3


def check_zones(folder):
    """The zones of a meshed block cover it, and its row has their mean."""
    frames = series(folder / "blocks.pvd")
    grid = read(folder / frames[-1][1])
    data = grid.GetCellData()
    ids = vtk_to_numpy(data.GetArray("id"))
    stress = vtk_to_numpy(data.GetArray("stress"))
    strain, yields = (vtk_to_numpy(data.GetArray(name)) for name in ("plastic_strain", "yields"))
    with open(folder / "blocks.csv") as file:
        rows = {r["name"]: r for r in csv.DictReader(file)}
    cells = [c for c in range(grid.GetNumberOfCells()) if ids[c] == int(rows["box"]["id"])]
    assert len(cells) > 20
    assert all(grid.GetCellType(c) == vtk.VTK_TRIANGLE for c in cells)
    areas = [area_and_centre(grid.GetCell(c))[0] for c in cells]
    assert min(areas) > 0.0 and abs(sum(areas) - 2.0) < 0.05, sum(areas)
    for column, component in (("sxx", 0), ("syy", 1), ("szz", 2), ("sxy", 3)):
        mean = sum(a * stress[c][component] for a, c in zip(areas, cells)) / sum(areas)
        assert abs(mean - float(rows["box"][column])) < 1e-2 * max(1e3, abs(mean)), (column, mean)
    assert max(stress[c][1] for c in cells) - min(stress[c][1] for c in cells) > 1e3
    assert strain.max() > 0.0 and yields.max() in (1, 2)
    assert all(strain[c] == 0.0 for c in range(len(ids)) if c not in cells)
    factor = vtk_to_numpy(data.GetArray("strength_factor"))
    assert all(factor[c] != factor[c] for c in range(len(ids)) if c not in cells), "rock without a strength has none"
    factor, yields = factor[cells], yields[cells]
    assert 0.0 <= factor.min() and factor.max() <= 10.0
    sheared = sorted(factor[yields == 1])
    assert len(sheared) > 0 and abs(sheared[len(sheared) // 2] - 1.0) < 1e-6, sheared
    start = read(folder / frames[0][1])
    moved = vtk_to_numpy(grid.GetPoints().GetData()) - vtk_to_numpy(start.GetPoints().GetData())
    assert abs(moved - vtk_to_numpy(grid.GetPointData().GetArray("displacement"))).max() < 1e-12


with tempfile.TemporaryDirectory() as name:
    work = pathlib.Path(name)
    (work / "m.toml").write_text(MODEL)
    subprocess.run([str(pathlib.Path(sys.argv[1]).resolve()), "run", "m.toml", "--quiet"], cwd=work, check=True)
    check_blocks(work / "m")
    check_contacts(work / "m")
    soft = "[materials.soft]\ndensity = 2000.0\nyoung = 1e7\npoisson = 0.25\nzone_size = 0.25\n" \
           "yield = { friction_angle = 20, cohesion = 2e3 }\n"
    zones = soft + MODEL.replace('name = "box"', 'name = "box"\nmaterial = "soft"')
    zones = zones.replace("duration = 0.1", "duration = 0.1\n")
    for other in ("floor", "L"):
        zones = zones.replace(f'name = "{other}"', f'name = "{other}"\nmaterial = "rock"')
    (work / "z.toml").write_text(zones)
    subprocess.run([str(pathlib.Path(sys.argv[1]).resolve()), "run", "z.toml", "--quiet"], cwd=work, check=True)
    check_zones(work / "z")
print("frames agree with the tables")
