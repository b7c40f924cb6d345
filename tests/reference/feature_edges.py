"""Counts the borders, creases over 30 degrees and edges of three and more faces of models by vtkFeatureEdges, and compares
them with the rows of tests/unit/test_features.c: python3 tests/reference/feature_edges.py MODELS (Debian: python3-vtk9)."""
import re
import sys

import vtk

BENT = {"suzanne.obj"}  # quads that are not planar: VTK averages their normals


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
    counts = []
    for kind in ("Boundary", "Feature", "NonManifold"):
        edges = vtk.vtkFeatureEdges()
        edges.SetInputConnection(clean.GetOutputPort())
        edges.SetFeatureAngle(30)
        for each in ("Boundary", "Feature", "NonManifold", "Manifold"):
            getattr(edges, f"Set{each}Edges")(each == kind)
        edges.Update()
        counts.append(edges.GetOutput().GetNumberOfLines())
    return counts


with open("tests/unit/test_features.c") as file:
    rows = re.findall(r'\{"([^"]+\.obj)", (\d+), (\d+), (\d+)\}', file.read())
faults = 0
for name, *want in rows:
    want, counts = [int(n) for n in want], counts_of(f"{sys.argv[1]}/{name}")
    equal = counts == want or (name in BENT and counts[::2] == want[::2])
    faults += not equal
    print(f"{'ok' if equal else 'NOT OK'} {name}: borders, creases, more: {counts}, here {want}")
sys.exit(1 if faults or not rows else 0)
