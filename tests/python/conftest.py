"""What the tests of the Python package share. Environment: EDDA_PROGRAM, PYTHONPATH."""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

os.environ["MPLBACKEND"] = "Agg"
sys.dont_write_bytecode = True
# A script that started the tests with & made them ignore it.
signal.signal(signal.SIGINT, signal.default_int_handler)

import pytest  # noqa: E402



@pytest.hookimpl(tryfirst=True)
def pytest_configure(config):
    """Folders of their own: those that pytest makes by itself are shared by all tests of one user."""
    if config.option.basetemp is None:
        folder = tempfile.mkdtemp(prefix="edda_python_")
        config.option.basetemp = os.path.join(folder, "tests")
        config.add_cleanup(lambda: shutil.rmtree(folder, ignore_errors=True))


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
