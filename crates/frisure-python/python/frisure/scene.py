"""Scenes: what hair is predicted, from text, and edited key by key."""

from __future__ import annotations

import difflib
import functools
import os
import re
import tomllib
import weakref
from collections.abc import Iterable, Iterator, Mapping, MutableMapping, MutableSequence
from pathlib import Path
from typing import Any, Union, overload

from frisure._check import path as _path
from frisure._check import shown
from frisure._check import text as _text
from frisure._frisure import SceneText, scene_keys
from frisure.errors import ArgumentError, ArgumentTypeError

SceneSource = Union["Scene", Mapping[str, Any], "os.PathLike[str]", str]
"""What a scene is made from: another one, a dict, a path, or text in TOML (a str with a line break)."""


@functools.cache
def _keys() -> dict[str, str]:
    """The declared keys with their documentation."""
    return dict(scene_keys())


def _parts(path: str) -> list[str | int]:
    """The steps of a path such as `region[0].length`."""
    if not isinstance(path, str):
        raise ArgumentTypeError(f"a key is a text, such as 'hair.length', and not {shown(path)}")
    _text("a key", path)
    parts: list[str | int] = []
    for step in path.split("."):
        found = re.fullmatch(r"([^\[\]]+)((?:\[\d+\])*)", step)
        if found is None:
            raise KeyError(f"{path!r} is no key of a scene: names have dots between them, and items of lists an index, as in 'region[0].length'")
        parts.append(found[1])
        parts.extend(int(index) for index in re.findall(r"\d+", found[2]))
    return parts


_NONE: Any = object()
"""Stands for an argument that is not given."""


class Section(MutableMapping[str, Any]):
    """A table of a scene, such as `scene.hair`; it reads and changes the scene.

    `section.length` and `section["length"]` are what the scene says, as it is written: `"28 cm"`. A key that the scene
    leaves out is `None` as an attribute and a `KeyError` as an item; `frisure.Scene.number` tells its value. Setting a
    key checks it at once, `None` removes it, and a dict replaces a table. A list is an `Items`.

    A table of a list that is moved or replaced there keeps what it said, and cannot change the scene any more.
    """

    _scene: Scene | _Former
    _path: str

    def __init__(self, scene: Scene | _Former, path: str) -> None:
        object.__setattr__(self, "_scene", scene)
        object.__setattr__(self, "_path", path)

    def _key(self, name: str) -> str:
        return f"{self._path}.{name}" if self._path else name

    def _given(self) -> Mapping[str, Any]:
        """What the scene says of this table."""
        found = self._scene._find(self._path)
        return found if isinstance(found, dict) else {}

    def _view(self, name: str, value: Any) -> Any:
        return _view(self._scene, self._key(name), value)

    def _names(self) -> list[str]:
        """The keys that this table can have."""
        start = self._key("")
        keys = (key.removeprefix(start) for key in _keys() if key.startswith(start))
        return list(dict.fromkeys(re.split(r"[.\[]", key)[0] for key in keys))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        found = self._scene._find(self._key(name))
        if found is not None:
            return self._view(name, found)
        names = self._names()
        if name not in names:
            where = f"`{self._path}`" if self._path else "a scene"
            near = difflib.get_close_matches(name, names, 1)
            hint = f"; did you mean `{near[0]}`?" if near else f"; its keys are {', '.join(names)}"
            raise AttributeError(f"{where} has no key `{name}`{hint}")
        start = self._key(name) + "."
        return Section(self._scene, self._key(name)) if any(k.startswith(start) for k in _keys()) else None

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith("_"):
            object.__setattr__(self, name, value)
        else:
            self[name] = value

    def __delattr__(self, name: str) -> None:
        if self._scene._find(self._key(name)) is None:
            raise AttributeError(f"the scene does not give `{self._key(name)}`")
        del self[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._names()]

    def __getitem__(self, name: str) -> Any:
        found = self._scene._find(self._key(name))
        if found is None:
            raise KeyError(self._key(name))
        return self._view(name, found)

    def __setitem__(self, name: str, value: Any) -> None:
        self._scene._change([(self._key(name), value)])

    def __delitem__(self, name: str) -> None:
        if self._scene._find(self._key(name)) is None:
            raise KeyError(f"the scene does not give {self._key(name)!r}")
        self._scene._change([(self._key(name), None)])

    def __iter__(self) -> Iterator[str]:
        return iter(list(self._given()))

    def __len__(self) -> int:
        return len(self._given())

    def pop(self, name: str, default: Any = _NONE) -> Any:
        """Removes a key, and returns what the scene said: of a table a dict."""
        found = self._scene._find(self._key(name))
        if found is None:
            if default is _NONE:
                raise KeyError(self._key(name))
            return default
        del self[name]
        return _plain(found)

    def popitem(self) -> tuple[str, Any]:
        """Removes the first key of the table, and returns it with what the scene said."""
        for name in self:
            return name, self.pop(name)
        raise KeyError("the scene gives no keys")

    def update(self, *changes: Any, **keys: Any) -> None:
        """Sets several keys at once, for values that mean something only together."""
        merged = dict(*changes, **keys)
        self._scene._change([(self._key(name), value) for name, value in merged.items()])

    def to_dict(self) -> dict[str, Any]:
        """What the scene says of this table, as plain values."""
        return {key: _plain(value) for key, value in self._given().items()}

    def __repr__(self) -> str:
        return f"<frisure.Section {self._path!r}: {self.to_dict()!r}>"


class Items(MutableSequence[Any]):
    """A list of a scene, such as `scene.region`; it reads and changes the scene.

    Its tables are `Section`s: `scene.region[0].length = "2 cm"`, `scene.step.append({"dry": {}})`. What is popped is plain: of a table a dict.
    """

    _scene: Scene | _Former
    _path: str

    def __init__(self, scene: Scene | _Former, path: str) -> None:
        self._scene = scene
        self._path = path

    def _given(self) -> list[Any]:
        """What the scene says of this list."""
        found = self._scene._find(self._path)
        return found if isinstance(found, list) else []

    def _item(self, index: int) -> Any:
        return _view(self._scene, f"{self._path}[{index}]", self._given()[index])

    def to_list(self) -> list[Any]:
        """What the scene says of this list, as plain values."""
        return [_plain(item) for item in self._given()]

    @overload
    def __getitem__(self, index: int) -> Any: ...
    @overload
    def __getitem__(self, index: slice) -> list[Any]: ...
    def __getitem__(self, index: int | slice) -> Any:
        if isinstance(index, slice):
            return [self._item(i) for i in range(len(self))[index]]
        try:
            return self._item(range(len(self))[index])
        except IndexError:
            raise IndexError(f"`{self._path}` has {len(self)} items; there is none with the index {index}") from None

    @overload
    def __setitem__(self, index: int, value: Any) -> None: ...
    @overload
    def __setitem__(self, index: slice, value: Iterable[Any]) -> None: ...
    def __setitem__(self, index: int | slice, value: Any) -> None:
        items = self.to_list()
        items[index] = value
        self._scene._change([(self._path, items)])

    def __delitem__(self, index: int | slice) -> None:
        items = self.to_list()
        del items[index]
        self._scene._change([(self._path, items)])

    def insert(self, index: int, value: Any) -> None:
        items = self.to_list()
        items.insert(index, value)
        self._scene._change([(self._path, items)])

    # Those of `MutableSequence` move one item after the other, and each move changes what the next one reads.
    def pop(self, index: int = -1) -> Any:
        """Removes an item, and returns what the scene said: of a table a dict."""
        try:
            popped = self.to_list()[index]
        except IndexError:
            raise IndexError(f"`{self._path}` has {len(self)} items; there is none with the index {index}") from None
        del self[index]
        return popped

    def reverse(self) -> None:
        self[:] = self.to_list()[::-1]

    def extend(self, values: Iterable[Any]) -> None:
        self[:] = [*self.to_list(), *values]

    def clear(self) -> None:
        del self[:]

    def __len__(self) -> int:
        return len(self._given())

    def __eq__(self, other: object) -> bool:
        if isinstance(other, (Items, list, tuple)):
            return bool(self.to_list() == [_plain(item) for item in other])
        return NotImplemented

    def __repr__(self) -> str:
        return repr(self.to_list())


def _view(scene: Scene | _Former, path: str, value: Any) -> Any:
    """A value of a scene through which the scene is changed, if it has parts."""
    if not isinstance(value, (dict, list)):
        return value
    view = Section(scene, path) if isinstance(value, dict) else Items(scene, path)
    if "[" in path:
        views, key = scene._views, id(view)
        views[key] = weakref.ref(view, lambda _: views.pop(key, None))
    return view


def _plain(value: Any) -> Any:
    """A copy of values of TOML."""
    if isinstance(value, (dict, Section)):
        return {key: _plain(item) for key, item in value.items()}
    return [_plain(item) for item in value] if isinstance(value, (list, Items)) else value


_DEEPEST = 16
"""Levels of lists and tables that are looked into for views of scenes; no scene is as deep."""


def _own(value: Any, levels: int = _DEEPEST) -> Any:
    """A value for a scene, with copies of what belongs to one."""
    if isinstance(value, (Section, Items)):
        return _plain(value)
    if levels > 0 and isinstance(value, dict):
        return {key: _own(item, levels - 1) for key, item in value.items()}
    return [_own(item, levels - 1) for item in value] if levels > 0 and isinstance(value, (list, tuple)) else value


def _found(data: Any, path: str) -> Any:
    """What the tables of a scene say at a path; None if nothing."""
    found = data
    # The scene itself has the empty path.
    for part in _parts(path) if path != "" else []:
        if isinstance(part, int):
            found = found[part] if isinstance(found, list) and part < len(found) else None
        else:
            found = found.get(part) if isinstance(found, dict) else None
        if found is None:
            return None
    return found


_Views = dict[int, "weakref.ref[Any]"]
"""Views of items of lists, by their identity."""


class _Former:
    """What a scene said, for views of items that have been moved or replaced."""

    def __init__(self, data: dict[str, Any]) -> None:
        self._data = data
        self._views: _Views = {}

    def _find(self, path: str) -> Any:
        return _found(self._data, path)

    def _change(self, changes: list[tuple[str, Any]]) -> None:
        raise ArgumentError(f"{changes[0][0]!r} is of an item that has been moved or replaced since it was taken; take it from the scene again")


class Scene(Section):
    """A scene: hair, head, steps, look; `docs/scene.md` has all keys.

    It is made from another scene, a dict, a path (`os.PathLike`, or a str without a line break), or text in TOML.
    Paths in a dict or a text are relative to `folder`, by default the working directory at the time the scene is made.

    >>> scene = Scene({"hair": {"type": "caucasian-curly"}})
    >>> scene.hair.length = "20 cm"
    >>> scene["hair.length"], scene.number("hair.length")
    ('20 cm', 0.2)
    """

    _core: SceneText
    _data: dict[str, Any]
    _views: _Views

    def __init__(
        self, source: SceneSource, /, *, folder: str | os.PathLike[str] | None = None
    ) -> None:
        Section.__init__(self, self, "")
        within = _path("folder", folder) if folder is not None else Path()
        if isinstance(source, Scene):
            core = source._core
        elif isinstance(source, Mapping):
            core = SceneText.from_mapping(_own(source), within)
        elif isinstance(source, str) and "\n" in source:
            core = SceneText.parse(_text("scene", source), "<text>", within, False)
        elif isinstance(source, (str, os.PathLike)):
            core = SceneText.read(_path("scene", source))
        else:
            kind = type(source).__name__
            raise ArgumentTypeError(f"scene is of the type {kind}; it must be a Scene, a dict, a path or a text")
        self._set(core)

    @classmethod
    def from_text(
        cls,
        text: str,
        *,
        file: str = "<text>",
        folder: str | os.PathLike[str] | None = None,
    ) -> Scene:
        """The scene of a text in TOML; errors call it `file`."""
        within = _path("folder", folder) if folder is not None else Path()
        return cls._of(SceneText.parse(_text("text", text), _text("file", file), within, False))

    @classmethod
    def _of(cls, core: SceneText) -> Scene:
        scene = cls.__new__(cls)
        Section.__init__(scene, scene, "")
        scene._set(core)
        return scene

    def _set(self, core: SceneText) -> None:
        if "_views" not in self.__dict__:
            self._views = {}
        self._core = core
        self._data = tomllib.loads(core.text)

    def _find(self, path: str) -> Any:
        """What the scene says at a path; None if nothing."""
        return _found(self._data, path)

    def _change(self, changes: list[tuple[str, Any]]) -> None:
        leaves = [leaf for path, value in changes for leaf in self._leaves(path, _own(value))]
        before = self._data
        self._set(self._core.with_values(leaves))
        self._leave_behind(before, [path for path, _ in changes])

    def _leave_behind(self, before: dict[str, Any], lists: list[str]) -> None:
        """Lets views of items of these lists that are not the same any more keep what the scene said before."""
        former = _Former(before)
        for key, reference in list(self._views.items()):
            view = reference()
            if view is None:
                continue
            within = (path for path in lists if view._path.startswith(f"{path}["))
            items = (view._path[: view._path.index("]", len(path)) + 1] for path in within)
            if any(_found(before, item) != self._find(item) for item in items):
                view._scene = former
                del self._views[key]

    def _leaves(self, path: str, value: Any) -> list[tuple[str, Any]]:
        """The changes that replace what is at a path: of a table that is there, key by key, since it may be written under a heading."""
        if path == "":
            raise ArgumentError("a key has no name")
        try:
            there = self._find(path)
        except KeyError as error:
            raise ArgumentError(error.args[0]) from None
        if isinstance(value, (list, tuple)) and isinstance(there, list) and any(isinstance(item, dict) for item in there):
            return [(path, None), (path, value)]
        if not isinstance(value, Mapping) or not isinstance(there, dict):
            return [(path, value)]
        gone = [(f"{path}.{key}", None) for key in there if value.get(key) is None]
        kept = [leaf for key, item in value.items() if item is not None for leaf in self._leaves(f"{path}.{key}", item)]
        return gone + kept

    @property
    def text(self) -> str:
        """The scene in TOML, with its comments."""
        return self._core.text

    @property
    def file(self) -> str:
        """What errors call the scene: the path of its file, if it has one. Where the text was edited since it was read, they say so."""
        return self._core.name

    @property
    def folder(self) -> Path:
        """The folder that paths in the scene are relative to; absolute."""
        return Path(self._core.folder)

    def number(self, key: str) -> float:
        """The number of a key such as `hair.length`, in SI units (m, rad, Pa, kg/m³), given by the scene or not. Items of lists have none."""
        number = self._core.number(_text("key", key, "a text, such as 'hair.length'"))
        if number is None:
            if key in _keys():
                raise KeyError(f"{key!r} is a key without a number of its own; what the scene says of it is scene[{key!r}]")
            if re.sub(r"\[\d+\]", "[]", key) in _keys():
                raise KeyError(f"{key!r} is of an item of a list, which has no numbers here; what the scene says of it is scene[{key!r}]")
            near = difflib.get_close_matches(key, _keys(), 1)
            raise KeyError(f"{key!r} is no key of a scene" + (f"; near it is {near[0]!r}" if near else ""))
        return number

    def with_step(self, operation: str, value: Any = None, /, **keys: Any) -> Scene:
        """The scene with one more step: `scene.with_step("cut", below="chin")`."""
        _text("step", operation, "the name of an operation, such as 'cut'")
        if value is not None and keys:
            raise ArgumentTypeError("give the value of the step or its keys, not both")
        # A trailing underscore lets a key be a word of Python.
        named = {key.removesuffix("_"): item for key, item in keys.items() if item is not None}
        return Scene._of(self._core.with_step(operation, _own(named if value is None else value)))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the text to a file, as a whole or not at all; `FailedError` where it cannot be written."""
        self._core.save(_path("path", path))

    def copy(self) -> Scene:
        """Another scene that is the same; changes of one do not change the other."""
        return Scene(self)

    __copy__ = copy

    def __deepcopy__(self, memo: object) -> Scene:
        return Scene(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.text, self.file, os.fspath(self.folder), self._core.edited)

    def __repr__(self) -> str:
        steps = self._core.step_count
        told = f", {steps} step{'' if steps == 1 else 's'}" if steps else ""
        return f"<frisure.Scene {self.file!r}: {self._core.hair_type}{told}>"


def _restored(text: str, file: str, folder: str, edited: bool = False) -> Scene:
    """A scene that was pickled."""
    return Scene._of(SceneText.parse(text, file, Path(folder), edited))
