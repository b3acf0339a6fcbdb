"""The hair types that a scene can start from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from frisure._frisure import preset_names, preset_text
from frisure.scene import Scene


class Presets(Mapping[str, Scene]):
    """The hair types by name, each as a new scene of it; `docs/hair-types.md` has their numbers and sources."""

    @property
    def names(self) -> list[str]:
        """The names of the hair types."""
        return [name for name, _ in preset_names()]

    @property
    def descriptions(self) -> dict[str, str]:
        """What each hair type is, in words."""
        return dict(preset_names())

    def __getitem__(self, name: str) -> Scene:
        text = preset_text(name) if isinstance(name, str) else None
        if text is None:
            raise KeyError(f"{name!r} is no hair type; there are {', '.join(self.names)}")
        return Scene.from_text(text, file=f"<{name}>")

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)

    def __repr__(self) -> str:
        return f"<frisure.presets: {', '.join(self.names)}>"


presets = Presets()
"""The hair types by name, each as a new scene of it."""
