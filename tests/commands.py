"""What the tests of whole programs share."""
import subprocess


def run(*command, **options):
    """Standard output of a command that must end well."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout
