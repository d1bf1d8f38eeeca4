#!/usr/bin/env python3
"""check_docs.py must find what it is there for: check_docs_test.py CHECK."""
import pathlib
import subprocess
import sys
import tempfile

SOUND = {
    "README.md": "# Title\n\n[index](docs/index.md#methods)\n",
    "docs/index.md": "# Index\n\n## Methods\n\n[page](methods/page.md) ![picture](picture.png) `[no](link.md)`\n",
    "docs/methods/page.md": "# Page\n\n[Wels] 3.1 [back](../index.md)\n\n```\n[no](link.md)\n```\n",
    "docs/bibliography.md": "# Bibliography\n\n- **[Wels]** M. Wels\n",
    "docs/picture.png": "",
    "libs/core/src/a.cpp": "// docs/methods/page.md, [Wels]\nint b = a[Other];\n",
}
SOUND["docs/index.md"] += "[keys](bibliography.md)\n"
CASES = {
    "a link to nothing": ({"README.md": "[gone](docs/gone.md)\n"}, "README.md:1: nothing is at docs/gone.md"),
    "a picture that is gone": ({"README.md": "![x](docs/gone.png)\n"}, "nothing is at docs/gone.png"),
    "a heading that is gone": ({"README.md": "[x](docs/index.md#gone)\n"}, "no heading makes #gone"),
    "a page that no link leads to": ({"docs/methods/alone.md": "# Alone\n"}, "docs/index.md does not lead here"),
    "a mention in code": ({"libs/core/src/a.cpp": "// docs/gone.md\n"}, "libs/core/src/a.cpp:1: there is no docs/gone.md"),
    "an unknown key": ({"libs/core/src/a.cpp": "// [Nobody] 2.1\n"}, "[Nobody] is not in docs/bibliography.md"),
}


def run(check, changed):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**SOUND, **changed}.items():
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return subprocess.run([sys.executable, check, folder], capture_output=True, text=True, check=False)


def main():
    check = sys.argv[1]
    failed = 0
    for title, (changed, expected) in CASES.items():
        result = run(check, changed)
        if result.returncode != 1 or expected not in result.stdout:
            print(f"not found: {title}: {result.stdout}{result.stderr}")
            failed += 1
    sound = run(check, {})
    if sound.returncode != 0:
        print(f"sound pages were refused: {sound.stdout}{sound.stderr}")
        failed += 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
