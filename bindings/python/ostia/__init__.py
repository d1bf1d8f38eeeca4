"""Ostia from Python: from cardiac CT to a coronary tree, its walls, meshes and solver cases.

World coordinates are DICOM's LPS in millimetres; arrays of an image are (z, y, x). Values are immutable, and their arrays are
views of one memory, never copies. docs/reference/python.md tells more.
"""

from ostia import _places
from ostia._start import library as _library
from ostia.errors import Cancelled, Error, GeometryError, InvalidInput, IoError, NumericalError, ResourceError, UsageError

for _name in dir(_library):
    if not _name.startswith("_"):
        globals()[_name] = _value = getattr(_library, _name)
        if isinstance(_value, type):
            _value.__module__ = "ostia"
_worker = _places.worker()
if _worker is not None:
    _library._set_worker_program(_worker)
__version__ = _library.version()
__all__ = sorted(
    [name for name in dir(_library) if not name.startswith("_")]
    + ["Cancelled", "Error", "GeometryError", "InvalidInput", "IoError", "NumericalError", "ResourceError", "UsageError"]
    + ["commands", "convert"]
)


def __getattr__(name: str):
    if name in ("commands", "convert"):  # when they are first asked for
        import importlib

        return importlib.import_module(f"ostia.{name}")
    raise AttributeError(f"module 'ostia' has no attribute '{name}'")
