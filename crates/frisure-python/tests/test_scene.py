"""Scenes: where they come from, their keys, their errors."""

from __future__ import annotations

import copy
import errno
import pickle
from pathlib import Path
from typing import Any

import frisure
import numpy as np
import pytest
from frisure._frisure import scene_keys

from conftest import SMALL

TEXT = '[hair]\n# as measured\nlength = "12 cm"\n'


def test_a_scene_comes_from_a_path_a_text_a_dict_or_a_scene(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(TEXT)
    for scene in (
        frisure.Scene(file),
        frisure.Scene(str(file)),
        frisure.Scene(TEXT),
        frisure.Scene.from_text(TEXT),
        frisure.Scene({"hair": {"length": "12 cm"}}),
        frisure.Scene(frisure.Scene(TEXT)),
    ):
        assert scene.hair.length == "12 cm"
        assert scene.number("hair.length") == 0.12
    assert frisure.Scene(file).file == str(file)
    assert frisure.Scene(file).folder == tmp_path


def test_values_of_numpy_and_paths_are_values_of_a_scene(tmp_path: Path) -> None:
    scene = frisure.Scene({"seed": np.int64(7), "wisps": {"count": np.uint8(9)}})
    scene.wisps.hairs = np.int32(50)
    scene.update({"camera.azimuth": np.float64(0.5)})
    assert (scene.seed, scene.wisps.count, scene.wisps.hairs) == (7, 9, 50)
    cut = scene.with_step("cut", plane={"point": np.zeros(3), "normal": [0, 0, -1]})
    assert cut.to_dict()["step"][0]["cut"]["plane"]["normal"] == [0, 0, -1]


def test_keys_are_attributes_and_items_and_comments_stay() -> None:
    scene = frisure.Scene(TEXT)
    scene.hair.length = "20 cm"
    scene["hair.curl.radius"] = "9 mm"
    assert "# as measured" in scene.text
    assert scene["hair"]["curl"]["radius"] == scene.hair.curl.radius == "9 mm"
    assert scene.hair.type is None and "type" not in scene.hair
    assert list(scene.hair) == ["length", "curl"] and len(scene.hair) == 2
    del scene.hair.curl
    with pytest.raises(KeyError):
        scene["hair.curl"]
    scene.hair.length = None
    assert scene.hair.length is None
    assert "length" in dir(scene.hair)


def test_a_copy_and_a_pickled_scene_are_the_same_and_apart() -> None:
    scene = frisure.Scene(SMALL)
    for other in (scene.copy(), copy.deepcopy(scene), pickle.loads(pickle.dumps(scene))):
        assert (other.text, other.file, other.folder) == (scene.text, scene.file, scene.folder)
        other.seed = 5
        assert scene.seed is None


def test_no_key_is_hidden_by_an_attribute_of_the_class() -> None:
    for path, _ in scene_keys():
        name = path.split(".")[-1].removesuffix("[]")
        owner = frisure.Section if "." in path else frisure.Scene
        assert not hasattr(owner, name), path


def test_errors_have_line_range_and_hint() -> None:
    with pytest.raises(frisure.SceneError) as wrong:
        frisure.Scene('[hair]\nlength = "-3 cm"\n')
    error = wrong.value
    assert isinstance(error, ValueError)
    assert (error.line, error.column, error.key, error.value) == (2, 10, "hair.length", '"-3 cm"')
    assert error.allowed == "between 1 mm and 3 m"
    assert "<text>:2:10" in str(error) and "must be between 1 mm and 3 m" in str(error)
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.line) == (str(error), 2)

    with pytest.raises(frisure.SceneError) as unknown:
        frisure.Scene({"hair": {"lenght": "3 cm"}})
    assert unknown.value.hint == "did you mean `length`?"
    with pytest.raises(AttributeError, match="did you mean `length`"):
        frisure.Scene(TEXT).hair.lenght
    with pytest.raises(frisure.SceneError):
        frisure.Scene(TEXT).hair.lenght = 3


def test_a_wrong_value_leaves_the_scene_as_it_was() -> None:
    scene = frisure.Scene(TEXT)
    with pytest.raises(ValueError, match="hair.length"):
        scene.hair.length = "3 km"
    assert scene.text == TEXT


def test_a_dict_replaces_a_table_however_it_is_written() -> None:
    scene = frisure.presets["wavy"]
    scene.hair.curl = {"radius": "5 mm", "pitch": "1 cm"}
    assert scene.hair.curl.to_dict() == {"radius": "5 mm", "pitch": "1 cm"} and "# length =" in scene.text
    scene.hair.curl = {"radius": "6 mm"}
    assert scene.hair.curl.to_dict() == {"radius": "6 mm"}
    scene.hair = {"type": "curly", "length": "10 cm", "fibre": {"diameter": "60 um"}, "curl": {"pitch": "2 cm"}}
    assert scene.hair.to_dict() == {
        "type": "curly", "length": "10 cm", "fibre": {"diameter": "60 um"}, "curl": {"pitch": "2 cm"},
    }
    scene["hair"] = {"length": "11 cm", "type": None}
    assert scene.to_dict()["hair"]["length"] == "11 cm" and scene.hair.type is None and scene.hair.curl.radius is None
    for text in ('[hair]\ncurl = { radius = "5 mm", pitch = "1 cm" }\n', '[hair.curl]\nradius = "5 mm"\npitch = "1 cm"\n', "seed = 1\n"):
        scene = frisure.Scene(text)
        scene.hair.curl = {"radius": "7 mm"}
        assert scene.to_dict()["hair"]["curl"] == {"radius": "7 mm"}
        scene.hair = frisure.Scene(TEXT).hair
        assert scene.to_dict()["hair"] == {"length": "12 cm"}
    regions = [{"where": "top", "length": "10 cm"}]
    for text in ("seed = 1\n", '[[region]]\nwhere = "nape"\nlength = "5 cm"\n\n[[region]]\nwhere = "back"\nlength = "6 cm"\n'):
        scene = frisure.Scene(text)
        scene.region = regions
        assert scene.region == regions
        scene["region[0]"] = {"where": "nape", "length": "9 cm"}
        assert scene.region == [{"where": "nape", "length": "9 cm"}]


def test_an_error_after_an_edit_names_the_file_and_says_so(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(TEXT)
    scene = frisure.Scene(file)
    scene.hair.type = "wavy"
    for wrong in (lambda: setattr(scene.hair, "length", "900 m"), lambda: scene.with_step("cut", below="knee")):
        with pytest.raises(frisure.SceneError) as found:
            wrong()
    with pytest.raises(frisure.SceneError, match=r"mine\.toml \(edited\):3") as found:
        scene.hair.length = "900 m"
    assert (found.value.file, found.value.line) == (str(file), 3)
    again = pickle.loads(pickle.dumps(scene))
    assert again.file == scene.file == str(file)
    with pytest.raises(frisure.SceneError, match=r"\(edited\)"):
        again.hair.length = "900 m"
    with pytest.raises(frisure.SceneError, match="<text>:"):
        frisure.Scene(TEXT).hair.length = "900 m"


def test_a_scene_is_saved_as_a_whole_or_not_at_all(tmp_path: Path, hair: frisure.Hairstyle) -> None:
    file = tmp_path / "saved.toml"
    file.write_text("before")
    frisure.Scene(TEXT).save(file)
    assert file.read_text() == TEXT and list(tmp_path.iterdir()) == [file]
    for name in ("x.toml", "x.json", "x.png", "x.exr", "x.hair", "x.usdc", "x.npz"):
        with pytest.raises(frisure.FailedError, match="nowhere"):
            hair.save(tmp_path / "nowhere" / name)


def test_folders_do_not_follow_the_working_directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "heads").mkdir()
    head = Path(__file__).parents[3] / "scenes" / "heads" / "female-head.obj"
    (tmp_path / "heads" / "head.obj").write_bytes(head.read_bytes())
    monkeypatch.chdir(tmp_path)
    small = {"head": {"mesh": "heads/head.obj"}, "wisps": {"count": 6, "hairs": 20}}
    Path("scene.toml").write_text('[head]\nmesh = "heads/head.obj"\n[wisps]\ncount = 6\nhairs = 20\n')
    scenes = [frisure.Scene(small), frisure.Scene(small, folder="."), frisure.Scene("scene.toml")]
    predicted = frisure.predict(scenes[0])
    pickled = pickle.dumps(predicted)
    monkeypatch.chdir("/")
    assert [scene.folder for scene in scenes] == [tmp_path] * 3
    assert len(predicted.wet().strands) == len(pickle.loads(pickled).strands) == 20
    assert len(frisure.predict(scenes[2]).strands) == 20


def test_keys_that_are_none_are_told() -> None:
    scene = frisure.Scene(TEXT)
    for key in ("hair[x]", "hair[", "a..b", "region[0]x"):
        with pytest.raises(KeyError, match="is no key of a scene"):
            scene[key]
        assert key not in scene
        with pytest.raises(frisure.ArgumentError, match="is no key of a scene"):
            scene[key] = 3
    with pytest.raises(TypeError, match="a key is a text.*and not 3"):
        scene[3] = 1  # type: ignore[index]
    with pytest.raises(AttributeError, match="does not give `hair.type`"):
        del scene.hair.type
    with pytest.raises(KeyError, match="does not give 'hair.type'"):
        del scene["hair.type"]
    with pytest.raises(TypeError, match="like is of the type int"):
        frisure.predict(scene, like=3)  # type: ignore[arg-type]


def test_a_scene_that_does_not_exist_is_named() -> None:
    with pytest.raises(FileNotFoundError, match="nowhere.toml") as missing:
        frisure.Scene("nowhere.toml")
    assert isinstance(missing.value, frisure.SceneError)
    assert missing.value.file == missing.value.filename == "nowhere.toml" and missing.value.errno == errno.ENOENT
    assert str(pickle.loads(pickle.dumps(missing.value))) == str(missing.value)


def test_values_that_no_scene_has_are_refused_by_name() -> None:
    with pytest.raises(TypeError, match=r'scene\["hair"\]\["length"\].*object'):
        frisure.Scene({"hair": {"length": object()}})
    with pytest.raises(TypeError, match="is no text"):
        frisure.Scene({3: 4})  # type: ignore[dict-item]
    with pytest.raises(TypeError, match="scene is of the type int"):
        frisure.predict(3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="64 bits"):
        frisure.Scene({"seed": 2**70})


def nested(depth: int) -> dict[str, Any]:
    inner: dict[str, Any] = {}
    for _ in range(depth):
        inner = {"a": inner}
    return inner


def test_values_that_are_too_deep_are_refused_by_name() -> None:
    itself: dict[str, Any] = {}
    itself["hair"] = itself
    items: list[Any] = []
    items.append(items)
    scene = frisure.Scene({"hair": {"type": "wavy"}})
    for wrong in (itself, nested(10_000), nested(100), {"step": items}):
        with pytest.raises(frisure.ArgumentError, match=r'scene\["(hair|a|step)"\].* more than 64 dicts and lists'):
            frisure.Scene(wrong)
    with pytest.raises(frisure.ArgumentError, match='hair.*more than 64 dicts and lists'):
        scene["hair"] = itself
    with pytest.raises(frisure.ArgumentError, match="cut.*more than 64 dicts and lists"):
        scene.with_step("cut", itself)
    with pytest.raises(frisure.ArgumentError, match=r"`a\.a\..*more than 64 names"):
        scene[".".join("a" * 30_000)] = 1
    with pytest.raises(frisure.SceneError, match="unknown key"):
        frisure.Scene(nested(60))
    assert scene.to_dict() == {"hair": {"type": "wavy"}}


def test_shared_lists_of_more_values_than_memory_has_are_refused_by_name() -> None:
    lists: list[Any] = [1]
    tables: dict[str, Any] = {"a": 1}
    for _ in range(40):
        lists = [lists, lists]
        tables = {"a": tables, "b": tables}
    scene = frisure.Scene({"hair": {"type": "wavy"}})
    texts = ["x" * 1_000_000] * 2000
    for wrong in (lists, tables, texts, np.broadcast_to(0, (10**12,)), [0] * 1_000_001):
        with pytest.raises(frisure.ArgumentError, match="more than 1000000 values"):
            frisure.Scene({"hair": wrong})
    # Counting to a million takes a second.
    with pytest.raises(frisure.ArgumentError, match="hair.*more than 1000000 values"):
        scene["hair"] = lists
    with pytest.raises(frisure.ArgumentError, match="cut.*more than 1000000 values"):
        scene.with_step("cut", tables)
    assert scene.to_dict() == {"hair": {"type": "wavy"}}


def test_every_wrong_type_is_an_error_of_the_package() -> None:
    scene = frisure.Scene({})
    wrong: list[tuple[Any, str]] = [
        (lambda: frisure.Scene({"hair": {"length": b"1"}}), r'scene\["hair"\]\["length"\] is of the type bytes'),
        (lambda: frisure.Scene({1: {}}), "the key 1 of scene"),  # type: ignore[dict-item]
        (lambda: frisure.Scene({"hair": {"type": "\ud800"}}), r'scene\["hair"\]\["type"\] has a lone surrogate'),
        (lambda: frisure.Scene("\ud800\n"), "scene is .*lone surrogate"),
        (lambda: frisure.Scene("\ud800"), "scene is .*lone surrogate"),
        (lambda: scene.save("\ud800.toml"), "path is .*lone surrogate"),
        (lambda: frisure.measure("\ud800.png", "10 px/mm"), "photo is .*lone surrogate"),
        (lambda: frisure.Scene({}, folder=3), "folder is 3"),  # type: ignore[arg-type]
        (lambda: scene.update({"hair.\ud800": 1}), "a key is .*lone surrogate"),
        (lambda: scene.number(None), "key is None"),  # type: ignore[arg-type]
        (lambda: scene.with_step(1), "step is 1"),  # type: ignore[arg-type]
        (lambda: scene.save(3), "path is 3"),  # type: ignore[arg-type]
        (lambda: frisure.predict(scene, like=1), "like is of the type int"),  # type: ignore[arg-type]
        (lambda: frisure.predict(scene, progress=1), "progress is 1"),  # type: ignore[arg-type]
    ]
    for call, words in wrong:
        with pytest.raises(frisure.ArgumentError, match=words):
            call()


def test_a_key_that_is_popped_is_returned() -> None:
    scene = frisure.Scene({"hair": {"type": "wavy"}, "wisps": {"count": 12, "hairs": 50}})
    assert scene.pop("wisps") == {"count": 12, "hairs": 50} and "wisps" not in scene
    assert scene.hair.pop("length", "3 cm") == "3 cm"
    with pytest.raises(KeyError, match="hair.length"):
        scene.hair.pop("length")
    assert scene.popitem() == ("hair", {"type": "wavy"})
    with pytest.raises(KeyError):
        frisure.Scene({}).popitem()


def test_every_preset_is_a_scene() -> None:
    assert "caucasian-curly" in frisure.presets and len(frisure.presets) > 10
    for name, scene in frisure.presets.items():
        assert scene.hair.type == name
        assert frisure.presets.descriptions[name]
    with pytest.raises(KeyError, match="there are"):
        frisure.presets["purple"]


def test_keys_are_texts() -> None:
    scene = frisure.Scene(TEXT)
    for key in (0, None, False):
        wrong: Any = key
        for use in (lambda: scene[wrong], lambda: wrong in scene, lambda: scene.get(wrong)):
            with pytest.raises(frisure.ArgumentTypeError, match="a key is a text"):
                use()


def test_lists_change_the_scene() -> None:
    scene = frisure.Scene({**SMALL, "region": [{"where": "nape", "length": "4 cm"}]})
    scene.region[0].length = "2 cm"
    scene.region.append({"where": ["sides", "back"], "length": "3 cm"})
    scene.region[1].where[0] = "top"
    again = frisure.Scene.from_text(scene.text)
    assert again.region == scene.region == [{"where": "nape", "length": "2 cm"}, {"where": ["top", "back"], "length": "3 cm"}]
    assert again == again and len(scene.region) == 2 and scene.region[-1].length == "3 cm"
    before = scene.text
    with pytest.raises(frisure.SceneError):
        scene.region.append({"where": "elbow"})
    assert scene.text == before
    del scene.region[0]
    scene.step = [{"wet": {}}]
    scene.step += [{"dry": {}}]
    assert [list(step) for step in scene.step] == [["wet"], ["dry"]] and "nape" not in scene.text
    with pytest.raises(IndexError, match="`region` has 1 items"):
        scene.region[1]


def test_a_scene_saved_elsewhere_names_the_same_files(tmp_path: Path) -> None:
    there, here = tmp_path / "there", tmp_path / "far" / "from" / "it"
    there.mkdir()
    here.mkdir(parents=True)
    (there / "head.obj").write_text("v 0 0 0\n")
    scene = frisure.Scene({**SMALL, "head": {"mesh": "head.obj", "unit": "m"}}, folder=there)
    scene.save(here / "a.toml")
    scene.save(there / "b.toml")
    assert (there / "b.toml").read_text() == scene.text
    mesh = frisure.Scene(here / "a.toml").head.mesh
    assert (here / mesh).resolve() == (there / "head.obj").resolve()


def test_every_number_is_told_also_where_another_key_gives_it() -> None:
    scene = frisure.Scene({"hair": {"type": "straight", "fibre": {"mean_radius": "40 um"}, "curl": {"kappa1": 100}}})
    assert scene.number("hair.fibre.mean_radius") == pytest.approx(40e-6)
    assert scene.number("hair.fibre.diameter") == pytest.approx(80e-6)
    assert scene.number("hair.curl.kappa1") == pytest.approx(100)
    with pytest.raises(KeyError, match="a key without a number"):
        scene.number("hair.type")


def three_steps() -> frisure.Scene:
    return frisure.Scene({"step": [{"wet": {}}, {"cut": {"below": "chin"}}, {"dry": {}}]})


def operations(scene: frisure.Scene) -> list[str]:
    return [name for step in scene.step for name in step]


def test_lists_of_tables_are_reversed_swapped_and_popped_as_lists_are() -> None:
    scene = three_steps()
    scene.step.reverse()
    assert operations(scene) == ["dry", "cut", "wet"]
    scene.step[0], scene.step[2] = scene.step[2], scene.step[0]
    assert operations(scene) == ["wet", "cut", "dry"]
    assert scene.step.pop(0) == {"wet": {}} and scene.step.pop() == {"dry": {}}
    assert operations(scene) == ["cut"]
    scene.step.insert(0, scene.step.pop())
    scene.step.extend(scene.step)
    assert operations(scene) == ["cut", "cut"]
    with pytest.raises(IndexError, match="2 items"):
        scene.step.pop(7)
    scene.step.clear()
    assert scene.step == []


def test_a_table_that_was_moved_keeps_what_it_said() -> None:
    scene = three_steps()
    cut = scene.step[1]
    scene.step.append({"wet": {}})
    cut.cut.below = "ears"
    assert scene.step[1] == {"cut": {"below": "ears"}}
    scene.step.insert(0, {"dry": {}})
    assert cut == {"cut": {"below": "ears"}} and scene.step[1] == {"wet": {}}
    with pytest.raises(frisure.ArgumentError, match="moved or replaced"):
        cut.cut.below = "chin"


def test_lists_of_a_scene_can_be_values_of_another() -> None:
    scene = frisure.Scene({"region": [{"where": ["fringe", "nape"], "length": "4 cm"}]})
    assert frisure.Scene({"region": scene.region}).region == scene.region
    assert frisure.Scene({**scene, "seed": 2}).region == scene.region
    scene.region.append({"where": scene.region[0].where, "length": "2 cm"})
    assert scene.region[1].where == ["fringe", "nape"]
    assert scene.with_step("wet", where=scene.region[0].where).step[0].wet.where == ["fringe", "nape"]
    scene.region = tuple(scene.region)
    assert len(scene.region) == 2
