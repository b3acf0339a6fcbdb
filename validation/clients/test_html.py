"""The page of a groom: Chromium opens the file without a network, draws the hair and turns it."""

import os
import struct
import zlib

import numpy as np
import pytest

import browser
import sample


def pixels(png):
    """Rows of red, green, blue of a PNG of eight bits, as Chromium writes it."""
    at, data, header = 8, b"", None
    while at < len(png):
        (length,) = struct.unpack(">I", png[at : at + 4])
        kind, body = png[at + 4 : at + 8], png[at + 8 : at + 8 + length]
        header = struct.unpack(">IIBB", body[:10]) if kind == b"IHDR" else header
        data += body if kind == b"IDAT" else b""
        at += 12 + length
    width, height, _, colour = header
    channels = {2: 3, 6: 4}[colour]
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(height, 1 + width * channels)
    image = np.zeros((height, width * channels), np.uint8)
    before = np.zeros(width * channels, np.uint8)
    for y, row in enumerate(rows):
        kind, line = row[0], row[1:].astype(int)
        for x in range(width * channels if kind not in (0, 2) else 0):
            left = line[x - channels] if x >= channels else 0
            corner = int(before[x - channels]) if x >= channels else 0
            above = int(before[x])
            if kind == 1:
                line[x] += left
            elif kind == 3:
                line[x] += (left + above) // 2
            else:
                guess = left + above - corner
                distances = (abs(guess - left), abs(guess - above), abs(guess - corner))
                line[x] += (left, above, corner)[distances.index(min(distances))]
            line[x] &= 255
        before = ((line + (before if kind == 2 else 0)) & 255).astype(np.uint8)
        image[y] = before
    return image.reshape(height, width, channels)[:, :, :3].astype(int)


@pytest.fixture(scope="module")
def page(frisure, tmp_path_factory):
    """A page of 12 thick curls in red, without a head."""
    folder = tmp_path_factory.mktemp("page")
    arrays = sample.arrays()
    arrays["radii"] = np.full_like(arrays["radii"], 1.5e-3)
    arrays["color"] = np.broadcast_to(np.array([0.6, 0.05, 0.02], "f4"), arrays["color"].shape)
    # Colours of points that are the same everywhere, and 12 hairs and 4 guides, which are not drawn.
    np.savez(folder / "curls.npz", **arrays)
    frisure.convert(folder / "curls.npz", folder / "curls.html")
    return folder / "curls.html"


def opened(path, **options):
    if not browser.installed():
        assert not os.environ.get("FRISURE_NEEDS_BROWSER"), "FRISURE_NEEDS_BROWSER is set, but there is no Chromium"
        pytest.skip("there is no Chromium")
    window = browser.Browser((360, 320), **options)
    window.open(path.as_uri())
    return window


@pytest.fixture()
def window(page):
    window = opened(page)
    complete(window)
    yield window
    window.close()


def complete(window):
    window.wait_for("window.viewer?.state().complete")


def red(image):
    """Pixels of hair."""
    return (image[:, :, 0] > image[:, :, 2] + 25) & (image[:, :, 0] > image[:, :, 1] + 25)


def test_the_page_draws_the_hair_and_asks_for_nothing(window, page):
    image = pixels(window.screenshot())
    hair = red(image)
    assert hair.mean() > 0.02, hair.mean()
    # In the middle of the window, and nowhere at its edge.
    assert not hair[:4].any() and not hair[-4:].any() and not hair[:, :4].any() and not hair[:, -4:].any()
    assert window.requests == [page.as_uri()] and window.said == []
    state = window.evaluate("window.viewer.state()")
    assert (state["strands"], state["points"]) == (sample.STRANDS, sample.STRANDS * sample.POINTS)


def test_positions_on_the_page_are_those_of_the_groom(window):
    found = window.evaluate("Array.from(window.viewer.groom.hair.places)")
    found = np.array(found).reshape(sample.STRANDS, sample.POINTS, 4)
    expected = sample.positions().astype(float)
    # The order of strands is another: each is the one whose root is nearest.
    order = [np.linalg.norm(expected[:, 0] - strand[0, :3], axis=1).argmin() for strand in found]
    assert sorted(order) == list(range(sample.STRANDS))
    # Half a step of 0.04 mm on each axis.
    assert np.abs(found[:, :, :3] - expected[order]).max() < 2.1e-5
    assert np.allclose(found[:, :, 3], 1.5e-3, rtol=1e-3)
    colours = np.array(window.evaluate("Array.from(window.viewer.groom.hair.colours)")).reshape(-1, 4)
    linear = np.array([0.6, 0.05, 0.02])
    srgb = 255 * (1.055 * linear ** (1 / 2.4) - 0.055)
    assert np.abs(colours[:, :3] - srgb).max() <= 0.51


def test_the_hair_is_turned_zoomed_and_moved(window):
    views = {"first": pixels(window.screenshot())}
    centre, aside = [180, 160], [240, 160]

    def seen(name, act):
        before = window.evaluate("window.viewer.state()")
        act()
        complete(window)
        views[name] = pixels(window.screenshot())
        return before, window.evaluate("window.viewer.state()")

    before, after = seen("turned", lambda: window.drag(centre, aside))
    assert after["azimuth"] != before["azimuth"] and after["target"] == before["target"]
    before, after = seen("moved", lambda: window.drag(centre, aside, "right"))
    assert after["azimuth"] == before["azimuth"] and after["target"] != before["target"]
    before, after = seen("nearer", lambda: window.wheel(centre, -300))
    assert after["zoom"] > before["zoom"] and red(views["nearer"]).sum() > red(views["moved"]).sum()
    before, after = seen("keys", lambda: [window.key("ArrowLeft"), window.key("-"), window.key("ArrowUp", 8)])
    assert after["azimuth"] < before["azimuth"] and after["zoom"] < before["zoom"] and after["target"] != before["target"]

    def pinch():
        window.touch("touchStart", [[150, 160], [210, 160]])
        window.touch("touchMove", [[120, 160], [240, 160]])
        window.touch("touchEnd", [])

    before, after = seen("pinched", pinch)
    assert after["zoom"] > 1.5 * before["zoom"]
    seen("home", lambda: window.key("Home"))
    names = list(views)
    for a, b in zip(names, names[1:]):
        assert (np.abs(views[a] - views[b]).max(axis=2) > 12).mean() > 0.01, (a, b)
    # The same view is the same picture, but for the ring around the canvas that keys go to.
    assert np.abs(views["home"] - views["first"])[8:-8, 8:-8].max() <= 2


def test_background_size_and_turning(window):
    # The corner below the words.
    light = pixels(window.screenshot())[100, 5].mean()
    window.key("b")
    complete(window)
    assert abs(pixels(window.screenshot())[100, 5].mean() - light) > 100
    window.resize((500, 200))
    window.wait_for("window.viewer.state().width === 500")
    complete(window)
    hair = red(pixels(window.screenshot()))
    assert hair.mean() > 0.01 and not hair[:, :100].any()
    azimuth = window.evaluate("window.viewer.state().azimuth")
    window.evaluate("document.getElementById('turn').click()")
    window.wait_for(f"window.viewer.state().azimuth > {azimuth} + 0.1")
    window.evaluate("document.getElementById('turn').click()")
    complete(window)


def test_curves_without_a_width_are_seen_to_the_corners_of_their_box(frisure, tmp_path):
    """Bars along the diagonals of a cube: their ends are as far from its middle as anything in it can be."""
    ends = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], "f4")
    along = np.linspace(0.0, 1.0, 9, dtype="f4")
    positions = 0.1 * ends[:, None] * along[None, :, None]
    radii = np.zeros(positions.shape[:2], "f4")
    colour = np.broadcast_to(np.array([0.6, 0.05, 0.02], "f4"), (len(ends), 3))
    np.savez(tmp_path / "star.npz", positions=positions, radii=radii, color=colour)
    frisure.convert(tmp_path / "star.npz", tmp_path / "star.html")
    window = opened(tmp_path / "star.html")
    complete(window)
    hair = red(pixels(window.screenshot()))
    window.close()
    assert hair.any()
    assert not hair[:2].any() and not hair[-2:].any() and not hair[:, :2].any() and not hair[:, -2:].any()


def test_a_browser_without_webgl_is_told(page):
    window = opened(page, flags=["--disable-3d-apis"])
    window.wait_for("document.getElementById('notice').innerText.includes('hardware acceleration')")
    window.close()


def test_twenty_thousand_hairs_are_a_page_of_at_most_five_megabytes(frisure, tmp_path):
    strands, points = 20_000, 48
    np.savez(tmp_path / "many.npz", positions=sample.positions(strands, points))
    frisure.convert(tmp_path / "many.npz", tmp_path / "many.html")
    assert (tmp_path / "many.html").stat().st_size < 5_000_000
