#!/usr/bin/env python3
"""C++ in the documentation is compiled: each block as the body of a function, whose parameters are what the page takes as given.

Usage: snippets_test.py SOURCE COMPILER [-I ... further arguments]
A block that is no code, but its form, has <!-- not compiled: REASON --> above it.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"(?:<!-- not compiled: (?P<why>[^\n]+?) -->\n)?^```cpp\n(?P<code>.*?)^```$", re.M | re.S)
# What the blocks of a page find there.
GIVEN = {
    "docs/methods/boundary-layer.md": "const FacedSurface& surface",
    "docs/methods/flow-extensions.md": "const TriMesh& lumen, const VesselTree& tree",
    "docs/methods/mesh-quality.md": "const MixedMesh& mesh, const TriMesh& model_surface, const FacedSurface& surface, const ForecastOptions& options",
    "docs/methods/meshing.md": "const TriMesh& lumen, const VesselTree& tree",
    "docs/methods/quadratic-elements.md": "const MixedMesh& linear, const TriMesh& reference_wall",
    "docs/methods/tetrahedra.md": "const FacedSurface& surface",
}


def headers(source):
    names = sorted((source / "libs/meshing/include").rglob("*.h"))
    return [f"#include <{path.relative_to(source / 'libs/meshing/include')}>" for path in names]


def main():
    source, compiler = pathlib.Path(sys.argv[1]), sys.argv[2:]
    lines, found, faults = headers(source) + ["namespace ostia {", "using namespace geometry;", "using namespace meshing;"], 0, []
    for page in sorted((source / "docs").rglob("*.md")):
        name, text = str(page.relative_to(source)), page.read_text(encoding="utf-8")
        for block in BLOCK.finditer(text):
            if block["why"]:
                continue
            line = text.count("\n", 0, block.start("code")) + 1
            if name not in GIVEN:
                faults.append(f"{name}:{line}: what this block takes as given is not in snippets_test.py")
                continue
            lines += [f"void block_{found}([[maybe_unused]] int, {GIVEN[name]}) {{", f'#line {line} "{name}"', block["code"], "}"]
            found += 1
    lines.append("}")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "snippets.cpp"
        path.write_text("\n".join(lines) + "\n")
        includes = [f"-I{room}" for room in sorted((source / "libs").glob("*/include"))]
        done = subprocess.run([*compiler, "-std=c++20", "-fsyntax-only", "-w", *includes, str(path)], capture_output=True, text=True, check=False)
    faults += [done.stderr] if done.returncode else []
    print(*faults, sep="\n")
    print(f"{found} blocks compiled, {'with' if faults else 'no'} fault")
    return 1 if faults or not found else 0


if __name__ == "__main__":
    sys.exit(main())
