"""Runs pytest on a file. Exit 77, skipped, where pytest or NumPy is missing or all tests of the file are skipped.

  run_tests.py FILE
"""
import importlib.util
import sys

missing = [name for name in ("pytest", "numpy") if importlib.util.find_spec(name) is None]
if missing:
    print(f"{', '.join(missing)}: not here, skipped")
    sys.exit(77)

import pytest  # noqa: E402

done = pytest.main(["-q", "-rs", "-p", "no:cacheprovider", sys.argv[1]])
sys.exit(77 if done == pytest.ExitCode.NO_TESTS_COLLECTED else done)
