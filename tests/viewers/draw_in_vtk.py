# Draws the cell data of a VTU file with VTK.
#
#   draw_in_vtk.py FILE.vtu ARRAY VIEW.json EXPOSURE WIDTH HEIGHT PICTURE.png
#
# A cell's colour is its value, of three components, times EXPOSURE, encoded as sRGB, without light of VTK. Cells whose
# corners run clockwise as seen from the camera are left out.
import json
import sys

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

file, name, view, exposure, width, height, picture = sys.argv[1:]
reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(file)
reader.Update()
grid = reader.GetOutput()
print("cells:", grid.GetNumberOfCells())
light = numpy.clip(vtk_to_numpy(grid.GetCellData().GetArray(name)) * float(exposure), 0, 1)
srgb = numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
colours = numpy_to_vtk(numpy.round(255 * srgb).astype(numpy.uint8), deep=True, array_type=vtk.VTK_UNSIGNED_CHAR)
colours.SetName("colours")
grid.GetCellData().AddArray(colours)

mapper = vtk.vtkDataSetMapper()
mapper.SetInputData(grid)
mapper.SetScalarModeToUseCellFieldData()
mapper.SelectColorArray("colours")
mapper.SetColorModeToDirectScalars()
actor = vtk.vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().LightingOff()
actor.GetProperty().BackfaceCullingOn()
renderer = vtk.vtkRenderer()
renderer.AddActor(actor)
with open(view) as text:
    camera = json.load(text)
renderer.GetActiveCamera().SetPosition(camera["eye"])
renderer.GetActiveCamera().SetFocalPoint(camera["look_at"])
renderer.GetActiveCamera().SetViewUp(camera["up"])
renderer.GetActiveCamera().SetViewAngle(camera["fov"])
renderer.ResetCameraClippingRange()
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(0)
window.SetSize(int(width), int(height))
window.AddRenderer(renderer)
window.Render()
image = vtk.vtkWindowToImageFilter()
image.SetInput(window)
writer = vtk.vtkPNGWriter()
writer.SetFileName(picture)
writer.SetInputConnection(image.GetOutputPort())
writer.Write()
