"""The directive `ostia`: public names, with the types that the stubs have, and the words and defaults of the package itself."""
import ast
import importlib
import inspect
import pathlib
import re

import ostia
from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from ostia import _ostia
from sphinx.util.nodes import nested_parse_with_titles

PACKAGE = pathlib.Path(ostia.__file__).parent
DEFAULT = re.compile(r"(\w+): (?:[\w.]|\[[^\]]*\])+ = ([^,)]+)")  # in the first line of what pybind11 writes


def declared(module):
    """What a module's stub declares, by name."""
    stub = PACKAGE / f"{module or '__init__'}.pyi"
    tree = ast.parse((stub if stub.exists() else stub.with_suffix(".py")).read_text(encoding="utf-8"))
    return by_name(tree.body)


def by_name(nodes):
    """Functions, with all their signatures, and all else that a stub declares."""
    found = {}
    for node in nodes:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found.setdefault(node.name, []).append(node)
        elif isinstance(node, ast.AnnAssign):
            found.setdefault(node.target.id, []).append(node)
    return found


def text_of(thing):
    """Its doc string without the lines of signatures and options, which are shown from the stubs."""
    lines = (inspect.getdoc(thing) or "").splitlines()
    ours = [line for line in lines if "->" not in line and "(*args, **kwargs)" not in line and line != "Overloaded function."]
    return "\n".join(line for line in ours if not line.startswith("Options")).strip()


def marked(text):
    """Plain words as reStructuredText: what stands in backquotes is code."""
    parts = text.split("`")
    if len(parts) % 2 == 0:
        return re.sub(r"([*|\\`]|_\b)", r"\\\1", text)
    return "".join(f"``{part}``" if at % 2 else re.sub(r"([*|\\]|(?<=\w)_(?=\W|$))", r"\\\1", part) for at, part in enumerate(parts))


def paragraphs(text):
    """Lines that are set in, `name: words`, are a list."""
    out = []
    for line in text.splitlines():
        name, colon, words = line.strip().partition(": ")
        if line.startswith("  ") and colon:
            out += ([""] if out and not out[-1].startswith("* ") else []) + [f"* ``{name}``: {marked(words)}"]
        elif out and out[-1].startswith("* ") and line.strip():
            out[-1] += " " + marked(line.strip())
        else:
            out.append(marked(line.strip()))
    return out


def options_in_options(function):
    """The defaults of options that are dictionaries, and of those that are none, or lists, unless they are given."""
    always = {name: value for name, value in _ostia._options.get(function, {}).items() if isinstance(value, dict)}
    lines = []
    for title, groups in (("Options in options:", always), ("In those that are none, or lists, unless they are given:", _ostia._options_given.get(function, {}))):
        shown = [f"* ``{name}``: ``{', '.join(f'{key}={value!r}' for key, value in group.items())}``" for name, group in groups.items()]
        lines += ["", title, "", *shown] if shown else []
    return lines


def with_defaults(arguments, thing, function=""):
    """The arguments as text; where the stub has no default, the library's own."""
    known = dict(DEFAULT.findall((thing.__doc__ or "").split("\n", 1)[0]))
    known.update({name: repr(value) for name, value in _ostia._options.get(function, {}).items() if not isinstance(value, dict)})

    def default(argument, value):
        if not isinstance(value, ast.Constant) or value.value is not Ellipsis or argument.arg not in known:
            return value
        try:
            return ast.parse(known[argument.arg], mode="eval").body
        except SyntaxError:
            return value

    arguments.args = [one for one in arguments.args if one.arg not in ("self", "cls")]
    last = arguments.args[len(arguments.args) - len(arguments.defaults):]
    arguments.defaults = [default(*pair) for pair in zip(last, arguments.defaults)]
    arguments.kw_defaults = [value and default(one, value) for one, value in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return ast.unparse(arguments)


def command_arguments(arguments):
    """What must be given; the rest is listed below."""
    arguments.kwonlyargs = [one for one, value in zip(arguments.kwonlyargs, arguments.kw_defaults) if value is None]
    arguments.kw_defaults = [None] * len(arguments.kwonlyargs)
    arguments.kwarg = ast.arg("options", ast.Name("Any"))


def block(head, options, body):
    return f".. py:{head}".splitlines() + [f"   {line}" for line in options] + [""] + [f"   {line}" if line else "" for line in body] + [""]


def function_lines(kind, name, nodes, thing, text):
    head = f"{kind}:: "
    signatures = []
    for node in nodes:
        gives = f" -> {ast.unparse(node.returns)}" if node.returns is not None else ""
        signatures.append(f"{name}({with_defaults(node.args, thing, name)}){gives}")
    static = any(ast.unparse(one) == "staticmethod" for one in nodes[0].decorator_list)
    return block(head + ("\n" + " " * len(f".. py:{head}")).join(signatures), [":staticmethod:"] if static else [], text)


def member_lines(name, nodes, thing):
    if isinstance(nodes[0], ast.AnnAssign):
        return block(f"attribute:: {name}", [f":type: {ast.unparse(nodes[0].annotation)}"], [])
    if name.startswith("_"):
        return []
    own = getattr(thing, name)
    if any(ast.unparse(one).endswith("property") for one in nodes[0].decorator_list):
        return block(f"property:: {name}", [f":type: {ast.unparse(nodes[0].returns)}"], paragraphs(text_of(own)))
    return function_lines("method", name, nodes, own, paragraphs(text_of(own)))


def class_lines(name, node, thing):
    members = by_name(node.body)
    text = paragraphs(text_of(thing)) if thing is not None else ["A dictionary with these keys."]  # of the stub alone
    made = members.get("__init__")
    if made and text_of(thing.__init__):
        text += ["", *paragraphs(text_of(thing.__init__))]
    arguments = f"({with_defaults(made[0].args, thing.__init__)})" if made else ""
    return block(f"class:: {name}{arguments}", [], text + [""] + [line for one in members for line in member_lines(one, members[one], thing)])


def error_lines(name, thing):
    above = ", ".join(base.__name__ for base in thing.__bases__)
    return block(f"exception:: {name}", [], [marked(text_of(thing)), "", f"Also: {above}. Exit code of the commands: {thing.exit_code}."])


def lines_of(name):
    """The reStructuredText of `mesh_lumen`, `Volume`, `convert.to_vtk`."""
    module, _, last = name.rpartition(".")
    where = importlib.import_module(f"ostia.{module}") if module else ostia
    thing = getattr(where, last, None)
    if isinstance(thing, type) and issubclass(thing, BaseException):
        return error_lines(name, thing)
    nodes = declared(module)[last]
    if isinstance(nodes[0], ast.ClassDef):
        return class_lines(name, nodes[0], thing)
    if module == "commands" and last in where.names:
        command_arguments(nodes[0].args)
    return function_lines("function", name, nodes, thing, paragraphs(text_of(thing)) + options_in_options(name))


class Names(Directive):
    """`.. ostia:: NAME NAME ...`; `commands.*` is all commands."""

    has_content = True

    def run(self):
        names = [name for line in self.content for name in line.split()]
        if names == ["commands.*"]:
            names = [f"commands.{name}" for name in sorted(ostia.commands.names)]
        text = [line for name in names for line in lines_of(name)]
        parent = nodes.Element()
        nested_parse_with_titles(self.state, StringList(text, source="the package ostia"), parent)
        return parent.children


def setup(app):
    app.add_directive("ostia", Names)
    return {"parallel_read_safe": True}
