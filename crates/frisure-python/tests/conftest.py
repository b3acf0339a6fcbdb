"""What the tests share: a small head of hair, predicted once."""

from __future__ import annotations

from typing import Any

import frisure
import pytest

SMALL: dict[str, Any] = {
    "name": "small",
    "hair": {"type": "caucasian-curly", "length": "12 cm"},
    "wisps": {"count": 30, "hairs": 200},
    "output": {"width": 120, "height": 140},
}
"""A head that is predicted in a second."""


@pytest.fixture(scope="session")
def hair() -> frisure.Hairstyle:
    return frisure.predict(SMALL)
