"""Where the programs are that belong to this package."""

from __future__ import annotations

import os
import pathlib
import shutil

_package = pathlib.Path(__file__).resolve().parent


def program() -> str | None:
    """The command `ostia`: $OSTIA_PROGRAM, the one of the build tree or the prefix that the package is in, or on the path."""
    given = os.environ.get("OSTIA_PROGRAM")
    if given:
        return given
    places = [_package.parents[1] / "bin" / "ostia"]  # BUILD/python/ostia
    places += [above / "bin" / "ostia" for above in _package.parents[2:5]]  # PREFIX/lib/python3/dist-packages/ostia
    for place in places:
        if os.access(place, os.X_OK) and place.is_file():
            return str(place)
    return shutil.which("ostia")


def worker() -> str | None:
    """The program that meshes and decodes in a process of its own; None: the library looks for it."""
    if "OSTIA_WORKER" in os.environ:
        return None
    found = program()
    if found is None:
        return None
    folder = pathlib.Path(found).resolve().parent
    for place in (folder / "ostia-worker", folder.parent / "libexec" / "ostia" / "ostia-worker"):
        if place.is_file():
            return str(place)
    return None
