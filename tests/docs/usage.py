"""Whether a quoted command could be run, without running it: the program itself reads its words."""
import functools
import re
import shlex
import subprocess
import tempfile

from quoted import PROGRAMS

BOGUS = "--no-option-has-this-name"
# A word that stands for one of the reader's own: FILE, CASE.ostia, A:B, x,y,z, [--json], a|b, ...
PLACEHOLDER = re.compile(r"[A-Z][A-Z_]*(\.[\w.]+)?|[A-Z]:[A-Z]|x,y,z|.*(\.\.\.|…|[\[\]|{}<>]).*")
OUTPUTS = ("-o", "--output", "--case", "--lines", "--levelset", "--canal", "--hexahedra", "--sections", "--preview", "--screenshot", "--video")


def simple_commands(text):
    """Lists of words between | && ; and the like; redirections' targets as (">", NAME) at the end of theirs."""
    words = shlex.shlex(text.replace("\\\n", " "), posix=True, punctuation_chars="|&;<>()")
    words.whitespace_split = True
    commands, current, redirection = [], [], ""
    for word in words:
        if set(word) <= set("|&;()"):
            commands.append(current)
            current = []
        elif set(word) <= set("<>"):
            redirection = word
        elif redirection:
            current.append((redirection, word))
            redirection = ""
        else:
            current.append(word)
    return [command for command in commands + [current] if command]


def split_words(text):
    try:
        return simple_commands(text)
    except ValueError:  # a quotation mark within a here-document
        return []


def name_of(command):
    return command[0].rsplit("/", 1)[-1] if isinstance(command[0], str) else ""


class Usage:
    def __init__(self, folder):
        self.folder = folder

    @functools.lru_cache(maxsize=None)
    def help(self, *words):
        """What `--help` prints, or nothing where there is no such command."""
        done = subprocess.run([f"{self.folder}/{words[0]}", *words[1:], "--help"], capture_output=True, text=True, check=False)
        return done.stdout if done.returncode == 0 else ""

    @functools.lru_cache(maxsize=None)
    def below(self, *words):
        _, heading, listed = self.help(*words).partition("\nSubcommands:\n")
        return re.findall(r"^  (\w[\w-]*)", listed.partition("\n\n")[0], re.M) if heading else []

    def fault(self, command):
        """Why the program does not take these words; nothing where it takes them. It is told two options that it cannot
        have, and must complain of these alone: so nothing is done. Of one, the last option could make its value."""
        program, words = name_of(command), [word for word in command[1:] if isinstance(word, str)]
        if program == "ostia-workstation":  # wants a display first
            return self.unknown(command)
        if program not in ("ostia", "ostia-live") or "--help" in words or "--version" in words:
            return ""
        with tempfile.TemporaryDirectory() as empty:
            done = subprocess.run([f"{self.folder}/{program}", *words, BOGUS, BOGUS], cwd=empty, capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL, timeout=60, check=False)
        said = done.stderr.strip().splitlines()
        complaint = re.search(r"not expected: (.*?)( \(.*)?$", said[0]) if done.returncode == 2 and said else None
        if complaint and complaint.group(1) == f"{BOGUS} {BOGUS}":
            return ""
        if complaint and complaint.group(1) == BOGUS:
            return "the last option has no value"
        return (said[0] if said else f"exit code {done.returncode}").replace(f" {BOGUS}", "")

    def unknown(self, command):
        """Of a mention: the first word that is no command, or the first option that the command has not."""
        words, at = [name_of(command)], 1
        while at < len(command) and self.below(*words):
            choices = command[at].split("|") if isinstance(command[at], str) else []
            missing = [word for word in choices if word not in self.below(*words)]
            if not choices or choices[0].startswith(("-", "[")) or PLACEHOLDER.fullmatch(choices[0]):
                break
            if missing:
                return f"there is no command {' '.join(words)} {missing[0]}"
            words.append(choices[0])
            at += 1
        known = set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", self.help(*words) + self.help(words[0])))
        for word in command[at:]:
            option = re.match(r"\[?(--?[a-z][\w-]*)", word) if isinstance(word, str) else None
            if option and option.group(1) not in known:
                return f"{' '.join(words)} has no option {option.group(1)}"
        return ""

    def is_mention(self, command):
        """Whether the text only speaks of a command: without what it works on, or with words that stand for others."""
        words = [word for word in command[1:] if isinstance(word, str)]
        program = name_of(command)
        if any(PLACEHOLDER.fullmatch(word) for word in words):
            return True
        if program == "ostia-worker" or (program != "ostia" and all(word.startswith("-") for word in words)):
            return True
        if words[:1] == ["mesh"] and not {"-o", "--output", "--check", "--forecast"} & set(words):
            return True
        if len(words) < (3 if words[:1] in (["evaluate"], ["motion"], ["experiment"]) else 2):
            return True
        fault = self.fault(command)
        if words[-1].startswith("--") and fault.startswith(words[-1] + ":"):  # it wants a value
            return True
        return bool(re.search(r"is required|requires|required .* missing|subcommand|no value|\bneeds\b", fault, re.I))


def outputs_of(command):
    """Files and folders that the words say are made."""
    words = [word for word in command if isinstance(word, str)]
    made = [after for option, after in zip(words, words[1:]) if option in OUTPUTS]
    made += [word[1] for word in command if isinstance(word, tuple) and ">" in word[0]]
    if words[:2] == ["ostia", "convert"]:
        made += [after for word, after in zip(words[2:], words[3:]) if not word.startswith("--") and not after.startswith("--")][:1]
    return [name for name in made if not name.startswith("-") and "$" not in name and not name.startswith("/dev/")]


def inputs_of(command):
    """Names that the words may mean as inputs: all that are neither options, nor commands, nor outputs."""
    words = [word for word in command if isinstance(word, str)]
    made, names = set(outputs_of(command)), [word[1] for word in command if isinstance(word, tuple) and word[0] == "<"]
    start = 1
    if name_of(command) == "ostia":
        start = 3 if words[1:2] in (["motion"], ["evaluate"], ["experiment"], ["plugin"]) else 2
    if name_of(command) not in PROGRAMS:
        start = 0
    for word in words[start:]:
        name = word.split("=", 1)[-1].rstrip("/")
        if name and not word.startswith("-") and name not in made and word not in made:
            names.append(name)
    return names
