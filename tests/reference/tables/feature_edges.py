"""Counts the borders, creases over 30 degrees and edges of three and more faces of models by vtkFeatureEdges, and compares
them with the rows of tests/unit/mesh/test_features.c: python3 tests/reference/tables/feature_edges.py MODELS (Debian: python3-vtk9).

Quads that are bent have one normal in VTK, the mean of all their corners; here, each side has that of its triangle. For
such a model VTK gets the triangles, cut from the first corner, and the creases on diagonals are not counted."""
import os
import re
import sys

import vtk

BENT = {"suzanne.obj"}  # quads that are not planar


def cut(faces):
    """Returns the triangles of polygons, and the sides of the polygons."""
    cells, out, sides = faces.GetPolys(), vtk.vtkCellArray(), set()
    ids = vtk.vtkIdList()
    cells.InitTraversal()
    while cells.GetNextCell(ids):
        corners = [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
        sides.update(frozenset(side) for side in zip(corners, corners[1:] + corners[:1]))
        for i in range(2, len(corners)):
            out.InsertNextCell(3)
            for corner in (corners[0], corners[i - 1], corners[i]):
                out.InsertCellPoint(corner)
    triangles = vtk.vtkPolyData()
    triangles.SetPoints(faces.GetPoints())
    triangles.SetPolys(out)
    return triangles, sides


def count_on_sides(edges, faces, sides):
    """Counts the lines of `edges` that are sides of polygons."""
    places = {faces.GetPoint(i): i for i in range(faces.GetNumberOfPoints())}
    count, ids = 0, vtk.vtkIdList()
    edges.GetLines().InitTraversal()
    while edges.GetLines().GetNextCell(ids):
        count += frozenset(places[edges.GetPoint(ids.GetId(k))] for k in (0, 1)) in sides
    return count


def counts_of(path):
    reader = vtk.vtkOBJReader()
    reader.SetFileName(path)
    reader.Update()
    faces = vtk.vtkPolyData()
    faces.SetPoints(reader.GetOutput().GetPoints())
    faces.SetPolys(reader.GetOutput().GetPolys())
    clean = vtk.vtkCleanPolyData()
    clean.SetInputData(faces)
    clean.SetTolerance(1e-6)
    clean.Update()
    welded, counts = clean.GetOutput(), []
    sides = None
    if os.path.basename(path) in BENT:
        welded, sides = cut(welded)
    for kind in ("Boundary", "Feature", "NonManifold"):
        edges = vtk.vtkFeatureEdges()
        edges.SetInputData(welded)
        edges.SetFeatureAngle(30)
        for each in ("Boundary", "Feature", "NonManifold", "Manifold"):
            getattr(edges, f"Set{each}Edges")(each == kind)
        edges.Update()
        lines = edges.GetOutput()
        counts.append(count_on_sides(lines, welded, sides) if sides else lines.GetNumberOfLines())
    return counts


with open("tests/unit/mesh/test_features.c") as file:
    rows = re.findall(r'\{"([^"]+\.obj)", (\d+), (\d+), (\d+)\}', file.read())
if not os.path.isdir(sys.argv[1]):
    print(f"SKIPPED: no folder {sys.argv[1]} (DATA=FOLDER of models)", file=sys.stderr)
    sys.exit(0)
faults = 0
for name, *want in rows:
    want, counts = [int(n) for n in want], counts_of(f"{sys.argv[1]}/{name}")
    equal = counts == want
    faults += not equal
    print(f"{'ok' if equal else 'NOT OK'} {name}: borders, creases, more: {counts}, here {want}")
sys.exit(1 if faults or not rows else 0)
