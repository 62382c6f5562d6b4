"""Speed and memory on the scenes of bench/scenes.hpp, beside the kernel; the critical step against the true one."""
import csv
import datetime
import json
import os
import re
import statistics
import subprocess

from speed.programs import ROOT, Running, circumstances, commit, processor

TIMES = 5  # that a scene is measured, unless told otherwise
HISTORY = ROOT / "bench" / "history.csv"
SCENES = ["wall:67x30", "wall:667x30", "wall:3334x30", "wall:33334x30", "collapse:230x87", "heap:5000", "cavern",
          "rock:50", "free:20000", "squeezing", "ground:50"]
SMALL = ["wall:67x30", "collapse:67x30", "heap:2000", "cavern", "rock:50", "free:2000", "squeezing"]
QUICK = ["wall:20x10", "collapse:20x10", "heap:200", "cavern", "rock:10", "free:200", "ground:5"]


def names(given):
    return given.scene or (QUICK if given.quick else SCENES)


def block_steps(given):
    """Of one repetition."""
    return 20_000 if given.quick else 4_000_000


def repetitions(given, usual):
    return given.repeat or (1 if given.quick else usual)


def beside(name, blocks):
    """Columns and rows of the kernel's wall: those of the scene, or as many bricks as it has blocks."""
    size = re.fullmatch(r"wall:(\d+)x(\d+)", name)
    if size:
        return int(size[1]), int(size[2])
    rows = 30 if blocks >= 900 else 10
    return max(1, round(blocks / rows)), rows


def blocks_of(name):
    """How many the name asks for, near enough to choose the number of steps."""
    numbers = [int(n) for n in re.findall(r"\d+", name)]
    if not numbers:
        return {"cavern": 200, "squeezing": 10_000}[name]
    of_square = {"rock": 1, "ground": 9}.get(name.partition(":")[0])  # per m2
    if of_square:
        return of_square * numbers[0] ** 2
    return numbers[0] * (numbers[1] if len(numbers) > 1 else 1)


def steps_of(name, wanted):
    return max(32, wanted // blocks_of(name))


def rate(scene, run):
    """Million block-steps per second."""
    return 1e-6 * scene["blocks"] * run["steps"] / run["seconds"]


def measure(programs, name, times, wanted):
    steps = steps_of(name, wanted)
    running = Running(programs.scene(name, "--wait", "--repeat", times, "--steps", steps), programs.environment)
    scene = running.line()
    columns, rows = beside(name, scene["blocks"])
    runs, kernel = [], []
    for _ in range(times):
        runs.append(running.go())
        kernel.append(programs.kernel(columns, rows, max(10, wanted // (columns * rows))))
    memory = running.line()
    rates = [rate(scene, run) for run in runs]

    def median(key):
        return statistics.median(run[key] for run in runs)
    return {
        "scene": name, "blocks": scene["blocks"], "candidates": scene["candidates"], "closed": scene["closed"],
        "switched_per_step": median("switched") / steps, "searches_per_step": median("searches") / steps,
        "rate": statistics.median(rates), "slowest": min(rates), "fastest": max(rates),
        "kernel_rate": statistics.median(kernel), "ratio": statistics.median(rates) / statistics.median(kernel),
        "steps": steps, "seconds": median("seconds"), "search_s": median("search"), "forces_s": median("forces"),
        "integrate_s": median("integrate"), "bytes_per_block": memory["bytes"] / scene["blocks"],
        "contact_bytes_per_block": memory["contacts"] / scene["blocks"],
        "peak_bytes_per_block": memory["peak"] / scene["blocks"], "row_error": scene["row_error"],
    }


def record(row):
    new = not HISTORY.exists()
    with HISTORY.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(row)
        writer.writerow([f"{v:.4g}" if isinstance(v, float) else v for v in row.values()])


HEAD = ("scene", "blocks", "candidates", "closed", "switch/step", "M block-steps/s", "kernel", "ratio", "search s",
        "forces s", "move s", "bytes/block", "peak")
FORM = "{:16s} {:>9s} {:>11s} {:>9s} {:>11s} {:>15s} {:>7s} {:>6s} {:>8s} {:>8s} {:>8s} {:>11s} {:>6s}"


def cells(r):
    return (r["scene"], str(r["blocks"]), str(r["candidates"]), str(r["closed"]), f"{r['switched_per_step']:.2f}",
            f"{r['rate']:.3f}", f"{r['kernel_rate']:.2f}", f"{r['ratio']:.3f}", f"{r['search_s']:.3f}",
            f"{r['forces_s']:.3f}", f"{r['integrate_s']:.3f}", f"{r['bytes_per_block']:.0f}",
            f"{r['peak_bytes_per_block']:.0f}")


def speed(given, programs):
    load = os.getloadavg()[0]
    head = {"date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%MZ"), "commit": commit(),
            "processor": processor(), "threads": given.threads, "load": load}
    print(f"{head['commit']} on {circumstances(given.threads, load)}")
    print(FORM.format(*HEAD), flush=True)
    for name in names(given):
        row = measure(programs, name, repetitions(given, TIMES), block_steps(given))
        print(FORM.format(*cells(row)), flush=True)
        if not given.quick and not given.no_record:
            record({**head, **row})


def limit(given, programs):
    print("Steps in s; true: with the contacts that carry, and with all candidates that would if they touched.")
    form = "{:16s} {:>7s} {:>10s} {:>10s} {:>10s} {:>10s} {:>8s} {:>8s}"
    print(form.format("scene", "blocks", "in force", "critical", "true", "true, all", "of true", "of all"))
    for name in given.scene or (QUICK if given.quick else SMALL):
        command = programs.scene(name, "--limit", "100" if given.quick else "2000")
        out = subprocess.run(command, env=programs.environment, check=True, capture_output=True, text=True).stdout
        scene, steps = map(json.loads, out.splitlines())
        critical, now, every = steps["undamped_step"], steps["true_step"], steps["true_step_of_all"]
        print(form.format(name, str(scene["blocks"]), *(f"{x:.3e}" for x in (scene["step"], critical, now, every)),
                          f"{critical / now:.3f}", f"{critical / every:.3f}"), flush=True)


BARRIER = 3e-6  # s, to wake the threads of a loop and to wait for the last of them


def cores(given, programs):
    print("As if there were so many cores, all loops on one: what no loop shares, and what the busiest thread of each has\n"
          f"to do; {1e6 * BARRIER:.0f} us for each loop. Memory is as fast as for one core.")
    form = "{:16s} {:>7s} {:>6s} {:>10s} {:>8s} {:>8s} {:>8s}"
    print(form.format("scene", "blocks", "cores", "us a step", "serial", "loops", "speedup"))
    for name in given.scene or (QUICK if given.quick else SMALL):
        for count in (1, 2, 4, 16, 64):
            steps = str(max(10, block_steps(given) // 4 // blocks_of(name)))
            command = programs.scene(name, "--cores", str(count), "--steps", steps)
            out = subprocess.run(command, env=programs.environment, check=True, capture_output=True, text=True).stdout
            scene, r = map(json.loads, out.splitlines())
            serial = r["seconds"] - r["shared"]
            shared = serial + r["busiest"] + (BARRIER * r["loops"] if count > 1 else 0.0)
            print(form.format(name, str(scene["blocks"]), str(count), f"{1e6 * r['seconds'] / r['steps']:.1f}",
                              f"{serial / r['seconds']:.3f}", f"{r['loops'] / r['steps']:.1f}",
                              f"{r['seconds'] / shared:.2f}"), flush=True)
