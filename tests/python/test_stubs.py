"""The stubs say what the module has: every public name, every parameter and its default."""
import ast
import inspect
import pathlib
import re

import edda
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


def test_names_are_exported_and_typed():
    folder = pathlib.Path(edda.__file__).parent
    assert (folder / "py.typed").is_file()
    for name in edda.__all__:
        assert hasattr(edda, name)
    assert edda.__version__ == edda.version()
