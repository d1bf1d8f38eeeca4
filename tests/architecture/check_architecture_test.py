#!/usr/bin/env python3
"""The architecture check finds each kind of breach, and nothing in a sound tree."""
import pathlib
import subprocess
import sys
import tempfile

CASES = {
    "upward arrow": ("libs/core/src/a.cpp", '#include "ostia/geometry/vec.h"\n', "core may not use geometry"),
    "sideways arrow": ("libs/centerline/src/a.cpp", '#include "ostia/meshing/clip.h"\n', "centerline may not use meshing"),
    "truth uses what it judges": ("libs/phantom/src/a.cpp", '#include "ostia/centerline/a.h"\n', "phantom may not use centerline"),
    "VTK in a public header": ("libs/io/include/ostia/io/a.h", "#include <vtkPolyData.h>\n", "third party"),
    "Qt in a library": ("libs/io/src/a.cpp", "#include <QString>\n", "Qt belongs"),
    "TetGen outside its file": ("libs/meshing/src/caps.cpp", "#include <tetgen.h>\n", "tetgen.h may not"),
    "a header's constant that a source hides": ("libs/core/src/a.h", "inline constexpr double far_mm = 1.0;\n", "far_mm hides that of"),
    "unknown room": ("libs/utils/src/a.cpp", "\n", "no place in the picture"),
    "workstation's source in no folder": ("apps/workstation/a.cpp", "\n", "live in its folders"),
    "workstation's folder that is unknown": ("apps/workstation/misc/a.cpp", "\n", "live in its folders"),
    "command's source in no folder": ("apps/ostia/command_a.cpp", "\n", "live in the folders of apps/ostia"),
    "command's folder that is unknown": ("apps/ostia/misc/command_a.cpp", "\n", "live in the folders of apps/ostia"),
    "MainWindow outside the shell": ("apps/workstation/flow/a.h", "class MainWindow;\n", "only shell knows MainWindow"),
    "bindings' source of no room": ("bindings/python/src/helpers.cpp", "\n", "named after its room"),
    "bindings' source that asks a room above": ("bindings/python/src/lumen.cpp", '#include "ostia/session/case_file.h"\n', "lumen may not use session"),
    "what bindings share asks a room": ("bindings/python/src/array.cpp", '#include "ostia/io/surface_file.h"\n', "core and geometry alone"),
    "bindings see a third party": ("bindings/python/src/io.cpp", "#include <vtkPolyData.h>\n", "the libraries' own headers"),
    "pybind11 in a library": ("libs/io/src/a.cpp", "#include <pybind11/numpy.h>\n", "bindings/python alone"),
    "its header outside the shell": ("apps/workstation/flow/a.cpp", '#include "shell/main_window.h"\n', "only shell knows MainWindow"),
}
SOUND = [
    ("libs/meshing/src/a.cpp", '#include "ostia/centerline/a.h"\n#include "ostia/core/error.h"\n'),
    ("apps/ostia/command_table.cpp", '#include "mesh/cli_mesh.h"\n'),
    ("apps/ostia/mesh/command_a.cpp", "\n"),
    ("bindings/python/src/case.cpp", '#include "ostia/session/case_file.h"\n#include <pybind11/stl.h>\n'),
    ("apps/workstation/shell/a.h", "class MainWindow;\n"),
    ("apps/workstation/flow/a.h", "class QMainWindow;\n"),
    ("apps/workstation/main.cpp", '#include "shell/main_window.h"\n'),
]


def run(check, name, text):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / name
        path.parent.mkdir(parents=True)
        path.write_text(text)
        room = pathlib.Path(*pathlib.PurePosixPath(name).parts[:2]) if name.startswith("libs/") else pathlib.Path("libs/core")
        source = pathlib.Path(folder) / room / "src" / "other.cpp"
        source.parent.mkdir(parents=True, exist_ok=True)
        source.write_text("constexpr double far_mm = 2.0;\n")
        return subprocess.run([sys.executable, check, folder], capture_output=True, text=True, check=False)


def main():
    check = sys.argv[1]
    failed = 0
    for title, (name, text, expected) in CASES.items():
        result = run(check, name, text)
        if result.returncode != 1 or expected not in result.stdout:
            print(f"not found: {title}: {result.stdout}")
            failed += 1
    for name, text in SOUND:
        sound = run(check, name, text)
        if sound.returncode != 0:
            print(f"a sound tree was refused: {name}: {sound.stdout}")
            failed += 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
