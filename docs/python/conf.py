"""Sphinx: the reference of the package `ostia`, made of the package that is on PYTHONPATH (target python_docs)."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))

import ostia

extensions = ["reference"]
project = "ostia"
author = "Ostia"
copyright = "Ostia, Apache License 2.0"  # noqa: A001
version = release = ostia.__version__
html_title = f"The Python package ostia {release}"
html_theme = "alabaster"
html_theme_options = {"description": html_title, "fixed_sidebar": True, "page_width": "1100px", "sidebar_width": "230px"}
html_copy_source = False
smartquotes = False
add_module_names = False
python_use_unqualified_type_names = True
exclude_patterns = ["__pycache__"]
