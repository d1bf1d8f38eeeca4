"""What it costs to begin."""
import json
import os
import pathlib
import subprocess
import sys

import ostia

MEASURE = """
import resource, json, sys
before = resource.getrusage(resource.RUSAGE_SELF)
import ostia
after = resource.getrusage(resource.RUSAGE_SELF)
seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
peak = [line for line in open("/proc/self/status") if line.startswith("VmHWM")][0].split()[1]
print(json.dumps({"seconds": seconds, "peak_mb": int(peak) / 1024, "numpy": "numpy" in sys.modules}))
"""


def test_the_import_is_short_and_small():
    tries = [json.loads(subprocess.run([sys.executable, "-c", MEASURE], capture_output=True, text=True, check=True).stdout) for _ in range(5)]
    assert min(one["seconds"] for one in tries) <= 0.15
    assert max(one["peak_mb"] for one in tries) <= 60
    assert not tries[0]["numpy"]


def test_it_is_one_version():
    program = pathlib.Path(ostia._places.program())
    said = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    assert said.strip() == f"ostia {ostia.__version__}"


def test_no_name_of_other_libraries_is_exported():
    """VTK's own Python module may be loaded beside it: only the start of the module is seen."""
    symbols = subprocess.run(["nm", "-D", "--defined-only", ostia._ostia.__file__], capture_output=True, text=True, check=True).stdout
    names = [line.split()[-1] for line in symbols.splitlines()]
    assert "PyInit__ostia" in names and not [name for name in names if "ostia" in name and name != "PyInit__ostia"]


def test_beside_vtk():
    script = "import vtkmodules.vtkIOXML, ostia; s = ostia.example_surface(0.6); import ostia.convert as c; print(c.to_vtk(s).GetNumberOfCells() == len(s.triangles))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.strip() == "True", done.stderr


def test_the_worker_is_known(tmp_path):
    """Meshing takes a process of its own, wherever the package is."""
    assert os.access(ostia._places.worker(), os.X_OK)
