"""Plug-ins: functions of your own that work on a case, from the command line, in `ostia run`, and in the workstation.

A script in the folder of plug-ins has functions with one of four marks, which say what becomes of the result:

    from ostia import plugin

    @plugin.edits("Widen a vessel", version="1.0")
    def widen(given: plugin.Given, vessel: plugin.Vessel = -1, by_mm: float = 0.2) -> list[str]:
        ...

Each runs in a process of its own on a copy of the case: what it gives back is checked, and then it is a step of the case that is
undone as one. docs/reference/plugins.md tells more.
"""

from __future__ import annotations

import hashlib
import json
import linecache
import os
import pathlib
import sys
import traceback
import types
from dataclasses import dataclass, field as _dataclass_field
from functools import cached_property
from typing import Any, Callable, Iterable, Mapping, Optional, TypeVar, Union

import numpy as np
import numpy.typing as npt

import ostia
from ostia import _edits

Vessel = int
"""A parameter that is a vessel's id; people choose it by its name. -1: the one that is selected, or the first."""

Result = Any


@dataclass(frozen=True)
class Overlay:
    """A surface to be looked at, with fields at its points: one number (n,) or a vector (n, k) each."""

    mesh: "ostia.TriMesh"
    fields: Mapping[str, npt.ArrayLike] = _dataclass_field(default_factory=dict)


def edit(op: str, **fields: Any) -> str:
    """An edit by its name and fields, `edit("wall.push", vessel=1, path=[...], radius_mm=1.0)`, as Case.edit takes it."""
    return _edits.line(op, **fields)


class Given:
    """What a plug-in is given: a read-only copy of the case and, where it asks for it, the image."""

    def __init__(self, case: "Optional[ostia.Case]", image: "Optional[ostia.Volume]", folder: pathlib.Path) -> None:
        self._case = case
        self._image = image
        self._folder = folder

    @property
    def case(self) -> "ostia.Case":
        if self._case is None:
            raise ostia.InvalidInput("no case was given; open one, or name it on the command line")
        return self._case

    @property
    def has_case(self) -> bool:
        return self._case is not None

    @cached_property
    def model(self) -> "ostia.LumenModel":
        return self.case.model

    @property
    def tree(self) -> "ostia.VesselTree":
        return self.model.tree

    @cached_property
    def surface(self) -> "ostia.TriMesh":
        """The wall of the whole tree, closed."""
        return self.model.surface()

    @property
    def image(self) -> "ostia.Volume":
        """The CT, int16 HU, axes (z, y, x)."""
        if self._image is None:
            raise ostia.InvalidInput("no image was given; the mark of a plug-in that needs one says image=True")
        return self._image

    @property
    def has_image(self) -> bool:
        return self._image is not None

    def vessel(self, name: Union[str, int]) -> int:
        """The id of a vessel of this name or id; of "" or -1 that of the first."""
        vessels = self.tree.vessels
        if name == "" or name == -1:
            return vessels[0].id
        for one in vessels:
            if one.name == name:
                return one.id
        for one in vessels:
            if str(one.id) == str(name):
                return one.id
        raise ostia.InvalidInput(f"there is no vessel {name}; there are {', '.join(one.name for one in vessels)}")

    def progress(self, fraction: float, stage: str = "") -> None:
        """Shown while the plug-in runs; fraction is in [0, 1]."""
        beside = self._folder / "progress.new"
        beside.write_text(f"{min(max(float(fraction), 0.0), 1.0):.4f}\n{stage}\n", encoding="utf-8")
        os.replace(beside, self._folder / "progress")


_Function = TypeVar("_Function", bound=Callable[..., Any])


def _marked(gives: str, title: str, version: str, image: bool) -> Callable[[_Function], _Function]:
    def keep(function: _Function) -> _Function:
        setattr(function, "__ostia_plugin__", gives)
        return function

    return keep


def edits(title: str, *, version: str = "", image: bool = False) -> Callable[[_Function], _Function]:
    """Marks a function that returns edits, each as `edit(...)` makes it: all of them are one step of the case, or none."""
    return _marked("edits", title, version, image)


def overlay(title: str, *, version: str = "", image: bool = False) -> Callable[[_Function], _Function]:
    """Marks a function that returns surfaces to be looked at: a TriMesh, an Overlay, or several."""
    return _marked("overlay", title, version, image)


def field(title: str, *, version: str = "", image: bool = False) -> Callable[[_Function], _Function]:
    """Marks a function that returns values by name, one for each point of `given.surface`."""
    return _marked("field", title, version, image)


def mask(title: str, *, version: str = "", image: bool = True) -> Callable[[_Function], _Function]:
    """Marks a function that returns labels, one for each voxel of `given.image`, 0 outside: a tree is made of them."""
    return _marked("mask", title, version, True)


# -- in the process of its own ------------------------------------------------------------------------------------------------


class _Fault(Exception):
    """Of the plug-in, where the script itself has no line to show."""


def _edit_lines(result: Any) -> list[str]:
    if result is None:
        return []
    if isinstance(result, (str, dict)):
        result = [result]
    if not isinstance(result, Iterable):
        raise _Fault(f"it gave {type(result).__name__}, not a list of edits")
    lines: list[str] = []
    for one in result:
        if not isinstance(one, (str, dict)):
            raise _Fault(f"its edit {len(lines) + 1} is {type(one).__name__}; make it by plugin.edit(...)")
        lines.append(_edits.line(one))
    return lines


def _overlays(result: Any) -> list[Overlay]:
    if isinstance(result, (ostia.TriMesh, Overlay)):
        result = [result]
    if isinstance(result, Mapping):
        result = list(result.values())
    if not isinstance(result, Iterable):
        raise _Fault(f"it gave {type(result).__name__}, not surfaces (TriMesh or plugin.Overlay)")
    made: list[Overlay] = []
    for one in result:
        if isinstance(one, ostia.TriMesh):
            one = Overlay(one)
        if not isinstance(one, Overlay):
            raise _Fault(f"its surface {len(made) + 1} is {type(one).__name__}, not a TriMesh or plugin.Overlay")
        made.append(one)
    return made


def _surface_files(result: Any, folder: pathlib.Path) -> list[str]:
    names: list[str] = []
    for one in _overlays(result):
        names.append(f"surface-{len(names) + 1}.vtp")
        ostia.write_surface_fields(folder / names[-1], one.mesh, dict(one.fields))
    if not names:
        raise _Fault("it gave no surface")
    return names


def _field_file(result: Any, given: Given, folder: pathlib.Path) -> list[str]:
    if not isinstance(result, Mapping):
        result = {"value": result}
    points = len(given.surface.points)
    for name, values in result.items():
        if len(np.shape(values)) == 0 or np.shape(values)[0] != points:
            raise _Fault(f"its field {name} has the shape {np.shape(values)}; given.surface has {points} points")
    return _surface_files(Overlay(given.surface, result), folder)


def _mask_file(result: Any, given: Given, folder: pathlib.Path) -> str:
    image = given.image
    if isinstance(result, ostia.Volume):
        labels = result
        if labels.size == image.size and (labels.origin != image.origin or labels.spacing != image.spacing):
            raise _Fault("its mask has the image's size and lies elsewhere; return the array alone, and it lies as the image does")
    else:
        array = np.asarray(result)
        if array.shape != image.array.shape:
            raise _Fault(f"its mask has the shape {array.shape}, the image {image.array.shape}")
        labels = ostia.Volume(_labels(array), spacing=image.spacing, origin=image.origin, direction=image.direction)
    if not np.any(labels.array):
        raise _Fault("its mask is empty: no voxel is a vessel")
    ostia.write_image(folder / "mask.mhd", labels)
    return "mask.mhd"


def _labels(array: npt.NDArray[Any]) -> npt.NDArray[np.uint8]:
    if array.dtype == bool or array.dtype == np.uint8:
        return np.ascontiguousarray(array, dtype=np.uint8)
    if not np.issubdtype(array.dtype, np.integer) or array.min() < 0 or array.max() > 255:
        raise _Fault(f"its mask is {array.dtype}; it must be bool, or whole numbers from 0 to 255 (of probabilities: p >= 0.5)")
    return np.ascontiguousarray(array, dtype=np.uint8)


def _place(error: BaseException, script: str) -> dict[str, Any]:
    """Where in the script it went wrong, as far down as the script's own folder goes."""
    if isinstance(error, SyntaxError) and error.filename:
        return {"file": os.path.basename(error.filename), "line": error.lineno or 1}
    folder = os.path.dirname(script)
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if os.path.dirname(frame.filename) == folder]
    return {"file": os.path.basename(frames[-1].filename), "line": frames[-1].lineno or 1} if frames else {}


def _message(error: BaseException) -> str:
    if isinstance(error, (_Fault, ostia.Error)):
        return str(error)
    text = str(error)
    return type(error).__name__ + (f": {text}" if text else "")


def _loaded(script: str, digest: str) -> types.ModuleType:
    text = pathlib.Path(script).read_bytes()
    if hashlib.sha256(text).hexdigest() != digest:
        raise _Fault("the script has changed since it was listed; look for plug-ins again")
    module = types.ModuleType("ostia_plugin_" + pathlib.Path(script).stem)
    module.__file__ = script
    sys.modules[module.__name__] = module
    sys.path.append(os.path.dirname(script))  # its neighbours, behind all packages
    linecache.checkcache(script)
    exec(compile(text, script, "exec"), module.__dict__)
    return module


def _answer(request: dict[str, Any], folder: pathlib.Path) -> dict[str, Any]:
    case = ostia.Case.open(folder / request["case"], read_only=True) if "case" in request else None
    image = ostia.read_image(folder / request["image"]) if "image" in request else None
    given = Given(case, image, folder)
    values = dict(request["values"])
    for name in request["vessels"]:
        values[name] = given.vessel(values[name])
    function = getattr(_loaded(request["script"], request["digest"]), request["name"])
    result = function(given, **values)
    if request["gives"] == "edits":
        return {"edits": _edit_lines(result)}
    if request["gives"] == "overlay":
        return {"surfaces": _surface_files(result, folder)}
    if request["gives"] == "field":
        return {"surfaces": _field_file(result, given, folder)}
    return {"mask": _mask_file(result, given, folder)}


def _run(place: str) -> None:
    """One run, as the program asks for it in `place`; its answer goes there, too. Standard output is the log."""
    sys.stdout.flush()
    os.dup2(2, 1)
    folder = pathlib.Path(place)
    os.chdir(folder)  # what is written by a name alone goes with the folder
    request = json.loads((folder / "request.json").read_text(encoding="utf-8"))
    try:
        answer = _answer(request, folder)
    except (Exception, SystemExit) as error:
        if not isinstance(error, _Fault):
            traceback.print_exc()
        answer = {"error": {"message": _message(error), **_place(error, request["script"])}}
    sys.stdout.flush()
    beside = folder / "answer.new"
    beside.write_text(json.dumps(answer), encoding="utf-8")
    os.replace(beside, folder / "answer.json")
