"""A case from a script: edits, undo, redo, its journal."""
import threading

import pytest

import ostia


@pytest.fixture
def case(tmp_path, model):
    with ostia.Case.create(tmp_path / "a.ostia", model) as opened:
        yield opened


def push(case, depth=0.9):
    return case.edit("wall.push", vessel=1, path=[(0.0, 0, 8), (depth, 0, 8)], radius_mm=1.0)


def test_steps(case, model, tmp_path):
    assert case.model == model
    edited = push(case)
    assert case.model == edited.model != model
    assert case.undo() and case.model == model and not case.undo()
    assert case.redo() and case.model == edited.model and not case.redo()
    case.set_author("A. Reader")
    case.edit("vessel.rename", vessel=1, name="LCX")
    assert case.model.tree.vessels[0].name == "LCX" and len(case.edits) == 2
    assert case.go_to_step(1) and case.model == model == case.starting_model
    ops = [(step["op"], step["undone"]) for step in case.journal]
    assert ops[:2] == [("case.begin", False), ("wall.push", True)]
    assert case.journal[-1]["op"] == "undo"


def test_it_is_on_disk_at_once(case, tmp_path):
    edited = push(case)
    case.save_as(tmp_path / "copy.ostia")
    with ostia.Case.open(tmp_path / "copy.ostia", read_only=True) as copy:
        assert copy.model == edited.model and copy.replay() and not copy.editable
        with pytest.raises(ostia.IoError):
            push(copy)
    case.close()
    assert ostia.Case.open(tmp_path / "a.ostia").model == edited.model
    assert repr(case) == "<ostia.Case, closed>"
    with pytest.raises(ostia.UsageError, match="closed"):
        case.undo()


def test_a_refused_edit_changes_nothing(case, model):
    for fields in [dict(vessel=9, path=[(0, 0, 8)]), dict(vessel=1), dict(vessel=1, path=[(0, 0, 8)], radius_mm=-1)]:
        with pytest.raises(ostia.InvalidInput):
            case.edit("wall.push", **fields)
    with pytest.raises(TypeError):
        case.edit("wall.push", vessel=object())
    assert case.model == model and len(case.journal) == 1


def test_words_of_pythons_own_have_an_underscore(case, model):
    case.edit("wall.drag", vessel=1, from_=(1.5, 0, 8), to=(1.9, 0, 8), reach_mm=2.0)
    case.edit({"op": "vessel.rename", "vessel": 1, "name": "RCA"})
    assert [e[:24] for e in case.edits] == ['{"v":1,"op":"wall.drag",', '{"v":1,"op":"vessel.rena']


def test_files_that_are_there_or_are_not(tmp_path, model, case):
    with pytest.raises(ostia.IoError):
        ostia.Case.create(tmp_path / "a.ostia", model)
    with pytest.raises(ostia.IoError):
        ostia.Case.open(tmp_path / "none.ostia")
    (tmp_path / "bad.ostia").write_text("no case")
    with pytest.raises(ostia.InvalidInput):
        ostia.Case.open(tmp_path / "bad.ostia")


def test_threads_take_turns_or_are_told(case):
    told, steps = [], []

    def work(i):
        for _ in range(5):
            try:
                case.edit("vessel.rename", vessel=1, name=f"v{i}")
                steps.append(i)
            except ostia.UsageError as error:
                told.append(str(error))

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(steps) + len(told) == 20 and len(case.edits) == len(steps)
    assert all("another thread" in text for text in told)
