"""Models: the same keys, checks and messages from a dict, a text or a file."""
import enum
import pickle
import tomllib

import edda
import numpy as np
import pytest

EXAMPLES = ["ramp", "cavern", "tunnel", "dam", "wall", "quake-cavern", "rockfall"]


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_dict_is_the_same_model_as_the_file(name, models, monkeypatch):
    monkeypatch.chdir(models)  # where the files that models name are
    with open(f"{name}.toml", "rb") as file:
        document = tomllib.load(file)
    assert edda.load(document).to_toml() == edda.load(f"{name}.toml").to_toml()


def test_a_dict_runs_to_the_same_bits_as_the_file(models):
    with open(models / "ramp.toml", "rb") as file:
        document = tomllib.load(file)
    ends = []
    for source in (document, models / "ramp.toml"):
        simulation = edda.Simulation(edda.load(source, {"solver.duration": 0.03}))
        simulation.run()
        ends.append([row.copy() for row in simulation.node_x + simulation.node_vy])
    assert np.array_equal(ends[0], ends[1])


def test_numbers_keep_their_bits_whatever_they_are():
    awkward = [0.1, 1 / 3, 5e-324, 1.7976931348623157e308, -0.0, float("inf")]
    text = edda._toml.dumps({"numbers": np.array(awkward), "whole": np.int64(7), "single": np.float64(0.1)})
    read = tomllib.loads(text)
    assert np.array(read["numbers"]).tobytes() == np.array(awkward).tobytes()
    assert read["whole"] == 7 and isinstance(read["whole"], int)


def test_texts_and_tables_survive():
    model = {"a b": 'quo"te \\ \n\t\x01 é', "list": [{"name": "x", "on": True}, {"flag": False}], "none": None}
    read = tomllib.loads(edda._toml.dumps(model))
    assert read == {"a b": model["a b"], "list": model["list"]}


def test_all_faults_come_at_once_without_lines_that_nobody_wrote(models):
    with open(models / "ramp.toml", "rb") as file:
        document = tomllib.load(file)
    document["materials"]["rock"]["density"] = -1.0
    document["solver"]["durration"] = 1.0
    with pytest.raises(edda.ModelError) as caught:
        edda.load(document)
    faults = {fault.key: fault for fault in caught.value.faults}
    assert set(faults) == {"materials.rock.density", "solver.durration"}
    assert "duration" in faults["solver.durration"].remedy
    assert all(fault.file == "" and fault.line == 0 for fault in faults.values())
    assert "materials.rock.density: -1 is out of range" in str(caught.value)
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.faults == caught.value.faults


def test_what_toml_cannot_hold_is_a_fault():
    with pytest.raises(edda.ModelError) as caught:
        edda.load({"block": [{"name": "a", "polygon": object()}], "x": 1j})
    assert [fault.key for fault in caught.value.faults] == ["block.a.polygon", "x"]


def test_faults_of_files_and_overrides_say_where(tmp_path, models):
    path = tmp_path / "bad.toml"
    path.write_text((models / "ramp.toml").read_text().replace("density = ", "density = -"))
    with pytest.raises(edda.ModelError) as caught:
        edda.load(path)
    assert caught.value.faults[0].file == str(path) and caught.value.faults[0].line > 0
    with pytest.raises(edda.ModelError) as caught:
        edda.load(models / "ramp.toml", {"solver.duration": -1})
    assert str(caught.value).startswith('overrides["solver.duration"]: solver.duration: ')
    with pytest.raises(edda.ModelError) as caught:
        edda.load(models / "ramp.toml", ["solver.duration=-1"])
    assert caught.value.faults[0].file == "--set"
    with pytest.raises(edda.ModelError):
        edda.load(tmp_path / "nothing.toml")
    with pytest.raises(TypeError):
        edda.load(models / "ramp.toml", "solver.duration=1")


def test_overrides_as_dict_or_list(models):
    for overrides in ({"solver.duration": 0.5}, ["solver.duration=0.5"]):
        assert edda.load(models / "ramp.toml", overrides).duration == 0.5
    model = edda.load(models / "ramp.toml", {"joints.ramp.friction_angle": "0.1 rad", "title": 'a "title"'})
    assert model.title == 'a "title"'


def test_cut_keeps_the_area_and_tells_the_joint_of_each_edge(models):
    cut = edda.load(models / "cavern.toml").cut()
    assert len(cut.blocks) > 100 and cut.smallest_edge > 0.0
    for block in cut.blocks:
        x, y = block.rings[0].T
        area = 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
        assert area == pytest.approx(block.area)
        assert [len(j) for j in block.joints] == [len(r) for r in block.rings]


def test_cut_is_what_the_program_writes(models, program, tmp_path):
    program("cut", models / "cavern.toml", "-o", tmp_path / "cut.csv")
    table = edda.results.read_table(tmp_path / "cut.csv")
    cut = edda.load(models / "cavern.toml").cut()
    corners = np.vstack([ring for block in cut.blocks for ring in block.rings])
    assert np.array_equal(corners[:, 0], table["x"]) and np.array_equal(corners[:, 1], table["y"])


def test_numbers_of_enums_are_numbers():
    class Seed(enum.IntEnum):
        FIRST = 7

    class Ratio(float, enum.Enum):
        HALF = 0.5

    class Law(str, enum.Enum):
        DRY = "dry"

    read = tomllib.loads(edda._toml.dumps({"seed": Seed.FIRST, "ratio": Ratio.HALF, Law.DRY: Law.DRY}))
    assert read == {"seed": 7, "ratio": 0.5, "dry": "dry"}
    assert edda._toml.setting("a.b", Seed.FIRST) == "a.b=7"


def test_whole_numbers_beyond_64_bits_are_faults_with_their_key(models):
    assert tomllib.loads(edda._toml.dumps({"x": [2**63 - 1, -(2**63)]}))["x"] == [2**63 - 1, -(2**63)]
    for number in (2**63, -(2**63) - 1, np.uint64(2**63)):
        with pytest.raises(edda.ModelError) as caught:
            edda.load({"network": [{"name": "fine", "seed": number}], "title": number})
        assert [fault.key for fault in caught.value.faults] == ["network.fine.seed", "title"]
        assert "beyond 64 bits" in str(caught.value)
    with pytest.raises(edda.ModelError, match="solver.duration: is a whole number beyond 64 bits"):
        edda.load(models / "ramp.toml", {"solver.duration": 10**30})
