"""Plug-ins as the program runs them: what they give, what is refused, and that nothing else is touched."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import ostia
from ostia import _places, _plugin_scripts

PROGRAM = _places.program()


def run(folder, *words, code=0, plugins="plugins", **environment):
    """Standard output of `ostia` in the folder; its standard error where it shall not end well."""
    setting = {**os.environ, "OSTIA_PLUGINS": str(folder / plugins), "XDG_CONFIG_HOME": str(folder), **environment}
    done = subprocess.run([PROGRAM, *map(str, words)], cwd=folder, env=setting, capture_output=True, text=True)
    assert done.returncode == code, done.stderr
    return done.stderr if code else done.stdout


@pytest.fixture
def folder(tmp_path, model):
    """With the case of a tube of radius 1.5 mm that narrows to half of it, and an empty folder of plug-ins."""
    (tmp_path / "plugins").mkdir()
    ostia.Case.create(tmp_path / "a.ostia", model).close()
    return tmp_path


def script(folder, body, head="from ostia import plugin\nimport ostia, os, time\nimport numpy as np\n", name="mine"):
    (folder / "plugins" / f"{name}.py").write_text(head + body)


def diameter(case, s_mm):
    with ostia.Case.open(case, read_only=True) as opened:
        profile = ostia.lumen_profile(opened.model, 1)
    return np.interp(s_mm, profile.s_mm, profile.diameter_mm)


def entries(case):
    with ostia.Case.open(case, read_only=True) as opened:
        return [(one["op"], one["undone"]) for one in opened.journal]


# -- the examples -------------------------------------------------------------------------------------------------------------


def test_the_example_widens_the_wall_in_one_step(folder, source):
    before = (folder / "a.ostia").read_bytes()
    done = json.loads(run(folder, "plugin", "run", "widen_wall", "a.ostia", "-o", "b.ostia", "--set", "by_mm=0.2", "--json", plugins=source / "examples/plugins"))
    assert done["edits"] > 20 and done["plugin"] == "widen_wall" and done["version"] == "1.0"
    for s in (8, 12, 20, 32):
        assert diameter(folder / "b.ostia", s) == pytest.approx(diameter(folder / "a.ostia", s) + 0.4, abs=0.06)
    assert entries(folder / "b.ostia") == [("case.begin", False), ("plugin", False)]
    assert (folder / "a.ostia").read_bytes() == before
    with ostia.Case.open(folder / "b.ostia") as case, ostia.Case.open(folder / "a.ostia", read_only=True) as first:
        assert len(case.edits) == done["edits"] and case.replay()
        assert case.undo() and case.model == first.model and not case.undo()
        assert case.redo()
    run(folder, "replay", "b.ostia", "-o", "edits.jsonl")
    assert len((folder / "edits.jsonl").read_text().splitlines()) == done["edits"]


def test_the_examples_mask_becomes_a_tree(folder, source):
    """A bright tube of radius 1.5 mm in fat, along z."""
    k, j, i = np.mgrid[0:110, 0:64, 0:64]
    r = np.hypot(i * 0.4 - 12.6, j * 0.4 - 12.6)
    hu = np.round(-80 + 480 * np.clip(0.5 - (r - 1.5) / 0.6, 0, 1)).astype(np.int16)
    ostia.write_image(folder / "ct.nrrd", ostia.Volume(hu, spacing=(0.4, 0.4, 0.4), origin=(-12.6, -12.6, -2.0)))
    examples = source / "examples/plugins"
    run(folder, "plugin", "run", "grow_mask", "ct.nrrd", "-o", "mask.nrrd", plugins=examples)
    grown = ostia.read_mask(folder / "mask.nrrd")
    assert np.array_equal(grown.array > 0, hu >= 150) and grown.origin == (-12.6, -12.6, -2.0)
    done = json.loads(run(folder, "plugin", "run", "grow_mask", "ct.nrrd", "-o", "tree.ostia", "--set", "lower_hu=160", "--json", plugins=examples))
    assert done["vessels"] == 1
    with ostia.Case.open(folder / "tree.ostia", read_only=True) as case:
        axis = case.model.tree.axis(case.model.tree.vessels[0].id)
        assert axis.length > 35 and np.abs(axis.points[:, :2]).max() < 0.4
        assert np.median(axis.radius) == pytest.approx(1.5, abs=0.15)
    away = run(folder, "plugin", "run", "grow_mask", "ct.nrrd", "-o", "c.nrrd", "--set", "lower_hu=5000", "--set", "upper_hu=6000", code=3, plugins=examples)
    assert "grow_mask.py, line" in away and "no voxel is between 5000 and 6000 HU" in away and not (folder / "c.nrrd").exists()


def test_the_list_is_what_the_scripts_say(folder, source):
    listed = json.loads(run(folder, "plugin", "list", "--json", plugins=source / "examples/plugins"))["plugins"]
    widen = {one["name"]: one for one in listed}["widen_wall"]
    assert [one["name"] for one in listed] == ["grow_mask", "widen_wall"]
    assert (widen["title"], widen["version"], widen["gives"], widen["needs_image"]) == ("Widen the wall", "1.0", "edits", False)
    assert [(one["name"], one["value"]) for one in widen["parameters"]] == [("vessel", ""), ("by_mm", 0.2), ("step_mm", 1.0), ("narrow_alone", False)]
    assert "--set by_mm=0.2" in run(folder, "plugin", "list", plugins=source / "examples/plugins")


def test_what_is_printed_is_as_its_schemas_say(folder, source):
    jsonschema = pytest.importorskip("jsonschema", reason="jsonschema is not there: apt install python3-jsonschema")

    def holds(name, text):
        printed = json.loads(text)
        validator = jsonschema.Draft202012Validator(json.loads((source / f"docs/schemas/{name}.schema.json").read_text()))
        validator.validate(printed)
        assert not validator.is_valid({key: value for key, value in printed.items() if key != "kind"})

    script(folder, "@plugin.field('Height')\ndef height(given):\n    return given.surface.points[:, 2]\n")
    holds("plugin", run(folder, "plugin", "run", "height", "a.ostia", "-o", "h.vtp", "--json"))
    holds("plugins", run(folder, "plugin", "list", "--json"))
    holds("plugins", run(folder, "plugin", "list", "--json", plugins=source / "examples/plugins"))
    holds("plugin", run(folder, "plugin", "run", "widen_wall", "a.ostia", "-o", "b.ostia", "--json", plugins=source / "examples/plugins"))


# -- overlays and fields ------------------------------------------------------------------------------------------------------


def test_a_field_on_the_wall(folder):
    script(folder, "@plugin.field('Height')\ndef height(given):\n    return {'height_mm': given.surface.points[:, 2]}\n")
    run(folder, "plugin", "run", "height", "a.ostia", "-o", "h.vtp")
    mesh, points, _ = ostia.read_surface_fields(folder / "h.vtp")
    assert set(points) == {"height_mm"} and np.allclose(points["height_mm"].ravel(), mesh.points[:, 2], atol=1e-5) and mesh.closed


def test_several_surfaces_are_one_with_their_numbers(folder):
    script(folder, """@plugin.overlay('Two')
def two(given):
    return [ostia.example_surface(1.0), plugin.Overlay(given.surface, {'one': np.ones(len(given.surface.points))})]
""")
    done = json.loads(run(folder, "plugin", "run", "two", "a.ostia", "-o", "two.vtp", "--json"))
    mesh, points, _ = ostia.read_surface_fields(folder / "two.vtp")
    first = len(ostia.example_surface(1.0).points)
    assert done["fields"] == ["one", "part"] and set(points) == {"one", "part"}
    part, one = points["part"].ravel(), points["one"].ravel()
    assert (part[:first] == 0).all() and (part[first:] == 1).all()
    assert np.isnan(one[:first]).all() and (one[first:] == 1).all()


# -- what it is given ---------------------------------------------------------------------------------------------------------


def test_parameters_arrive_in_their_types(folder):
    script(folder, """from typing import Literal
@plugin.edits('Types')
def types(given, vessel: plugin.Vessel = -1, on: bool = False, n: int = 2, x: float = 1, s: str = 'a', side: Literal['left', 'right'] = 'left'):
    print(repr((vessel, on, n, x, s, side)))
    return plugin.edit('vessel.rename', vessel=vessel, name=repr((on, n, x, s, side)))
""")
    run(folder, "plugin", "run", "types", "a.ostia", "-o", "b.ostia", "--set", "on=true", "--set", "n=3", "--set", "side=right", "--set", "vessel=LAD")
    with ostia.Case.open(folder / "b.ostia", read_only=True) as case:
        assert case.model.tree.vessels[0].name == repr((True, 3, 1.0, "a", "right"))
    assert "takes a whole number" in run(folder, "plugin", "run", "types", "a.ostia", "-o", "c.ostia", "--set", "n=3.5", code=3)
    assert "it has vessel, on, n" in run(folder, "plugin", "run", "types", "a.ostia", "-o", "c.ostia", "--set", "m=3", code=2)
    assert "there is no vessel RCA; there are LAD" in run(folder, "plugin", "run", "types", "a.ostia", "-o", "c.ostia", "--set", "vessel=RCA", code=3)


def test_it_works_on_copies_in_a_folder_that_goes(folder):
    script(folder, """@plugin.edits('Writes')
def writes(given):
    open('left_here.txt', 'w').write('x')
    print(os.getcwd())
    try:
        given.case.edit('vessel.rename', vessel=1, name='spoilt')
    except ostia.IoError:
        print('read-only')
    return []
""")
    before = (folder / "a.ostia").read_bytes()
    done = subprocess.run([PROGRAM, "plugin", "run", "writes", "a.ostia", "-o", "b.ostia"], cwd=folder, capture_output=True, text=True,
                          env={**os.environ, "OSTIA_PLUGINS": str(folder / "plugins")})
    assert done.returncode == 0 and "writes: read-only" in done.stderr and "gave no edits" in done.stderr
    place = pathlib.Path(next("/" + line.split("writes: /", 1)[1] for line in done.stderr.splitlines() if "writes: /" in line))
    assert not place.exists() and not list(folder.rglob("left_here.txt"))
    assert (folder / "a.ostia").read_bytes() == before and entries(folder / "b.ostia") == [("case.begin", False)]


def test_neighbours_are_imported(folder):
    (folder / "plugins" / "_shared.py").write_text("NAME = 'LCX'\n")
    script(folder, "from _shared import NAME\n@plugin.edits('A')\ndef a(given):\n    return [plugin.edit('vessel.rename', vessel=1, name=NAME)]\n")
    run(folder, "plugin", "run", "a", "a.ostia", "-o", "b.ostia")
    with ostia.Case.open(folder / "b.ostia", read_only=True) as case:
        assert case.model.tree.vessels[0].name == "LCX"


# -- what is refused ----------------------------------------------------------------------------------------------------------

REFUSED = {
    "raises": ("@plugin.edits('A')\ndef a(given):\n    raise ValueError('no such place')\n", "mine.py, line 6: ValueError: no such place"),
    "library": ("@plugin.edits('A')\ndef a(given):\n    given.tree.axis(77)\n", "mine.py, line 6: "),
    "import": ("import not_there\n@plugin.edits('A')\ndef a(given):\n    return []\n", "mine.py, line 4: ModuleNotFoundError: No module named 'not_there'"),
    "leaves": ("@plugin.edits('A')\ndef a(given):\n    raise SystemExit(3)\n", "mine.py, line 6: SystemExit: 3"),
    "dies": ("@plugin.edits('A')\ndef a(given):\n    os.kill(os.getpid(), 9)\n", "ended without a result: Python was killed by signal 9"),
    "no_list": ("@plugin.edits('A')\ndef a(given):\n    return 7\n", "it gave int, not a list of edits"),
    "no_edit": ("@plugin.edits('A')\ndef a(given):\n    return [plugin.edit('vessel.rename', vessel=1, name='x'), 7]\n", "its edit 2 is int"),
    "no_op": ("@plugin.edits('A')\ndef a(given):\n    return [plugin.edit('wall.paint', vessel=1)]\n", 'edit 1 of 1: an edit has the unknown "op" "wall.paint"'),
    "half": ("@plugin.edits('A')\ndef a(given):\n    return [plugin.edit('vessel.rename', vessel=v, name='x') for v in (1, 9)]\n",
             "edit 2 of 2 (vessel.rename) is refused, and none was made"),
    "no_surface": ("@plugin.overlay('A')\ndef a(given):\n    return []\n", "it gave no surface"),
    "short_field": ("@plugin.field('A')\ndef a(given):\n    return {'x': [1.0, 2.0]}\n", "its field x has the shape (2,); given.surface has"),
}


@pytest.mark.parametrize("what", sorted(REFUSED))
def test_refused_with_one_message_and_nothing_is_left(folder, what):
    body, wanted = REFUSED[what]
    script(folder, body)
    out = "b.ostia" if "edits" in body else "b.vtp"
    said = run(folder, "--quiet", "plugin", "run", "a", "a.ostia", "-o", out, code=3)
    assert wanted in said and said.count("\n") == 1
    assert sorted(one.name for one in folder.iterdir()) == ["a.ostia", "plugins"]


@pytest.mark.parametrize("array, wanted", [("np.zeros((2, 2, 2), bool)", "its mask has the shape (2, 2, 2), the image (8, 9, 10)"), ("np.zeros((8, 9, 10), bool)", "its mask is empty"),
                                           ("np.full((8, 9, 10), 0.7)", "its mask is float64"), ("np.full((8, 9, 10), 300)", "its mask is int64"),
                                           ("ostia.Volume(np.ones((8, 9, 10), bool))", "lies elsewhere")])
def test_masks_that_are_none(folder, array, wanted):
    ostia.write_image(folder / "ct.nrrd", ostia.Volume(np.arange(720, dtype=np.int16).reshape(8, 9, 10), spacing=(0.5, 0.5, 0.5)))
    script(folder, f"@plugin.mask('A')\ndef a(given):\n    return {array}\n")
    assert wanted in run(folder, "plugin", "run", "a", "ct.nrrd", "-o", "b.nrrd", code=3)
    assert not (folder / "b.nrrd").exists()


def test_scripts_that_cannot_be_read_are_told_with_their_line_and_the_others_stay(folder):
    good = "from ostia import plugin\n@plugin.edits('Good')\ndef good(given):\n    return []\n"
    for name, text in {
        "b_default": "from ostia import plugin\n@plugin.edits('A')\ndef a(given, x: float):\n    return []\n",
        "c_type": "from ostia import plugin\n@plugin.edits('A')\ndef a(given, x=1.0):\n    return []\n",
        "d_computed": "from ostia import plugin\nX = 1.0\n@plugin.edits('A')\ndef a(given, x: float = X):\n    return []\n",
        "e_syntax": "from ostia import plugin\ndef (:\n",
        "f_title": "from ostia import plugin\n@plugin.edits\ndef a(given):\n    return []\n",
        "g_other": "import numpy\n@numpy.vectorize\ndef mask(x):\n    return x\n",
        "h_wrong": "from ostia import plugin\n@plugin.edits('A')\ndef a(given, n: int = 'two'):\n    return []\n",
        "a_good": good, "z_twice": good,
    }.items():
        (folder / "plugins" / f"{name}.py").write_text(text)
    listed = json.loads(run(folder, "plugin", "list", "--json"))
    assert [one["name"] for one in listed["plugins"]] == ["good"] and listed["plugins"][0]["script"] == "a_good.py"
    told = {one.split(",")[0].split(":")[0]: one for one in listed["warnings"]}
    assert sorted(told) == ["b_default.py", "c_type.py", "d_computed.py", "e_syntax.py", "f_title.py", "h_wrong.py", "z_twice.py"]
    assert "line 3: the parameter x needs a default" in told["b_default.py"] and "line 4" in told["d_computed.py"] and "needs a type" in told["c_type.py"]
    assert "line 2" in told["e_syntax.py"] and "has a title" in told["f_title.py"] and "another plug-in before it" in told["z_twice.py"]


def test_listing_runs_nothing(folder):
    script(folder, f"open({str(folder / 'ran')!r}, 'w')\n@plugin.edits('A')\ndef a(given):\n    return []\n")
    run(folder, "plugin", "list")
    assert not (folder / "ran").exists()


def test_a_name_that_is_not_there(folder):
    script(folder, "@plugin.edits('A')\ndef a(given):\n    return []\n")
    assert "there is no plug-in b; there are a" in run(folder, "plugin", "run", "b", "a.ostia", "-o", "b.ostia", code=3)
    assert "works on a case" in run(folder, "plugin", "run", "a", "plugins", "-o", "b.ostia", code=2)


def test_without_python_or_the_package_the_way_out_is_told(folder, tmp_path):
    script(folder, "@plugin.edits('A')\ndef a(given):\n    return []\n")
    assert "OSTIA_PYTHON names" in run(folder, "plugin", "list", code=3, OSTIA_PYTHON="/nowhere/python3")
    bare = tmp_path / "bin" / "ostia"
    bare.parent.mkdir()
    bare.write_bytes(pathlib.Path(PROGRAM).read_bytes())
    bare.chmod(0o755)
    done = subprocess.run([bare, "plugin", "list"], capture_output=True, text=True, env={"OSTIA_PLUGINS": str(folder / "plugins"), "PATH": "/usr/bin"})
    assert done.returncode == 3 and "install python3-ostia" in done.stderr


def test_a_script_that_changes_meanwhile_is_not_run(tmp_path):
    request = {"script": str(tmp_path / "a.py"), "digest": "0" * 64, "name": "a", "gives": "edits", "vessels": [], "values": {}}
    (tmp_path / "a.py").write_text("raise RuntimeError('it ran')\n")
    (tmp_path / "request.json").write_text(json.dumps(request))
    subprocess.run([sys.executable, "-c", f"from ostia.plugin import _run; _run({str(tmp_path)!r})"], check=True)
    assert "has changed since it was listed" in json.loads((tmp_path / "answer.json").read_text())["error"]["message"]


# -- time ---------------------------------------------------------------------------------------------------------------------

SLEEPS = """@plugin.edits('A')
def a(given):
    import subprocess
    child = subprocess.Popen(['sleep', '300'])
    open({there!r}, 'w').write(f'{{os.getpid()}} {{child.pid}}')
    given.progress(0.5, 'sleeping')
    time.sleep(300)
"""


def alive(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def wait(until, most_s=60):
    end = time.monotonic() + most_s
    while not until() and time.monotonic() < end:
        time.sleep(0.02)
    return until()


def test_cancel_ends_it_and_its_children(folder):
    there = folder / "plugins" / "there"
    script(folder, SLEEPS.format(there=str(there)))
    child = subprocess.Popen([PROGRAM, "plugin", "run", "a", "a.ostia", "-o", "b.ostia", "--progress", "plain"], cwd=folder, stderr=subprocess.PIPE, text=True,
                             env={**os.environ, "OSTIA_PLUGINS": str(folder / "plugins")})
    assert wait(lambda: there.exists() and len(there.read_text().split()) == 2)
    pids = there.read_text().split()
    assert all(alive(pid) for pid in pids)
    assert any("sleeping" in line for line in child.stderr), "its progress is told"
    child.send_signal(signal.SIGINT)
    child.communicate(timeout=60)
    assert child.returncode == 130 and wait(lambda: not any(alive(pid) for pid in pids))
    assert not (folder / "b.ostia").exists()


def test_it_has_a_time_limit(folder):
    there = folder / "plugins" / "there"
    script(folder, SLEEPS.format(there=str(there)))
    said = run(folder, "plugin", "run", "a", "a.ostia", "-o", "b.ostia", "--time-limit", "3", code=5)
    assert "took longer than 3 s" in said and not (folder / "b.ostia").exists()


# -- a chain ------------------------------------------------------------------------------------------------------------------


def test_a_step_of_a_chain_is_done_again_when_its_script_has_changed(folder):
    text = "@plugin.edits('Name')\ndef name(given, to: str = 'a'):\n    return [plugin.edit('vessel.rename', vessel=1, name=to + 'SUFFIX')]\n"
    script(folder, text.replace("SUFFIX", "1"))
    chain = {"v": 1, "steps": [{"command": "plugin run name", "input": "a.ostia", "output": "b.ostia", "options": {"set": ["to={to}"]}},
                               {"command": "replay", "input": "b.ostia", "output": "c.ostia"}]}
    (folder / "chain.json").write_text(json.dumps(chain))

    def done():
        run(folder, "run", "chain.json", "-o", "out", "--set", "to=L")
        with ostia.Case.open(folder / "out" / "b.ostia", read_only=True) as case:
            return case.model.tree.vessels[0].name

    assert done() == "L1"
    made = (folder / "out" / "b.ostia").stat().st_mtime_ns
    assert done() == "L1" and (folder / "out" / "b.ostia").stat().st_mtime_ns == made
    script(folder, text.replace("SUFFIX", "2"))
    assert done() == "L2"
    chain["steps"][0]["command"] = "plugin run other"
    (folder / "chain.json").write_text(json.dumps(chain))
    assert "step 1 (plugin run other): there is no plug-in other; there are name" in run(folder, "run", "chain.json", "-o", "out", "--set", "to=L", code=3)


# -- the marks themselves -----------------------------------------------------------------------------------------------------


def test_marks_leave_the_function_as_it_is(source):
    from ostia import plugin

    @plugin.mask("A", version="1")
    def twice(x):
        return 2 * x

    assert twice(3) == 6 and twice.__ostia_plugin__ == "mask"
    for name in _plugin_scripts.GIVES:
        assert callable(getattr(plugin, name))
    for path in (source / "examples/plugins").glob("*.py"):
        assert _plugin_scripts.plugins_of(path.read_bytes())
