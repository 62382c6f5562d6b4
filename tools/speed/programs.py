"""The programs that are measured, of this checkout or of another build, and what is known of them."""
import json
import os
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def build(*targets):
    """Brings build/ up to date. Its path."""
    for command in (["cmake", "--preset", "release"], ["cmake", "--build", "--preset", "release", "--target", *targets]):
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    return ROOT / "build"


class Programs:
    """The programs in a build folder."""

    def __init__(self, folder, threads):
        self.folder = folder.resolve()
        self.threads = threads
        self.environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}

    def scene(self, name, *more):
        return [str(self.folder / "bench" / "bench_scene"), name, "--threads", str(self.threads), "--cache",
                str(self.folder / "bench" / "cache"), *map(str, more)]

    def kernel(self, columns, rows, steps):
        """Million brick-steps per second of the kernel."""
        command = [str(self.folder / "bench" / "bench_kernel"), str(columns), str(rows), str(steps)]
        out = subprocess.run(command, env=self.environment, check=True, capture_output=True, text=True).stdout
        return float(re.search(r"([\d.]+) million brick-steps/s", out).group(1))

    def run(self, model, folder):
        """Of `edda run`."""
        return [str(self.folder / "edda"), "run", str(model), "-o", str(folder), "--threads", str(self.threads), "--json"]

    def commit(self):
        """Of the checkout that the folder was configured for, with a + where its sources have changed since."""
        try:
            cache = (self.folder / "CMakeCache.txt").read_text(encoding="utf-8")
            source = re.search(r"^CMAKE_HOME_DIRECTORY:\w+=(.*)$", cache, re.M)[1]
        except (OSError, TypeError):
            return "unknown commit"
        return commit(source)


class Ended(Exception):
    """A scene ended too early; the text says how. What went wrong in it, it has said itself."""


class Running:
    """A scene that waits for a line before each repetition."""

    def __init__(self, command, environment):
        self.process = subprocess.Popen(command, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def line(self):
        text = self.process.stdout.readline()
        if not text:
            raise Ended(f"{' '.join(self.process.args)}: exit code {self.process.wait()}")
        return json.loads(text)

    def go(self):
        try:
            self.process.stdin.write("\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            pass  # line() says how it ended
        return self.line()


def commit(source=ROOT):
    def git(*words):
        return subprocess.run(["git", *words], cwd=source, check=False, capture_output=True, text=True)
    name = git("rev-parse", "--short", "HEAD").stdout.strip() or "unknown"
    return name + ("" if git("diff", "--quiet", "HEAD", "--", "src", "bench/*.?pp").returncode == 0 else "+")


def processor():
    """Name, family and model: the name alone may be that of several generations."""
    text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    found = [re.search(rf"^{key}\s*: (.*)$", text, re.M) for key in ("model name", "cpu family", "model")]
    return " ".join(f[1].strip() for f in found if f) or os.uname().machine


def circumstances(threads, load):
    """Under which all figures of a table were measured."""
    busy = "" if load < 1.5 else ", busy: the figures are not to be relied on"
    return f"{processor()}, {threads} thread{'s' * (threads > 1)}; load before: {load:.1f}{busy}"


def title_of_pair(programs, other):
    """Which two builds a table compares."""
    return f"before: {other.commit()}, {other.folder}\nafter:  {programs.commit()}, {programs.folder}"
