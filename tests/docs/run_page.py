"""Runs the commands of one page in a folder of its own, one shell for all of them, as a reader would type them."""
import os
import pathlib
import re
import select
import shutil
import signal
import subprocess

from inputs import BESIDE, Missing
from quoted import PROGRAMS
from usage import inputs_of, name_of, outputs_of, split_words

OPENS_WINDOW = re.compile(r"\bostia-(workstation|live)\b(?!.*--(screenshot|video|help|version))")


def smaller(text):
    """The same with a phantom that takes seconds, and a coarser cage for it: the quick test's."""
    if "--depth" not in text:
        text = text.replace("ostia motion fit ", "ostia motion fit --depth 2 ")
    if "ostia phantom" not in text:
        return text
    text = re.sub(r"--cases \d+", "--cases 1", re.sub(r"--phases \d+", "--phases 4", text))
    text = re.sub(r"--preset \w+|--surface-spacing \S+|--no-report|--formats \S+", "", text)
    return text.replace("ostia phantom", "ostia phantom --preset tiny --surface-spacing 1 --formats nrrd --no-report")


class Shell:
    """One bash. What it runs reads nothing from the test's input."""

    def __init__(self, folder, environment):
        self.folder = folder
        self.told, tell = os.pipe()
        self.process = subprocess.Popen(["bash", "--noprofile", "--norc", "-o", "pipefail"], cwd=folder, env=environment,
                                        stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                        pass_fds=(tell,), start_new_session=True)
        self.tell = tell
        self.used_s = self.last_s = 0.0  # of processor time
        os.close(tell)

    def run(self, text, log, limit_s):
        """Exit code and what was printed; code None where it took longer than the limit."""
        script = f"{{\n{text}\n}} > '{log}.out' 2> '{log}.err' < /dev/null {self.tell}>&-\n{{ echo $?; times; echo end; }} >&{self.tell}\n"
        self.process.stdin.write(script.encode())
        self.process.stdin.flush()
        answer = []
        while answer[-1:] != ["end"] and select.select([self.told], [], [], limit_s)[0]:
            told = os.read(self.told, 256).decode().split()
            if not told:  # the shell is gone
                answer = []
                break
            answer += told
        read = lambda end: pathlib.Path(f"{log}.{end}").read_text(errors="replace") if pathlib.Path(f"{log}.{end}").exists() else ""
        if answer[-1:] != ["end"]:
            return None, read("out"), read("err") or "the shell ended: is the command whole?"
        used = sum(60 * float(m) + float(s) for m, s in re.findall(r"(\d+)m([\d.]+)s", " ".join(answer[1:])))
        self.last_s, self.used_s = used - self.used_s, used
        return int(answer[0]), read("out"), read("err")

    def close(self):
        self.process.stdin.close()
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait()
        os.close(self.told)


class Page:
    """ran, checked, mentioned: how many. reasons: why commands were only checked. faults: FILE:LINE: text."""

    def __init__(self, name, usage, inputs, slow):
        self.name, self.usage, self.inputs, self.slow = name, usage, inputs, slow
        self.ran = self.checked = self.mentioned = 0
        self.reasons, self.faults, self.times = {}, [], []
        self.given, self.reduced = {}, False

    def fail(self, quoted, text):
        self.faults.append(f"{quoted.page}:{quoted.line}: {quoted.text.splitlines()[0].strip()}\n    {text}")

    def why_not(self, quoted, commands):
        """Why it is not run here; nothing where it is."""
        marks = quoted.marks
        if "not run" in marks:
            return marks["not run"]
        if "slow" in marks and not self.slow:
            return "slow: " + marks["slow"]
        missing = [name for name in marks.get("needs", "").replace(",", " ").split() if not shutil.which(name)]
        if missing:
            return f"{missing[0]} is not installed"
        if any(OPENS_WINDOW.search(" ".join(w for w in c if isinstance(w, str))) for c in commands if name_of(c) in PROGRAMS):
            return "it opens a window"
        return ""

    def check(self, quoted, commands, reason):
        self.checked += 1
        self.reasons[reason] = self.reasons.get(reason, 0) + 1
        for command in commands:
            if name_of(command) in PROGRAMS and not any(isinstance(w, str) and "$" in w for w in command):
                fault = self.usage.fault(command)
                if fault:
                    self.fail(quoted, fault)
            elif isinstance(command[0], str) and command[0].startswith("scripts/") and not (self.inputs.source / command[0]).exists():
                self.fail(quoted, f"there is no {command[0]}")

    def give_inputs(self, commands, text, folder):
        made = {name for command in commands for name in outputs_of(command)}
        for command in commands:
            names = [name for name in inputs_of(command) if name.split("/")[0] not in made]
            for name in names + [beside for name in names for beside in BESIDE.get(name, ())]:
                given = self.inputs.place(name, text, folder, self.given)
                if given:
                    self.given[given[0]] = given[1]

    def judge(self, quoted, commands, code, out, err, folder):
        expected = int(quoted.marks.get("exit code", 0))
        if code is None:
            self.fail(quoted, f"did not end in time; {err[-300:]}")
        elif code != expected:
            self.fail(quoted, f"exit code {code}, not {expected}: {(err or out)[-1500:].strip()}")
        elif quoted.printed and re.search(r"echo \$\?\s*$", quoted.text) and not self.reduced:
            if out.split()[-1:] != quoted.printed.split()[-1:]:
                self.fail(quoted, f"prints {out.split()[-1:]}, the text says {quoted.printed.split()[-1:]}")
        for command in commands:
            for made in outputs_of(command):
                if code == expected and not (folder / made.removeprefix("./")).exists():
                    self.fail(quoted, f"has not made {made}")

    def run(self, all_quoted, text, folder, environment, limit_s):
        shell, logs = Shell(folder, environment), folder.parent / (folder.name + ".logs")
        logs.mkdir()
        try:
            self.run_in(shell, all_quoted, folder, logs, limit_s)
        finally:  # nothing that it began outlives the test
            shell.close()
        self.look_for_named_files(text, folder)

    def run_in(self, shell, all_quoted, folder, logs, limit_s):
        for number, quoted in enumerate(all_quoted):
            if quoted.file:
                (folder / quoted.file).write_text(quoted.text)
                continue
            commands = split_words(quoted.text)
            if quoted.inline and (re.search(r"\w\|\w", quoted.text) or not commands or self.usage.is_mention(commands[0])):
                self.mentioned += 1
                fault = self.usage.unknown(quoted.text.split())
                if fault and not self.name.startswith("CHANGELOG"):
                    self.fail(quoted, fault)
                continue
            reason = self.why_not(quoted, commands)
            if not reason:
                try:
                    self.give_inputs(commands, quoted.text, folder)
                except Missing as missing:
                    reason = str(missing)
                except (RuntimeError, OSError, subprocess.SubprocessError) as failure:
                    self.fail(quoted, str(failure))
                    continue
            if reason:
                self.check(quoted, commands, reason)
                continue
            self.ran += 1
            typed = quoted.text if self.slow else smaller(quoted.text)
            self.reduced = self.reduced or (typed != quoted.text and "ostia phantom" in typed)
            code, out, err = shell.run(typed, logs / str(number), limit_s)
            self.times.append((shell.last_s, quoted.text.splitlines()[0]))
            self.judge(quoted, commands, code, out, err, folder)
            if code is None:
                break

    def look_for_named_files(self, text, folder):
        """`first/report.html`: where the page has made the folder `first`, it must hold what the page says."""
        if self.reduced or not self.ran:
            return
        for number, line in enumerate(text.splitlines(), 1):
            for name in re.findall(r"`([\w-]+/\w[\w./-]*)`", line):
                top = name.split("/")[0]
                if top not in self.given and (folder / top).is_dir() and not (folder / name).exists():
                    self.faults.append(f"{self.name}:{number}: the page's commands have not made {name}")
