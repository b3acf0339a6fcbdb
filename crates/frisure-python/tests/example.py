"""What a user writes, for `mypy --strict`; `test_types.py` runs it, too."""

from pathlib import Path

import frisure
import numpy as np
from numpy.typing import NDArray


def main(folder: Path) -> NDArray[np.uint8]:
    scene = frisure.Scene({"hair": {"type": "caucasian-curly"}, "wisps": {"count": 12, "hairs": 50}})
    scene.hair.length = "8 cm"
    hair = frisure.predict(scene, progress=lambda stage, done: None)
    points: NDArray[np.float32] = hair.strands.points
    lowest = float(points[:, 2].min())
    bob = hair.wet().cut("chin").dry()
    assert float(bob.strands.points[:, 2].min()) >= lowest - 0.1
    bob.save(folder / "bob.hair")
    stable: int = bob.report["guides"]["stable"]
    assert stable == 12
    rest = frisure.rods.settle(np.linspace(0.1, 0.2, 5), curl_radius=0.01)
    assert rest.points is not None
    energy: NDArray[np.float64] = rest.energy
    assert energy.shape == (5,)
    try:
        frisure.Scene("[hair]\nlength = 3\n")
    except frisure.SceneError as error:
        print(error.line, error.hint)
    picture = bob.render(90, 110)
    return picture
