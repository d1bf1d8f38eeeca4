"""Long calls let others work, tell how far they are, and end when they are asked to."""
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import ostia


@pytest.fixture(scope="module")
def fine():
    """Some seconds of work: a million triangles or so."""
    z = np.linspace(0, 60, 241)
    tree = ostia.VesselTree.single(np.column_stack([5 * np.sin(z / 10), 0 * z, z]), np.full(len(z), 2.0))
    return ostia.model_of_tubes(tree)


def test_others_work_meanwhile(fine):
    counted, done = [0], threading.Event()

    def count():
        while not done.wait(0.005):
            counted[0] += 1

    other = threading.Thread(target=count)
    other.start()
    fine.surface(0.05)
    done.set()
    other.join()
    assert counted[0] > 3


def test_progress_is_told(fine):
    told = []
    fine.surface(0.05, progress=lambda fraction, stage: told.append((fraction, stage)))
    fractions = [fraction for fraction, _ in told]
    assert told and fractions == sorted(fractions) and 0 <= fractions[0] and fractions[-1] <= 1


def test_what_a_callback_raises_ends_the_work(fine):
    class Enough(Exception):
        pass

    def stop(fraction, stage):
        raise Enough("that will do")

    with pytest.raises(Enough, match="that will do"):
        fine.surface(0.03, progress=stop)


def test_what_a_caller_gave_is_not_closed(fine):
    class Told:
        closed = False

        def __call__(self, fraction, stage):
            pass

        def close(self):
            self.closed = True

    told = Told()
    fine.surface(0.5, progress=told)
    assert not told.closed


def test_a_callback_that_is_none_is_refused(fine):
    with pytest.raises(TypeError, match="progress"):
        fine.surface(progress=3)


INTERRUPTED = textwrap.dedent("""
    import os, signal, threading, time, numpy as np, ostia
    z = np.linspace(0, 60, 241)
    tree = ostia.VesselTree.single(np.column_stack([5 * np.sin(z / 10), 0 * z, z]), np.full(len(z), 2.0))
    model = ostia.model_of_tubes(tree)
    asked = []
    def ask():
        asked.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)
    threading.Timer(0.4, ask).start()
    try:
        model.surface(0.025)
        print("it ended by itself")
    except KeyboardInterrupt:
        print(time.monotonic() - asked[0])
""")


def test_control_c_ends_it_soon():
    """Within a second beside other tests; 0.2 s on a machine of its own."""
    done = subprocess.run([sys.executable, "-c", INTERRUPTED], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) < 1.0


def test_control_c_ends_a_command_and_leaves_nothing(tmp_path):
    script = textwrap.dedent("""
        import sys, ostia
        try:
            ostia.commands.phantom(output=sys.argv[1], preset="small", progress=lambda *told: print("at work", flush=True))
        except KeyboardInterrupt:
            print("ended", flush=True)
    """)
    child = subprocess.Popen([sys.executable, "-c", script, str(tmp_path / "phantom")], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline().strip() == "at work"
    child.send_signal(signal.SIGINT)
    rest, _ = child.communicate(timeout=60)
    assert rest.strip().endswith("ended")
    assert list(tmp_path.iterdir()) == []


def test_calls_in_several_threads_give_the_same(surface):
    found = [None] * 4

    def work(i):
        found[i] = ostia.extract_centerlines(surface).tree

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for tree in found[1:]:
        assert all(np.array_equal(a.axis.points, b.axis.points) for a, b in zip(found[0].segments, tree.segments))


def test_a_small_call_costs_microseconds():
    times = []
    for _ in range(300):
        start = time.perf_counter()
        ostia.version()
        times.append(time.perf_counter() - start)
    assert min(times) < 2e-6


def test_the_number_of_threads_changes_no_bit(fine):
    before = ostia.threads()
    try:
        ostia.set_threads(1)
        one = fine.surface(0.2)
    finally:
        ostia.set_threads(0)
    assert before >= 1 and np.array_equal(one.points, fine.surface(0.2).points)


def test_warnings_of_the_libraries_go_to_python(tmp_path, caplog):
    quad = "# vtk DataFile Version 3.0\nquad\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 0 1 0 0 1 1 0 0 1 0\nPOLYGONS 1 5\n4 0 1 2 3\n"
    (tmp_path / "quad.vtk").write_text(quad)
    ostia.read_surface(tmp_path / "quad.vtk")
    assert any("split into triangles" in record.getMessage() for record in caplog.records)


def test_progress_as_lines(fine):
    script = "import sys, ostia; ostia.example_surface(); from ostia._progress import Bar; b = Bar(); b(0.5, 'wall'); b.close()"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, encoding="utf-8", env={**os.environ})
    assert done.returncode == 0 and "50" in done.stderr


ENDING = textwrap.dedent("""
    import threading, time, numpy as np, ostia
    z = np.linspace(0, 60, 241)
    tree = ostia.VesselTree.single(np.column_stack([5 * np.sin(z / 10), 0 * z, z]), np.full(len(z), 2.0))
    model = ostia.model_of_tubes(tree)
    def work():
        while True:
            try:
                {call}
            except ostia.Cancelled:
                pass
    for _ in range(3):
        threading.Thread(target=work, daemon=True).start()
    time.sleep(0.3)
    print("ends", flush=True)
""")


@pytest.mark.parametrize("call", ["model.surface(0.025)", "model.surface(0.025, progress=lambda *told: None)", "ostia.model_of_tubes(tree)", "model.digest"])
def test_python_ends_while_calls_are_on_their_way(call):
    """Threads that Python does not wait for: their calls are cancelled and waited for, and nothing falls."""
    done = subprocess.run([sys.executable, "-c", ENDING.format(call=call)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, (done.returncode, done.stderr)
    assert done.stdout.strip() == "ends" and "Fatal" not in done.stderr and "terminate" not in done.stderr


def test_a_call_when_python_ends_is_answered(tmp_path):
    script = "import atexit\natexit.register(lambda: print(ostia.example_surface(1.0).closed, ostia.taubin_smoothed(ostia.example_surface(1.0)).closed))\nimport ostia"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and done.stdout.strip() == "False False", done.stderr


def test_warnings_are_those_of_the_call_itself(tmp_path, caplog):
    """Several threads read files with a fault each: each hears of its own alone, once."""
    quad = "# vtk DataFile Version 3.0\nquads\nASCII\nDATASET POLYDATA\nPOINTS {n} double\n{points}\nPOLYGONS {k} {size}\n{rows}\n"
    for k in range(1, 5):
        points = " ".join(f"{x} {y} {i}" for i in range(k) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
        rows = "\n".join(f"4 {4 * i} {4 * i + 1} {4 * i + 2} {4 * i + 3}" for i in range(k))
        (tmp_path / f"quads{k}.vtk").write_text(quad.format(n=4 * k, points=points, k=k, size=5 * k, rows=rows))
    heard = {k: [] for k in range(1, 5)}

    def read(k):
        for _ in range(20):
            ostia.read_surface(tmp_path / f"quads{k}.vtk")

    class Told(__import__("logging").Handler):
        def emit(self, record):
            heard[int(record.threadName)].append(record.getMessage())

    handler = Told()
    logger = __import__("logging").getLogger("ostia")
    logger.addHandler(handler)
    try:
        threads = [threading.Thread(target=read, args=(k,), name=str(k)) for k in heard]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    finally:
        logger.removeHandler(handler)
    texts = {k: set(told) for k, told in heard.items()}
    assert all(len(told) == 20 for told in heard.values()) and all(len(text) == 1 for text in texts.values())
    assert len(set.union(*texts.values())) == 4  # each tells another number of polygons


def test_warnings_of_short_calls_are_heard(caplog):
    z = np.linspace(0, 40, 81)
    still = ostia.example_surface(1.0, False)
    fit = ostia.fit_motion({k / 4: still for k in range(4)}, registration={"depth": 1}, template_phase=0.0)
    low, high = still.points.min(axis=0), still.points.max(axis=0)
    beyond = np.vstack([np.linspace(low, high, 30), high + [200, 0, 0]])
    caplog.clear()
    fit.motion.carried(beyond, 0.25)
    assert any("outside" in record.getMessage() for record in caplog.records) and len(z)


LEFT = textwrap.dedent("""
    import os, signal, sys, threading, time, numpy as np, ostia
    rows = {rows}
    k = np.arange(rows * rows).reshape(rows, rows)
    points = np.column_stack([(k % rows).ravel(), (k // rows).ravel(), np.sin(k).ravel()]).astype(float)
    a, b, c, d = k[:-1, :-1].ravel(), k[:-1, 1:].ravel(), k[1:, 1:].ravel(), k[1:, :-1].ravel()
    mesh = ostia.TriMesh(points, np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])]).astype(np.int32))
    {before}
    asked = []
    def ask():
        asked.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)
    threading.Timer(0.15, ask).start()
    try:
        {call}
        print("it ended by itself", file=sys.stderr)
        time.sleep(1)
    except KeyboardInterrupt:
        print(time.monotonic() - asked[0], flush=True)
""")


@pytest.mark.parametrize("before, call", [
    ("", "ostia.write_surface('left.vtp', mesh)"), ("ostia.write_surface('kept.stl', mesh)", "ostia.read_surface('kept.stl')"),
    ("", "ostia.write_surface_fields('left.vtp', mesh, {'x': points})"),
])
def test_control_c_ends_reading_and_writing_soon(tmp_path, before, call):
    """Within a second beside other tests; 0.2 s on a machine of its own. What was being written does not appear."""
    done = subprocess.run([sys.executable, "-c", LEFT.format(rows=1500, before=before, call=call)], capture_output=True, text=True, timeout=120, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "it ended by itself" not in done.stderr, "the file is too small to be interrupted"
    assert float(done.stdout.split()[0]) < 1.0
    assert [path.name for path in tmp_path.iterdir() if not path.name.startswith("kept")] == []
