"""Warnings, checks, factors of safety and error bars; what a study of parameters counts."""
import math
import pickle
import warnings

import edda
import numpy as np
import pytest

TILT = math.radians(30)
PLANE = {
    "gravity": [9.81 * math.sin(TILT), -9.81 * math.cos(TILT)],
    "materials": {"rock": {"density": 2600, "young": "1 GPa", "poisson": 0.25}},
    "joints": {"plane": {"friction_angle": 33}},
    "block": [
        {"name": "ground", "polygon": [[-1, -1], [9, -1], [9, 0], [-1, 0]], "fixed": True},
        {"name": "slab", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]]},
    ],
    "monitor": [{"name": "slab", "point": [1.0, 0.5]}],
    "solver": {"duration": 0.05},
}
STAGE = {"stage": [{"until": "equilibrium", "duration": 1.0}], "solver": {}}


def test_warnings_are_those_of_check(models):
    model = edda.load(PLANE)
    assert any(w.startswith("gravity acts at once") for w in model.warnings)
    found = edda.check(model)
    assert found.warnings == model.warnings == edda.Simulation(model).warnings
    assert (found.blocks, found.held) == (2, 1)
    assert found.steps * found.time_step == pytest.approx(0.05, rel=1e-6)
    assert "block 1 (slab)" in found.governed_by
    assert edda.check(PLANE, {"solver.duration": 0.1}).steps > found.steps
    assert pickle.loads(pickle.dumps(found)).warnings == found.warnings
    with pytest.raises(edda.ModelError):
        edda.check({**PLANE, "monitor": [{"name": "M", "point": [50, 50]}]})
    with pytest.raises(TypeError):
        edda.check(model, {"solver.duration": 0.1})


def test_a_run_warns_as_python_does():
    with pytest.warns(edda.ModelWarning, match="gravity acts at once"):
        edda.run(PLANE)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert edda.run({**PLANE, **STAGE}).status == "equilibrium"
    with pytest.warns(edda.ModelWarning, match="all 1|the only block"):
        edda.run({**PLANE, "block": PLANE["block"][1:], "joints": {}})


def test_an_outcome_says_whether_anything_moves():
    sliding = edda.run({**PLANE, "joints": {"plane": {"friction_angle": 20}}})
    assert (sliding.status, sliding.at_rest, sliding.fastest) == ("completed", False, 1)
    exact = 9.81 * (math.sin(TILT) - math.tan(math.radians(20)) * math.cos(TILT)) * 0.05
    assert sliding.speed == pytest.approx(exact, rel=0.2)
    assert "still moving: fastest is block 1 (slab)" in sliding.message
    resting = edda.run({**PLANE, **STAGE})
    assert resting.at_rest and resting.failed_checks == []


def test_a_factor_of_safety():
    found = edda.fos({**PLANE, "fos": {"tolerance": 0.005}})
    exact = math.tan(math.radians(33)) / math.tan(TILT)
    assert found.status == "found" and found.factor == pytest.approx(exact, abs=0.005)
    assert found.holds < exact < found.fails
    assert found.mechanism == "sliding along plane: 1 block"
    assert {trial.holds for trial in found.trials} == {True, False}
    assert max(t.factor for t in found.trials if t.holds) == found.holds
    assert pickle.loads(pickle.dumps(found)).trials[0].reason == found.trials[0].reason
    without = {key: value for key, value in PLANE.items() if key != "solver"}
    assert edda.fos({**without, "fos": {"tolerance": 0.005}}).trials[-1].factor == found.trials[-1].factor
    assert edda.load(without).duration == 0
    with pytest.raises(edda.ModelError, match="solver.duration: is missing"):
        edda.check(without)
    assert edda.fos(PLANE, {"joints.plane.type": "glued", "joints.plane.friction_angle": 0}).factor is None


def test_a_limit_load():
    found = edda.limit(PLANE)
    exact = math.tan(math.radians(33)) / math.tan(TILT)
    assert found.status == "found" and found.limit == pytest.approx(exact, rel=1e-5)
    assert found.upper >= found.limit and found.other_end is None and found.residual is None
    assert found.mechanism == "sliding along plane: 1 block"
    (joint,) = found.joints
    assert joint.joint == "plane" and joint.mobilised == pytest.approx(1.0) and joint.normal_force > 0
    again = pickle.loads(pickle.dumps(found))
    assert again.joints[0].fx == joint.fx and again.message == found.message
    pushed = edda.limit(PLANE, {"fos.vary": "kh"})
    # To the left, down the plane, and to the right, up it.
    phi = math.radians(33)
    assert sorted(abs(k) for k in (pushed.limit, pushed.other_end)) == pytest.approx(
        sorted([math.tan(phi - TILT), math.tan(phi + TILT)]), rel=1e-6)
    with pytest.raises(edda.ModelError, match="no gravity"):
        edda.limit(PLANE, {"gravity": [0, 0], "fos.vary": "kh"})


def test_error_bars():
    found = edda.verify(PLANE)
    (bar,) = found.monitors
    assert (bar.monitor, found.failed, found.time) == ("slab", "", 0.05)
    assert 0.0 < bar.step < 0.1 * math.hypot(bar.ux, bar.uy)
    with pytest.raises(edda.ModelError):
        edda.verify({**PLANE, "monitor": []})


def test_a_study_finds_the_probability_of_failure():
    """As docs/python.md does it: by equilibria, sample by sample right, and by one factor of safety."""
    rng = np.random.default_rng(1)
    angles = rng.normal(28.5, 4.0, 20)
    angles = angles[abs(angles - 30) > 0.1]
    ends = [edda.run({**PLANE, **STAGE}, None, {"joints.plane.friction_angle": a}).status for a in angles]
    assert [end != "equilibrium" for end in ends] == list(angles < 30)
    factor = edda.fos(PLANE).factor
    critical = math.degrees(math.atan(math.tan(math.radians(33)) / factor))
    assert critical == pytest.approx(30, abs=0.4)
