#!/usr/bin/env python3
"""The types of ostia/commands.py from what the program says of itself: command_stubs.py COMMANDS.json COMMANDS.pyi"""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent / "ostia"))
from _words import OURS, function_name, spelled

TYPES = {"FLOAT": "float", "INT": "int", "UINT": "int"}
HEAD = '''"""Made of the program's own description by command_stubs.py."""

import os
from typing import Any, Callable, Literal, Sequence, Union

Progress = Callable[[float, str], None]
Word = Union[str, os.PathLike[str]]
Place = Sequence[float]
Value = Union[Word, Place, Sequence[Place], Sequence[str]]

class Result:
    exit_code: int
    text: str
    data: Any
    warnings: list[str]
    @property
    def quality_ok(self) -> bool: ...

names: list[str]

def run(words: list[str], progress: Progress | None = ...) -> Result: ...
'''


def type_of(option):
    if not option["value"]:
        return "bool | Value" if option["flag_or_value"] else "bool"
    one = TYPES.get(option["value"], "Value")
    if option["choices"]:
        one = "Literal[" + ", ".join(json.dumps(word) for word in option["choices"]) + "]"
    return f"{one} | Sequence[{one}]" if option["repeats"] else one


def parameter(name, option):
    if option["required"]:
        return f"{name}: {type_of(option)}"
    return f"{name}: {type_of(option)} | None = ..."


def functions(command, common):
    if command["commands"]:
        return [text for one in command["commands"] for text in functions(one, common)]
    name = function_name(command["words"][1:])
    positional = [o for o in command["options"] if not o["names"][0].startswith("-")]
    named = {spelled(o["names"][-1]): o for o in command["options"] + common if o["names"][0].startswith("-") and o["names"][-1] not in OURS}
    parts = [parameter(spelled(o["names"][0]), o) for o in positional] + ["*", "progress: Progress | None = ..."]
    # What must be given stands first: a stub's keyword arguments may be in any order.
    parts += [parameter(key, o) for key, o in sorted(named.items(), key=lambda item: not item[1]["required"])]
    body = ",\n    ".join(parts)
    return [f"def {name}(\n    {body},\n) -> Result:\n    {json.dumps(command['text'])}\n"]


def main():
    described = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    texts = [text for one in described["commands"] for text in functions(one, described["options"])]
    pathlib.Path(sys.argv[2]).write_text(HEAD + "\n" + "\n".join(texts), encoding="utf-8")


if __name__ == "__main__":
    main()
