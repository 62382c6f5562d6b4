"""Runs a command and prints what it took: exit code, wall seconds, processor seconds, peak bytes.

A process of its own, and a small one, because the kernel counts the memory of the process that starts a command
as the command's own. Usage: measure.py SECONDS COMMAND ARGUMENT... (SECONDS: after which the command is ended)
"""
import os
import signal
import sys
import time

KIBIBYTE = 1024  # ru_maxrss is counted in these


def main():
    start = time.monotonic()
    child = os.fork()
    if child == 0:
        os.dup2(2, 1)
        os.execv(sys.argv[2], sys.argv[2:])
    signal.signal(signal.SIGALRM, lambda *_: os.kill(child, signal.SIGKILL))
    signal.alarm(int(sys.argv[1]))
    _, status, usage = os.wait4(child, 0)
    wall = time.monotonic() - start
    print(os.waitstatus_to_exitcode(status), wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * KIBIBYTE)


if __name__ == "__main__":
    main()
