"""The types are complete, and strict mypy is content with the examples."""
import ast
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import ostia
import printed
from ostia import _ostia

PACKAGE = pathlib.Path(ostia.__file__).parent
STUB = ast.parse((PACKAGE / "__init__.pyi").read_text())
CLASSES = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}
FUNCTIONS = {node.name: node for node in STUB.body if isinstance(node, ast.FunctionDef)}


def public(thing):
    return {name for name in dir(thing) if not name.startswith("_")}


def test_every_public_name_has_types():
    values = {node.target.id for node in STUB.body if isinstance(node, ast.AnnAssign)}
    imported = {alias.asname for node in STUB.body if isinstance(node, ast.ImportFrom) for alias in node.names if alias.asname}
    assert set(ostia.__all__) <= CLASSES.keys() | FUNCTIONS.keys() | values | imported
    assert FUNCTIONS.keys() <= public(_ostia)


@pytest.mark.parametrize("name", sorted(n for n in public(_ostia) if inspect.isclass(getattr(_ostia, n))))
def test_every_member_has_types(name):
    declared = {node.name for node in CLASSES[name].body if isinstance(node, ast.FunctionDef)}
    assert {n for n in declared if not n.startswith("_")} == public(getattr(_ostia, name))


@pytest.mark.parametrize("name", sorted(_ostia._options))
def test_options_are_those_of_the_libraries(name):
    arguments = {argument.arg for argument in FUNCTIONS[name].args.kwonlyargs} - set(signature(getattr(_ostia, name)))
    assert arguments == set(_ostia._options[name])


def help_of(thing):
    """Without the lines of its signatures, which pybind11 writes by itself."""
    lines = (thing.__doc__ or "").splitlines()
    return [line for line in lines if line.strip() and "->" not in line and line != "Overloaded function."]


def test_every_name_has_help():
    values = {name: getattr(_ostia, name) for name in public(_ostia)}
    assert [name for name, value in values.items() if callable(value) and not help_of(value)] == []


def signature(function):
    """Names of arguments as the module has them: name(a: int, *, b: float = 1.0, **kwargs) -> int."""
    inside = function.__doc__.split("\n", 1)[0].split("(", 1)[1].rsplit(") ->", 1)[0]
    return re.findall(r"(?:^|, )(\*{0,2}\w+)(?=:|,|$)", inside)


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_arguments_are_those_of_the_module(name):
    function = getattr(_ostia, name)
    if "Overloaded function." in function.__doc__:
        pytest.skip("its first line has no arguments")
    declared = FUNCTIONS[name].args
    ours = [argument.arg for argument in declared.args + declared.kwonlyargs if argument.arg not in _ostia._options.get(name, {})]
    assert ours == [argument for argument in signature(function) if not argument.startswith("*")]


@pytest.mark.skipif(shutil.which("mypy") is None, reason="mypy is not there: apt install mypy")
def test_strict_mypy_is_content(source, tmp_path):
    examples = sorted((source / "examples" / "python").glob("*.py")) + sorted((source / "examples" / "plugins").glob("*.py"))
    printed_code = {f"recipe_{number}": code for number, _, _, code in printed.recipes(source)}
    printed_code |= {"notebook_" + path.stem.replace("-", "_"): printed.code_of(path) for path in printed.notebooks(source)}
    assert examples and len(printed_code) > 20
    for name, code in printed_code.items():
        examples.append(tmp_path / f"{name}.py")
        examples[-1].write_text(code)
    environment = {**os.environ, "MYPYPATH": str(PACKAGE.parent)}
    for what in (["-p", "ostia"], [str(example) for example in examples]):
        done = subprocess.run(["mypy", "--strict", "--ignore-missing-imports", "--cache-dir", str(tmp_path / "cache"), *what],
                              capture_output=True, text=True, env=environment, cwd=tmp_path)
        assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("example", ["first_model.py", "edits.py", "study.py"])
def test_examples_run(source, tmp_path, example):
    done = subprocess.run([sys.executable, str(source / "examples" / "python" / example), str(tmp_path), "--small"],
                          capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert list(tmp_path.iterdir())
    assert example != "study.py" or (tmp_path / "study.png").stat().st_size > 1000


def python_of(page):
    return "\n".join(re.findall(r"^```python\n(.*?)^```$", page.read_text(), re.S | re.M))


@pytest.mark.parametrize("page", ["README.md", "docs/reference/python.md"])
def test_what_the_texts_print_runs(source, tmp_path, monkeypatch, page):
    code = python_of(source / page)
    assert "ostia" in code
    monkeypatch.chdir(tmp_path)
    ostia.write_surface("lumen.stl", ostia.example_surface(0.6))
    exec(compile(code, page, "exec"), {})
    assert len(list(tmp_path.iterdir())) > 1
