"""A bar for `progress=True`: tqdm's where it is there, else a line on standard error."""

from __future__ import annotations

import sys
from typing import Any


class Bar:
    """Takes (fraction, stage) as all progress callbacks do; `close` ends it."""

    def __init__(self) -> None:
        self._stage = ""
        self._bar: Any = None
        try:
            from tqdm.auto import tqdm

            self._bar = tqdm(total=100, leave=False)
        except ImportError:
            self._lines = sys.stderr.isatty()

    def __call__(self, fraction: float, stage: str) -> None:
        if self._bar is not None:
            self._bar.n = round(100 * fraction)
            self._bar.set_description(stage)
        elif self._lines:
            sys.stderr.write(f"\r{100 * fraction:3.0f} % {stage}\033[K")
            sys.stderr.flush()
        elif stage != self._stage:
            sys.stderr.write(f"{100 * fraction:3.0f} % {stage}\n")
        self._stage = stage

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
        elif self._lines:
            sys.stderr.write("\r\033[K")
