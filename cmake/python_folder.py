"""Prints where the interpreter looks for packages below a prefix, relative to it."""
import os
import sys
import sysconfig

prefix = os.path.normpath(sys.argv[1])
known = sysconfig.get_scheme_names()
if prefix == "/usr" and "deb_system" in known:
    scheme = "deb_system"
elif prefix == "/usr/local" and "posix_local" in known:
    scheme = "posix_local"
else:
    scheme = "posix_prefix"
base = "/usr" if scheme == "posix_local" else prefix  # Debian's posix_local adds /local itself
folder = sysconfig.get_path("platlib", scheme, vars={"base": base, "platbase": base, "installed_base": base})
print(os.path.relpath(folder, prefix))
