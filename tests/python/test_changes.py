"""Changes by hand, and going on from the end of a stage."""
import edda
import numpy as np
import pytest

LONE = {
    "gravity": [0, 0],
    "materials": {"rock": {"density": 2500, "young": 10e9, "poisson": 0.2}},
    "block": [{"name": "b", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]]}],
    "load": [{"name": "push", "point": [0.5, 0.5], "force": [5e3, 0]}],
    "output": {"every": 0.1, "history_every": 0.05},
}


def moved(simulation):
    return simulation.field("displacement")[0, 0]


def test_changes_are_felt(models):
    model = edda.load(models / "ramp.toml", {"solver.duration": 0.05, "joints.ramp.friction_angle": 40})
    holds, slides = edda.Simulation(model), edda.Simulation(model)
    slides.set_strength_factor(4.0, "ramp")
    holds.run()
    slides.run()
    slip = [np.abs(s.contacts()["slip"]).max() for s in (holds, slides)]
    assert slip[1] > 5.0 * slip[0]
    for wrong in (
        lambda: slides.set_damping(1.0),
        lambda: holds.set_strength_factor(-1.0),
        lambda: holds.set_strength_factor(2.0, "no joint"),
        lambda: holds.excavate(["no opening"]),
        lambda: holds.switch_over(activate=["no load"]),
        lambda: holds.read("no monitor"),
    ):
        with pytest.raises(edda.ModelError):
            wrong()
    with pytest.raises(KeyError):
        edda.Simulation(model).set_velocity("nobody", (0.0, 0.0))
    with pytest.raises(edda.ModelError, match="not free"):
        edda.Simulation(model).set_velocity("ramp", (1.0, 0.0))


def test_a_load_is_switched_off_and_on():
    simulation = edda.Simulation({**LONE, "solver": {"duration": 0.3}})
    simulation.advance_to(0.1)
    simulation.switch_over(deactivate=["push"])
    simulation.advance_to(0.2)
    assert moved(simulation) == pytest.approx(0.01 + 0.02, abs=1e-4)
    simulation.switch_over([], ["push"])
    with pytest.raises(edda.ModelError, match="acts already"):
        simulation.switch_over(activate=["push"])
    with pytest.raises(edda.ModelError, match="in deactivate, too"):
        simulation.switch_over(["push"], ["push"])
    simulation.run()
    assert moved(simulation) == pytest.approx(0.04 + 0.02, abs=1e-3)


def test_displacements_count_from_their_reset():
    simulation = edda.Simulation({**LONE, "solver": {"duration": 0.2}})
    simulation.advance_to(0.1)
    before = moved(simulation)
    simulation.reset_displacements()
    assert before > 0.0 and moved(simulation) == 0.0
    simulation.run()
    assert moved(simulation) == pytest.approx(3.0 * before, rel=0.02)


def test_a_bolt_is_installed_once():
    bolt = {"name": "pin", "from": [0.5, 0.9], "to": [0.5, 0.1], "diameter": 0.02, "type": "end", "pretension": 1e4}
    stages = [{"duration": 0.01}, {"duration": 0.01, "install": ["pin"]}]
    simulation = edda.Simulation({**LONE, "bolt": [bolt], "stage": stages})
    simulation.step()
    simulation.install(["pin"])
    with pytest.raises(edda.ModelError, match="installed before"):
        simulation.install(["pin"])
    with pytest.raises(edda.ModelError, match="no bolt"):
        simulation.install(["no bolt"])
    assert simulation.field("stress")[0, 1] == 0.0
    simulation.step(20)
    assert simulation.field("stress")[0, 1] < 0.0  # pressed along the bolt
    assert simulation.run().status == "completed"


def test_rock_lets_go_more_and_more(models):
    simulation = edda.Simulation(models / "tunnel.toml")
    opening = simulation.model.openings[0]
    simulation.step(4)
    with pytest.raises(edda.ModelError, match="not been excavated yet"):
        simulation.relax(opening, 0.5)
    simulation.excavate([opening])
    simulation.relax(opening, 0.3)
    assert np.count_nonzero(simulation.alive == 0) > 0
    simulation.step(2)
    with pytest.raises(edda.ModelError, match="less than the 0.3 released so far"):
        simulation.relax(opening, 0.2)
    simulation.relax(opening, 1.0)
    simulation.step(2)
    assert abs(simulation.ledger.drift) < 1e-3


def test_threads_change_nothing(models):
    ends = []
    for threads in (1, 2):
        edda.set_threads(threads)
        simulation = edda.Simulation(edda.load(models / "cavern.toml"))
        simulation.step(20)
        ends.append(np.array(simulation.node_x))
    assert np.array_equal(*ends)
    for wrong in (0, -1):
        with pytest.raises(edda.ModelError, match="one thread"):
            edda.set_threads(wrong)


def test_a_run_goes_on_from_the_end_of_a_stage(tmp_path):
    model = edda.load({**LONE, "stage": [{"duration": 0.1}, {"duration": 0.1, "deactivate": ["push"]}]})
    edda.run(model, tmp_path / "out")
    history = (tmp_path / "out/history.csv").read_bytes()
    again = edda.Simulation(model, results=tmp_path / "out", from_stage=1)
    assert (again.time, again.stage) == (0.1, 2)
    assert again.run().status == "completed"
    assert (tmp_path / "out/history.csv").read_bytes() == history
    pushed = edda.Simulation(model, results=tmp_path / "out", from_stage=1)
    pushed.switch_over(activate=["push"])  # against the stage, which has begun
    pushed.run()
    assert moved(pushed) > moved(again) + 1e-3
    with pytest.raises(edda.ModelError):
        edda.Simulation(model, results=tmp_path / "out", from_stage=7)


def test_a_run_with_added_monitors_is_resumed_by_the_model_of_its_folder(models, tmp_path):
    first = edda.Simulation(edda.load(models / "ramp.toml", {"solver.duration": 0.05}), results=tmp_path / "out")
    first.add_monitor("corner", (1.0, 0.3))
    first.step(50)
    first.finish()
    second = edda.Simulation(tmp_path / "out/model.toml", results=tmp_path / "out", resume=True)
    assert second.monitors[-1] == "corner" and second.run().status == "completed"
    assert second.read("corner").ux == edda.Results(tmp_path / "out").history["corner.ux"][-1]


def test_a_change_after_the_end_is_an_error(models, tmp_path):
    simulation = edda.Simulation(edda.load(models / "ramp.toml", {"solver.duration": 0.02}), results=tmp_path / "out")
    vx, vy = simulation.node_vx[1], simulation.node_vy[2]
    outcome = simulation.run()
    slider = simulation.block_called("slider")
    with pytest.raises(edda.ModelError, match="the run is over"):
        simulation.set_velocity("slider", (0.0, 0.0))
    for look in (simulation.step, simulation.run, simulation.finish, lambda: simulation.advance_to(9.0),
                 lambda: simulation.field("velocity"), lambda: simulation.ledger):
        before = vx[slider], vy[slider]
        vx[slider], vy[slider] = 5.0, np.nan
        with pytest.raises(edda.ModelError, match="the run is over"):
            look()
        assert (vx[slider], vy[slider]) == before
        look()
    assert simulation.step() is False and simulation.run().steps == outcome.steps
    assert edda.Results(tmp_path / "out").summary["status"] == "completed"


def test_a_change_in_the_last_progress_is_an_error(models):
    simulation = edda.Simulation(
        edda.load(models / "ramp.toml", {"solver.duration": 0.02}),
        progress=lambda p: simulation.over and simulation.node_vx[0].fill(1.0),
    )
    with pytest.raises(edda.ModelError, match="the run is over"):
        simulation.run()
    assert simulation.over and simulation.run().status == "completed"
