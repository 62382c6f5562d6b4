"""Simulations: views, bits, fields, tables."""
import gc

import edda
import numpy as np
import pytest


@pytest.fixture
def ramp(models):
    return edda.load(models / "ramp.toml", {"solver.duration": 0.05})


def address(array):
    return array.__array_interface__["data"][0]


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
