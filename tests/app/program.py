"""What the tests of the program from end to end share: a folder for each test, the program run in it, what it wrote."""
import contextlib
import csv
import ctypes
import fcntl
import json
import os
import pathlib
import pty
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest

EDDA = pathlib.Path(sys.argv.pop(1)).resolve()
LIBC = ctypes.CDLL(None)
# Parts of the summary that depend on the machine and the threads, not on the model.
MACHINE = ("wall_seconds", "block_steps_per_second", "threads")


def read_rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def content(folder):
    """Every file but the summary (it has wall times) and the checkpoints."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*"))
            if p.is_file() and not p.name.startswith("checkpoint") and p.name != "summary.json"}


def lasting(folder):
    """The part of the summary that must not depend on the machine or on how often the run was stopped."""
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return {k: v for k, v in summary.items() if k not in MACHINE}


def prepared(more):
    """What a child does first: it obeys signals that a script or nohup made this test ignore, and it ends with this test."""
    def prepare():
        for number in (signal.SIGINT, signal.SIGHUP, signal.SIGPIPE):
            signal.signal(number, signal.SIG_DFL)
        set_parent_death_signal = 1
        LIBC.prctl(set_parent_death_signal, signal.SIGKILL, 0, 0, 0)
        if more:
            more()
    return prepare


def end(process):
    process.kill()
    process.wait()
    for pipe in (process.stdin, process.stdout, process.stderr):
        if pipe:
            pipe.close()


class Program(unittest.TestCase):
    seconds = 300  # that a command, or a wait, may take on a busy machine with sanitizers

    def setUp(self):
        self.dir = pathlib.Path(tempfile.mkdtemp(prefix="edda_test_"))
        self.addCleanup(shutil.rmtree, self.dir, True)

    def edda(self, *args, program=EDDA, cwd=None, preexec_fn=None, **more):
        if not {"stdout", "stderr"} & more.keys():
            more["capture_output"] = True
        return subprocess.run([str(program), *args], cwd=cwd or self.dir, text=True, timeout=self.seconds,
                              preexec_fn=prepared(preexec_fn), **more)

    def expect(self, code, *args, **more):
        done = self.edda(*args, **more)
        self.assertEqual(done.returncode, code, f"{args}: {done.stdout}{done.stderr}")
        return done

    def start(self, *args, program=EDDA, **more):
        """A process that continues; it ends with the test."""
        process = subprocess.Popen([str(program), *args], cwd=self.dir, preexec_fn=prepared(None), **more)
        self.addCleanup(end, process)
        return process

    @contextlib.contextmanager
    def soon(self, what):
        """A wait for `what`, in whatever call, that fails when it takes too long."""
        def fail(*_):
            raise AssertionError(f"{what}: not within {self.seconds} s")
        before = signal.signal(signal.SIGALRM, fail)
        signal.alarm(self.seconds)
        try:
            yield
        finally:
            signal.alarm(0)
            signal.signal(signal.SIGALRM, before)

    def wait_for(self, path, process):
        """Until the file is there, or the process has ended."""
        with self.soon(path):
            while not (self.dir / path).exists() and process.poll() is None:
                time.sleep(0.002)

    def stop_early(self, *args, number=signal.SIGINT, until="checkpoint.h5", **more):
        """The exit code of a run into r that gets the signal once a file is there."""
        for _ in range(20):
            shutil.rmtree(self.dir / "r", ignore_errors=True)
            process = self.start("run", "m.toml", "--quiet", "-o", "r", *args, stderr=subprocess.PIPE, **more)
            self.wait_for("r/" + until, process)
            process.send_signal(number)
            process.communicate(timeout=self.seconds)
            if process.returncode != 0:
                return process.returncode
        self.fail("the run is over before it can be stopped")

    def on_terminal(self, *args, columns=80):
        """What a terminal of that width sees on stderr."""
        main, other = pty.openpty()
        fcntl.ioctl(other, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        run = self.start(*args, stdout=subprocess.DEVNULL, stderr=other)
        os.close(other)
        text = b""
        with self.soon("the end of " + " ".join(args)), contextlib.suppress(OSError), os.fdopen(main, "rb", 0) as terminal:
            while chunk := terminal.read(4096):
                text += chunk
        self.assertEqual(run.wait(self.seconds), 0)
        return text.decode()

    def rows(self, name):
        return read_rows(self.dir / name)
