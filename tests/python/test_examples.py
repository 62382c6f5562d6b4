"""The example scripts, and every block of Python in docs/python.md, run as they stand."""
import csv
import importlib.util
import os
import re
import subprocess
import sys

import pytest

draws = pytest.mark.skipif(importlib.util.find_spec("matplotlib") is None, reason="matplotlib is not here")


def run(*command, cwd):
    done = subprocess.run([sys.executable, *map(str, command)], cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@draws
def test_the_cavern_closes_less_where_joints_are_rougher(models, tmp_path):
    run(models / "python/cavern_sweep.py", models / "cavern.toml", "-o", tmp_path / "closure.png",
        "--angles", 5, 40, "--duration", 0.04, cwd=tmp_path)
    assert (tmp_path / "closure.png").read_bytes().startswith(b"\x89PNG")
    with open(tmp_path / "closure.csv", newline="") as file:
        smooth, rough = csv.DictReader(file)
    assert (float(smooth["friction_angle"]), float(rough["friction_angle"])) == (5.0, 40.0)
    assert float(smooth["roof_to_floor"]) > 1.05 * float(rough["roof_to_floor"]) > 0.0


@draws
def test_the_script_in_cells_runs(models, tmp_path):
    out = run(models / "python/first_steps.py", cwd=tmp_path)
    assert "status='completed'" in out


def test_every_example_has_a_test(models):
    scripts = {p.name for p in (models / "python").glob("*.py")}
    assert scripts == {"cavern_sweep.py", "first_steps.py"}


def blocks_of_manual(source):
    text = (source / "docs/python.md").read_text()
    return re.findall(r"^```python\n(.*?)^```", text, re.S | re.M)


@draws
def test_the_manual_runs_from_top_to_bottom(source, models, tmp_path):
    """In a folder that holds the models it names, one block after the other."""
    blocks = blocks_of_manual(source)
    assert len(blocks) > 8
    for name in ("ramp.toml", "cavern.toml", "tunnel.toml"):
        os.symlink(models / name, tmp_path / name)
    script = tmp_path / "manual.py"
    script.write_text("\n".join(blocks))
    run(script, cwd=tmp_path)


@pytest.mark.parametrize("page", ["python.md", "library.md"])
def test_names_in_the_manual_exist(source, page):
    import edda

    text = (source / "docs" / page).read_text()
    for name in re.findall(r"`edda\.(\w+)", text):
        assert hasattr(edda, name) or name in {"hpp", "api"}, name
    for name in re.findall(r"`simulation\.(\w+)", text):
        assert hasattr(edda.Simulation, name), name


@draws
def test_the_page_that_greets_runs(source, tmp_path):
    """The model and the script of README.md."""
    text = (source / "README.md").read_text()
    for name, language in (("hillside.toml", "toml"), ("script.py", "python")):
        (tmp_path / name).write_text(re.search(rf"^```{language}\n(.*?)^```", text, re.S | re.M).group(1))
    assert len(run("script.py", cwd=tmp_path).splitlines()) > 3
    assert (tmp_path / "hillside.png").stat().st_size > 5000
