"""Simulations: views, bits, callbacks, threads, Ctrl-C, changes."""
import gc
import os
import signal
import subprocess
import sys
import threading
import time
import weakref

import edda
import numpy as np
import pytest


@pytest.fixture
def ramp(models):
    return edda.load(models / "ramp.toml", {"solver.duration": 0.05})


@pytest.fixture
def long(models):
    return edda.load(models / "ramp.toml", {"solver.duration": 1000, "output.every": 100, "output.history_every": 100})


def address(array):
    return array.__array_interface__["data"][0]


def state_of(simulation):
    return np.array(simulation.node_x + simulation.node_y)


def test_views_are_no_copies(ramp):
    simulation = edda.Simulation(ramp)
    x, vx, alive = simulation.node_x[1], simulation.node_vx[2], simulation.alive
    assert not x.flags.owndata and x.base is simulation
    before = x.copy()
    for _ in range(5):  # steps exchange arrays inside; views must not notice
        simulation.step()
        assert address(simulation.node_x[1]) == address(x)
        assert address(simulation.node_vx[2]) == address(vx)
        assert address(simulation.alive) == address(alive)
        assert np.array_equal(simulation.node_vx[2], vx)
    simulation.step(200)
    assert not np.array_equal(x, before)


def test_writing_through_a_view_moves_the_block(ramp):
    simulation = edda.Simulation(ramp)
    slider = simulation.block_called("slider")
    simulation.step(3)
    away = np.array([np.sin(np.pi / 6), np.cos(np.pi / 6)])  # off the ramp
    for vx, vy in zip(simulation.node_vx, simulation.node_vy):
        vx[slider], vy[slider] = 2.0 * away
    other = edda.Simulation(ramp)
    other.step(3)
    simulation.advance_to(0.05)
    other.advance_to(0.05)
    moved = (simulation.field("displacement") - other.field("displacement"))[slider] @ away
    assert moved == pytest.approx(2.0 * 0.05 - 0.5 * 9.81 * np.cos(np.pi / 6) * 0.05**2, rel=0.02)
    assert simulation.ledger.external == pytest.approx(0.5 * simulation.mass[slider] * 4.0, rel=0.01)
    assert abs(simulation.ledger.drift) < 1e-3


@pytest.mark.parametrize("name", ["node_x", "node_y"])
def test_positions_cannot_be_written_to(ramp, name):
    simulation = edda.Simulation(ramp)
    with pytest.raises(ValueError):
        getattr(simulation, name)[0][0] = 1.0
    for other in ("area", "mass", "fixed", "alive", "material"):
        assert not getattr(simulation, other).flags.writeable


def test_a_simulation_takes_what_load_takes_and_tells_where_it_is(models):
    simulation = edda.Simulation(models / "ramp.toml")
    simulation.step(3)
    assert repr(simulation) == f"<edda.Simulation of 2 blocks at {simulation.time} s, step 3>"
    assert type(simulation).__module__ == edda.ModelError.__module__ == "edda"
    with pytest.raises(edda.ModelError):
        edda.Simulation({"no": "model"})


def test_views_keep_the_simulation(ramp):
    x = edda.Simulation(ramp).node_x[0]
    gc.collect()
    assert np.all(np.isfinite(x))


def test_results_are_those_of_the_program_bit_for_bit(models, program, tmp_path):
    overrides = {"solver.duration": 0.05}
    program("run", models / "ramp.toml", "-o", tmp_path / "program", "--quiet", "--set", "solver.duration=0.05")
    simulation = edda.Simulation(edda.load(models / "ramp.toml", overrides), results=tmp_path / "python")
    looks = []
    simulation.every(10, lambda s: looks.append((s.time, s.ledger.kinetic, len(s.contacts()))))
    simulation.step(7)
    simulation.advance_to(0.02)
    assert simulation.run().status == "completed"
    assert looks
    written = sorted(p.relative_to(tmp_path / "program") for p in (tmp_path / "program").rglob("*") if p.is_file())
    assert len(written) > 10
    for file in written:
        if file.name != "summary.json":  # which tells the wall time
            assert (tmp_path / "program" / file).read_bytes() == (tmp_path / "python" / file).read_bytes(), file


def test_stages_run_as_in_the_program(models, program, tmp_path):
    short = ["output.every=1", "output.history_every=0.5"]
    program("run", models / "roof-wedge.toml", "-o", tmp_path / "program", "--quiet", *[f"--set={s}" for s in short])
    edda.run(models / "roof-wedge.toml", tmp_path / "python", short)
    for file in ("history.csv", "blocks.csv", "joints.csv"):
        assert (tmp_path / "program" / file).read_bytes() == (tmp_path / "python" / file).read_bytes()


def test_callbacks_see_every_nth_step(ramp):
    simulation = edda.Simulation(ramp)
    seen = []
    number = simulation.every(10, lambda s: seen.append((s is simulation, s.steps)))
    simulation.step(35)
    assert seen == [(True, 10), (True, 20), (True, 30)]
    simulation.forget(number)
    simulation.step(10)
    assert len(seen) == 3
    with pytest.raises(TypeError):
        simulation.every(10, "no function")


def test_a_callback_may_change_what_it_sees(ramp):
    simulation = edda.Simulation(ramp)
    simulation.every(50, lambda s: s.set_velocity("slider", (0.0, 0.0)))
    simulation.step(200)
    assert simulation.ledger.external < 0.0
    free = edda.Simulation(ramp)
    free.step(200)
    assert 0.0 < np.abs(simulation.field("displacement")).max() < 0.5 * np.abs(free.field("displacement")).max()


def test_a_callback_that_raises_stops_the_run(ramp):
    class Mine(Exception):
        pass

    def fail(simulation):
        raise Mine("at " + str(simulation.steps))

    simulation = edda.Simulation(ramp)
    number = simulation.every(15, fail)
    with pytest.raises(Mine, match="at 15"):
        simulation.run()
    assert simulation.steps == 15 and not simulation.over
    simulation.forget(number)
    assert simulation.run().status == "completed"
    untouched = edda.Simulation(ramp)
    untouched.run()
    assert np.array_equal(state_of(simulation), state_of(untouched))


def test_a_run_with_results_that_a_callback_stops_leaves_them_whole(ramp, tmp_path):
    simulation = edda.Simulation(ramp, results=tmp_path / "out")
    simulation.every(15, lambda s: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        simulation.run()
    assert edda.Results(tmp_path / "out").summary["status"] == "interrupted"


def test_stepping_from_a_callback_is_refused(ramp):
    simulation = edda.Simulation(ramp)
    simulation.every(5, lambda s: s.step())
    with pytest.raises(edda.ModelError, match="while the simulation goes on"):
        simulation.run()


class OnTheWay:
    """Progress of a run that does something once, from another thread, when the run is on its way."""

    def __init__(self, act):
        self.act, self.thread = act, None

    def __call__(self, progress):
        if progress.steps > 0 and self.thread is None:
            self.thread = threading.Timer(0.05, self.act)  # by then the run is between two calls of this
            self.thread.start()


def interrupt():
    os.kill(os.getpid(), signal.SIGINT)


def test_ctrl_c_loses_nothing(long, tmp_path):
    simulation = edda.Simulation(long, results=tmp_path / "out", progress=OnTheWay(interrupt), progress_every=0.2)
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        simulation.run()
    assert time.monotonic() - start < 60.0
    results = edda.Results(tmp_path / "out")
    assert results.summary["status"] == "interrupted"
    assert results.summary["steps"] == simulation.steps > 0
    resumed = edda.Simulation(long, results=tmp_path / "out", resume=True)
    assert resumed.steps == simulation.steps
    assert np.array_equal(state_of(resumed), state_of(simulation))
    assert resumed.step(3)


def test_ctrl_c_without_results_pauses(long):
    simulation = edda.Simulation(long, progress=OnTheWay(interrupt), progress_every=0.2)
    with pytest.raises(KeyboardInterrupt):
        simulation.run()
    steps = simulation.steps
    assert steps > 0 and simulation.step(5) and simulation.steps == steps + 5


def test_other_threads_run_meanwhile(long):
    counted = 0
    refused = []

    def count():
        nonlocal counted
        end = time.monotonic() + 0.5
        while time.monotonic() < end:
            counted += 1
        try:
            simulation.field("stress")
        except RuntimeError as error:
            refused.append(str(error))
        simulation.pause()

    on_the_way = OnTheWay(count)
    simulation = edda.Simulation(long, progress=on_the_way)
    outcome = simulation.run()
    on_the_way.thread.join()
    assert outcome.message == "paused"
    assert counted > 10_000
    assert refused and "another thread" in refused[0]
    assert simulation.field("stress").shape == (2, 4)


def test_two_simulations_side_by_side_are_as_one_after_the_other(ramp):
    simulations = [edda.Simulation(ramp) for _ in range(2)]
    threads = [threading.Thread(target=s.run) for s in simulations]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    alone = edda.Simulation(ramp)
    alone.run()
    for simulation in simulations:
        assert np.array_equal(state_of(simulation), state_of(alone))


def test_progress_tells_and_stops(long):
    told = []

    def progress(p):
        told.append(p.steps)
        return len(told) < 3

    simulation = edda.Simulation(long, progress=progress, progress_every=0.0)
    assert simulation.run().status == "interrupted"
    assert len(told) >= 3 and told == sorted(told) and simulation.over


def test_the_last_progress_is_told_whatever_the_clock_says(ramp):
    told = []
    simulation = edda.Simulation(ramp, progress=told.append, progress_every=1e9)
    simulation.run()
    last = told[-1]
    assert (last.steps, last.fraction, last.seconds_left) == (simulation.steps, 1.0, 0.0)
    assert (last.stage, last.stages, last.stage_name) == (0, 1, "")
    assert last.largest_velocity > 0.0


def test_what_the_last_progress_raises_comes_through(ramp, tmp_path):
    simulation = edda.Simulation(ramp, results=tmp_path / "out", progress=lambda p: 1 / (p.steps - 3), progress_every=1e9)
    simulation.step(3)
    with pytest.raises(ZeroDivisionError):
        simulation.finish()
    assert simulation.over and edda.Results(tmp_path / "out").summary["status"] == "interrupted"


def test_looking_from_progress_leaves_the_ledger_alone(ramp):
    drifts = []
    simulation = edda.Simulation(ramp, progress=lambda p: drifts.append(simulation.ledger.drift), progress_every=0.0)
    assert simulation.node_vx
    simulation.run()
    assert len(drifts) > 10 and max(map(abs, drifts)) < 1e-3


class Listener:
    """Counts, and may hold the simulation: a cycle."""

    def __init__(self):
        self.calls = 0
        self.simulation = None

    def __call__(self, told):
        self.calls += 1


@pytest.mark.parametrize("held", ["action", "progress", "warn"])
@pytest.mark.parametrize("cycle", [False, True])
def test_simulations_and_callbacks_are_let_go(ramp, tmp_path, held, cycle):
    listener = Listener()
    gone = weakref.ref(listener)
    given = {} if held == "action" else {held: listener}
    simulation = edda.Simulation(ramp, results=tmp_path / "out", **given)
    if held == "action":
        simulation.every(3, listener)
    if cycle:
        listener.simulation = simulation
    gc.collect()
    simulation.step(10)
    assert listener.calls == {"action": 3, "progress": listener.calls, "warn": 0}[held]
    del listener, simulation, given
    gc.collect()
    assert gone() is None
    assert edda.Results(tmp_path / "out").summary["steps"] == 10


def test_a_forgotten_action_is_let_go(ramp):
    listener = Listener()
    gone = weakref.ref(listener)
    simulation = edda.Simulation(ramp)
    number = simulation.every(3, listener)
    del listener
    simulation.step(3)
    assert gone() is not None
    simulation.forget(number)
    assert gone() is None
    simulation.step(3)


@pytest.mark.parametrize("ending", ["", "raise SystemExit(0)", "1 / 0"])
def test_a_script_that_just_ends_keeps_its_results(models, tmp_path, ending):
    script = f"""
import edda
model = edda.load({str(models / "ramp.toml")!r}, {{"solver.duration": 0.05}})
simulation = edda.Simulation(model, results={str(tmp_path / "out")!r})
vx = simulation.node_vx
def action(s):
    return vx, simulation  # of which no collector knows the whole
simulation.every(5, action)
def cycle():
    here = edda.Simulation(model, results={str(tmp_path / "local")!r})
    views = here.node_vx
    here.every(5, lambda s: views)
    here.step(7)
cycle()
simulation.step(12)
fresh = edda.Simulation(model, results={str(tmp_path / "fresh")!r})
{ending}
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == (1 if "/" in ending else 0), done.stderr
    for name, steps in (("out", 12), ("local", 7)):
        summary = edda.Results(tmp_path / name).summary
        assert (summary["status"], summary["steps"]) == ("interrupted", steps)
    assert not (tmp_path / "fresh").exists()  # nothing had begun


def test_fields_into_a_given_array(ramp):
    simulation = edda.Simulation(ramp)
    simulation.step(100)
    out = np.empty((2, 4))
    assert simulation.field("stress", out) is out
    assert np.array_equal(out, simulation.field("stress"))
    assert simulation.field("rotation").shape == (2,)
    for shape in (3, (4, 2), (2, 4, 1), 8):
        with pytest.raises(ValueError, match="shape"):
            simulation.field("stress", np.empty(shape))
    with pytest.raises(TypeError):
        simulation.field("stress", np.empty((2, 4), dtype=np.float32))
    with pytest.raises(ValueError, match="centroid"):
        simulation.field("strain")


def test_monitors_contacts_and_ledger_agree_with_the_tables(ramp, tmp_path):
    simulation = edda.Simulation(ramp, results=tmp_path / "out")
    simulation.add_monitor("corner", (1.0, 0.3))
    simulation.run()
    results = edda.Results(tmp_path / "out")
    last = results.history[-1]
    for name in ("ux", "uy", "vx", "vy", "sxx", "syy", "sxy"):
        assert getattr(simulation.read("corner"), name) == last["corner." + name]
    for name in ("kinetic", "contact", "friction", "drift"):
        assert getattr(simulation.ledger, name) == last[name]
    assert simulation.unbalanced == last["unbalanced"]
    contacts = simulation.contacts()
    assert len(contacts) == len(results.joints) > 0
    for name in ("x", "y", "normal_force", "shear_force", "opening", "slip", "mobilised", "block_i", "length",
                 "closed_length", "x_a", "y_b", "normal_stress", "normal_stress_a", "normal_stress_b", "shear_stress"):
        assert np.array_equal(contacts[name], results.joints[name])
    words = np.array(["open", "stick", "slide", "bonded"])
    assert np.array_equal(words[contacts["state"]], results.joints["state"])
    blocks = results.blocks
    assert np.array_equal(simulation.field("displacement"), np.column_stack([blocks["ux"], blocks["uy"]]))
    assert np.array_equal(simulation.field("velocity"), np.column_stack([blocks["vx"], blocks["vy"]]))
    assert np.array_equal(simulation.field("omega"), blocks["omega"])


def test_a_bad_folder_is_refused_before_anything_is_cut(ramp, tmp_path):
    (tmp_path / "mine.txt").write_text("keep me")
    with pytest.raises(edda.ModelError):
        edda.Simulation(ramp, results=tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["mine.txt"]
    with pytest.raises(edda.ModelError):
        edda.Simulation(ramp, resume=True)
