"""The commands that a text quotes: those in its blocks of shell, and those in its lines that are whole commands.

A comment before a block, a paragraph or a table says what cannot be run there:
  <!-- not run: REASON -->   never (hours, a network, root); that its options exist is checked all the same
  <!-- slow: REASON -->      by the slow test alone
  <!-- needs: PROGRAM -->    where PROGRAM is installed
  <!-- exit code: N -->      what each command of it ends with
  <!-- file: NAME -->        not commands: the block is what the file NAME of the next commands holds
`not run on this page` and `slow on this page` hold from there to the page's end.
"""
import dataclasses
import re
import subprocess

PROGRAMS = ("ostia", "ostia-live", "ostia-workstation", "ostia-worker")
WORD = r"(?:build/release/bin/)?(?:" + "|".join(sorted(PROGRAMS, reverse=True)) + ")"
MARK = re.compile(r"^\s*<!--\s*(not run|slow|needs|exit code|file|not run on this page|slow on this page):\s*(.*?)\s*-->\s*$")
ODD_MARK = re.compile(r"<!--\s*(not run|slow|needs|exit code|file)\b")
FENCE = re.compile(r"^(\s*)(`{3,})\s*(\S*)\s*$")
INLINE = re.compile(r"`(" + WORD + r" [^`\n]+)`")
SHELL = ("sh", "bash", "shell", "console")


@dataclasses.dataclass
class Quoted:
    """A command, or a file that the text shows; printed is what the text says that it prints."""
    page: str
    line: int
    text: str
    marks: dict
    inline: bool = False
    file: str = ""
    printed: str = ""


def is_whole(text):
    """Whether bash has the whole of a command."""
    done = subprocess.run(["bash", "-n"], input=text, capture_output=True, text=True, check=False)
    return done.returncode == 0 and "here-document" not in done.stderr and not text.rstrip("\n").endswith("\\")


def split(lines):
    """Commands of a block, each with the number of its first line: loops, functions and here-documents stay whole."""
    commands, begun, first = [], [], 0
    for number, line in enumerate(lines):
        if not begun and (not line.strip() or line.lstrip().startswith("#")):
            continue
        if not begun:
            first = number
        begun.append(line)
        text = "\n".join(begun)
        # Most are one line that opens nothing: bash need not be asked.
        if (len(begun) == 1 and not re.search(r"[\\{(<'\"]|\b(for|while|if|case)\b", text)) or is_whole(text + "\n"):
            commands.append((first, text))
            begun = []
    if begun:
        commands.append((first, "\n".join(begun)))
    return commands


def _is_shell(language, lines):
    first = next((line.strip() for line in lines if line.strip()), "")
    return language in SHELL or (not language and re.match(WORD + r"(\s|$)", first) is not None)


def _end_of_fence(lines, at):
    fence = FENCE.match(lines[at]).group(2)
    end = at + 1
    while end < len(lines) and not lines[end].strip().startswith(fence):
        end += 1
    return end


def _of_block(name, lines, start, end, marks):
    language, content = FENCE.match(lines[start]).group(3), lines[start + 1:end]
    if "file" in marks:
        return [Quoted(name, start + 1, "\n".join(content) + "\n", marks, file=marks["file"])]
    if not _is_shell(language, content):
        return []
    made = [Quoted(name, start + 2 + at, text, marks) for at, text in split(content)]
    after = end + 1
    while after < len(lines) and not lines[after].strip():
        after += 1
    if made and after < len(lines) and lines[after].strip() == "```":  # what it prints
        made[-1].printed = "\n".join(lines[after + 1:_end_of_fence(lines, after)])
    return made


def commands_of(name, text):
    """Commands and files of a page in its order. Raises ValueError for a mark that is misspelt."""
    lines, found, marks, whole_page, at = text.splitlines(), [], {}, {}, 0
    within = False  # a paragraph that the marks are for
    while at < len(lines):
        line = lines[at]
        mark = MARK.match(line)
        if mark:
            what, value = mark.groups()
            if not value:
                raise ValueError(f"{name}:{at + 1}: the mark says no reason: {line.strip()}")
            if what.endswith(" on this page"):
                whole_page[what.removesuffix(" on this page")] = value
            else:
                marks = {**(marks if not within else {}), what: value}
                within = False
        elif ODD_MARK.search(line):
            raise ValueError(f"{name}:{at + 1}: this mark is not understood: {line.strip()}")
        elif FENCE.match(line):
            end = _end_of_fence(lines, at)
            found += _of_block(name, lines, at, end, {**whole_page, **marks})
            marks, within, at = {}, False, end
        elif not line.strip():
            if within:
                marks, within = {}, False
        else:
            within = True
            found += [Quoted(name, at + 1, text, {**whole_page, **marks}, inline=True) for text in INLINE.findall(line)]
        at += 1
    return found


def examples_of_help(command, text):
    """The examples at the end of `--help`. What is said behind them, two blanks or more away, is left out."""
    _, heading, examples = text.partition("\nExample")
    lines = examples.splitlines()[1:] if heading else []
    return [Quoted(f"`{command} --help`", number, re.sub(r"(\S)\s{2,}\S.*$", r"\1", line.strip()), {})
            for number, line in enumerate(lines, 1) if re.match(r"\s*" + WORD + r"\s", line)]
