"""The test of examples must find what it is there for. Usage: quoted_test.py PROGRAMS"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import quoted
import usage

PROGRAMS = pathlib.Path(sys.argv[1]).resolve()
HERE = pathlib.Path(__file__).parent


def block(*lines, language="sh"):
    return "\n".join([f"```{language}", *lines, "```", ""])


class Extraction(unittest.TestCase):
    def texts(self, page):
        return [q.text for q in quoted.commands_of("page", page)]

    def test_blocks_are_split_into_whole_commands(self):
        page = block("# only a comment", "ostia info a.vtp   # what is it", "", "for r in 1 2; do", "  echo $r", "done",
                     "cat > edits <<'END'", "{}", "END", "ostia mesh a \\", "  -o b")
        self.assertEqual(self.texts(page), ["ostia info a.vtp   # what is it", "for r in 1 2; do\n  echo $r\ndone",
                                            "cat > edits <<'END'\n{}\nEND", "ostia mesh a \\\n  -o b"])

    def test_other_blocks_are_no_commands(self):
        self.assertEqual(self.texts(block("vessel  ov", "LAD  0.9", language="") + block("int a;", language="cpp")), [])
        self.assertEqual(self.texts(block("ostia info a", language="")), ["ostia info a"])

    def test_lines_are_looked_through(self):
        self.assertEqual(self.texts("Try `ostia info a.vtp`, or `build/release/bin/ostia-live x`; `mesh` is another word.\n"),
                         ["ostia info a.vtp", "build/release/bin/ostia-live x"])

    def test_marks_are_for_what_follows_them(self):
        page = "<!-- not run: hours -->\n" + block("ostia a b") + "<!-- exit code: 4 -->\n`ostia c d`\nand `ostia e f`\n\n`ostia g h`\n"
        self.assertEqual([q.marks for q in quoted.commands_of("page", page)],
                         [{"not run": "hours"}, {"exit code": "4"}, {"exit code": "4"}, {}])
        page = "`ostia a b`\n\n<!-- slow on this page: minutes -->\n" + block("ostia c d") + "`ostia e f`\n"
        self.assertEqual([q.marks for q in quoted.commands_of("page", page)], [{}, {"slow": "minutes"}, {"slow": "minutes"}])

    def test_marks_that_are_misspelt_are_refused(self):
        for mark in ("<!-- not run -->", "<!-- not run: -->", "<!-- slow -->", "text <!-- not run: hours -->"):
            with self.assertRaises(ValueError, msg=mark):
                quoted.commands_of("page", mark + "\n" + block("ostia a b"))

    def test_files_and_what_is_printed(self):
        file, command = quoted.commands_of("page", "<!-- file: a.json -->\n" + block("{}", language="json") + block("ostia a; echo $?") + block("4", language=""))
        self.assertEqual((file.file, file.text, command.printed), ("a.json", "{}\n", "4"))

    def test_words(self):
        command, = usage.split_words("ostia convert in.vtp -.stl --units cm > out.stl  # and so on")
        self.assertEqual((usage.outputs_of(command), usage.inputs_of(command)), (["out.stl"], ["in.vtp", "cm"]))

    def test_examples_of_help(self):
        text = "Options:\n  -o\n\nExamples:\n  ostia-live motion/          a beating tree\n  ostia info CT/ --preview slices\n"
        self.assertEqual([q.text for q in quoted.examples_of_help("ostia", text)], ["ostia-live motion/", "ostia info CT/ --preview slices"])


class Usage(unittest.TestCase):
    known = usage.Usage(str(PROGRAMS))

    def test_the_program_reads_the_words(self):
        for right in ("ostia mesh lumen.stl -o mesh --edge-ratio 0.3", "ostia experiment sensitivity -o out", "ostia --quiet info a"):
            self.assertEqual(self.known.fault(right.split()), "", right)
        for wrong in ("ostia mesh lumen.stl -o mesh --edge-ratio 33", "ostia mesh a -o b --no-such", "ostia nothing a", "ostia mesh a -o"):
            self.assertNotEqual(self.known.fault(wrong.split()), "", wrong)

    def test_mentions(self):
        for mention in ("ostia mesh", "ostia mesh CASE -o DIR", "ostia convert --repair", "ostia evaluate lumen REFERENCE RESULT", "ostia measure --patch-length"):
            self.assertTrue(self.known.is_mention(mention.split()), mention)
        for whole in ("ostia info CT/", "ostia model --builtin -o first", "ostia evaluate lumen --floor"):
            self.assertFalse(self.known.is_mention(whole.split()), whole)
        self.assertEqual(self.known.unknown("ostia evaluate lumen|surface [--json]".split()), "")
        self.assertIn("no option --repairs", self.known.unknown("ostia convert --repairs".split()))
        self.assertIn("no command ostia evaluate lumens", self.known.unknown("ostia evaluate lumen|lumens".split()))


class WholeTest(unittest.TestCase):
    def run_on(self, readme):
        with tempfile.TemporaryDirectory() as holder:
            root = pathlib.Path(holder)
            (root / "docs").mkdir()
            (root / "README.md").write_text(readme)
            done = subprocess.run([sys.executable, "-B", HERE / "examples_test.py", PROGRAMS, root, root / "cache", "--only", "README.md"],
                                  capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_a_page_that_is_right(self):
        code, said = self.run_on(block("ostia convert tree.swc tree.vtp", "n=tree", "ostia info $n.vtp", "ostia convert tree.vtp new/axes.csv")
                                 + "`new/axes.csv` is a table.\n\n<!-- exit code: 3 -->\n" + block("ostia info nothing.vtp"))
        self.assertEqual(code, 0, said)
        self.assertIn("5 commands ran, 0 were checked", said)

    def test_faults(self):
        for page, told in ((block("ostia info nothing.vtp"), "README.md:2: ostia info nothing.vtp\n    exit code 3, not 0"),
                           (block("true > a; ostia info tree.swc -o"), "exit code 2, not 0"),
                           ("<!-- not run: hours -->\n" + block("ostia mesh a -o b --layer 3"), "--layer"),
                           ("The option is `ostia mesh --layer N`.\n", "ostia mesh has no option --layer"),
                           (block("ostia convert tree.swc new/a.vtp") + "`new/b.vtp` is there.\n", "have not made new/b.vtp"),
                           (block("ostia info nothing.vtp; echo $?") + "\n" + block("4", language=""), "prints ['3'], the text says ['4']"),
                           ("<!-- not run -->\n" + block("ostia info a"), "this mark is not understood")):
            code, said = self.run_on(page)
            self.assertNotEqual(code, 0, page)
            self.assertIn(told, said, page)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
