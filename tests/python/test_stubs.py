"""The stubs say what the module has: every public name, every parameter and its default."""
import ast
import inspect
import pathlib
import re

import edda
import numpy as np
import pytest
from edda import _edda

STUB = ast.parse((pathlib.Path(edda.__file__).resolve().parent / "_edda.pyi").read_text())


def public(names):
    return {name for name in names if not name.startswith("_")}


def stub_parameters(function):
    arguments = function.args.args
    plain = len(arguments) - len(function.args.defaults)
    defaults = [None] * plain + [ast.unparse(d) for d in function.args.defaults]
    return [(a.arg, d) for a, d in zip(arguments, defaults) if a.arg != "self"]


def module_parameters(function):
    """From the first line of the docstring, which pybind11 writes: name(self: T, steps: int = 1) -> bool."""
    signature = function.__doc__.splitlines()[0]
    inner = signature[signature.index("(") + 1 : signature.rindex(") ->")]
    found = []
    for part in re.split(r", (?=\w+:)", inner):
        if not part:
            continue
        name, _, rest = part.partition(":")
        default = rest.rpartition(" = ")[2] if " = " in rest else None
        if name != "self":
            found.append((name, default))
    return found


def members(node):
    return {item.name: item for item in node.body if isinstance(item, ast.FunctionDef)}


def test_every_name_is_there_and_no_other():
    classes = {n.name: n for n in STUB.body if isinstance(n, ast.ClassDef)}
    functions = members(STUB)
    assert public(dir(_edda)) == set(classes) | set(functions)
    for name, node in classes.items():
        assert public(vars(getattr(_edda, name))) == public(members(node)), name


def test_parameters_and_defaults_agree():
    checked = 0
    for node in [STUB, *[n for n in STUB.body if isinstance(n, ast.ClassDef)]]:
        owner = _edda if node is STUB else getattr(_edda, node.name)
        for name, function in members(node).items():
            decorators = {d.id for d in function.decorator_list if isinstance(d, ast.Name)}
            member = inspect.getattr_static(owner, name)
            assert ("property" in decorators) == isinstance(member, property), name
            if "property" in decorators:
                continue
            assert module_parameters(getattr(owner, name)) == stub_parameters(function), f"{node}.{name}"
            checked += 1
    assert checked > 25


def test_everything_public_is_documented():
    for name in edda.__all__:
        assert getattr(edda, name).__doc__, name
    for name, kind in vars(_edda).items():
        if inspect.isclass(kind):
            for attribute in public(vars(kind)):
                assert getattr(kind, attribute).__doc__, f"{name}.{attribute}"


def words(text):
    return " ".join((text or "").split())


def test_docstrings_of_stubs_are_those_at_run_time():
    """Which help() shows; behind the line with the signature, which pybind11 writes."""
    checked = 0
    for node in [STUB, *[n for n in STUB.body if isinstance(n, ast.ClassDef)]]:
        owner = _edda if node is STUB else getattr(_edda, node.name)
        if node is not STUB:
            assert words(ast.get_docstring(node)) == words(owner.__doc__)
        for name, member in members(node).items():
            text = getattr(owner, name).__doc__
            if not isinstance(inspect.getattr_static(owner, name), property):
                text = text.partition("\n")[2]
            assert words(ast.get_docstring(member)) == words(text) != "", f"{node}.{name}"
            checked += 1
    assert checked > 100


def test_docstrings_say_arguments_columns_and_units():
    for name in ("model", "results", "resume", "from_stage", "progress", "progress_every", "warn"):
        assert f"\n{name}: " in inspect.cleandoc(edda.Simulation.__init__.__doc__), name
    for name in edda.Simulation({**LONE}).contacts().dtype.names:
        assert name in edda.Simulation.contacts.__doc__, name
    for unit in ("(m)", "(N", "(m/s)", "(Pa", "rad/s"):
        assert unit in edda.Simulation.contacts.__doc__ + edda.Simulation.field.__doc__


LONE = {
    "materials": {"rock": {"density": 2500, "young": 10e9, "poisson": 0.2}},
    "block": [{"name": "b", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]]}],
    "solver": {"duration": 0.01},
}


def annotation(function, argument):
    node = members(next(n for n in STUB.body if isinstance(n, ast.ClassDef) and n.name == "Simulation"))[function]
    return ast.unparse(next(a.annotation for a in node.args.args if a.arg == argument))


def test_stubs_take_what_runs(models):
    """Whole numbers of NumPy, points as lists and arrays, names as tuples."""
    for function, argument in [("name", "block"), ("set_velocity", "block"), ("step", "steps"), ("every", "steps")]:
        assert "SupportsIndex" in annotation(function, argument)
    for function, argument in [("excavate", "openings"), ("install", "bolts"), ("switch_over", "activate")]:
        assert annotation(function, argument) == "Sequence[str]"
    assert annotation("set_velocity", "velocity") == annotation("add_monitor", "point") == "_Point"
    simulation = edda.Simulation({**LONE})
    one = np.int64(1)
    for k, point in enumerate([(0.5, 0.5), [0.5, 0.5], np.array([0.5, 0.5]), np.array([0, 1]), np.float32([0.5, 0.5])]):
        simulation.add_monitor(f"m{k}", point)
        simulation.set_velocity(np.int64(0), point)
    assert simulation.name(np.int32(0)) == "b"
    assert simulation.step(one) and simulation.forget(np.int64(simulation.every(one, print))) is None
    edda.set_threads(one)
    tunnel = edda.Simulation(models / "tunnel.toml")
    tunnel.excavate(("heading",))
    tunnel.install(())
    tunnel.switch_over((), ())
    with pytest.raises(TypeError):
        tunnel.excavate("heading")
    assert edda.Model.read(str(models / "ramp.toml"), ("solver.duration=0.5",)).duration == 0.5


def test_names_are_exported_and_typed():
    folder = pathlib.Path(edda.__file__).parent
    assert (folder / "py.typed").is_file()
    for name in edda.__all__:
        assert hasattr(edda, name)
    assert edda.__version__ == edda.version()
