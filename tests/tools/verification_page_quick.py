"""The page of known answers comes out whole: every row, every bound held, figures that can be read.

Usage: verification_page_quick.py RECORDS, a folder into which the tests have recorded (tests/verification/record.hpp)
"""
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
NUMBER = r"\| (\d+) \|"


def rows_of(text):
    """The numbers in the first column of its tables."""
    return {int(number) for number in re.findall(rf"^{NUMBER}", text, re.M)}


def check_figures(folder, page):
    figures = re.findall(r"\]\((figures/verification-\d\d\.svg)\)", page)
    assert len(figures) == len(set(figures)) >= 21, figures
    for figure in figures:
        file = folder / figure
        xml.etree.ElementTree.parse(file)
        assert file.stat().st_size < LARGEST_FIGURE, f"{figure} is large"


def check_rows(page):
    planned = rows_of((ROOT / "docs" / "validation.md").read_text(encoding="utf-8"))
    assert len(planned) >= 21 and rows_of(page) >= planned, rows_of(page) ^ planned
    verdicts = dict(re.findall(rf"^{NUMBER} .*\| ([^|]+) \|$", page, re.M))
    for row, verdict in verdicts.items():
        held = re.fullmatch(r"(\d+) of (\d+) hold", verdict)
        assert held and held[1] == held[2] != "0", f"row {row}: {verdict}"
    for row in verdicts:
        assert re.search(rf"^## {row}\. ", page, re.M), f"row {row} has no section"


def main():
    if importlib.util.find_spec("matplotlib") is None:
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([str(ROOT / "tools" / "verification-page"), "--records", sys.argv[1], "--out", name], check=True)
        page = (folder / "verification.md").read_text(encoding="utf-8")
        assert not re.search(r"\bnan\b|\bNone\b|\binf\b", page), "a number on the page is none"
        check_rows(page)
        check_figures(folder, page)


main()
