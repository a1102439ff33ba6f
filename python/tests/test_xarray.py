import pathlib
import subprocess
import sys

import numpy as np
import pytest

import flowgrain
from conftest import vortices

xr = pytest.importorskip("xarray")
ROOT = pathlib.Path(__file__).resolve().parents[2]


def dataset(**names):
    x, y, u, v = vortices(33, 25)
    return xr.Dataset({names.get("u", "u"): (("y", "x"), u), names.get("v", "v"): (("y", "x"), v)},
                      {"x": x, "y": y})


# every format of the program gives the same answers (src/read/names_test.c)
NAMES = [line.split(" = ") for line in (ROOT / "tests" / "vectors.txt").read_text().splitlines()
         if " = " in line and line[0] != "#"]


@pytest.mark.parametrize("names, wanted", NAMES)
def test_components_are_found_by_name(names, wanted):
    from flowgrain._dataset import meaning

    x, y, u, _ = vortices(5, 4)
    found = xr.Dataset({name: (("lat", "lon"), u) for name in names.split()},
                       {"lon": x, "lat": y})
    if wanted in "-?":
        with pytest.raises(ValueError, match="no vectors" if wanted == "-" else "which is meant"):
            meaning(found)
    else:
        assert ",".join(meaning(found).components) == wanted


def test_components_are_found_by_standard_name():
    from flowgrain._dataset import meaning

    found = dataset(u="first", v="second")
    found["first"].attrs["standard_name"] = "sea_water_x_velocity"
    found["second"].attrs["standard_name"] = "sea_water_y_velocity"
    found["u"], found["v"] = found["first"], found["second"]  # names count less
    found["u"].attrs, found["v"].attrs = {}, {}
    found["tx"], found["ty"] = found["first"].copy(), found["second"].copy()
    found["tx"].attrs["standard_name"] = "surface_downward_x_stress"
    found["ty"].attrs["standard_name"] = "surface_downward_y_stress"
    assert meaning(found).components == ["first", "second"]
    with pytest.raises(ValueError, match="no vectors found"):
        meaning(found[["tx"]])


def test_names_that_are_not_there_are_told_the_nearest():
    found = dataset(u="UWND", v="VWND")
    with pytest.raises(ValueError, match="u is 'UWNDD'.*: UWND, VWND$"):
        found.flowgrain.quiver(u="UWNDD", v="VWND")
    with pytest.raises(ValueError, match="v is 'VWIND'.*: VWND, UWND$"):
        found.flowgrain.arrows(u="UWND", v="VWIND")
    with pytest.raises(ValueError, match="x is 'lon'.*: .*x"):
        found.flowgrain.arrows(x="lon", y="y")
    bare = found.drop_vars(["x", "y"])  # a dimension is a coordinate, too
    assert len(bare.flowgrain.arrows(x="x", y="y", n=3)) == 3


def test_two_heights_of_one_standard_name():
    from flowgrain._dataset import meaning

    found = dataset(u="u100", v="v100")
    found["u10"], found["v10"] = found["u100"], found["v100"]
    for name in found.data_vars:
        way = "eastward" if name[0] == "u" else "northward"
        found[name].attrs["standard_name"] = way + "_wind"
    with pytest.raises(ValueError, match="holds 2 vectors.*u100,v100.*u10,v10"):
        meaning(found)


def test_arrows_are_those_of_the_arrays():
    found = dataset()
    expected = flowgrain.arrows(*vortices(33, 25), n=5)
    for given in (found, found.transpose(), found.isel(y=slice(None, None, -1))):
        ours = given.flowgrain.arrows(n=5)
        assert all(map(np.array_equal, ours.paths, expected.paths))


def test_time_is_kept():
    found = dataset().expand_dims(time=np.array(["2001-01-01", "2001-02-01"], "M8[ns]"))
    found = found.assign(u=found.u * xr.DataArray([1.0, -1.0], dims="time"))
    several = found.flowgrain.arrows(n=4)
    assert several.dims == ("time",) and (several.time == found.time).all()
    last = several.sel(time="2001-02-01").item()
    assert isinstance(last, flowgrain.Arrows) and len(last) == 4
    assert not np.array_equal(last.paths[0], several[0].item().paths[0])
    plt = pytest.importorskip("matplotlib.pyplot")
    with pytest.raises(ValueError, match=r"ds.isel\(time=0\)"):
        found.flowgrain.quiver()
    q = found.isel(time=[0]).flowgrain.quiver(arrows=4)
    assert len(q.get_paths()) == 4 and q.axes.get_xlabel() == "x"
    plt.close("all")


def globe():
    lon, lat = np.arange(0.0, 360.0, 10.0), np.arange(80.0, -81.0, -10.0)
    u = np.cos(np.radians(lat))[:, None] + 0.0 * lon
    v = np.sin(np.radians(2.0 * lon)) * np.cos(np.radians(lat))[:, None]
    found = xr.Dataset({"a": (("j", "i"), u), "b": (("j", "i"), v)},
                       {"i": lon, "j": lat})
    found["i"].attrs = {"units": "degrees_east", "long_name": "longitude"}
    found["j"].attrs = {"standard_name": "latitude"}
    found["a"].attrs = {"standard_name": "eastward_wind"}
    found["b"].attrs = {"standard_name": "northward_wind"}
    return found


def test_longitude_and_latitude():
    found = globe().flowgrain.arrows(n=6)
    assert found.bounds.tolist() == [[0.0, 360.0], [-80.0, 80.0]]
    assert found.to_geojson()["projection"] == "+proj=longlat"
    flat = globe().reset_coords(drop=False)
    lon, lat = np.meshgrid(globe().i, globe().j)
    curved = xr.Dataset({"u": (("j", "i"), flat.a.values), "v": (("j", "i"), flat.b.values)},
                        {"nav_lon": (("j", "i"), lon), "nav_lat": (("j", "i"), lat)})
    assert curved.flowgrain.arrows(n=6).to_geojson()["projection"] == "+proj=longlat"


def test_longitudes_in_another_order():
    turned = globe().assign_coords(i=(globe().i + 180.0) % 360.0 - 180.0)
    turned["i"].attrs = globe()["i"].attrs
    found = turned.flowgrain.arrows(n=6)
    expected = turned.sortby("i").flowgrain.arrows(n=6)
    assert found.bounds.tolist() == [[-180.0, 180.0], [-80.0, 80.0]]
    assert all(map(np.array_equal, found.paths, expected.paths))
    east = turned.isel(i=slice(10, 26)).flowgrain.arrows(n=6)  # across the antimeridian
    assert east.bounds.tolist() == [[100.0, 250.0], [-80.0, 80.0]]
    with pytest.raises(ValueError, match=r"ds.sortby\('i'\)"):
        globe().isel(i=[0, 5, 3, 9, 7, 8]).flowgrain.arrows(n=6)
    bad = globe().assign_coords(j=np.where(globe().j < -70.0, np.nan, globe().j))
    with pytest.raises(ValueError, match="coordinate 16 of 'j' is nan"):
        bad.flowgrain.quiver(x="i", y="j")


def test_map():
    ccrs = pytest.importorskip("cartopy.crs")
    plt = pytest.importorskip("matplotlib.pyplot")
    figure = plt.figure()
    ax = figure.add_subplot(projection=ccrs.Robinson())
    ax.set_global()
    q = globe().flowgrain.quiver(ax, arrows=10)
    assert len(q.get_paths()) == 10
    assert np.ptp(np.concatenate(q._lines)[:, 0]) > 2e7  # metres
    plt.close(figure)


def staggered(names, sides, counts, coordinates=True):
    """u = 2 + x, v = 3 - 2 y on the faces of 6 x 5 cells whose centres are at 0, 1, 2, ..."""
    (face_x, x), (face_y, y) = names
    cx, cy = np.arange(6.0), np.arange(5.0)
    fx, fy = np.arange(counts[0]) + 0.5 * sides[0], np.arange(counts[1]) + 0.5 * sides[1]
    found = xr.Dataset({
        "u": ((y, face_x), np.broadcast_to(2.0 + fx, (5, counts[0])).copy()),
        "v": ((face_y, x), np.broadcast_to(3.0 - 2.0 * fy[:, None], (counts[1], 6)).copy()),
    })
    if coordinates:
        found = found.assign_coords({x: cx, y: cy, face_x: fx, face_y: fy})
    return found


COUNTED = pytest.mark.filterwarnings("ignore:axes count")


@COUNTED
@pytest.mark.parametrize("names, sides, counts, coordinates", [
    ((("XG", "XC"), ("YG", "YC")), (-1, -1), (6, 5), True),
    ((("XG", "XC"), ("YG", "YC")), (-1, -1), (6, 5), False),
    ((("xi_u", "xi_rho"), ("eta_v", "eta_rho")), (1, 1), (5, 4), False),
    ((("xq", "xh"), ("yq", "yh")), (1, 1), (6, 5), False),
    ((("x_stag", "x"), ("y_stag", "y")), (-1, -1), (7, 6), False),
    ((("a", "b"), ("c", "d")), (1, -1), (6, 5), True),
])
def test_components_on_faces_become_means_at_the_centres(names, sides, counts, coordinates):
    found = staggered(names, sides, counts, coordinates).flowgrain._field(
        None, None, None, None, "auto")
    x, y = np.arange(6.0), np.arange(5.0)
    u, v = np.broadcast_to(2.0 + x, (5, 6)).copy(), np.broadcast_to((3.0 - 2.0 * y)[:, None],
                                                                    (5, 6)).copy()
    for values, side, along, count, cells in ((u, sides[0], 1, counts[0], 6),
                                              (v, sides[1], 0, counts[1], 5)):
        ends = np.moveaxis(values, along, 0)
        if side > 0:  # no face before the first centre
            ends[0] = np.nan
        if count < cells or (side < 0 and count == cells):  # and none behind the last
            ends[-1] = np.nan
    assert found.u.dims == found.v.dims == (names[1][1], names[0][1])
    assert np.allclose(found.u, u, equal_nan=True) and np.allclose(found.v, v, equal_nan=True)


@COUNTED
def test_walls_and_masks_of_staggered_grids():
    found = staggered((("xi_u", "xi_rho"), ("eta_v", "eta_rho")), (1, 1), (5, 4), False)
    found["u"][2, 1] = np.nan
    field = found.flowgrain._field("u", "v", None, None, "auto")
    assert field.u[2, 1] == 0.5 * (2.0 + 0.5) and field.u[2, 2] == 0.5 * (2.0 + 2.5)
    sea = np.ones((5, 6))
    sea[1, 3] = 0.0
    lon, lat = np.meshgrid(np.arange(6.0), np.arange(5.0))
    dims = ("eta_rho", "xi_rho")
    masked = found.assign(mask_rho=(dims, sea), lon_rho=(dims, lon),
                          lat_rho=(dims, lat)).flowgrain._field(
        "u", "v", None, None, "auto")
    assert np.isnan(masked.u[1, 3]) and np.isnan(masked.v[1, 3])
    assert masked.u[1, 2] == pytest.approx(4.0, 1e-3)
    assert len(found.flowgrain.arrows(n=2)) == 2
    with pytest.raises(ValueError, match="on which side they lie"):
        staggered((("a", "b"), ("c", "d")), (1, 1), (6, 5), False).flowgrain.arrows(n=2)
    with pytest.raises(ValueError, match="'u' is 5 x 3"):
        staggered((("a", "b"), ("c", "d")), (1, 1), (3, 5)).flowgrain.arrows(n=2)


def test_components_along_the_grid_are_turned():
    """A wind to the north-east on a grid that is turned and staggered; and back."""
    turn = np.radians(25.0)
    along, across = np.meshgrid(np.arange(9.0), np.arange(8.0))

    def place(i, j):
        lat = 50.0 + 0.1 * (i * np.sin(turn) + j * np.cos(turn))
        return 10.0 + 0.1 * (i * np.cos(turn) - j * np.sin(turn)) / np.cos(np.radians(50.0)), lat

    u, v = np.cos(np.radians(45.0) - turn), np.sin(np.radians(45.0) - turn)
    dims = ("eta_rho", "xi_rho")
    lon, lat = place(along, across)
    found = xr.Dataset({"u": (("eta_rho", "xi_u"), np.full((8, 8), u)),
                        "v": (("eta_v", "xi_rho"), np.full((7, 9), v))},
                       {"lon_rho": (dims, lon), "lat_rho": (dims, lat)})
    field = found.flowgrain._field(None, None, None, None, "auto")
    inner = (slice(1, -1), slice(1, -1))
    assert field.degrees and field.x.name == "lon_rho"
    for component in (field.u, field.v):
        assert component.values[inner] == pytest.approx(np.sqrt(0.5), abs=0.02)
    plane = xr.Dataset({"a": (("y", "x"), np.ones((8, 9))), "b": (("y", "x"), np.ones((8, 9)))},
                       {"lon": (("y", "x"), lon), "lat": (("y", "x"), lat),
                        "x": 0.1 * np.arange(9.0), "y": 0.1 * np.arange(8.0)})
    plane["x"].attrs["axis"], plane["y"].attrs["axis"] = "X", "Y"
    sphere = plane.flowgrain._field("a", "b", None, None, "east")  # as of a file
    assert sphere.degrees and sphere.x.name == "lon" and (sphere.u == 1.0).all()
    back = plane.flowgrain._field("a", "b", "x", "y", "east")
    assert back.u.values == pytest.approx(np.sqrt(2.0) * u, abs=0.02)
    assert back.v.values == pytest.approx(np.sqrt(2.0) * v, abs=0.02)
    with pytest.raises(ValueError, match="frame='east' or frame='grid'"):
        plane.drop_vars(["x", "y"]).flowgrain.arrows("a", "b", n=3)


def test_longitudes_may_count_to_the_west():
    found = dataset().rename(x="lon", y="lat")
    found["lat"].attrs["units"] = "degrees_north"
    found["lon"].attrs["units"] = "degrees_east"
    west = found.assign_coords(lon=-found["lon"])
    west["lon"].attrs["units"] = "degrees_west"
    for named in ({}, {"x": "lon", "y": "lat"}):
        one, other = (d.flowgrain.arrows(n=4, **named) for d in (found, west))
        assert [a.path.tolist() for a in one] == [a.path.tolist() for a in other]


def test_longitudes_and_latitudes_in_two_dimensions():
    """Also where they are those of axes, and others count samples."""
    found = dataset().rename(x="lon", y="lat")
    lon, lat = np.meshgrid(found["lon"], found["lat"])
    plane = xr.Dataset({k: (("y", "x"), found[k].values) for k in "uv"},
                       {"lon": (("y", "x"), lon), "lat": (("y", "x"), lat)})
    counted = plane.assign_coords(x=np.arange(33), y=np.arange(25))
    radians = found.assign_coords(
        {k: found[k].copy(data=np.radians(found[k])).assign_attrs(units="radians")
         for k in ("lon", "lat")})
    wrf = plane.rename(x="west_east", y="south_north").reset_coords().expand_dims(Time=1)
    one = found.flowgrain.arrows(n=4)
    for other in (plane, counted, radians, wrf):
        paths = [a.path for a in other.flowgrain.arrows(n=4)]
        assert all(np.allclose(a.path, path, atol=1e-9) for a, path in zip(one, paths))


def test_packed_numbers_are_refused():
    found = dataset()
    found["v"] = (100 * found["v"]).astype("i2").assign_attrs(scale_factor=0.01)
    with pytest.raises(ValueError, match="v has whole numbers and the attribute scale_factor"):
        found.flowgrain.arrows(n=3)
    assert len(xr.decode_cf(found).flowgrain.arrows(n=3)) == 3


def test_what_is_unsure_is_a_warning():
    found = dataset().rename(x="lon", y="lat").drop_vars(["lon", "lat"])
    with pytest.warns(UserWarning, match="'lon' and 'lat' count samples"):
        found.flowgrain.arrows(n=3)


def test_components_are_compared_with_a_direction():
    found = dataset(u="ua", v="va").rename(x="lon", y="lat")
    for name, word in (("ua", "eastward"), ("va", "northward")):
        found[name].attrs = {"standard_name": f"{word}_wind", "units": "m/s"}
    toward = np.degrees(np.arctan2(found["ua"], found["va"]))
    attrs = {"standard_name": "wind_to_direction", "units": "degree"}
    same = found.assign(wd=toward.assign_attrs(attrs))
    assert len(same.flowgrain.arrows(n=3)) == 3
    other = found.assign(wd=(toward + 180.0).assign_attrs(attrs))
    with pytest.raises(ValueError, match="off the direction 'wd'.*u and v are taken as they are"):
        other.flowgrain.arrows(n=3)
    assert len(other.flowgrain.arrows(u="ua", v="va", n=3)) == 3


def test_refusals():
    mixed = dataset()
    mixed["u"].attrs["units"], mixed["v"].attrs["units"] = "m s-1", "cm/s"
    with pytest.raises(ValueError, match="'u' is in m/s, 'v' in cm/s"):
        mixed.flowgrain.arrows()
    with pytest.raises(ValueError, match="both u and v"):
        dataset().flowgrain.arrows("u")
    with pytest.raises(ValueError, match="both x and y"):
        dataset().flowgrain.arrows(x="x")
    with pytest.raises(ValueError, match="two of u's"):
        dataset().assign_coords(t=("t", [1.0, 2.0])).flowgrain.arrows(x="t", y="y")


def test_the_accessor_is_there_in_any_order():
    """Here flowgrain is imported first."""
    assert xr.Dataset().flowgrain
    code = "import xarray, flowgrain; xarray.Dataset().flowgrain"
    subprocess.run([sys.executable, "-c", code], check=True)
