"""Reads names of model files, one per line. Prints the result of a Python package for each, in the form of three.mjs.

    read.py meshio|trimesh|lib3mf <names
"""
import json
import sys

import mf3


def facts_of_meshio(path):
    import meshio  # pylint: disable=import-outside-toplevel
    import numpy  # pylint: disable=import-outside-toplevel
    mesh = meshio.read(path)
    faces = [block.data for block in mesh.cells if block.type not in ("vertex", "line")]
    used = [block.ravel() for block in faces]
    points = mesh.points[numpy.unique(numpy.concatenate(used))] if used else mesh.points
    return {"triangles": sum(len(block) * (block.shape[1] - 2) for block in faces), "min": points.min(0).tolist(),
            "max": points.max(0).tolist(), "colors": len(points) if "red" in mesh.point_data else 0}


def facts_of_trimesh(path):
    import trimesh  # pylint: disable=import-outside-toplevel
    scene = trimesh.load(path, force="scene", process=False)
    meshes = [geometry for geometry in scene.geometry.values() if isinstance(geometry, trimesh.Trimesh)]
    return {"triangles": len(scene.triangles), "min": scene.bounds[0].tolist(), "max": scene.bounds[1].tolist(),
            "colors": sum(len(mesh.vertices) for mesh in meshes if mesh.visual.kind == "vertex")}


def main(facts_of):
    out, sys.stdout = sys.stdout, sys.stderr  # both packages print warnings
    for line in sys.stdin:
        try:
            facts = facts_of(line.rstrip("\n"))
        except (Exception, SystemExit) as error:  # pylint: disable=broad-except
            facts = {"error": "%s: %s" % (type(error).__name__, str(error)[:200])}
        print(json.dumps(facts), file=out, flush=True)


main({"meshio": facts_of_meshio, "trimesh": facts_of_trimesh, "lib3mf": mf3.facts}[sys.argv[1]])
