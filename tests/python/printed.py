"""The Python that texts and notebooks print."""
import json
import re

RECIPE = re.compile(r"^## (\d+)\. ([^\n]+)\n\nVMTK: ([^\n]+)\n\n```python\n(.*?)^```$", re.M | re.S)


def recipes(source):
    """(number, title, VMTK's names, code) of each."""
    page = (source / "docs" / "tutorials" / "python-recipes.md").read_text(encoding="utf-8")
    return [(int(number), title, names, code) for number, title, names, code in RECIPE.findall(page)]


def notebooks(source):
    return sorted((source / "examples" / "notebooks").glob("*.ipynb"))


def code_of(notebook):
    """Its cells as one program."""
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    return "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code") + "\n"
