#!/usr/bin/env python3
"""How far a cavern closes, against the friction angle of its joints.

    cavern_sweep.py cavern.toml -o closure.png
    cavern_sweep.py cavern.toml --angles 15 30 --duration 0.1

Each angle is a simulation of its own; they run side by side, since a simulation that goes on leaves
the interpreter to others. A picture and a table (.csv) come out.
"""
import argparse
import concurrent.futures
import csv
import pathlib

import edda
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def closure(model, angle, duration):
    """Roof towards floor, wall towards wall (m) after a time (s)."""
    overrides = {
        "joints.bare.friction_angle": angle,
        "boundary.sides.stiffness": "190 GPa",  # as stiff as the contacts: a larger step
        "solver.damping": {"local": 0.8},  # towards rest
        "solver.duration": duration,
    }
    simulation = edda.Simulation(edda.load(model, overrides))
    points = {"roof": (0, 10.3), "floor": (0, -8.3), "left": (-9.3, 0), "right": (9.3, 0)}
    for name, point in points.items():
        simulation.add_monitor(name, point)
    outcome = simulation.run()
    if outcome.status != "completed":
        raise RuntimeError(f"friction angle {angle}: {outcome.message}")
    at = {name: simulation.read(name) for name in points}
    return at["floor"].uy - at["roof"].uy, at["left"].ux - at["right"].ux


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", help="cavern.toml")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("closure.png"))
    parser.add_argument("--angles", type=float, nargs="+", default=[5, 15, 25, 35, 45], help="degrees")
    parser.add_argument("--duration", type=float, default=0.3, help="s")
    parser.add_argument("--jobs", type=int, default=2, help="simulations at once")
    arguments = parser.parse_args()

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        tasks = [pool.submit(closure, arguments.model, angle, arguments.duration) for angle in arguments.angles]
        closures = [task.result() for task in tasks]

    with open(arguments.output.with_suffix(".csv"), "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["friction_angle", "roof_to_floor", "wall_to_wall"])
        table.writerows([angle, *pair] for angle, pair in zip(arguments.angles, closures))

    figure, ax = plt.subplots(layout="constrained")
    for label, values in zip(("roof to floor", "wall to wall"), zip(*closures)):
        ax.plot(arguments.angles, [1e3 * value for value in values], "o-", label=label)
    ax.set_xlabel("friction angle (degrees)")
    ax.set_ylabel(f"closure after {arguments.duration:g} s (mm)")
    ax.set_ylim(bottom=0.0)
    ax.legend()
    figure.savefig(arguments.output, dpi=150)
    print(f"wrote {arguments.output} and {arguments.output.with_suffix('.csv')}")


if __name__ == "__main__":
    main()
