#!/usr/bin/env python3
"""What steps ask for: a line above what was taken, doubled when it was not enough, and a rule of thumb where nothing is known.

Usage: asks_test.py WORKFLOW
"""
import json
import pathlib
import random
import sys
import tempfile
import unittest

sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import asks  # noqa: E402


class Asks(unittest.TestCase):
    def test_a_line_that_is_there_is_found(self):
        sizes = [1.0, 2.0, 5.0, 9.0]
        always, each = asks.line_above(sizes, [100 + 7 * size for size in sizes])
        self.assertAlmostEqual(always, 100)
        self.assertAlmostEqual(each, 7)

    def test_what_does_not_grow_with_size_or_has_one_size_is_a_constant(self):
        self.assertEqual(asks.line_above([1, 2, 3], [30, 20, 10]), (30, 0.0))
        self.assertEqual(asks.line_above([4, 4, 4], [10, 30, 20]), (30, 0.0))
        always, each = asks.line_above([1, 2, 3], [1, 2, 6])  # the least-squares line begins below nothing
        self.assertEqual(always, 0.0)
        self.assertAlmostEqual(each, 2.0)

    def test_of_what_steps_take_most_is_asked_for_between_once_and_1_6_times(self):
        """With a tenth of scatter about a line, which real steps have."""
        chance = random.Random(1)
        taken = [(size, (300 + 20 * size) * chance.uniform(0.9, 1.1), 60.0) for size in (chance.uniform(1, 60) for _ in range(400))]
        model = asks.fitted(taken[:200])
        shares = [asks.asked(model, "mb", size, 1) / mb for size, mb, _ in taken[200:]]
        self.assertGreaterEqual(sum(1.0 <= share <= 1.6 for share in shares) / len(shares), 0.95)

    def test_an_attempt_more_asks_for_twice_as_much(self):
        model = asks.of_thumb("mesh")
        first, second = (asks.asked(model, "mb", 4.0, attempt) for attempt in (1, 2))
        self.assertEqual(second - 1, 2 * (first - 1))

    def test_a_few_steps_are_no_model(self):
        self.assertIsNone(asks.fitted([(1.0, 100.0, 1.0)] * (asks.FEWEST - 1)))
        self.assertIsNotNone(asks.fitted([(1.0, 100.0, 1.0)] * asks.FEWEST))

    def test_they_are_read_off_manifests_and_kept_for_the_jobs_of_a_run(self):
        with tempfile.TemporaryDirectory() as folder:
            cohort = pathlib.Path(folder)
            for number in range(asks.FEWEST):
                (cohort / "lumens" / f"p-{number}").mkdir(parents=True)
            stages = {"lumen": ("lumens", "extract"), "mesh": ("meshes", "extract")}
            found = asks.kept(cohort / "asks.json", lambda: asks.models(cohort, stages, lambda *_: None, lambda *_: {"peak_mb": 200.0, "seconds": 600.0}), True)
            self.assertEqual(found["lumen"]["mb"], [250.0, 0.0])
            self.assertEqual(asks.asked(found["lumen"], "minutes", None, 1), 31)
            self.assertEqual(found["mesh"], asks.of_thumb("mesh"))
            self.assertEqual(asks.kept(cohort / "asks.json", lambda: None, False), json.loads(json.dumps(found)))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
