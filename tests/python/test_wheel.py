"""The wheel that pip would get, of the build at hand, which stays as it is."""
import base64
import hashlib
import os
import subprocess
import sys
import zipfile

import pytest


@pytest.fixture(scope="module")
def wheel(source, tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    sys.path.insert(0, str(source / "cmake"))
    import python_wheel

    build = os.path.dirname(os.environ["EDDA_PROGRAM"])
    return folder / python_wheel.build_wheel(folder, {"build-dir": build})


def test_it_asks_for_pybind11(source, tmp_path, monkeypatch, capfd):
    sys.path.insert(0, str(source / "cmake"))
    import python_wheel

    python_wheel.configure(tmp_path / "with")
    assert "\nEDDA_PYTHON:BOOL=ON\n" in (tmp_path / "with/CMakeCache.txt").read_text()
    monkeypatch.setenv("CMAKE_ARGS", "-DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON")
    with pytest.raises(subprocess.CalledProcessError):
        python_wheel.configure(tmp_path / "without")
    assert "pybind11" in capfd.readouterr().err


def test_it_imports_and_runs_alone(wheel, models, tmp_path):
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    code = f"import edda; print(edda.__file__, edda.run({str(models / 'ramp.toml')!r}, None, ['solver.duration=0.01']).status)"
    done = subprocess.run([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": str(tmp_path)},
                          capture_output=True, text=True, check=True)
    where, status = done.stdout.split()
    assert where.startswith(str(tmp_path)) and status == "completed"


def test_its_record_is_right(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        record = next(name for name in names if name.endswith("RECORD"))
        rows = [line.split(",") for line in archive.read(record).decode().splitlines()]
        assert [row[0] for row in rows] == names
        for name, digest, size in rows:
            if name == record:
                continue
            data = archive.read(name)
            assert int(size) == len(data)
            found = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            assert digest == "sha256=" + found
    assert {"edda/py.typed", "edda/_edda.pyi", "edda/results.py"} <= set(names)
