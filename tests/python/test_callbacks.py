"""Callbacks of simulations: when they are called, what they may do, and that they are let go."""
import gc
import subprocess
import sys
import weakref

import edda
import numpy as np
import pytest


@pytest.fixture
def ramp(models):
    return edda.load(models / "ramp.toml", {"solver.duration": 0.05})


def state_of(simulation):
    return np.array(simulation.node_x + simulation.node_y)


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
    with pytest.raises(edda.ModelError, match="while the simulation is running"):
        simulation.run()


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
