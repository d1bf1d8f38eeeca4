#!/usr/bin/env python3
"""Checks that the tree is what docs/architecture.md says: floors, public headers, where heavy libraries may stand.

Usage: check_architecture.py [ROOT]. Prints each breach as FILE:LINE: TEXT and exits with 1 when there is one.
"""
import pathlib
import re
import sys

FLOORS = [
    ["core", "geometry"],
    ["imaging", "dicom", "pacs", "reformat", "io", "figure"],
    ["filtering", "registration", "segmentation", "centerline", "reconstruction", "lumen", "meshing", "hemodynamics", "solver", "motion", "analysis"],
    ["phantom", "evaluation", "coronary", "pipeline"],
    ["session", "experiments", "cohort"],
    ["glview", "view"],
]
GROUND_AND_DATA_ONLY = {"phantom", "evaluation"}
FOREIGN = re.compile(
    r'#\s*include\s*[<"](itk|vtk|gdcm|CGAL/|tetgen|cholmod|sqlite3|SQLiteCpp|nlohmann|spdlog|fmt/|CLI/|tbb/|oneapi/|embree|cairo|pango|'
    r'nanoflann|openssl|dcmtk/|curl/|zlib|isa-l|Q[A-Z])')
OWN = re.compile(r'#\s*include\s*[<"]ostia/([a-z]+)/')
HEADERS_MAY_SHOW_THIRD_PARTIES = {"view", "glview"}
# Each stays in files of its own, because of its licence.
QUARANTINE = {
    "tetgen.h": re.compile(r"libs/meshing/src/mesher/tetgen\w*\.cpp$"),
    "cholmod.h": re.compile(r"libs/lumen/src/interpolation/sparse_factor\.cpp$"),
    "sqlite3.h": re.compile(r"libs/(session|cohort)/src/[\w/]+\.(cpp|h)$"),
}
# The workstation: its frame, and a folder for what a user does, each of which may use the frame and those before it.
# The window that puts them together is known in these sources alone.
FRAME = {"shell", "commands", "views"}
FEATURES = ["opening", "archive", "trees", "phases", "calcium", "vessels", "measuring", "comparison", "pressure", "meshing", "flow", "plugins", "qa", "help"]
WORKSTATION = FRAME | set(FEATURES)
COMPOSED_IN = re.compile(r"shell/(main_window\w*|panel_layout)\.cpp$")
# The command line: what serves all commands, and a folder for what they work on. Above the folders, all of them together.
COMMAND_LINE = {"options", "input", "output", "convert", "pacs", "vessel", "tree", "mesh", "flow", "measure", "motion", "phantom", "evaluate", "experiment", "chain", "cohort", "doctor"}
ABOVE_COMMANDS = {"main", "cli", "commands", "command_table"}
# Python's hands: a source a room, which is named after it, and what they share. pybind11 stands nowhere else.
SHARED_BY_BINDINGS = {"module", "rooms", "array", "call", "errors", "figures", "options", "values"}
PARTS_OF_BINDINGS = {"meshes": "geometry", "trees": "geometry", "graphs": "geometry", "volume": "imaging", "contours": "geometry", "fields": "io", "walls": "lumen", "mesh_options": "meshing",
                     "growth": "analysis", "pipeline_motion": "pipeline", "pipeline_parts": "pipeline", "pipeline_trees": "pipeline",
                     "case": "session", "display": "session", "pressure": "session", "session_parts": "session", "session_tissues": "session", "session_comparison": "session", "session_walls": "session"}
FEATURE_INCLUDED = re.compile(r'#\s*include\s*"([a-z]+)/')


def position(room):
    for floor, rooms in enumerate(FLOORS):
        if room in rooms:
            return floor, rooms.index(room)
    return None


def may_use(user, used):
    if user == used:
        return True
    a, b = position(user), position(used)
    if a is None or b is None:
        return False
    if user in GROUND_AND_DATA_ONLY:
        return b[0] <= 1
    return b[0] < a[0] or (b[0] == a[0] and b[1] < a[1])


def check_file(root, path, breaches):
    relative = path.relative_to(root).as_posix()
    room = path.relative_to(root / "libs").parts[0]
    public = "/include/" in relative
    if position(room) is None:
        breaches.append(f"{relative}:1: the room {room} has no place in the picture")
        return
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        own = OWN.search(line)
        if own and not may_use(room, own.group(1)):
            breaches.append(f"{relative}:{number}: {room} may not use {own.group(1)}")
        if public and room not in HEADERS_MAY_SHOW_THIRD_PARTIES and FOREIGN.search(line):
            breaches.append(f"{relative}:{number}: a public header shows a third party: {line.strip()}")
        if re.search(r'#\s*include\s*<Q[A-Z]', line):
            breaches.append(f"{relative}:{number}: Qt belongs in apps/workstation alone")
        for header, allowed in QUARANTINE.items():
            if re.search(rf'#\s*include\s*[<"]{re.escape(header)}', line) and not allowed.search(relative):
                breaches.append(f"{relative}:{number}: {header} may not be included here")


CONSTANT = re.compile(r"^(?:inline |static )?constexpr [\w:<>, ]+? (\w+)(?: =|\{|;|\[)", re.MULTILINE)


def check_hidden_constants(room, root, breaches):
    """Sources are compiled in batches: a source's own constant would be used by the next source in the batch in
    place of a header's of the same name, without a word."""
    known = {}
    for header in sorted(room.rglob("*.h")):
        for name in CONSTANT.findall(header.read_text(encoding="utf-8")):
            known.setdefault(name, header.relative_to(root).as_posix())
    for source in sorted((room / "src").rglob("*.cpp")):
        text = source.read_text(encoding="utf-8")
        for match in CONSTANT.finditer(text):
            if match.group(1) in known:
                line = text.count("\n", 0, match.start()) + 1
                breaches.append(f"{source.relative_to(root).as_posix()}:{line}: {match.group(1)} hides that of {known[match.group(1)]}")


def check_workstation(root, breaches):
    house = root / "apps" / "workstation"
    for path in sorted(p for p in house.rglob("*") if p.suffix in {".h", ".cpp"}):
        relative = path.relative_to(root).as_posix()
        folders = path.relative_to(house).parts[:-1]
        if folders == () and path.name == "main.cpp":
            continue
        if len(folders) != 1 or folders[0] not in WORKSTATION:
            breaches.append(f"{relative}:1: the workstation's sources live in its folders: {', '.join(sorted(WORKSTATION))}")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            included = FEATURE_INCLUDED.search(line)
            if included and included.group(1) in FEATURES and not COMPOSED_IN.search(relative):
                before = FEATURES[: FEATURES.index(folders[0]) + 1] if folders[0] in FEATURES else []
                if included.group(1) not in before:
                    breaches.append(f"{relative}:{number}: {folders[0]} may not use {included.group(1)}")
            if folders[0] != "shell":
                if re.search(r"(?<![A-Za-z])MainWindow|main_window\.h", line):
                    breaches.append(f"{relative}:{number}: only shell knows MainWindow; take a Desk, or what is needed of it")


def check_command_line(root, breaches):
    for path in sorted(p for p in (root / "apps" / "ostia").rglob("*") if p.suffix in {".h", ".cpp"}):
        folders = path.relative_to(root / "apps" / "ostia").parts[:-1]
        if folders == () and path.stem in ABOVE_COMMANDS:
            continue
        if len(folders) != 1 or folders[0] not in COMMAND_LINE:
            breaches.append(f"{path.relative_to(root).as_posix()}:1: the commands' sources live in the folders of apps/ostia: {', '.join(sorted(COMMAND_LINE))}")


def check_bindings(root, breaches):
    """A room's source asks its own room, and those below it whose values it hands over."""
    for path in sorted(p for p in (root / "bindings" / "python").rglob("*") if p.suffix in {".h", ".cpp"}):
        relative = path.relative_to(root).as_posix()
        room = PARTS_OF_BINDINGS.get(path.stem, path.stem)
        if path.stem not in SHARED_BY_BINDINGS and position(room) is None:
            breaches.append(f"{relative}:1: a source of the bindings is named after its room")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            own = OWN.search(line)
            if own and path.stem not in SHARED_BY_BINDINGS and not may_use(room, own.group(1)):
                breaches.append(f"{relative}:{number}: {room} may not use {own.group(1)}")
            if own and path.stem in SHARED_BY_BINDINGS and own.group(1) not in {"core", "geometry"}:
                breaches.append(f"{relative}:{number}: what all bindings share uses core and geometry alone")
            if FOREIGN.search(line):
                breaches.append(f"{relative}:{number}: the bindings see the libraries' own headers: {line.strip()}")
    for folder in ("libs", "apps"):
        for path in sorted(p for p in (root / folder).rglob("*") if p.suffix in {".h", ".cpp"}):
            if "pybind11" in path.read_text(encoding="utf-8"):
                breaches.append(f"{path.relative_to(root).as_posix()}:1: pybind11 stands in bindings/python alone")


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__.rsplit("/", 2)[0]).resolve()
    breaches = []
    sources = [p for p in sorted((root / "libs").rglob("*")) if p.suffix in {".h", ".cpp"}]
    if not sources:
        breaches.append("libs: no sources found")
    for path in sources:
        check_file(root, path, breaches)
    for folder in sorted((root / "libs").iterdir()):
        if folder.is_dir() and not any(folder.rglob("*.cpp")):
            breaches.append(f"libs/{folder.name}: an empty room")
        if folder.is_dir():
            check_hidden_constants(folder, root, breaches)
    check_workstation(root, breaches)
    check_command_line(root, breaches)
    check_bindings(root, breaches)
    print("\n".join(breaches) if breaches else f"{len(sources)} files, no breach")
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main())
