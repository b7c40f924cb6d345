"""vtk_views.py MESH.obj FRAMES PICTURE.ppm: VTK with its window and pipeline kept. For each line of standard input, moves
the camera around the mesh, and renders and reads back each view, 512x512. Prints milliseconds. Writes the first view."""
import math
import sys
import time

import vtk
from vtk.util.numpy_support import vtk_to_numpy

SIDE, FRAMES = 512, int(sys.argv[2])
reader = vtk.vtkOBJReader()
reader.SetFileName(sys.argv[1])
normals = vtk.vtkPolyDataNormals()
normals.SetInputConnection(reader.GetOutputPort())
normals.SplittingOff()
mapper = vtk.vtkPolyDataMapper()
mapper.SetInputConnection(normals.GetOutputPort())
actor = vtk.vtkActor()
actor.SetMapper(mapper)
renderer = vtk.vtkRenderer()
renderer.AddActor(actor)
renderer.SetBackground(1, 1, 1)
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(0)
window.SetSize(SIDE, SIDE)
window.AddRenderer(renderer)
renderer.ResetCamera()
camera = renderer.GetActiveCamera()
bounds = mapper.GetBounds()
center = [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)]
radius = math.dist(bounds[0::2], bounds[1::2]) / 2
distance = 0.8 * radius / math.sin(math.radians(camera.GetViewAngle() / 2))
pixels = vtk.vtkUnsignedCharArray()


def draw(number):
    angle, rise = 2 * math.pi * number / FRAMES, math.radians(20)
    way = (math.sin(angle) * math.cos(rise), math.sin(rise), math.cos(angle) * math.cos(rise))
    camera.SetFocalPoint(center)
    camera.SetPosition([center[i] + distance * way[i] for i in range(3)])
    camera.SetViewUp(0, 1, 0)
    renderer.ResetCameraClippingRange()
    window.Render()
    window.GetPixelData(0, 0, SIDE - 1, SIDE - 1, 0, pixels, 0)


draw(0)
with open(sys.argv[3], "wb") as file:
    file.write(b"P6 %d %d 255\n" % (SIDE, SIDE) + vtk_to_numpy(pixels).reshape(SIDE, SIDE, 3)[::-1].tobytes())
print("VTK", vtk.vtkVersion().GetVTKVersion(), flush=True)
for line in sys.stdin:
    begin = time.perf_counter()
    for number in range(FRAMES):
        draw(number)
    print(1000 * (time.perf_counter() - begin), flush=True)
