"""frisure predicts how natural hair falls, from the physics of its fibres.

>>> import frisure
>>> hair = frisure.predict({"hair": {"type": "caucasian-curly", "length": "12 cm"},
...                         "wisps": {"count": 12, "hairs": 100}})
>>> hair.strands.points.shape[1]
3
>>> short = hair.wet().cut("chin").dry()
>>> picture = short.render(300, 360)          # (360, 300, 3), uint8

- `predict` makes a `Hairstyle` from a `Scene`: a file, a text in TOML, or a dict.
- A `Hairstyle` has `strands` and `guides` as NumPy arrays, a `report`, one method for each step of styling, and
  exact `derivatives` of all guides together.
- `frisure.rods` solves many single fibres at once; `frisure.fit` finds the numbers of measured ones, with error bars;
  `frisure.measure` those of a lock in a photo.
- `frisure.batch` computes many heads that vary, as a table of Arrow.
- `frisure.presets` has a scene for each hair type.

Lengths are metres, z points up, the face looks towards -y and its left is +x. Every error about an argument is a
`FrisureError`; those about what was asked for are `ValueError`s, too. A key, an attribute or an index that is not there is a
`KeyError`, an `AttributeError` or an `IndexError`.
"""

import os as _os

from frisure import rods
from frisure._batch import batch
from frisure._frisure import __version__
from frisure._frisure import after_fork as _after_fork
from frisure.derivatives import HeadDerivatives
from frisure.errors import ArgumentError, ArgumentTypeError, FailedError, FrisureError, SceneError, SceneNotFoundError
from frisure.fits import Fits, fit
from frisure.hairstyle import Hairstyle, predict
from frisure.photos import Measured, measure
from frisure.presets import presets
from frisure.scene import Items, Scene, Section
from frisure.strands import Strands

__all__ = [
    "ArgumentError",
    "ArgumentTypeError",
    "FailedError",
    "Fits",
    "FrisureError",
    "Hairstyle",
    "HeadDerivatives",
    "Items",
    "Measured",
    "Scene",
    "SceneError",
    "SceneNotFoundError",
    "Section",
    "Strands",
    "__version__",
    "batch",
    "fit",
    "measure",
    "predict",
    "presets",
    "rods",
]

# A fork has none of the threads that compute, and is told so where it asks for them, instead of waiting for ever.
if hasattr(_os, "register_at_fork"):
    _os.register_at_fork(after_in_child=_after_fork)
