"""What is given wrong is an IndexError, a TypeError or a ValueError, at once."""
import edda
import numpy as np
import pytest


@pytest.fixture
def simulation(models):
    return edda.Simulation(edda.load(models / "ramp.toml", {"solver.duration": 0.05}))


@pytest.mark.parametrize("block", [-1, 2, 99, 2**70])
def test_blocks_that_are_not_there(simulation, block):
    with pytest.raises(IndexError):
        simulation.set_velocity(block, (0.0, 0.0))
    with pytest.raises(IndexError):
        simulation.name(block)


@pytest.mark.parametrize("block", [1.5, None, [1]])
def test_blocks_that_are_no_numbers(simulation, block):
    with pytest.raises(TypeError):
        simulation.set_velocity(block, (0.0, 0.0))
    with pytest.raises(TypeError):
        simulation.name(block)


def test_blocks_by_numbers_of_numpy(simulation):
    number = np.int64(simulation.block_called("slider"))
    simulation.set_velocity(number, (0.1, 0.0))
    assert simulation.name(number) == "slider"
    with pytest.raises(KeyError):
        simulation.block_called("nobody")


def test_callbacks_that_cannot_be_called(models):
    for name in ("progress", "warn"):
        with pytest.raises(TypeError, match=name):
            edda.Simulation(models / "ramp.toml", **{name: 3})


def test_a_time_that_is_none(simulation, tmp_path):
    with pytest.raises(ValueError):
        simulation.advance_to(float("nan"))
    recorded = edda.Simulation(simulation.model, results=tmp_path / "out")
    recorded.step()
    with pytest.raises(ValueError):
        recorded.advance_to(float("nan"))
    assert recorded.steps == 1 and not recorded.over


def test_answers_of_progress_are_taken_as_python_does(models):
    for answer, duration, status in (([], 1000, "interrupted"), (np.False_, 1000, "interrupted"),
                                     ("go on", 0.01, "completed"), (None, 0.01, "completed")):
        long = {"solver.duration": duration, "output.every": 100, "output.history_every": 100}
        model = edda.load(models / "ramp.toml", long)
        run = edda.Simulation(model, progress=lambda p: answer, progress_every=0.0)
        assert run.run().status == status


def test_velocities_that_are_no_numbers(simulation):
    simulation.step()
    slider = simulation.block_called("slider")
    before = simulation.node_vx[0][slider]
    simulation.node_vx[0][slider] = np.nan
    with pytest.raises(edda.ModelError, match="no number"):
        simulation.step()
    assert simulation.node_vx[0][slider] == before and simulation.step()


def test_pictures_need_a_number_per_block(simulation):
    pytest.importorskip("matplotlib")
    for wrong in (np.zeros(3), np.zeros((2, 2)), np.zeros(1)):
        with pytest.raises(ValueError, match="per block"):
            edda.plot_blocks(simulation, wrong)
    edda.plot_blocks(simulation, [1.0, 2.0])
