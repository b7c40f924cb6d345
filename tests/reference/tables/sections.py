"""Compares the areas of caps in `info` with those of vtkCutter and shapely, for 20 random planes through each closed model:
python3 tests/reference/tables/sections.py BUILD MODELS (Debian: python3-vtk9, python3-shapely, python3-numpy).

The lines of vtkCutter get the direction of the triangles that they cut. Shapely measures the loops that they form. Loops that
turn the other way are holes and count as negative, as `capArea` defines it."""
import glob
import json
import os
import subprocess
import sys
import tempfile

import numpy
import vtk
from shapely.geometry import LinearRing, Polygon
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

PLANES, BAR = 20, 1e-4


def mesh_of(path):
    """Returns the mesh, and the normal of each triangle, which is the value of its cell."""
    reader, faces, clean, triangles = vtk.vtkOBJReader(), vtk.vtkPolyData(), vtk.vtkCleanPolyData(), vtk.vtkTriangleFilter()
    reader.SetFileName(path)
    reader.Update()
    faces.SetPoints(reader.GetOutput().GetPoints())
    faces.SetPolys(reader.GetOutput().GetPolys())
    clean.SetInputData(faces)
    clean.SetTolerance(1e-6)
    triangles.SetInputConnection(clean.GetOutputPort())
    triangles.Update()
    mesh = triangles.GetOutput()
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    a, b, c = points[vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)].transpose(1, 0, 2)
    normals = numpy_to_vtk(numpy.cross(b - a, c - a), deep=True)
    normals.SetName("normals")
    mesh.GetCellData().AddArray(normals)
    return mesh, points


def loops_of(ends):
    """Joins lines from ends[:, 0] to ends[:, 1] into loops of three and more points."""
    loops, after = [], {}
    for a, b in ends:
        after.setdefault(a, []).append(b)
    for first, others in after.items():
        while others:
            loop = [first]
            while after.get(loop[-1]):
                loop.append(after[loop[-1]].pop())
            if loop[-1] != first:
                sys.exit("vtkCutter left a loop open")
            if len(loop) > 3:
                loops.append(loop[:-1])
    return loops


def area_of(mesh, normal, point):
    """Returns the area of a cut: the sum of its loops, holes less."""
    plane, cutter = vtk.vtkPlane(), vtk.vtkCutter()
    plane.SetNormal(normal)
    plane.SetOrigin(point)
    cutter.SetInputData(mesh)
    cutter.SetCutFunction(plane)
    cutter.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    cutter.Update()
    cut = cutter.GetOutput()
    if cut.GetNumberOfLines() == 0:
        return 0.0
    points = vtk_to_numpy(cut.GetPoints().GetData())
    ends = vtk_to_numpy(cut.GetLines().GetConnectivityArray()).reshape(-1, 2).copy()
    outwards = vtk_to_numpy(cut.GetCellData().GetArray("normals"))
    along = numpy.einsum("ij,ij->i", points[ends[:, 1]] - points[ends[:, 0]], numpy.cross(outwards, normal))
    ends[along < 0] = ends[along < 0][:, ::-1]
    across = numpy.linalg.svd(numpy.array(normal).reshape(1, 3))[2][1:]
    rings = [LinearRing(points[loop] @ across.T) for loop in loops_of(ends[ends[:, 0] != ends[:, 1]])]
    return abs(sum(Polygon(ring).area * (1 if ring.is_ccw else -1) for ring in rings))


def cap_area(build, path, normal, point):
    """Returns the area of the caps, or None if the model is not closed."""
    scene = {"meshes": [{"asset": "model.obj"}],
             "sections": {"planes": [{"normal": normal, "point": point, "keep": "positive"}]}}
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(scene, file)
        file.flush()
        out = subprocess.run([f"{build}/zraster", file.name, "--part", f"model.obj={path}", "-c", "info", "--render", "false",
                              "-o", "-"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    if out.returncode != 0:
        sys.exit(f"{path}: {out.stderr.decode()}")
    part, = json.loads(out.stdout)["parts"]
    return part["capArea"] if part["closed"] else None


build, models = sys.argv[1], sys.argv[2]
paths = sorted(glob.glob(f"{models}/*.obj") + glob.glob(f"{models}/parts/*.obj"))
faults = compared = 0
for path in paths:
    name, random, worst, cut = os.path.basename(path), numpy.random.default_rng(1), 0.0, 0
    mesh, points = mesh_of(path)
    low, high = points.min(0), points.max(0)
    for _ in range(PLANES):
        normal = [float(x) for x in random.normal(size=3)]
        point = [float(numpy.float32(x)) for x in low + (high - low) * random.uniform(0.25, 0.75, 3)]
        normal = [float(numpy.float32(x)) for x in normal]
        ours = cap_area(build, path, normal, point)
        if ours is None:
            break
        theirs = area_of(mesh, normal, point)
        worst, cut = max(worst, abs(ours - theirs) / theirs if theirs > 0 else float(ours > 0)), cut + 1
    if cut == 0:
        print(f"LEFT OUT: {name}: it is not closed")
        continue
    compared += cut
    faults += worst > BAR
    print(f"{'ok' if worst <= BAR else 'NOT OK'} {name}: {cut} planes, largest difference {worst:.2e}")
print(f"{compared} planes, vtkCutter of VTK {vtk.vtkVersion().GetVTKVersion()}")
sys.exit(faults > 0 or compared == 0)
