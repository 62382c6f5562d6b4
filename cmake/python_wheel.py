"""What `pip install .` calls (PEP 517): the module built by CMake, for the Python that asks, packed as a wheel.

It needs a compiler, CMake, Ninja, pybind11 and the libraries of docs/dependencies.md, and nothing that would have to be
downloaded. Options for CMake come from the environment variable CMAKE_ARGS; the setting build-dir names a build folder whose
module is packed as it is, not built (pip wheel --config-settings build-dir=build .).
"""
import base64
import hashlib
import os
import pathlib
import re
import shlex
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    given = (config_settings or {}).get("build-dir")
    if given:
        return _pack(pathlib.Path(given), pathlib.Path(wheel_directory))
    with tempfile.TemporaryDirectory(prefix="edda_wheel_") as folder:
        configure(folder)
        subprocess.run(["cmake", "--build", folder, "--target", "edda_python"], check=True)
        return _pack(pathlib.Path(folder), pathlib.Path(wheel_directory))


def configure(build):
    """The module alone, and nothing without pybind11."""
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DEDDA_TESTS=OFF", "-DEDDA_BENCH=OFF", "-DEDDA_PYTHON=ON",
               "-DCMAKE_REQUIRE_FIND_PACKAGE_pybind11=ON", f"-DEDDA_PYTHON_EXECUTABLE={sys.executable}"]
    options += shlex.split(os.environ.get("CMAKE_ARGS", ""))
    subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", build, *options], check=True)


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    information = pathlib.Path(metadata_directory) / f"edda-{_version()}.dist-info"
    information.mkdir()
    (information / "METADATA").write_text(_metadata(), encoding="utf-8")
    (information / "WHEEL").write_text(_wheel_file(), encoding="utf-8")
    return information.name


def build_sdist(sdist_directory, config_settings=None):
    stem = f"edda-{_version()}"
    path = pathlib.Path(sdist_directory) / f"{stem}.tar.gz"
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    with tempfile.TemporaryDirectory() as folder, tarfile.open(path, "w:gz", format=tarfile.PAX_FORMAT) as archive:
        metadata = pathlib.Path(folder) / "PKG-INFO"
        metadata.write_text(_metadata(), encoding="utf-8")
        archive.add(metadata, f"{stem}/PKG-INFO")
        for name in filter(None, names.split("\0")):
            archive.add(ROOT / name, f"{stem}/{name}", recursive=False)
    return path.name


def _version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(edda VERSION ([\d.]+)", text).group(1)


def _metadata():
    with open(ROOT / "pyproject.toml", "rb") as file:
        project = tomllib.load(file)["project"]
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {_version()}",
             f"Summary: {project['description']}", f"License: {project['license']['text']}",
             f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {name}" for name in project["dependencies"]]
    for extra, names in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *[f'Requires-Dist: {name}; extra == "{extra}"' for name in names]]
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", (ROOT / project["readme"]).read_text("utf-8")])


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _wheel_file():
    return f"Wheel-Version: 1.0\nGenerator: edda {_version()}\nRoot-Is-Purelib: false\nTag: {_tag()}\n"


def _pack(build, wheel_directory):
    information = f"edda-{_version()}.dist-info"
    if not (build / "python/edda").is_dir():
        raise FileNotFoundError(f"{build} holds no Python module: build its target edda_python")
    contents = {f"edda/{file.name}": file.read_bytes() for file in sorted((build / "python/edda").iterdir()) if file.is_file()}
    contents[f"{information}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    contents[f"{information}/METADATA"] = _metadata().encode()
    contents[f"{information}/WHEEL"] = _wheel_file().encode()
    record = "".join(f"{name},sha256={_hash(data)},{len(data)}\n" for name, data in contents.items())
    contents[f"{information}/RECORD"] = f"{record}{information}/RECORD,,\n".encode()
    path = wheel_directory / f"edda-{_version()}-{_tag()}.whl"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, data in contents.items():
            wheel.writestr(name, data)
    return path.name


def _hash(data):
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
