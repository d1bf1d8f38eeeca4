"""Every command of the program `ostia` as a function: its options are keyword arguments, `--edge-ratio` is `edge_ratio`.

The functions are made of what the program says of itself (commands.json), so that names, defaults and refusals are its own.
Each runs the program in a process of its own, on files; Ctrl-C ends it as it does in a terminal, and leaves nothing behind.
"""

from __future__ import annotations

import json
import os
import pathlib
import re
import signal
import subprocess
import threading
from typing import Any, Callable, Optional

from ostia import _places, errors
from ostia._words import OURS as _OURS, function_name as _function_name, spelled as _spelled

_STAGE = re.compile(r"^\s*(\d+) % (.*)$")
Progress = Callable[[float, str], None]


class Result:
    """What a command left: its exit code, the object that it prints with --json, its text, and its warnings."""

    def __init__(self, exit_code: int, text: str, warnings: list[str]) -> None:
        self.exit_code = exit_code
        self.text = text
        self.warnings = warnings
        try:
            self.data: Any = json.loads(text)
        except ValueError:
            self.data = None

    @property
    def quality_ok(self) -> bool:
        """False where a person must look (exit code 4)."""
        return self.exit_code == 0

    def __repr__(self) -> str:
        return f"<ostia.commands.Result: {'done' if self.quality_ok else 'done, a person must look'}, {len(self.warnings)} warnings>"


def _text(value: Any) -> str:
    """A place is x,y,z, and several places that are one value stand between colons."""
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if hasattr(value, "tolist"):  # NumPy's
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        nested = any(hasattr(one, "__len__") and not isinstance(one, (str, os.PathLike)) for one in value)
        return (":" if nested else ",").join(_text(one) for one in value)
    return repr(value)


class _Command:
    """The words and options of one command."""

    def __init__(self, described: dict[str, Any], common: list[dict[str, Any]]) -> None:
        self.words: list[str] = described["words"][1:]
        self.positional = [o for o in described["options"] if not o["names"][0].startswith("-")]
        named = [o for o in described["options"] + common if o["names"][0].startswith("-")]
        self.says_json = any("--json" in o["names"] for o in named)
        self.named = {_spelled(o["names"][-1]): o for o in named if o["names"][-1] not in _OURS}

    def arguments(self, given: tuple[Any, ...], options: dict[str, Any]) -> list[str]:
        where = "commands." + "_".join(self.words)
        names = [_spelled(o["names"][0]) for o in self.positional]
        if len(given) > len(names):
            raise errors.UsageError(f"{where}: {len(given)} inputs given, it takes {', '.join(names) or 'none'}")
        values = dict(zip(names, given))
        for name in names:
            if name in options:
                values[name] = options.pop(name)
        # Inputs come first: behind an option of several values they would be taken for more of them.
        words = self.words + [_text(values[name]) for name in names if values.get(name) is not None]
        for name, value in options.items():
            if name not in self.named:
                raise errors.UsageError(f"{where}: there is no option {name}; there are {', '.join(self.named)}")
            words += self._option(f"{where}: {name}", self.named[name], value)
        return words

    def _option(self, where: str, option: dict[str, Any], value: Any) -> list[str]:
        flag: str = option["names"][-1]
        if value is None:
            return []
        if isinstance(value, bool) and not option["value"]:
            return [flag] if value else []
        if not option["value"] and not option["flag_or_value"]:
            raise errors.UsageError(f"{where}: True or False, not {value!r}")
        if isinstance(value, bool):
            raise errors.UsageError(f"{where}: a value, not {value!r}")
        if option["repeats"] and isinstance(value, (list, tuple)):
            return [f"{flag}={_text(one)}" for one in value]
        return [f"{flag}={_text(value)}"]


def _heard(stream: Any, progress: Optional[Progress]) -> list[str]:
    """What the program says, without the stages of its progress, which are told on."""
    lines = []
    for line in stream:
        stage = _STAGE.match(line)
        if not stage:
            lines.append(line.rstrip("\n"))
        elif progress is not None:
            progress(int(stage[1]) / 100, stage[2])
    return lines


def run(words: list[str], progress: Optional[Progress] = None) -> Result:
    """Runs the program with these words. Raises the error that belongs to its exit code; 4 is a result (`quality_ok`)."""
    program = _places.program()
    if program is None:
        raise errors.IoError("the program ostia is not on the path; install the package ostia, or name it in OSTIA_PROGRAM")
    # A group of its own: a terminal's Ctrl-C comes here alone, and is handed on once (a second one would end it at once).
    child = subprocess.Popen(
        [program, *words, "--progress=plain"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        text=True, encoding="utf-8", errors="replace", start_new_session=True)
    assert child.stdout is not None and child.stderr is not None
    written: list[str] = []
    reader = threading.Thread(target=lambda: written.append(child.stdout.read()))  # type: ignore[union-attr]
    reader.start()
    try:
        lines = _heard(child.stderr, progress)
        code = child.wait()
    except BaseException:
        child.send_signal(signal.SIGINT)
        child.stderr.read()
        child.wait()
        raise
    finally:
        reader.join()
        child.stdout.close()
        child.stderr.close()
    if code in (0, 4):
        warnings = [line.split("warning: ", 1)[1] for line in lines if line.startswith("warning: ")]
        return Result(code, written[0], warnings)
    message = next((line for line in reversed(lines) if line.startswith("ostia: ")), "; ".join(lines[:3]))
    if code < 0:
        raise errors.Error(f"ostia was ended by signal {-code}: {message}")
    raise errors.of_exit_code(code, message.removeprefix("ostia: "))


def _function(command: _Command, described: dict[str, Any]) -> Callable[..., Result]:
    def call(*inputs: Any, progress: Optional[Progress] = None, **options: Any) -> Result:
        words = command.arguments(inputs, options)
        return run(words + (["--json"] if command.says_json else []), progress)

    call.__name__ = call.__qualname__ = _function_name(command.words)
    options = "\n".join(f"  {name}: {o['text']}" for name, o in command.named.items())
    call.__doc__ = f"{described['text']}.\n\n`ostia {' '.join(command.words)}` with these options, by keyword:\n{options}"
    return call


def _define(described: dict[str, Any], common: list[dict[str, Any]]) -> list[str]:
    if described["commands"]:
        return [name for one in described["commands"] for name in _define(one, common)]
    function = _function(_Command(described, common), described)
    globals()[function.__name__] = function
    return [function.__name__]


_described = json.loads((pathlib.Path(__file__).parent / "commands.json").read_text(encoding="utf-8"))
names = [name for one in _described["commands"] for name in _define(one, _described["options"])]
