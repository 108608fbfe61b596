"""Which state of the program makes the trials: results of different ones do not belong into one table."""

import hashlib
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import understudy

__all__ = ["fingerprint"]

_PACKAGE = Path(understudy.__file__).parent

_TELLING = ("cli/", "figures/", "experiments/reports/")
"""No trial's outcome comes from these."""

_DECIDING = ("mujoco-core", "numpy", "opencv-python-headless")
"""Packages whose versions can change the last bit of a trial, and a bit can change the trial."""


@cache
def fingerprint() -> dict[str, str]:
    """Versions, and a digest of the source of all that trials are made by."""
    digest = hashlib.sha256()
    for path in sorted(_PACKAGE.rglob("*.py")):
        name = path.relative_to(_PACKAGE).as_posix()
        if not name.startswith(_TELLING):
            digest.update(f"{name}\n".encode() + path.read_bytes())
    found = {"understudy": understudy.__version__, "source": digest.hexdigest()[:16]}
    for package in _DECIDING:
        try:
            found[package] = version(package)
        except PackageNotFoundError:  # another build of the same package
            found[package] = "of another build"
    return found
