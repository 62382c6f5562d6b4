"""The model in README.md runs and does what the text says. Usage: readme_test.py EDDA"""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def slides(edda, folder, *more):
    """Displacement of every free block, m."""
    subprocess.run([edda, "run", "hillside.toml", "--quiet", *more], cwd=folder, check=True)
    summary = json.loads((folder / "hillside" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "completed", summary["message"]
    with open(folder / "hillside" / "blocks.csv", encoding="utf-8") as table:
        all_slides = [math.hypot(float(row["ux"]), float(row["uy"])) for row in csv.DictReader(table)]
    return [s for s in all_slides if s != 0.0]


def main():
    edda = pathlib.Path(sys.argv[1]).resolve()
    model = re.search(r"```toml\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.S).group(1)
    assert model.count("\n") <= 21, "the README promises a short model"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "hillside.toml").write_text(model, encoding="utf-8")
        found = slides(edda, folder)
        assert len(found) == 5 and all(0.895 < s < 0.915 for s in found), found
        found = slides(edda, folder, "--set", "joints.bed.friction_angle=35")
        assert max(found) < 1e-4, found


main()
