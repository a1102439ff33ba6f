"""A filter of ParaView and VTK: few curved arrows that show a vector field.

In ParaView load this file as a plug-in (Tools > Manage Plugins > Load New, or LoadPlugin of
paraview.simple); the filter is then Filters > Alphabetical > Flowgrain Arrows. In VTK alone
`FlowgrainArrows` is an algorithm. The package flowgrain is found where Python looks, or where this
file lies in it.
"""

import pathlib
import sys

import numpy as np
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkPoints
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkCompositeDataSet, vtkDataObject,
                                           vtkImageData, vtkPolyData, vtkRectilinearGrid)
from vtkmodules.vtkFiltersCore import (vtkAppendFilter, vtkCellDataToPointData, vtkProbeFilter,
                                       vtkTriangleFilter)
from vtkmodules.vtkParallelCore import vtkMultiProcessController

try:
    from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smproperty, smproxy
except ImportError:  # VTK without ParaView: nothing is to be declared
    from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase

    class _Undeclared:
        def __getattr__(self, name):
            return lambda *args, **kwargs: lambda declared: declared

    smproperty = smproxy = _Undeclared()

try:
    import flowgrain
except ImportError:  # the package that this file is in
    sys.path.append(str(pathlib.Path(__file__).resolve().parents[2]))
    import flowgrain

HIDDEN_POINT, HIDDEN_CELL = 2, 8 | 32  # bits of vtkGhostType
FLAT = 1e-5  # of a width: what is thinner is a plane
MOST_SAMPLES, FINEST = 1 << 20, 8  # of a raster, and samples to a narrow cell


class Field:
    """Samples on axes, and where these lie in space: place = origin + sum of coordinate * way.

    A layer has a thickness.
    """

    def __init__(self, velocity, axes, ways=None, origin=(0.0, 0.0, 0.0), thickness=0.0):
        self.velocity, self.axes, self.thickness = velocity, axes, thickness
        self.ways = np.eye(3)[:len(axes)] if ways is None else np.asarray(ways)
        self.origin = np.asarray(origin, np.float64)

    def places(self, points):
        return self.origin + points @ self.ways

    @property
    def normal(self):
        return np.cross(*self.ways)

    @property
    def width(self):
        return float(np.linalg.norm([axis[-1] - axis[0] for axis in self.axes]))


def field_of(data, name, on_cells=False, samples=0):
    """The field of a dataset's vectors.

    Images and rectilinear grids keep their samples. All else, and images with turned axes, is
    interpolated onto a raster over its box: along each axis as fine as a quarter of the cells are,
    within 2^20 samples, or `samples` along the longest. Data in a plane, and one layer of cells,
    become a field in 2D in that plane.
    """
    if isinstance(data, vtkCompositeDataSet):
        data = _merged(data)
    data = _with_vectors(data, name, on_cells)
    if isinstance(data, vtkRectilinearGrid) or _is_upright(data):
        return _on_axes(data)
    return _on_raster(data, samples)


def _merged(blocks):
    append = vtkAppendFilter()
    iterator = blocks.NewIterator()
    while not iterator.IsDoneWithTraversal():
        if iterator.GetCurrentDataObject().IsA("vtkDataSet"):
            append.AddInputData(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    append.Update()
    return append.GetOutput()


def _with_vectors(data, name, on_cells):
    """A copy of the grid with the vectors alone, NaN where they are hidden."""
    points, cells = data.GetPointData(), data.GetCellData()
    given = (cells if on_cells else points).GetArray(name)
    if given is None:
        place = "cells" if on_cells else "points"
        raise ValueError(f"there are no vectors {name!r} on the {place}")
    if not 2 <= given.GetNumberOfComponents() <= 3:
        raise ValueError(f"{name} has {given.GetNumberOfComponents()} components; vectors have 3")
    vectors = np.zeros((given.GetNumberOfTuples(), 3))
    vectors[:, :given.GetNumberOfComponents()] = vtk_to_numpy(given)
    if on_cells:
        _hide(vectors, cells.GetArray("vtkGhostType"), HIDDEN_CELL)
    copy = data.NewInstance()
    copy.CopyStructure(data)
    copy.GetPointData().Initialize()
    copy.GetCellData().Initialize()
    array = numpy_to_vtk(vectors, deep=True)
    array.SetName("v")
    (copy.GetCellData() if on_cells else copy.GetPointData()).AddArray(array)
    if on_cells:
        means = vtkCellDataToPointData()
        means.SetInputData(copy)
        means.Update()
        copy = means.GetOutput()
    vectors = vtk_to_numpy(copy.GetPointData().GetArray("v"))
    _hide(vectors, points.GetArray("vtkGhostType"), HIDDEN_POINT)
    valid = points.GetArray("vtkValidPointMask")
    if valid is not None:
        vectors[vtk_to_numpy(valid) == 0] = np.nan
    if not on_cells:
        _hide_corners(copy, vectors, cells.GetArray("vtkGhostType"))
    return copy


def _hide(vectors, flags, bits):
    if flags is not None:
        vectors[(vtk_to_numpy(flags) & bits) != 0] = np.nan


def _hide_corners(data, vectors, flags):
    if flags is not None:
        for cell in np.flatnonzero(vtk_to_numpy(flags) & HIDDEN_CELL):
            corners = data.GetCell(int(cell)).GetPointIds()
            vectors[[corners.GetId(n) for n in range(corners.GetNumberOfIds())]] = np.nan


def _is_upright(data):
    return isinstance(data, vtkImageData) and data.GetDirectionMatrix().IsIdentity()


def _on_axes(data):
    if isinstance(data, vtkRectilinearGrid):
        axes = [vtk_to_numpy(a).astype(np.float64) for a in
                (data.GetXCoordinates(), data.GetYCoordinates(), data.GetZCoordinates())]
    else:
        low, step, first = data.GetOrigin(), data.GetSpacing(), data.GetExtent()[::2]
        axes = [low[k] + step[k] * (first[k] + np.arange(n))
                for k, n in enumerate(data.GetDimensions())]
    shape = [len(axis) for axis in axes]
    vectors = vtk_to_numpy(data.GetPointData().GetArray("v")).reshape(*shape[::-1], 3)
    flat = _flat_axis(shape)
    if flat is None:
        return Field([vectors[..., k] for k in range(3)], axes)
    return _in_plane(vectors.mean(2 - flat), axes, flat)


def _flat_axis(shape):
    """Which of three axes a field in 2D is across: one of one sample, or of two."""
    for thin in (1, 2):
        if shape.count(thin) == 1 and min(n for n in shape if n != thin) > thin:
            return shape.index(thin)
    if min(shape) < 2:
        raise ValueError("{} x {} x {} points are no field in 2D or 3D".format(*shape))
    return None


def _in_plane(vectors, axes, flat):
    kept = [k for k in range(3) if k != flat]
    ways = np.eye(3)[kept]
    origin = np.zeros(3)
    origin[flat] = axes[flat].mean()
    return Field([vectors[..., k] for k in kept], [axes[k] for k in kept], ways, origin,
                 np.ptp(axes[flat]))


def _on_raster(data, samples):
    if data.GetNumberOfCells() == 0:
        raise ValueError("the grid has no cells")
    append = vtkAppendFilter()  # any grid becomes an unstructured one
    append.AddInputData(data)
    append.Update()
    cells = append.GetOutput()
    points = dataset_adapter.WrapDataObject(cells).Points.astype(np.float64)
    ways, origin = _plane_of(points)
    flat = len(ways) == 2
    if not flat and _dimension_of(cells) < 3:
        raise ValueError("the cells are a surface or lines that lie in no plane; vectors of a "
                         "volume or of a plane are needed, as of a slice")
    if flat:
        points = (points - origin) @ ways.T
        _move(cells, np.column_stack([points, np.zeros(len(points))]))
    low, high = points.min(0), points.max(0)
    layer = None if flat else _layer_of(points, low, high)
    counts = _raster_counts(cells, points, low, high, samples, layer)
    axes = [np.linspace(a, b, n) if n > 1 else np.array([a, b])
            for a, b, n in zip(low, high, counts)]
    values = _probed(cells, counts if not flat else [*counts, 1], low, high)
    if flat:
        return Field([values[0] @ way for way in ways], axes, ways, origin)
    if layer is None:
        return Field([values[..., k] for k in range(3)], axes)
    return _in_plane(values.take(0, 2 - layer), axes, layer)


def _plane_of(points):
    """The directions of a plane that all points lie in and its origin; or three axes."""
    middle = points.mean(0)
    _, widths, ways = np.linalg.svd((points - middle)[::max(1, len(points) // 20000)],
                                    full_matrices=False)
    normal = ways[2]
    off = np.abs((points - middle) @ normal).max()
    rounding = 4e-7 * np.abs(points).max()
    if len(widths) == 3 and off > FLAT * np.ptp(points, 0).max() + rounding:
        return np.eye(3), np.zeros(3)
    # of x, y and z the one nearest to the normal is left out, and of the others the one nearer to
    # the plane keeps its direction there
    out = int(np.abs(normal).argmax())
    first, second = sorted((k for k in range(3) if k != out), key=lambda k: abs(normal[k]))
    one = np.eye(3)[first] - normal[first] * normal
    one /= np.linalg.norm(one)
    other = np.cross(normal, one)
    other *= np.sign(other[second])
    pair = {first: one, second: other}
    ways = np.array([pair[k] for k in sorted(pair)])
    ways[np.abs(ways) < 1e-7] = 0.0
    return ways, (middle @ normal) * normal


def _dimension_of(cells):
    types = vtk_to_numpy(cells.GetCellTypesArray())
    return max(cells.GetCell(int(n)).GetCellDimension()
               for n in np.unique(types, return_index=True)[1])


def _move(cells, places):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places), deep=True))
    cells.SetPoints(points)


def _layer_of(points, low, high):
    """The axis along which there is one layer of cells; None: there is none."""
    for k in range(3):
        slack = FLAT * (high - low).max()
        if (np.minimum(points[:, k] - low[k], high[k] - points[:, k]) <= slack).all():
            return k
    return None


def _raster_counts(cells, points, low, high, samples, layer):
    extent = np.maximum(high - low, 1e-300)
    if samples > 1:
        wanted = np.maximum(np.ceil(extent / extent.max() * (samples - 1)) + 1, 2)
    else:
        corners = vtk_to_numpy(cells.GetCells().GetConnectivityArray())
        first = vtk_to_numpy(cells.GetCells().GetOffsetsArray())[:-1]
        at = points[corners]
        wide = np.maximum.reduceat(at, first) - np.minimum.reduceat(at, first)
        step = np.array([np.percentile(w[w > 1e-9 * e], 25) if (w > 1e-9 * e).any() else e
                         for w, e in zip(wide.T, extent)])
        counts = extent / step
        if layer is not None:
            counts[layer] = 1.0
        free = counts > 1.0
        finer = (MOST_SAMPLES / counts.prod()) ** (1.0 / max(free.sum(), 1))
        wanted = np.maximum(np.ceil(counts * min(finer, FINEST)), 2)
    if layer is not None:
        wanted[layer] = 1
    return wanted.astype(int)


def _probed(cells, counts, low, high):
    """Vectors at the nodes of an even raster; along an axis of one node in the middle."""
    ends = np.zeros((2, 3))
    ends[:, :len(low)] = low, high
    wide = np.array(counts) > 1
    raster = vtkImageData()
    raster.SetDimensions(*(int(n) for n in counts))
    raster.SetOrigin(*np.where(wide, ends[0], ends.mean(0)))
    steps = np.maximum(np.array(counts) - 1, 1)
    raster.SetSpacing(*np.where(wide, (ends[1] - ends[0]) / steps, 1.0))
    probe = vtkProbeFilter()
    probe.SetInputData(raster)
    probe.SetSourceData(cells)
    probe.Update()
    found = probe.GetOutput().GetPointData()
    values = vtk_to_numpy(found.GetArray("v")).copy()
    values[vtk_to_numpy(found.GetArray(probe.GetValidPointMaskArrayName())) == 0] = np.nan
    return values.reshape(*counts[::-1], 3)


def polydata_of(arrows, field, lift=0.0):
    """Arrows as polydata of triangles: in 2D those of polygons, `lift` off the plane on both
    sides, or before a layer; in 3D closed surfaces with normals. Arrays of the cells: speed, area
    (in 3D volume), cluster, arrow (from 1)."""
    if len(field.axes) == 2:
        return _polygons(arrows, field, lift)
    return _solids(arrows)


def _polygons(arrows, field, lift):
    outlines = [(n, o) for n, o in enumerate(arrows.outlines) if len(o)]
    # on both sides of a plane, so that no surface in it hides them; on the front of a layer
    sides = (1.0, -1.0) if lift and not field.thickness else (1.0,)
    lift += 0.5 * field.thickness * (lift > 0.0)
    outlines = [(n, o, side) for side in sides for n, o in outlines]
    points = [field.places(o) + side * lift * field.normal for _, o, side in outlines]
    sizes = np.array([len(o) for _, o, _ in outlines])
    polygons = vtkCellArray()
    polygons.SetData(numpy_to_vtkIdTypeArray(np.append(0, np.cumsum(sizes)), deep=True),
                     numpy_to_vtkIdTypeArray(np.arange(sizes.sum()), deep=True))
    drawn = np.array([n for n, _, _ in outlines])
    triangles = vtkTriangleFilter()  # renderers take polygons as convex
    triangles.SetInputData(_polydata(points, polygons, arrows, drawn, "area"))
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    triangles.Update()
    return triangles.GetOutput()


def _solids(arrows):
    points, normals, triangles, drawn, start = [], [], [], [], 0
    for n, (vertex, corner, normal, triangle) in enumerate(arrows._surfaces()):
        points.append(vertex[corner])
        normals.append(normal)
        triangles.append(triangle + start)
        drawn += [n] * len(triangle)
        start += len(corner)
    corners = np.concatenate(triangles).astype(np.int64)
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, corners.size + 1, 3), deep=True),
                  numpy_to_vtkIdTypeArray(corners.ravel(), deep=True))
    data = _polydata(points, cells, arrows, np.array(drawn), "volume")
    array = numpy_to_vtk(np.concatenate(normals), deep=True)
    array.SetName("Normals")
    data.GetPointData().SetNormals(array)
    return data


def _polydata(points, cells, arrows, owner, area):
    data = vtkPolyData()
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.concatenate(points), deep=True))
    data.SetPoints(places)
    data.SetPolys(cells)
    for name, values in (("speed", arrows.speed), (area, arrows.area),
                         ("cluster", arrows.cluster), ("arrow", np.arange(1, len(arrows) + 1))):
        array = numpy_to_vtk(np.ascontiguousarray(values[owner]), deep=True)
        array.SetName(name)
        data.GetCellData().AddArray(array)
    data.GetCellData().SetActiveScalars("speed")
    return data


@smproxy.filter(name="FlowgrainArrows", label="Flowgrain Arrows")
@smproperty.xml("""
  <InputProperty name="Input" command="SetInputConnection">
    <ProxyGroupDomain name="groups">
      <Group name="sources"/><Group name="filters"/>
    </ProxyGroupDomain>
    <DataTypeDomain name="input_type" composite_data_supported="1">
      <DataType value="vtkDataSet"/><DataType value="vtkCompositeDataSet"/>
    </DataTypeDomain>
    <InputArrayDomain name="input_array" number_of_components="3"/>
    <Documentation>A vector field: in a volume, or in a plane.</Documentation>
  </InputProperty>
  <StringVectorProperty name="Vectors" command="SetVectors" number_of_elements="5"
      element_types="0 0 0 0 2" animateable="0">
    <ArrayListDomain name="array_list" attribute_type="Vectors" input_domain_name="input_array">
      <RequiredProperties><Property name="Input" function="Input"/></RequiredProperties>
    </ArrayListDomain>
    <Documentation>The vectors.</Documentation>
  </StringVectorProperty>
  <IntVectorProperty name="Arrows" command="SetArrows" number_of_elements="1" default_values="40">
    <IntRangeDomain name="range" min="1" max="200"/>
    <Documentation>How many arrows; of clusters at most so many.</Documentation>
  </IntVectorProperty>
  <IntVectorProperty name="Kind" command="SetKind" number_of_elements="1" default_values="0"
      panel_visibility="advanced">
    <EnumerationDomain name="enum">
      <Entry value="0" text="Placed arrows"/><Entry value="1" text="An arrow in each cluster"/>
    </EnumerationDomain>
  </IntVectorProperty>
  <IntVectorProperty name="Seed" command="SetSeed" number_of_elements="1" default_values="1">
    <IntRangeDomain name="range" min="1"/>
    <Documentation>Of the noise that clusters grow from.</Documentation>
  </IntVectorProperty>
  <DoubleVectorProperty name="Coverage" command="SetCoverage" number_of_elements="1"
      default_values="0.3">
    <DoubleRangeDomain name="range" min="0.05" max="0.95"/>
    <Documentation>The share of the field that clusters cover.</Documentation>
  </DoubleVectorProperty>
  <DoubleVectorProperty name="Anisotropy" command="SetAnisotropy" number_of_elements="1"
      default_values="0.15" panel_visibility="advanced">
    <DoubleRangeDomain name="range" min="0.02" max="1"/>
    <Documentation>How much cheaper interfaces are along the flow.</Documentation>
  </DoubleVectorProperty>
  <IntVectorProperty name="Samples" command="SetSamples" number_of_elements="1"
      default_values="0" panel_visibility="advanced">
    <IntRangeDomain name="range" min="0" max="513"/>
    <Documentation>Along the longest side of the raster onto which curvilinear and unstructured
    grids are brought; 0: as fine as their cells.</Documentation>
  </IntVectorProperty>
  <DoubleVectorProperty name="Lift" command="SetLift" number_of_elements="1"
      default_values="0.001" panel_visibility="advanced">
    <DoubleRangeDomain name="range" min="0" max="0.1"/>
    <Documentation>By which share of the field's diagonal arrows lie off their plane, on both sides,
    or before a layer of cells, so that they are seen on a picture of it; 0: in it.</Documentation>
  </DoubleVectorProperty>
""")
class FlowgrainArrows(VTKPythonAlgorithmBase):
    """Few curved arrows that show a vector field, each for a part that flows alike."""

    def __init__(self):
        super().__init__(nInputPorts=1, nOutputPorts=1, outputType="vtkPolyData")
        self._association, self._name = vtkDataObject.FIELD_ASSOCIATION_POINTS, ""
        self._options = {"n": 40, "seed": 1, "kind": "arrows", "coverage": 0.3,
                         "anisotropy": 0.15}
        self._samples, self._lift = 0, 0.001
        self._field = self._field_key = None

    def FillInputPortInformation(self, port, info):
        info.Set(self.INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet")
        info.Append(self.INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet")
        return 1

    def SetVectors(self, index, port, connection, association, name):
        """Chooses the array: as vtkAlgorithm.SetInputArrayToProcess."""
        self._association, self._name = int(association), name
        self.Modified()

    def SetArrows(self, count):
        self._set("n", int(count))

    def SetKind(self, kind):
        self._set("kind", ("arrows", "clusters")[int(kind)])

    def SetSeed(self, seed):
        self._set("seed", int(seed))

    def SetCoverage(self, share):
        self._set("coverage", float(share))

    def SetAnisotropy(self, anisotropy):
        self._set("anisotropy", float(anisotropy))

    def SetSamples(self, samples):
        self._samples = int(samples)
        self.Modified()

    def SetLift(self, lift):
        self._lift = float(lift)
        self.Modified()

    def _set(self, name, value):
        self._options[name] = value
        self.Modified()

    def RequestData(self, request, inputs, outputs):
        data = vtkDataObject.GetData(inputs[0], 0)
        try:
            _check_alone()
            result = self._arrows_of(data)
        except (ValueError, MemoryError) as error:
            vtkOutputWindow.GetInstance().DisplayErrorText(f"Flowgrain Arrows: {error}\n")
            return 1  # with nothing; VTK would add a page to what was said
        vtkDataObject.GetData(outputs, 0).ShallowCopy(result)
        return 1

    def _arrows_of(self, data):
        name, on_cells = self._name, self._association == vtkDataObject.FIELD_ASSOCIATION_CELLS
        if not name:
            name, on_cells = _first_vectors(data)
        key = (data.GetAddressAsString(""), data.GetMTime(), name, on_cells, self._samples)
        if key != self._field_key:  # else other arrows of the same field
            self._field, self._field_key = field_of(data, name, on_cells, self._samples), key
        field = self._field
        x, y, *rest = field.axes
        u, v, *third = field.velocity
        volume = {"w": third[0], "z": rest[0]} if rest else {}
        few = flowgrain.arrows(x, y, u, v, **volume, **self._options)
        return polydata_of(few, field, self._lift * field.width)


def _check_alone():
    controller = vtkMultiProcessController.GetGlobalController()
    if controller is not None and controller.GetNumberOfProcesses() > 1:
        raise ValueError(f"the data are shared by {controller.GetNumberOfProcesses()} processes; "
                         "use a server of one")


def _first_vectors(data):
    """The first array of three components, on the points or else on the cells."""
    if isinstance(data, vtkCompositeDataSet):
        data = _merged(data)
    for on_cells, arrays in ((False, data.GetPointData()), (True, data.GetCellData())):
        for n in range(arrays.GetNumberOfArrays()):
            array = arrays.GetArray(n)
            if array is not None and array.GetNumberOfComponents() == 3:
                return array.GetName(), on_cells
    raise ValueError("there are no vectors, arrays of three components")
