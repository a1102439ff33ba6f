"""Draws docs/gallery/python/paraview.png: pvpython paraview_picture.py FIELD.vti PLUGIN

FIELD.vti: flowgrain synth vortex3d -o FIELD.vti --nodes 65
PLUGIN: flowgrain_filter.py of an installed package
"""

import inspect
import pathlib
import sys

from PIL import Image

if not hasattr(inspect, "getargspec"):  # ParaView 5.11 with Python 3.11
    inspect.getargspec = inspect.getfullargspec
from paraview import simple  # noqa: E402

OUT = pathlib.Path(__file__).resolve().parents[2] / "docs" / "gallery" / "python" / "paraview.png"

simple.LoadPlugin(sys.argv[2], remote=False, ns=globals())
field = simple.OpenDataFile(sys.argv[1])
cut = simple.Slice(Input=field)
cut.SliceType.Normal, cut.SliceType.Origin = [0.0, 0.0, 1.0], [0.5, 0.5, 0.12]
view = simple.CreateView("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1.0, 1.0, 1.0]
view.OrientationAxesVisibility = 0
arrows = FlowgrainArrows(Input=field, Arrows=25)  # noqa: F821 of the plug-in
flat = FlowgrainArrows(Input=cut, Arrows=25)  # noqa: F821
for few in (arrows, flat):
    shown = simple.Show(few, view)
    simple.ColorBy(shown, ("CELLS", "speed"))
    simple.GetColorTransferFunction("speed").ApplyPreset("Viridis (matplotlib)", True)
simple.Show(cut, view).DiffuseColor = [0.9, 0.9, 0.9]
box = simple.Show(field, view)
box.SetRepresentationType("Outline")
box.AmbientColor = [0.4, 0.4, 0.4]
camera = view.GetActiveCamera()
camera.SetPosition(-1.2, -2.6, 1.9)
camera.SetFocalPoint(0.5, 0.5, 0.45)
camera.SetViewUp(0.0, 0.0, 1.0)
simple.ResetCamera(view)
camera.Zoom(1.02)
simple.SaveScreenshot(str(OUT), view, ImageResolution=[900, 700])
picture = Image.open(OUT).convert("RGB")
picture.quantize(128, dither=Image.Dither.NONE).save(OUT, optimize=True)
