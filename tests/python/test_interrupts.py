"""Simulations beside others: Ctrl-C, threads and progress."""
import os
import signal
import threading
import time

import edda
import numpy as np
import pytest


@pytest.fixture
def ramp(models):
    return edda.load(models / "ramp.toml", {"solver.duration": 0.05})


@pytest.fixture
def long(models):
    return edda.load(models / "ramp.toml", {"solver.duration": 1000, "output.every": 100, "output.history_every": 100})


def state_of(simulation):
    return np.array(simulation.node_x + simulation.node_y)


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
    assert (last.stage, last.stages, last.stage_name) == (1, 1, "")
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
