"""Results folders as arrays, against the files; pictures."""
import csv
import subprocess
import sys

import edda
import numpy as np
import pytest


@pytest.fixture(scope="module")
def folder(models, tmp_path_factory):
    path = tmp_path_factory.mktemp("results") / "tunnel"
    short = ["output.every=0.5", "output.history_every=0.1"]
    simulation = edda.Simulation(edda.load(models / "tunnel.toml", short), results=path)
    simulation.step(400)
    simulation.finish()
    return path


def columns_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: [row[name] for row in rows] for name in rows[0]}


@pytest.mark.parametrize("name", ["history", "blocks", "joints", "reactions"])
def test_tables_hold_what_the_files_say_to_the_bit(folder, name):
    table = getattr(edda.Results(folder), name)
    columns = columns_of(folder / f"{name}.csv")
    assert list(table.dtype.names) == list(columns)
    assert len(table) > 0
    for column, texts in columns.items():
        if table[column].dtype.kind == "U":
            assert table[column].tolist() == texts
        else:
            assert table[column].tolist() == [float(t) if t else pytest.approx(np.nan, nan_ok=True) for t in texts]
    assert table.dtype[list(columns)[0]].kind in "fi"


def test_columns_tell_unit_and_meaning(folder):
    results = edda.Results(folder)
    columns = results.columns
    assert columns.dtype.names == ("file", "column", "unit", "meaning")
    assert all(columns[name].dtype.kind == "U" for name in columns.dtype.names)
    for name in ("history", "blocks", "joints", "reactions"):
        of_file = columns["column"][columns["file"] == f"{name}.csv"]
        assert tuple(of_file) == getattr(results, name).dtype.names


def test_normal_stress_has_the_sign_of_normal_force(folder):
    results = edda.Results(folder)
    for contacts in (results.joints, results.contact_frames[-1]):
        closed = contacts["state"] != ("open" if contacts is results.joints else 0)
        force = np.asarray(contacts["normal_force"])[closed]
        assert np.all(force * np.asarray(contacts["normal_stress"])[closed] >= 0.0)
        assert np.count_nonzero(force > 0.0) > 10


@pytest.mark.parametrize("left", ["whole", "1 row", "no line", "amid a number", "amid the header"])
def test_a_table_that_is_being_written_is_read_as_far_as_it_goes(folder, tmp_path, left):
    text = (folder / "history.csv").read_bytes()
    header = text.index(b"\n") + 1
    second = text.index(b"\n", header) + 1
    end = {"whole": len(text), "1 row": second, "no line": header, "amid a number": len(text) - 4, "amid the header": 20}
    (tmp_path / "history.csv").write_bytes(text[: end[left]])
    results, whole = edda.Results(tmp_path), edda.Results(folder).history
    if left == "amid the header":
        with pytest.raises(ValueError, match="no line yet"):
            results.history
        return
    rows = {"whole": len(whole), "1 row": 1, "no line": 0, "amid a number": len(whole) - 1}[left]
    assert results.history.dtype.names == whole.dtype.names
    assert results.history.tolist() == whole[:rows].tolist()


def test_a_row_that_is_short_is_told(folder, tmp_path):
    lines = (folder / "history.csv").read_text().splitlines(keepends=True)
    lines[2] = lines[2].rpartition(",")[0] + "\n"
    (tmp_path / "history.csv").write_text("".join(lines))
    with pytest.raises(ValueError, match="row 3"):
        edda.Results(tmp_path).history


def test_names_that_look_like_numbers_stay_names(tmp_path):
    (tmp_path / "history.csv").write_text("time\n0\n")
    (tmp_path / "bolts.csv").write_text("time,bolt,axial_force\n0.5,007,1.5\n0.5,1e3,2\n")
    bolts = edda.Results(tmp_path).bolts
    assert bolts["bolt"].tolist() == ["007", "1e3"]
    assert bolts["axial_force"].tolist() == [1.5, 2.0]


def test_a_row_that_breaks_off_inside_quotes_is_left_out(tmp_path):
    (tmp_path / "history.csv").write_text("time\n0\n")
    (tmp_path / "blocks.csv").write_text('id,name\n0,"a ""b"",\nc"\n1,"d\ne')
    blocks = edda.Results(tmp_path).blocks
    assert blocks["name"].tolist() == ['a "b",\nc']


def test_unknown_names_are_told_with_the_known_ones(folder):
    results = edda.Results(folder)
    for error in (KeyError, ValueError):
        with pytest.raises(error, match="no column is called 'tme': did you mean 'time'. known are time, "):
            results.history["tme"]
        with pytest.raises(error, match="no cell field is called 'stres': did you mean 'stress'. known are "):
            results.frames[-1]["stres"]
    history = results.history
    assert type(history["time"]) is np.ndarray
    assert history[:2]["time"].tolist() == history["time"][:2].tolist()
    assert history[["time"]].dtype.names == ("time",)


def test_summary_and_what_was_not_written(folder, models, tmp_path):
    results = edda.Results(folder)
    assert results.summary["status"] == "interrupted"
    assert results.summary["steps"] == 400
    edda.run(models / "ramp.toml", tmp_path / "ramp", {"solver.duration": 0.01})
    with pytest.raises(AttributeError, match="no stages.csv"):
        edda.Results(tmp_path / "ramp").stages
    with pytest.raises(FileNotFoundError):
        edda.Results(tmp_path / "nothing")
    with pytest.raises(FileNotFoundError):
        edda.Results(tmp_path)


def test_frames_agree_with_the_table_at_the_end(folder):
    results = edda.Results(folder)
    frames = results.frames
    assert len(frames) >= 2 and frames.times[0] == 0.0
    last, blocks = frames[-1], results.blocks
    assert last.time == frames.times[-1] == results.history["time"][-1]
    row = {block: k for k, block in enumerate(blocks["id"])}
    rows = [row[block] for block in last["id"]]
    assert np.array_equal(last["displacement"][:, 0], blocks["ux"][rows])
    assert np.array_equal(last["stress"][:, 1], blocks["syy"][rows])
    area = np.zeros(len(blocks))
    for polygon, k in zip(last.polygons(), rows):
        x, y = polygon.T
        area[k] += 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
    assert area == pytest.approx(blocks["area"])
    assert [f.time for f in frames[:2]] == list(frames.times[:2])
    assert len(list(frames)) == len(frames)
    contacts = results.contact_frames[-1]
    for name in ("normal_force", "normal_stress_a", "normal_stress_b", "x_a", "y_a", "x_b", "y_b"):
        assert np.array_equal(contacts[name], results.joints[name]), name


def test_stages_and_bolts(models, tmp_path):
    model = edda.load(models / "tunnel.toml", ["output.every=10", "output.history_every=1"])
    assert len(model.stages) > 1
    simulation = edda.Simulation(model, results=tmp_path / "out")
    while simulation.stage == 1 and simulation.step(50):
        pass
    simulation.finish()
    results = edda.Results(tmp_path / "out")
    assert len(results.stages) == 1
    assert results.stages["steps"].dtype.kind == "i"
    at_end = results.stage_joints(1)
    assert at_end.dtype.names == results.joints.dtype.names
    assert np.count_nonzero(at_end["normal_force"] > 0.0) > 10
    with pytest.raises(AttributeError, match="joints_2.csv"):
        results.stage_joints(2)


def test_curve_of_a_ramp(models, tmp_path):
    model = edda.load(models / "pushover.toml", ["stage.push.ramp={kh=[0,0.1],steps=2}"])
    edda.Simulation(model, results=tmp_path / "out").run()
    curve = edda.Results(tmp_path / "out").curve
    assert curve["value"].tolist() == [0.0, 0.05, 0.1]
    assert curve["holds"].tolist() == [1, 1, 1] and curve["holds"].dtype == np.int64
    assert curve["vary"].tolist() == ["kh"] * 3
    weight = -curve["fy"][0]
    assert np.allclose(curve["fx"], curve["value"] * weight, rtol=1e-12)
    assert np.all(np.diff(curve["top.ux"]) > 0.0)
    text = " ".join(edda.Results.curve.__doc__.split())
    assert all(name.rpartition(".")[2] in text for name in curve.dtype.names)


def test_matplotlib_is_imported_only_for_pictures():
    code = "import edda, sys; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


WHOLE = {
    "blocks.csv": ["id"],
    "joints.csv": ["block_i", "block_j", "ever_slipped", "ever_opened"],
    "stages.csv": ["stage", "reached", "steps", "largest_block", "contacts", "sliding", "bonded", "detached", "open",
                   "broken", "yielded_bolts", "loose"],
    "bolts.csv": ["yielded", "ruptured"],
    "cut.csv": ["block", "ring"],
}


@pytest.fixture(scope="module")
def bolted(models, program, tmp_path_factory):
    """A run with bolts and stages, some steps into the third."""
    path = tmp_path_factory.mktemp("bolted") / "tunnel"
    model = edda.load(models / "tunnel.toml", ["output.every=10", "output.history_every=1"])
    simulation = edda.Simulation(model, results=path)
    while simulation.stage < 3 and simulation.step(50):
        pass
    simulation.step(50)
    simulation.finish()
    program("cut", models / "tunnel.toml", "-o", path / "cut.csv")
    return path


@pytest.mark.parametrize("name", list(WHOLE))
def test_whole_numbers_are_whole_and_others_are_not(bolted, name):
    table = edda.results.read_table(bolted / name)
    columns = columns_of(bolted / name)
    assert len(table) > 0
    kinds = {column: table.dtype[column].kind for column in columns}
    assert [column for column in columns if kinds[column] == "i"] == WHOLE[name]
    for column in WHOLE[name]:
        assert table[column].dtype == np.int64 and table[column].tolist() == [int(t) for t in columns[column]]


def test_whole_numbers_that_are_left_blank_are_minus_one(tmp_path):
    (tmp_path / "fos.csv").write_text("factor,outcome,displacement,block,time,steps,reason\n1,holds,,,0.5,7,\n2,fails,0.1,3,1,9,x\n")
    fos = edda.Results(tmp_path).fos
    assert fos["block"].dtype == np.int64 and fos["block"].tolist() == [-1, 3]
    assert np.isnan(fos["displacement"][0]) and fos["reason"].tolist() == ["", "x"]


def test_energies_of_the_history_stay_as_they_are(folder):
    history = edda.Results(folder).history
    assert {history.dtype[name].kind for name in history.dtype.names} == {"f"}


def test_docstrings_say_columns_and_units(folder, bolted):
    for name, path in [("history", folder), ("reactions", folder), ("blocks", bolted), ("joints", bolted),
                       ("stages", bolted), ("bolts", bolted)]:
        text = " ".join(getattr(edda.Results, name).__doc__.split())
        for column in getattr(edda.Results(path), name).dtype.names:
            ending = column.rpartition(".")[2]
            assert ending in text, (name, column)
        assert "(s)" in text or "(m)" in text
    frames = edda.Results(folder)
    for frame in (frames.frames[0], frames.contact_frames[0]):
        for field in frame:
            assert field in edda.Frame.__doc__, field
    assert "xx yy zz xy yz xz" in edda.Frame.__doc__


ZONES = """
[materials.soft]
density = 2000
young = "10 MPa"
poisson = 0.25
zone_size = 0.25
yield = { friction_angle = 20, cohesion = "4 kPa" }
[joints.j]
friction_angle = 30
[[block]]
fixed = true
polygon = [[-1, -1], [5, -1], [5, 0], [-1, 0]]
[[block]]
polygon = [[0, 0], [2, 0], [2, 2], [0, 2]]
[solver]
duration = 0.05
[output]
every = 0.05
"""


def test_a_block_with_zones_has_their_mean(tmp_path):
    (tmp_path / "zones.toml").write_text(ZONES)
    simulation = edda.Simulation(edda.load(tmp_path / "zones.toml"), results=tmp_path / "zones")
    simulation.run()
    frame, blocks = edda.Results(tmp_path / "zones").frames[-1], edda.Results(tmp_path / "zones").blocks
    assert len(frame["id"]) == 2
    for k, name in enumerate(("ux", "uy")):
        assert frame["displacement"][1, k] == pytest.approx(blocks[name][1], rel=0.02, abs=1e-5)
    for k, name in enumerate(("sxx", "syy", "szz", "sxy")):
        assert frame["stress"][1, k] == pytest.approx(blocks[name][1], rel=0.02, abs=50)
    assert abs(frame["displacement"][1, 1]) > 1e-4
    assert frame["strength_factor"][1] > 0.5
