"""What the tests of the Python package share. Environment: EDDA_PROGRAM, PYTHONPATH."""
import os
import pathlib
import subprocess
import sys

os.environ["MPLBACKEND"] = "Agg"
sys.dont_write_bytecode = True

import pytest  # noqa: E402

SOURCE = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def source():
    return SOURCE


@pytest.fixture(scope="session")
def models():
    return SOURCE / "examples"


@pytest.fixture(scope="session")
def program():
    """Runs the command line."""

    def run(*arguments):
        command = [os.environ["EDDA_PROGRAM"], *map(str, arguments)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run
