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
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env={**os.environ})
    assert done.returncode == 0 and "50" in done.stderr
