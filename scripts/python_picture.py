#!/usr/bin/env python3
"""The picture that README's lines of Python make: python_picture.py README.md PICTURE.png"""
import os
import pathlib
import re
import shutil
import sys
import tempfile

import ostia


def main():
    readme, picture = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    code = re.search(r"^```python\n(.*?)^```$", readme.read_text(encoding="utf-8"), re.S | re.M)[1]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        ostia.write_surface("lumen.stl", ostia.example_surface())
        exec(code, {})
        shutil.copy("mesh.png", picture)
        os.chdir("/")


if __name__ == "__main__":
    main()
