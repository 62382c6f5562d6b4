"""Instructions per block and step, counted by callgrind: they are the same however busy the machine is."""
import json
import pathlib
import re
import subprocess
import tempfile

from speed.programs import title_of_pair
from speed.scenes import QUICK, SMALL, blocks_of


def parts(listing):
    """Share and name of each function, largest first."""
    found = re.findall(r"^ *[\d,]+ \(([ \d.]+)%\)\s+\S*?:(?:edda::)?(.*?)(?: \[.*\])?$", listing, re.M)
    names = [(share.strip() + " %", re.sub(r"\(anonymous namespace\)::|edda::|[(<].*$", "", name)) for share, name in found]
    return [(share, name) for share, name in names if name != "PROGRAM TOTALS"]


def where(listing):
    return ", ".join(f"{name} {share}" for share, name in parts(listing)[:12])


def count(programs, name):
    """Blocks of the scene, instructions per block and step, and callgrind's listing of functions."""
    steps = max(16, 200_000 // blocks_of(name))
    with tempfile.TemporaryDirectory(prefix="bench-") as folder:
        out = pathlib.Path(folder) / "callgrind.out"
        command = ["valgrind", "--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={out}",
                   *programs.scene(name, "--steps", steps)]
        if name.startswith("wall:"):  # once without valgrind: what it came to is kept
            subprocess.run(programs.scene(name, "--steps", "1"), env=programs.environment, check=True, capture_output=True)
        text = subprocess.run(command, env=programs.environment, check=True, capture_output=True, text=True).stdout
        scene = json.loads(text.splitlines()[0])
        counted = int(re.search(r"^totals: (\d+)", out.read_text(encoding="utf-8"), re.M).group(1))
        listing = subprocess.run(["callgrind_annotate", "--threshold=90", str(out)], check=True, capture_output=True,
                                 text=True).stdout
    return scene["blocks"], counted / steps / scene["blocks"], listing


def vectors(listing):
    return "AVX2" if "arch_x86_64_v3" in listing else "none"


def instructions(given, programs, other):
    print("Instructions of the vector code that callgrind's processor takes: it knows no AVX-512.")
    if other:
        print(title_of_pair(programs, other))
        print(f"{'scene':16s} {'blocks':>7s} {'before':>8s} {'after':>8s} {'ratio':>6s} {'vectors':>8s}   where")
    else:
        print(f"{'scene':16s} {'blocks':>7s} {'per block-step':>15s} {'vectors':>8s}   where")
    for name in given.scene or (QUICK if given.quick else SMALL):
        blocks, after, listing = count(programs, name)
        if not other:
            print(f"{name:16s} {blocks:7d} {after:15.0f} {vectors(listing):>8s}   {where(listing)}", flush=True)
            continue
        _, before, listing_before = count(other, name)
        print(f"{name:16s} {blocks:7d} {before:8.0f} {after:8.0f} {after / before:6.3f} {vectors(listing):>8s}   "
              f"before: {where(listing_before)}\n{'':60s}after: {where(listing)}", flush=True)
