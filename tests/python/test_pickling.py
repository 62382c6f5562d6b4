"""What a run returns may be copied and goes from process to process."""
import copy
import pickle
import subprocess
import sys

import edda
import numpy as np
import pytest


@pytest.fixture(scope="module")
def records(models):
    told = []
    model = edda.load(models / "ramp.toml", {"solver.duration": 0.02})
    simulation = edda.Simulation(model, progress=told.append, progress_every=0.0)
    outcome = simulation.run()
    reading = simulation.read(simulation.monitors[0])
    return {"outcome": outcome, "ledger": simulation.ledger, "progress": told[-1], "reading": reading}


def values(record):
    return {name: getattr(record, name) for name in dir(record) if not name.startswith("_")}


WAYS = [copy.copy, copy.deepcopy, *[lambda r, p=p: pickle.loads(pickle.dumps(r, p)) for p in range(2, 6)]]


@pytest.mark.parametrize("name", ["outcome", "ledger", "progress", "reading"])
@pytest.mark.parametrize("way", WAYS)
def test_records_are_the_same_again(records, name, way):
    record = records[name]
    again = way(record)
    assert again is not record and type(again) is type(record)
    assert values(again) == values(record) and len(values(record)) > 5
    assert repr(again) == repr(record)


@pytest.mark.parametrize("way", WAYS)
def test_cuts_are_the_same_again(models, way):
    cut = edda.load(models / "cavern.toml").cut()
    again = way(cut)
    assert len(again.blocks) == len(cut.blocks) and again.notes == cut.notes
    for name in ("trimmed", "merged", "smallest_area", "smallest_edge", "smallest_angle"):
        assert getattr(again, name) == getattr(cut, name)
    for a, b in zip(again.blocks, cut.blocks):
        assert (a.name, a.material, a.fixed, a.area) == (b.name, b.material, b.fixed, b.area)
        assert all(map(np.array_equal, a.rings, b.rings)) and all(map(np.array_equal, a.joints, b.joints))


def test_tables_and_frames_are_the_same_again(models, tmp_path):
    edda.run(models / "ramp.toml", tmp_path / "out", {"solver.duration": 0.02})
    results = pickle.loads(pickle.dumps(edda.Results(tmp_path / "out")))
    table = pickle.loads(pickle.dumps(results.blocks))
    assert table.tolist() == results.blocks.tolist() and table["ux"].dtype == np.float64
    frame = pickle.loads(pickle.dumps(results.frames[-1]))
    assert np.array_equal(frame["stress"], results.frames[-1]["stress"])


def test_a_model_copies_to_itself_and_says_what_to_pickle_instead(models):
    model = edda.load(models / "ramp.toml")
    assert copy.copy(model) is model and copy.deepcopy([model])[0] is model
    with pytest.raises(TypeError, match="cannot be pickled: give another process its path"):
        pickle.dumps(model)


def test_a_pool_of_processes_runs_models(models, tmp_path):
    script = tmp_path / "sweep.py"
    script.write_text(f"""
import multiprocessing
import edda

if __name__ == "__main__":
    calls = [({str(models / "ramp.toml")!r}, None, {{"solver.duration": t}}) for t in (0.01, 0.02)]
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        for outcome in pool.starmap(edda.run, calls):
            print(outcome.status, round(outcome.time, 9))
""")
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=False)
    assert done.stdout.splitlines() == ["completed 0.01", "completed 0.02"], done.stderr
