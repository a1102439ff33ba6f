import pathlib
import shutil
import subprocess
import sys

import numpy as np
import pytest

import flowgrain
from conftest import WITH_A_DISPLAY, vortices

pytest.importorskip("vtkmodules")
from vtkmodules import vtkCommonDataModel as model  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringOutputWindow  # noqa: E402

PLUGIN = pathlib.Path(flowgrain.__file__).parent / "paraview" / "flowgrain_filter.py"
sys.path.append(str(PLUGIN.parent))
import flowgrain_filter  # noqa: E402


def add(data, vectors, name="v"):
    array = numpy_to_vtk(np.ascontiguousarray(vectors, np.float64), deep=True)
    array.SetName(name)
    data.AddArray(array)


def grid_of(x, y, z, velocity, kind=model.vtkStructuredGrid):
    """A curvilinear grid: coordinates of the shape (nz, ny, nx), velocity with 3 more."""
    grid = kind()
    grid.SetDimensions(*x.shape[::-1])
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.stack([x, y, z], -1).reshape(-1, 3), deep=True))
    grid.SetPoints(points)
    add(grid.GetPointData(), np.stack(velocity, -1).reshape(-1, 3))
    return grid


def run(data, **options):
    algorithm = flowgrain_filter.FlowgrainArrows()
    algorithm.SetInputDataObject(data)
    algorithm.SetVectors(0, 0, 0, int(options.pop("on_cells", False)), "v")
    for name, value in options.items():
        getattr(algorithm, f"Set{name}")(value)
    algorithm.Update()
    return algorithm.GetOutputDataObject(0)


def triangles(found):
    points = vtk_to_numpy(found.GetPoints().GetData())
    return points[vtk_to_numpy(found.GetPolys().GetConnectivityArray()).reshape(-1, 3)]


def area(corners):
    return 0.5 * np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)


def image(field, flat=2):
    """An image in the plane across an axis."""
    x, y, u, v = field
    data, sizes = model.vtkImageData(), [len(x), len(y)]
    for sequence, value in ((sizes, 1), (low := [x[0], y[0]], 0.5),
                            (step := [x[1] - x[0], y[1] - y[0]], 1.0)):
        sequence.insert(flat, value)
    data.SetDimensions(*sizes)
    data.SetOrigin(*low)
    data.SetSpacing(*step)
    vectors = [u.ravel(), v.ravel()]
    vectors.insert(flat, 7.0 * np.ones(u.size))  # across the plane: left out
    add(data.GetPointData(), np.stack(vectors, 1))
    return data


def test_an_image_has_the_arrows_of_its_arrays(field):
    few = flowgrain.arrows(*field, n=12, seed=3)
    for flat in (2, 1):
        found = run(image(field, flat), Arrows=12, Seed=3, Lift=0)
        corners = triangles(found)
        owner = vtk_to_numpy(found.GetCellData().GetArray("arrow")) - 1
        assert (corners[..., flat] == 0.5).all()
        for n, outline in enumerate(few.outlines):
            x, y = outline.T
            shoelace = 0.5 * abs((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
            assert area(corners[owner == n]).sum() == pytest.approx(shoelace, rel=1e-6)
            kept = [k for k in range(3) if k != flat]
            assert corners[owner == n][..., kept].max((0, 1)) == pytest.approx(outline.max(0))
        for name, values in (("speed", few.speed), ("area", few.area), ("cluster", few.cluster)):
            assert np.array_equal(vtk_to_numpy(found.GetCellData().GetArray(name)), values[owner])


def test_no_surface_hides_arrows(field):
    height = triangles(run(image(field), Arrows=5, Lift=0.01))[:, 0, 2]
    assert set(np.round(height, 9)) == {0.4, 0.6}  # 8 x 6: a diagonal of 10
    x, y, u, v = field
    data = model.vtkRectilinearGrid()  # a layer of cells
    data.SetDimensions(len(x), len(y), 2)
    for axis, put in ((x, data.SetXCoordinates), (y, data.SetYCoordinates),
                      (np.array([1.0, 3.0]), data.SetZCoordinates)):
        put(numpy_to_vtk(axis, deep=True))
    add(data.GetCellData(), np.stack([u[1:, 1:].ravel(), v[1:, 1:].ravel(), 0 * u[1:, 1:].ravel()],
                                     1))
    height = triangles(run(data, Arrows=5, Lift=0.01, on_cells=True))[:, 0, 2]
    assert set(np.round(height, 9)) == {3.1}


def test_hidden_points_and_cells_are_avoided(field):
    x, y, u, v = field
    hole = np.hypot(*np.meshgrid(x - 6.0, y - 1.0)) < 1.2
    middle = np.hypot(*np.meshgrid(x[:-1] - 6.0, y[:-1] - 1.0)) < 1.2
    for flags, bit, on_cells in ((hole, 2, False), (middle, 32, True)):
        data = image(field)
        ghosts = numpy_to_vtk((bit * flags).astype(np.uint8).ravel(), deep=True)
        ghosts.SetName("vtkGhostType")
        (data.GetCellData() if on_cells else data.GetPointData()).AddArray(ghosts)
        places = triangles(run(data, Arrows=12)).reshape(-1, 3)
        assert np.hypot(*(places[:, :2] - (6.0, 1.0)).T).min() > 1.0


def test_a_turned_plane_of_cells():
    """Rotation about an oblique axis, on a curvilinear grid in the plane across it: circles."""
    angle, radius = np.meshgrid(np.linspace(0.2, 2.9, 61), np.linspace(0.5, 1.5, 25))
    flat = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle], -1)
    normal = np.array([1.0, 2.0, 3.0]) / np.sqrt(14.0)
    first = np.cross(normal, [1.0, 0.0, 0.0])
    first /= np.linalg.norm(first)
    turn = np.array([first, np.cross(normal, first), normal])
    center = np.array([5.0, -3.0, 2.0])
    places = center + flat @ turn
    velocity = np.cross(normal, places - center)
    x, y, z = np.moveaxis(places, -1, 0)[:, None]
    found = run(grid_of(x, y, z, np.moveaxis(velocity, -1, 0)[:, None]), Arrows=8, Lift=0)
    corners, owner = triangles(found), vtk_to_numpy(found.GetCellData().GetArray("arrow"))
    assert set(owner) == set(range(1, 9))
    off = (corners - center) @ normal
    assert np.abs(off).max() < 1e-6
    for n in range(1, 9):
        distance = np.linalg.norm(corners[owner == n] - center, axis=-1)
        assert 0.45 < distance.min() and distance.max() < 1.55 and np.ptp(distance) < 0.12


@pytest.fixture(scope="module")
def twist():
    """A warped grid in 3D round the axis x = 1, y = 2, and a velocity that is linear."""
    z, y, x = np.meshgrid(*[np.linspace(0.0, 2.0, n) for n in (9, 11, 13)], indexing="ij")
    x, y = x + 0.1 * z, y + 1.0 + 0.05 * np.sin(x)
    return grid_of(x, y, z, [2.0 - y, x - 1.0, 0.2 + 0 * z])


def test_volume(twist):
    found = run(twist, Arrows=3, Samples=9)
    corners, owner = triangles(found), vtk_to_numpy(found.GetCellData().GetArray("arrow"))
    assert set(owner) == set(range(1, 4)) and found.GetCellData().GetArray("volume") is not None
    normals = vtk_to_numpy(found.GetPointData().GetNormals())
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    shading = normals[vtk_to_numpy(found.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    assert np.mean((facing[:, None] * shading).sum(-1) > 0.0) > 0.99  # outwards
    assert np.linalg.norm(normals, axis=1) == pytest.approx(1.0, abs=1e-5)
    # closed: as much surface faces one way as the other
    assert np.abs(facing.sum(0)).max() < 1e-6 * area(corners).sum()
    field = flowgrain_filter.field_of(twist, "v")
    x, y = np.meshgrid(field.axes[0], field.axes[1])
    assert field.velocity[0][4] == pytest.approx(np.where(np.isnan(field.velocity[0][4]), np.nan,
                                                          2.0 - y), abs=1e-2, nan_ok=True)
    assert np.isfinite(field.velocity[2]).mean() > 0.85  # the box is a little wider
    assert [len(axis) for axis in field.axes] == pytest.approx([100, 85, 67], rel=0.15)


def test_blocks_are_one_field(field):
    x, y, u, v = field
    blocks = model.vtkMultiBlockDataSet()
    for n, part in enumerate((slice(None, 40), slice(39, None))):
        px, py = np.meshgrid(x[part], y)
        blocks.SetBlock(n, grid_of(px[None], py[None], 0 * px[None],
                                   [u[None, :, part], v[None, :, part], 0 * px[None]]))
    whole = grid_of(*(a[None] for a in (*np.meshgrid(x, y), 0 * u)),
                    [u[None], v[None], 0 * u[None]])
    one, other = (flowgrain_filter.field_of(data, "v") for data in (whole, blocks))
    for a, b in zip(one.velocity, other.velocity):
        assert np.isfinite(a).all() and np.allclose(a, b, atol=1e-6)
    algorithm = flowgrain_filter.FlowgrainArrows()  # of the first vectors that there are
    algorithm.SetInputDataObject(blocks)
    algorithm.Update()
    arrow = vtk_to_numpy(algorithm.GetOutputDataObject(0).GetCellData().GetArray("arrow"))
    assert len(set(arrow)) == 40


def test_refusals_are_said(field):
    window = vtkStringOutputWindow()
    before = window.GetInstance()
    window.SetInstance(window)
    try:
        still = image(field)
        still.GetPointData().GetArray("v").Fill(0.0)
        assert run(still).GetNumberOfCells() == 0
        assert "zero everywhere" in window.GetOutput()
        with pytest.raises(ValueError, match="no vectors 'w' on the points"):
            flowgrain_filter.field_of(still, "w")
        line = model.vtkImageData()
        line.SetDimensions(9, 1, 1)
        add(line.GetPointData(), np.ones((9, 3)))
        with pytest.raises(ValueError, match="9 x 1 x 1"):
            flowgrain_filter.field_of(line, "v")
        x, y = np.meshgrid(field[2], field[3])
        sheet = grid_of(x[None], y[None], np.cos(x)[None], [a[None] for a in (x, y, x)])
        with pytest.raises(ValueError, match="lie in no plane"):
            flowgrain_filter.field_of(sheet, "v")
    finally:
        window.SetInstance(before)


SCRIPT = """
import inspect
if not hasattr(inspect, "getargspec"):  # ParaView 5.11 with Python 3.11
    inspect.getargspec = inspect.getfullargspec
from paraview.simple import *
LoadPlugin({plugin!r}, remote=False, ns=globals())
source = OpenDataFile({field!r})
source.UpdatePipeline()
few = FlowgrainArrows(Input=source)
assert list(few.Vectors) == ["POINTS", "v"], few.Vectors
assert (few.Arrows, few.Seed, few.Coverage, few.Anisotropy) == (40, 1, 0.3, 0.15)
few.Arrows, few.Seed, few.Coverage = 9, 2, 0.4

def arrows_at(time):
    few.UpdatePipeline(time)
    speed, number = (few.CellData[name] for name in ("speed", "arrow"))
    return number and (number.GetRange(0)[1], speed.GetRange(0)[1])

assert list(source.TimestepValues) == [0.0, 2.0]
print("ARROWS", *arrows_at(0.0), *arrows_at(2.0))
few.Coverage = 2.0
assert arrows_at(2.0) is None  # and says why
few.Coverage = 0.4
view = CreateView("RenderView")
ColorBy(Show(few, view), ("CELLS", "speed"))
ResetCamera(view)
SaveScreenshot({picture!r}, view, ImageResolution=[300, 200])
"""


@pytest.mark.skipif(not shutil.which("pvpython") or not shutil.which("xvfb-run"),
                    reason="no pvpython, no xvfb-run")
def test_in_paraview(tmp_path, field):
    from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

    x, y, u, v = vortices()
    for name, factor in (("one", 1.0), ("other", 2.0)):
        writer = vtkXMLImageDataWriter()
        writer.SetInputData(image((factor * u, factor * v, x, y)))
        writer.SetFileName(str(tmp_path / f"{name}.vti"))
        writer.Write()
    (tmp_path / "field.pvd").write_text(
        '<VTKFile type="Collection" version="0.1"><Collection>'
        '<DataSet timestep="0" file="one.vti"/><DataSet timestep="2" file="other.vti"/>'
        '</Collection></VTKFile>')
    (tmp_path / "script.py").write_text(SCRIPT.format(
        plugin=str(PLUGIN), field=str(tmp_path / "field.pvd"), picture=str(tmp_path / "out.png")))
    found = subprocess.run([*WITH_A_DISPLAY, "pvpython", str(tmp_path / "script.py")],
                           capture_output=True, text=True)
    line = [line for line in found.stdout.splitlines() if line.startswith("ARROWS")]
    assert line, found.stderr
    count, speed, then, faster = (float(word) for word in line[0].split()[1:])
    assert (count, then, faster) == (9, 9, 2.0 * speed)
    assert "Flowgrain Arrows: coverage 2" in found.stdout + found.stderr
    image_ = pytest.importorskip("matplotlib.image")
    picture = image_.imread(tmp_path / "out.png")[..., :3]
    assert len(np.unique(np.round(picture.reshape(-1, 3), 2), axis=0)) > 9  # colours of speeds
