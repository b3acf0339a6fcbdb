"""The Alembic library reads files of frisure, and frisure reads its files."""

import math

import imath
import numpy as np
import pytest
from alembic3d import Abc, AbcGeom
from alembic3d.AbcGeom import BasisType, CurvePeriodicity, CurveType, GeometryScope

import sample


@pytest.fixture(scope="module")
def written(frisure, tmp_path_factory):
    folder = tmp_path_factory.mktemp("alembic")
    np.savez(folder / "sample.npz", **sample.arrays())
    frisure.convert(folder / "sample.npz", folder / "sample.abc")
    return folder / "sample.abc"


def objects(archive):
    """All objects with their paths."""
    open_ = [archive.getTop()]
    while open_:
        this = open_.pop()
        yield this
        open_ += [this.getChild(i) for i in range(this.getNumChildren())]


def curves_of(path):
    archive = Abc.IArchive(str(path))
    found = {}
    for this in objects(archive):
        header = this.getHeader()
        assert not AbcGeom.IPolyMesh.matches(header)
        if AbcGeom.ICurves.matches(header):
            found[this.getParent().getName()] = AbcGeom.ICurves(this.getParent(), this.getName())
    return archive, found


def floats(values):
    """Vectors of the library as an array."""
    values = list(values)
    return np.array([list(v) if hasattr(v, "__len__") else v for v in values])


def test_the_top_says_which_specification(written):
    archive = Abc.IArchive(str(written))
    top = archive.getTop().getChild(0)
    assert AbcGeom.IXform.matches(top.getHeader())
    schema = AbcGeom.IXform(archive.getTop(), top.getName()).getSchema()
    assert schema.getValue().getMatrix() == imath.M44d()
    user = schema.getUserProperties()
    found = {}
    for i in range(user.getNumProperties()):
        header = user.getPropertyHeader(i)
        assert header.isScalar()
        found[header.getName()] = (str(header.getDataType()), user.getProperty(i).getValue())
    assert found["groom_version_major"] == ("int16_t", 1)
    assert found["groom_version_minor"] == ("int16_t", 5)
    assert found["groom_tool"] == ("string", "frisure")
    assert found["frisure_metres"] == ("float64_t", 0.01)


def test_curves_are_linear_without_a_basis(written):
    _archive, found = curves_of(written)
    assert set(found) == {"guides", "fringe", "crown", "back"}
    points = sample.y_up(sample.positions(), 0.01)
    groups = sample.groups()
    for name, curves in found.items():
        value = curves.getSchema().getValue()
        assert value.getType() == CurveType.kLinear
        assert value.getBasis() == BasisType.kNoBasis
        assert value.getWrap() == CurvePeriodicity.kNonPeriodic
        rows = slice(4) if name == "guides" else groups == sample.REGIONS.index(name)
        expected = points[rows].reshape(-1, 3)
        assert list(value.getCurvesNumVertices()) == [sample.POINTS] * len(points[rows])
        np.testing.assert_allclose(floats(value.getPositions()), expected, rtol=1e-6, atol=1e-6)
        box = value.getSelfBounds()
        np.testing.assert_allclose([list(box.min()), list(box.max())],
                                   [expected.min(0), expected.max(0)], atol=1e-5)
        width = curves.getSchema().getWidthsParam()
        assert width.getScope() == GeometryScope.kVertexScope
        radii = sample.arrays()["guide_radii" if name == "guides" else "radii"]
        radii = radii if name == "guides" else radii[rows]
        widths = floats(width.getExpandedValue().getVals())
        np.testing.assert_allclose(widths, 200 * radii.ravel(), rtol=1e-6)


SCOPES = {"con": GeometryScope.kConstantScope, "uni": GeometryScope.kUniformScope,
          "vtx": GeometryScope.kVertexScope}


def test_every_attribute_has_its_type_and_scope(written):
    _archive, found = curves_of(written)
    arrays = sample.arrays()
    rows = sample.groups() == 2
    expected = {
        "groom_guide": ("int16_t", "con", [0]),
        "groom_group_id": ("int32_t", "con", [2]),
        "groom_group_name": ("string", "con", ["crown"]),
        "groom_group_cards_id": ("string", "con", ["crown"]),
        "groom_id": ("int32_t", "uni", arrays["id"][rows]),
        # The wisp is that of the guide.
        "groom_clumpid": ("int32_t", "uni", arrays["guide"][rows]),
        "groom_root_uv": ("float32_t[2]", "uni", arrays["root_uv"][rows]),
        "groom_closest_guides": ("int32_t[3]", "uni", arrays["closest_guides"][rows]),
        "groom_guide_weights": ("float32_t[3]", "uni", arrays["guide_weights"][rows]),
        "groom_color": ("float32_t[3]", "vtx", arrays["color"][rows].reshape(-1, 3)),
        "frisure_wetness": ("float32_t", "vtx", arrays["wetness"][rows].ravel()),
        "frisure_d1": ("float32_t[3]", "vtx", sample.y_up(arrays["d1"][rows]).reshape(-1, 3)),
        "frisure_axis_ratio": ("float32_t", "uni", arrays["axis_ratio"][rows]),
        "frisure_group": ("uint32_t", "uni", arrays["group"][rows]),
        "frisure_guide": ("uint32_t", "uni", arrays["guide"][rows]),
        "frisure_natural_strain": (
            "float32_t[3]", "vtx", arrays["natural_strain"][rows].reshape(-1, 3)),
    }
    parameters = found["crown"].getSchema().getArbGeomParams()
    names = [parameters.getPropertyHeader(i).getName() for i in range(parameters.getNumProperties())]
    assert set(names) == set(expected)
    for i, name in enumerate(names):
        kind, scope, values = expected[name]
        header = parameters.getPropertyHeader(i)
        assert header.isArray() and str(header.getDataType()) == kind, name
        assert header.getMetaData().get("geoScope") == scope, name
        value = parameters.getProperty(i).getValue()
        if kind == "string":
            assert list(value) == values
        else:
            np.testing.assert_allclose(floats(value), values, atol=1e-6, err_msg=name)


def test_hairs_are_in_the_group_of_their_guide(written, frisure):
    back = written.with_name("back.npz")
    frisure.convert(written, back)
    with np.load(back) as found:
        for name in ("group", "guide", "closest_guides", "guide_weights", "id", "positions"):
            np.testing.assert_allclose(found[name], sample.arrays()[name], atol=1e-7)


def test_guides_are_marked(written):
    _archive, found = curves_of(written)
    parameters = found["guides"].getSchema().getArbGeomParams()
    values = {parameters.getPropertyHeader(i).getName(): parameters.getProperty(i).getValue()
              for i in range(parameters.getNumProperties())}
    assert list(values["groom_guide"]) == [1]
    assert list(values["groom_id"]) == [0, 1, 2, 3]
    assert list(values["groom_group_id"]) == [0, 2, 4, 0]
    assert list(values["groom_group_name"]) == ["fringe", "crown", "back", "fringe"]


# frisure reads files of the library.

ARRAYS = {"f": imath.FloatArray, "i": imath.IntArray, "u": imath.UnsignedIntArray,
          "h": imath.ShortArray, "b": imath.UnsignedCharArray}


def array(kind, values):
    out = ARRAYS[kind](len(values))
    for i, v in enumerate(values):
        out[i] = v.item() if hasattr(v, "item") else v
    return out


def vectors(points):
    points = np.asarray(points, float).reshape(-1, 3)
    out = imath.V3fArray(len(points))
    for i, p in enumerate(points):
        out[i] = imath.V3f(*p)
    return out


def curves(parent, name, strands, kind=CurveType.kLinear, basis=BasisType.kNoBasis, width=None,
           knots=None, orders=None):
    """Writes strands of points as an object."""
    counts = array("i", [len(s) for s in strands])
    value = AbcGeom.OCurvesSchemaSample(
        vectors(np.concatenate(strands)), counts, kind, CurvePeriodicity.kNonPeriodic)
    value.setBasis(basis)
    if width is not None:
        scope, values = width
        value.setWidths(AbcGeom.OFloatGeomParamSample(array("f", values), scope))
    if knots is not None:
        value.setKnots(array("f", knots))
    if orders is not None:
        value.setOrders(array("b", orders))
    out = AbcGeom.OCurves(parent, name)
    out.getSchema().set(value)
    return out


def line(points=10, shift=0.0):
    """A smooth curve (cm, y up)."""
    t = np.linspace(0, 1, points)
    return np.stack([3 * t + shift, 10 - 8 * t**2, np.sin(3 * t)], -1)


def inside(points):
    """Converts centimetres, y up, to metres, z up."""
    points = np.asarray(points).reshape(-1, 3)
    return 0.01 * np.stack([points[:, 0], -points[:, 2], points[:, 1]], -1)


@pytest.fixture()
def write(tmp_path):
    """Calls a function that writes the file; the file is complete when all its objects are released."""

    def write(build):
        path = tmp_path / "library.abc"
        build(Abc.OArchive(str(path)).getTop())
        return path

    return write


def test_lines_of_one_width(write, hair_of):
    strands = [line(10), line(4, 1.0)]

    def build(top):
        curves(top, "hair", strands, width=(GeometryScope.kConstantScope, [0.008]))

    path = write(build)
    points, widths, counts = hair_of(path)
    assert list(counts) == [10, 4]
    np.testing.assert_allclose(points, inside(np.concatenate(strands)), atol=1e-7)
    np.testing.assert_allclose(widths, 8e-5, rtol=1e-6)


def test_widths_of_strands_and_points(write, hair_of):
    strands = [line(3), line(5, 1.0)]

    def build(top):
        curves(top, "a", strands, width=(GeometryScope.kUniformScope, [0.008, 0.004]))
        curves(top, "b", strands, width=(GeometryScope.kVertexScope, np.linspace(0.001, 0.008, 8)))

    path = write(build)
    _, widths, _ = hair_of(path)
    expected = [8e-5] * 3 + [4e-5] * 5 + list(np.linspace(1e-5, 8e-5, 8))
    np.testing.assert_allclose(widths, expected, rtol=1e-6)


def test_transforms_are_multiplied(write, hair_of):
    def build(top):
        outer = AbcGeom.OXform(top, "outer")
        value = AbcGeom.XformSample()
        value.setTranslation(imath.V3d(1, 2, 3))
        value.setRotation(imath.V3d(0, 1, 0), 90)
        outer.getSchema().set(value)
        inner = AbcGeom.OXform(outer, "inner")
        value = AbcGeom.XformSample()
        value.setScale(imath.V3d(2, 2, 2))
        value.setXRotation(30)
        inner.getSchema().set(value)
        curves(inner, "hair", [line()], width=(GeometryScope.kConstantScope, [0.004]))
        free = AbcGeom.OXform(outer, "free")
        value = AbcGeom.XformSample()
        value.setMatrix(imath.M44d(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1))
        value.setInheritsXforms(False)
        free.getSchema().set(value)
        curves(free, "hair", [line()], width=(GeometryScope.kConstantScope, [0.004]))

    path = write(build)
    archive = Abc.IArchive(str(path))
    outer = archive.getTop().getChild(0)
    matrix = lambda parent, name: AbcGeom.IXform(parent, name).getSchema().getValue().getMatrix()
    whole = matrix(outer, "inner") * matrix(archive.getTop(), "outer")
    moved = [list(imath.V3d(*p) * whole) for p in line()]
    points, widths, _ = hair_of(path)
    np.testing.assert_allclose(points, inside([*moved, *(line() + [5, 6, 7])]), atol=2e-7)
    np.testing.assert_allclose(widths, [8e-5] * 10 + [4e-5] * 10, rtol=1e-6)


def b_spline(points, t):
    """A point of an even cubic B-spline, by its textbook matrix."""
    k = min(int(t), len(points) - 4)
    u = t - k
    weights = [(1 - u) ** 3, 3 * u**3 - 6 * u**2 + 4, -3 * u**3 + 3 * u**2 + 3 * u + 1, u**3]
    return np.array(weights) / 6 @ points[k : k + 4]


def test_even_splines(write, hair_of):
    def build(top):
        curves(top, "hair", [line(8)], CurveType.kCubic, BasisType.kBsplineBasis)

    path = write(build)
    points, _, counts = hair_of(path)
    expected = [b_spline(line(8), t) for t in np.linspace(0, 5, int(counts[0]))]
    np.testing.assert_allclose(points, inside(expected), atol=2e-7)


@pytest.mark.parametrize("kind", [CurveType.kCubic, CurveType.kVariableOrder])
def test_splines_with_knots_reach_their_ends(write, hair_of, kind):
    knots = [0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5]

    def build(top):
        curves(top, "hair", [line(8)] * 2, kind, BasisType.kBsplineBasis, knots=knots * 2,
               orders=[4, 4], width=(GeometryScope.kVertexScope, np.tile(np.linspace(1, 8, 8) / 1e3, 2)))

    path = write(build)
    points, widths, counts = hair_of(path)
    n = counts[0]
    assert list(counts) == [n, n] and n > 8
    np.testing.assert_allclose(points[[0, n - 1]], inside(line(8)[[0, -1]]), atol=1e-7)
    np.testing.assert_allclose(points[:n], points[n:])
    np.testing.assert_allclose(widths[[0, n - 1]], [1e-5, 8e-5], rtol=1e-5)


def test_bezier_and_catmull_rom(write, hair_of):
    def build(top):
        curves(top, "a", [line(7)], CurveType.kCubic, BasisType.kBezierBasis)
        curves(top, "b", [line(9)], CurveType.kCubic, BasisType.kCatmullromBasis)

    path = write(build)
    points, _, counts = hair_of(path)
    assert list(counts) == [9, 9]
    t = np.linspace(0, 1, 5)[:, None]
    bezier = lambda p: (1 - t) ** 3 * p[0] + 3 * t * (1 - t) ** 2 * p[1] + 3 * t**2 * (1 - t) * p[2] + t**3 * p[3]
    first = np.concatenate([bezier(line(7)[:4]), bezier(line(7)[3:])[1:]])
    np.testing.assert_allclose(points[:9], inside(first), atol=2e-7)
    np.testing.assert_allclose(points[9:], inside(line(9)), atol=1e-7)


def parameter(parent, kind, name, values, scope, indices=None):
    made = getattr(AbcGeom, f"O{kind}GeomParam")(parent, name, indices is not None, scope, 1)
    value = getattr(AbcGeom, f"O{kind}GeomParamSample")
    if indices is None:
        made.set(value(values, scope))
    else:
        made.set(value(values, array("u", indices), scope))


def test_guides_and_attributes(write, frisure, tmp_path):
    def build(top):
        uniform, constant = GeometryScope.kUniformScope, GeometryScope.kConstantScope
        both = curves(top, "both", [line(4, i) for i in range(5)]).getSchema().getArbGeomParams()
        parameter(both, "Int16", "groom_guide", array("h", [1, 0, 1, 0, 0]), uniform)
        parameter(both, "Int32", "groom_id", array("i", [70, 5, 80, 3, 4]), uniform)
        closest = imath.V3iArray(5)
        weights = imath.V3fArray(5)
        for i in range(5):
            closest[i] = imath.V3i(80, 70, -1)
            weights[i] = imath.V3f(0.5, 0.3, 0.2)
        parameter(both, "V3i", "groom_closest_guides", closest, uniform)
        parameter(both, "V3f", "groom_guide_weights", weights, uniform)
        parameter(both, "Float", "frisure_axis_ratio", array("f", [1.25, 1.5]), uniform,
                  indices=[0, 1, 0, 1, 1])
        parameter(both, "Int32", "groom_group_id", array("i", [4]), constant)
        parameter(both, "Float", "unknown", array("f", [1] * 20), GeometryScope.kVertexScope)

    path = write(build)
    frisure.convert(path, tmp_path / "out.npz")
    with np.load(tmp_path / "out.npz") as found:
        assert found["guide_positions"].shape == (2, 4, 3) and found["positions"].shape == (3, 4, 3)
        assert list(found["guide_id"]) == [70, 80] and list(found["id"]) == [5, 3, 4]
        # Numbers of guides become their indices; -1 is none.
        assert found["closest_guides"].tolist() == [[1, 0, 0]] * 3
        np.testing.assert_allclose(found["guide_weights"], [[0.5, 0.3, 0]] * 3, atol=1e-7)
        assert list(found["axis_ratio"]) == [1.5, 1.5, 1.5]
        assert list(found["group"]) == [4, 4, 4]
        assert "unknown" not in found.files


def test_texture_coordinates_are_those_of_roots(write, frisure, tmp_path):
    def build(top):
        counts = array("i", [3, 3])
        value = AbcGeom.OCurvesSchemaSample(
            vectors(np.concatenate([line(3), line(3, 1.0)])), counts, CurveType.kLinear,
            CurvePeriodicity.kNonPeriodic)
        uvs = imath.V2fArray(2)
        uvs[0], uvs[1] = imath.V2f(0.25, 0.5), imath.V2f(0.75, 1)
        value.setUVs(AbcGeom.OV2fGeomParamSample(uvs, GeometryScope.kUniformScope))
        out = AbcGeom.OCurves(top, "hair")
        out.getSchema().set(value)
        parameter(out.getSchema().getArbGeomParams(), "Float", "groom_width",
                  array("f", [0.008]), GeometryScope.kConstantScope)

    frisure.convert(write(build), tmp_path / "out.npz")
    with np.load(tmp_path / "out.npz") as found:
        assert found["root_uv"].tolist() == [[0.25, 0.5], [0.75, 1]]
        np.testing.assert_allclose(found["radii"], 4e-5, rtol=1e-6)


def test_the_first_sample_of_what_moves(write, hair_of):
    def build(top):
        out = curves(top, "hair", [line()])
        for k in range(1, 3):
            counts = array("i", [10])
            value = AbcGeom.OCurvesSchemaSample(
                vectors(line() + k), counts, CurveType.kLinear, CurvePeriodicity.kNonPeriodic)
            out.getSchema().set(value)

    points, _, _ = hair_of(write(build))
    np.testing.assert_allclose(points, inside(line()), atol=1e-7)


def test_a_hundred_objects(write, hair_of):
    def build(top):
        parent = AbcGeom.OXform(top, "all")
        for k in range(100):
            curves(parent, f"hair{k}", [line(5, math.sin(k))])

    points, _, counts = hair_of(write(build))
    assert list(counts) == [5] * 100
    expected = np.concatenate([line(5, math.sin(k)) for k in range(100)])
    np.testing.assert_allclose(points, inside(expected), atol=1e-7)
