"""What a pickle of a model names."""

from typing import Any

from ostia._start import library


def model_of_bytes(content: bytes) -> Any:
    """A model from the case file that its pickle holds."""
    return library._model_of_bytes(content)
