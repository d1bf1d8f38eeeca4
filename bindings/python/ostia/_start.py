"""Loads the libraries. Symbols are looked up when they are first used: most of VTK's and HDF5's never are."""

import importlib
import os
import sys
from typing import Any

_before = sys.getdlopenflags()
sys.setdlopenflags(os.RTLD_LAZY | os.RTLD_LOCAL)
try:
    library: Any = importlib.import_module("ostia._ostia")
finally:
    sys.setdlopenflags(_before)
