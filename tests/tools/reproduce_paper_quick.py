"""The quick report runs, holds its bounds, and its figures come out the same twice. Usage: reproduce_paper_quick.py EDDA"""
import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
LARGEST_FIGURE = 120_000  # bytes


def reproduce(edda, folder, *more):
    """Runs the tool into `folder`. The page's text."""
    subprocess.run([str(ROOT / "tools" / "reproduce-paper"), "--quick", "--program", edda, "--out", str(folder), *more],
                   check=True)
    return (folder / "paper.md").read_text(encoding="utf-8")


def main():
    if importlib.util.find_spec("matplotlib") is None:
        sys.exit(SKIPPED)
    edda = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        page = reproduce(edda, folder / "all")
        assert not re.search(r"\bnan\b|\bNone\b|\binf\b", page), "a number on the page is none"
        figures = re.findall(r"\]\((figures/paper-\w+\.svg)\)", page)
        assert len(figures) >= 6, figures
        for figure in figures:
            file = folder / "all" / figure
            xml.etree.ElementTree.parse(file)
            assert file.stat().st_size < LARGEST_FIGURE, f"{figure} is large"
        reproduce(edda, folder / "again", "--only", "ramp", "--only", "rotation")
        for figure in ("figures/paper-ramp.svg", "figures/paper-rotation.svg"):
            assert (folder / "again" / figure).read_bytes() == (folder / "all" / figure).read_bytes(), figure


main()
