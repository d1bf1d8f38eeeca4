"""The reference has every public name, and words on the shapes and units of the arrays that it takes or gives."""
import ast
import inspect
import os
import pathlib
import re
import subprocess
import sys

import pytest

import ostia
from ostia import _ostia, plugin

STUB = ast.parse((pathlib.Path(ostia.__file__).parent / "__init__.pyi").read_text())
ARRAY = re.compile(r"\b(Floats|Ints|NDArray|ArrayLike|Places?)\b")
SHAPE = re.compile(r"\((?:[a-z]|\d+)(?:, ?(?:[a-z]|\d+))*,?\)")  # (n, 3), (n,), (z, y, x)
UNIT = re.compile(r"(\b|_)(mm[23]?|m_s|Pa|HU|voxels|units?|percent|deg|radians|shares?|relative)\b|\[-?[01], 1\]")
COUNTS = re.compile(r"\b(int32|int64|uint8|bool|ids?|indices|whole numbers)\b")


def declared():
    """Of each function and member in the stub: its name, what annotates it, its words."""
    for node in STUB.body:
        if isinstance(node, ast.FunctionDef):
            yield node.name, node, words(getattr(ostia, node.name))
        elif isinstance(node, ast.ClassDef) and hasattr(ostia, node.name):
            thing = getattr(ostia, node.name)
            for member in node.body:
                if isinstance(member, ast.FunctionDef) and member.name == "__init__":
                    yield node.name, member, words(thing) + "\n" + words(thing.__init__)
                elif isinstance(member, ast.FunctionDef) and not member.name.startswith("_"):
                    yield f"{node.name}.{member.name}", member, words(getattr(thing, member.name))


def words(thing):
    """Its help, without the lines that pybind11 writes and the options, whose units are in their names."""
    lines = (inspect.getdoc(thing) or "").splitlines()
    return "\n".join(line for line in lines if "->" not in line and "**kwargs" not in line and not line.startswith("Options")).strip()


def annotated(node):
    """The types of what it takes, options by keyword of the libraries left out, and of what it gives."""
    options = _ostia._options.get(node.name, {})
    taken = [one for one in node.args.args + node.args.kwonlyargs if one.annotation is not None and one.arg not in options]
    return " ".join([ast.unparse(one.annotation) for one in taken] + ([ast.unparse(node.returns)] if node.returns else []))


def public():
    names = {f"ostia.{name}" for name in ostia.__all__}
    for name in ostia.__all__:
        thing = getattr(ostia, name)
        if inspect.isclass(thing) and not issubclass(thing, BaseException):
            names |= {f"ostia.{name}.{member}" for member in dir(thing) if not member.startswith("_")}
    names |= {f"ostia.convert.{name}" for name in ostia.convert.__all__}
    own = {name for name, value in vars(plugin).items() if getattr(value, "__module__", "") == "ostia.plugin" and not name.startswith("_")}
    names |= {f"ostia.plugin.{name}" for name in own}
    return names | {f"ostia.commands.{name}" for name in [*ostia.commands.names, "Result", "run"]}


@pytest.fixture(scope="module")
def inventory(source, tmp_path_factory):
    """What a build without a warning has in it."""
    pytest.importorskip("sphinx", reason="Sphinx is not there: apt install python3-sphinx")
    from sphinx.util.inventory import InventoryFile

    folder = tmp_path_factory.mktemp("reference")
    done = subprocess.run(
        [sys.executable, "-B", "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", "-d", str(folder / "doctrees"),
         str(source / "docs" / "python"), str(folder / "html")],
        capture_output=True, text=True, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
    assert done.returncode == 0, done.stderr
    with open(folder / "html" / "objects.inv", "rb") as file:
        kinds = InventoryFile.load(file, "", lambda where, name: name)
    return {name for kind, names in kinds.items() if kind.startswith("py:") for name in names}


def test_the_reference_has_every_public_name(inventory):
    assert sorted(public() - inventory) == [], "add them to a page of docs/python"


def test_every_function_and_member_has_words():
    assert [name for name, _, text in declared() if not text] == []


def test_arrays_have_shapes():
    assert [name for name, node, text in declared() if ARRAY.search(annotated(node)) and not SHAPE.search(text)] == []


def test_arrays_and_numbers_have_units():
    """Those of indices, ids and flags have none."""
    def needs(node):
        return ARRAY.search(annotated(node)) or (node.returns is not None and ast.unparse(node.returns) == "float")

    lacking = [name for name, node, text in declared() if needs(node) and not UNIT.search(f"{name} {text}") and not COUNTS.search(text)]
    assert lacking == []


def test_the_rules_see_what_is_missing():
    assert not SHAPE.search("the points, mm") and SHAPE.search("(n, 3), mm") and SHAPE.search("(n,)")
    assert not UNIT.search("the points, (n, 3)") and UNIT.search("length_mm") and UNIT.search("of it, mm3")
    (node,) = ast.parse("def f(points: npt.ArrayLike) -> Floats: ...").body
    assert ARRAY.search(annotated(node)) and not ARRAY.search("dict[str, Any]")
