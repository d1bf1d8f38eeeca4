"""What the words of the program's own description are called in Python: for commands.py, and for command_stubs.py, which runs
when there is no package yet."""

from __future__ import annotations

import keyword

OURS = {"--help", "--config", "--log", "--progress", "--quiet", "--json"}  # options that commands.py gives itself, or not at all


def spelled(name: str) -> str:
    """`--edge-ratio` as edge_ratio, and a word of Python's own with an underscore."""
    word = name.lstrip("-").replace("-", "_").lower()
    return word + "_" if keyword.iskeyword(word) else word


def function_name(words: list[str]) -> str:
    """Of a command's words. `ostia run` has the name of what runs a command, and is a chain of them."""
    return "run_pipeline" if words == ["run"] else spelled("_".join(words))
