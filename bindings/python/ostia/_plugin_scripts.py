"""Reads from scripts' text which plug-ins they have, without running them: `python3 -I _plugin_scripts.py ANSWER SCRIPT...`.

Stands alone: the package is not imported for it. Decorators, titles and defaults are therefore literals.
"""

from __future__ import annotations

import ast
import hashlib
import json
import os
import sys
from typing import Any, Optional

GIVES = ("edits", "overlay", "field", "mask")
_TYPES = {"bool": "flag", "int": "whole", "float": "number", "str": "text", "Vessel": "vessel"}
_PYTHON: dict[str, Any] = {"flag": bool, "whole": int, "number": float, "text": str, "choice": str, "vessel": (int, str)}
_MOST_LETTERS = 100


class _Refused(Exception):
    def __init__(self, node: ast.AST, text: str) -> None:
        super().__init__(text)
        self.line = getattr(node, "lineno", 1)


def _last(node: Optional[ast.AST]) -> str:
    """`edits` of `plugin.edits` and of `edits`."""
    return node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else ""


def _literal(node: ast.AST, what: str) -> Any:
    try:
        return ast.literal_eval(node)
    except ValueError:
        raise _Refused(node, f"{what} must be written as it is, as a number, a text, True or False") from None


def _line(node: ast.AST, value: Any, what: str) -> str:
    if not isinstance(value, str) or not value.strip() or "\n" in value or len(value) > _MOST_LETTERS:
        raise _Refused(node, f"{what} is a text of one line and at most {_MOST_LETTERS} letters")
    return value


def _type(argument: ast.arg) -> tuple[str, list[str]]:
    note = argument.annotation
    if isinstance(note, ast.Subscript) and _last(note.value) == "Literal":
        choices = _literal(note.slice, f"the choices of {argument.arg}")
        choices = list(choices) if isinstance(choices, tuple) else [choices]
        if not choices or not all(isinstance(one, str) for one in choices):
            raise _Refused(argument, f"the choices of {argument.arg} are texts")
        return "choice", choices
    known = _TYPES.get(_last(note))
    if known is None:
        raise _Refused(argument, f"the parameter {argument.arg} needs a type: bool, int, float, str, plugin.Vessel or Literal[...]")
    return known, []


def _parameter(argument: ast.arg, default: Optional[ast.AST]) -> dict[str, Any]:
    kind, choices = _type(argument)
    if default is None:
        raise _Refused(argument, f"the parameter {argument.arg} needs a default")
    value = _literal(default, f"the default of {argument.arg}")
    if kind == "number" and isinstance(value, int) and not isinstance(value, bool):
        value = float(value)
    if kind == "vessel" and isinstance(value, int):
        value = "" if value < 0 else str(value)
    if not isinstance(value, _PYTHON[kind]) or (kind == "whole" and isinstance(value, bool)) or (choices and value not in choices):
        raise _Refused(default, f"the default of {argument.arg} is not of its type")
    if isinstance(value, float) and value - value != 0.0:
        raise _Refused(default, f"the default of {argument.arg} is not finite")
    return {"name": argument.arg, "type": kind, "value": value, "choices": choices}


def _parameters(function: ast.FunctionDef) -> list[dict[str, Any]]:
    all_of = function.args
    if all_of.vararg or all_of.kwarg or not all_of.posonlyargs + all_of.args:
        raise _Refused(function, f"{function.name} takes what it is given first, and then parameters with names")
    plain = all_of.posonlyargs + all_of.args
    none: list[Optional[ast.AST]] = [None] * (len(plain) - len(all_of.defaults))
    pairs = list(zip(plain, none + list(all_of.defaults)))[1:]
    pairs += list(zip(all_of.kwonlyargs, all_of.kw_defaults))
    return [_parameter(argument, default) for argument, default in pairs]


def _plugin(function: ast.FunctionDef, mark: ast.Call) -> dict[str, Any]:
    named: dict[Optional[str], Optional[ast.AST]] = {one.arg: one.value for one in mark.keywords}
    title = mark.args[0] if mark.args else named.pop("title", None)
    if title is None or len(mark.args) > 1:
        raise _Refused(mark, f"the mark of {function.name} has a title: @plugin.{_last(mark.func)}(\"...\")")
    version, image = named.pop("version", None), named.pop("image", None)
    if named:
        raise _Refused(mark, f"the mark of {function.name} has no {next(iter(named))}; it takes a title, version and image")
    gives = _last(mark.func)
    return {
        "name": function.name,
        "title": _line(title, _literal(title, "the title"), "the title"),
        "version": "" if version is None else _line(version, _literal(version, "the version"), "the version"),
        "text": " ".join((ast.get_docstring(function) or "").split("\n\n")[0].split()),
        "gives": gives,
        "image": gives == "mask" or (image is not None and bool(_literal(image, "image"))),
        "parameters": _parameters(function),
    }


def plugins_of(text: bytes) -> list[dict[str, Any]]:
    """Of a script. Throws SyntaxError, _Refused."""
    tree = ast.parse(text)
    imported = [alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names]
    imported += [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    if not any(name.split(".")[0] == "ostia" for name in imported):
        return []
    found = []
    for function in tree.body:
        if not isinstance(function, ast.FunctionDef):
            continue
        for mark in function.decorator_list:
            if isinstance(mark, ast.Call) and _last(mark.func) in GIVES:
                found.append(_plugin(function, mark))
            elif _last(mark) in GIVES:
                raise _Refused(mark, f"the mark of {function.name} has a title: @plugin.{_last(mark)}(\"...\")")
    return found


def read(scripts: list[str]) -> dict[str, Any]:
    plugins: list[dict[str, Any]] = []
    refused: list[str] = []
    for script in scripts:
        name = os.path.basename(script)
        try:
            with open(script, "rb") as file:
                text = file.read()
            digest = hashlib.sha256(text).hexdigest()
            plugins += [{**one, "script": script, "digest": digest} for one in plugins_of(text)]
        except SyntaxError as error:
            refused.append(f"{name}, line {error.lineno or 1}: {error.msg}")
        except _Refused as error:
            refused.append(f"{name}, line {error.line}: {error}")
        except (OSError, ValueError, RecursionError) as error:
            refused.append(f"{name}: {getattr(error, 'strerror', None) or error}")
    return {"plugins": plugins, "refused": refused}


if __name__ == "__main__":
    found_in = read(sys.argv[2:])
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        json.dump(found_in, out)
