"""Results folders that cannot be used are told at once, and what is in them is left alone."""
import os

import edda
import pytest


@pytest.fixture
def ramp(models):
    return edda.load(models / "ramp.toml", {"solver.duration": 0.05})


def test_a_folder_that_cannot_be_made(ramp, tmp_path):
    (tmp_path / "file").write_text("")
    for folder in ("/proc/nope/x", tmp_path / "file", tmp_path / "file/x"):
        with pytest.raises(edda.ModelError, match="cannot be (made|used)"):
            edda.run(ramp, folder)


def test_a_folder_that_vanishes_before_the_first_step(ramp, tmp_path):
    simulation = edda.Simulation(ramp, results=tmp_path / "a/b")
    (tmp_path / "a").write_text("")
    for act in (simulation.step, simulation.run, simulation.finish, lambda: simulation.set_damping(0.1)):
        with pytest.raises(edda.ModelError, match="cannot be made"):
            act()
        assert simulation.steps == 0 and not simulation.over
    os.remove(tmp_path / "a")
    assert simulation.run().status == "completed"
    assert edda.Results(tmp_path / "a/b").summary["status"] == "completed"


def test_a_folder_that_another_run_is_writing_to(ramp, tmp_path):
    first = edda.Simulation(ramp, results=tmp_path / "out")
    second = edda.Simulation(ramp, results=tmp_path / "out")
    first.step(10)
    written = {p.name: p.read_bytes() for p in (tmp_path / "out").iterdir() if p.is_file()}
    for act in (lambda: second.step(5), second.run, second.finish, lambda: edda.run(ramp, tmp_path / "out")):
        with pytest.raises(edda.ModelError, match="another run is writing to it"):
            act()
        assert not second.over
    assert {p.name: p.read_bytes() for p in (tmp_path / "out").iterdir() if p.is_file()} == written
    assert first.run().status == "completed"
    assert second.run().status == "completed"  # now that the folder is free


def test_a_simulation_that_was_refused_its_folder_ends_quietly(ramp, tmp_path):
    first = edda.Simulation(ramp, results=tmp_path / "out")
    second = edda.Simulation(ramp, results=tmp_path / "out")
    first.step(10)
    with pytest.raises(edda.ModelError):
        second.run()
    del second
    assert not (tmp_path / "out/summary.json").exists()
    first.finish()
    assert edda.Results(tmp_path / "out").summary["steps"] == 10


def test_an_empty_name_is_no_folder(ramp):
    for act in (lambda: edda.run(ramp, ""), lambda: edda.Simulation(ramp, results="")):
        with pytest.raises(edda.ModelError, match="results: names no folder.*None for no results"):
            act()
