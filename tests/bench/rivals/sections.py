"""sections.py BUILD MESH.obj...: a hatched section beside the whole picture, and the time that cutting takes beside that of
vtkClipClosedSurface, whose reader is kept. In turns, over HTTP, 512x512. Prints a row each: median milliseconds, and the
ratio. Ours is the facts of a cut mesh less those of the whole one. `make bench-rivals` runs it."""
import os
import sys

from compare import ROUNDS, row, start_daemon, timed

FACTS = "/v1/render?channel=info&render=false"
PICTURE = "/v1/render?width=512&height=512"


def ask(connection, target, body):
    connection.request("POST", target, body, {"Content-Type": "model/obj"})
    answer = connection.getresponse()
    text = answer.read()
    assert answer.status == 200, text


def make_clip(path):
    """Returns a function that clips a model by another plane each time."""
    import vtk
    reader, faces, clip = vtk.vtkOBJReader(), vtk.vtkPolyData(), vtk.vtkClipClosedSurface()
    reader.SetFileName(path)
    reader.Update()
    faces.SetPoints(reader.GetOutput().GetPoints())
    faces.SetPolys(reader.GetOutput().GetPolys())
    plane, planes, low_high = vtk.vtkPlane(), vtk.vtkPlaneCollection(), faces.GetBounds()
    plane.SetOrigin([0.5 * (low_high[2 * k] + low_high[2 * k + 1]) for k in range(3)])
    planes.AddItem(plane)
    clip.SetInputData(faces)
    clip.SetClippingPlanes(planes)
    turns = 0

    def work():
        nonlocal turns
        turns += 1
        plane.SetNormal(1e-4 * turns, 0, 1)
        clip.Modified()
        clip.Update()
        assert clip.GetOutput().GetNumberOfPolys() > 0

    return work


def main():
    daemon, connection = start_daemon()
    try:
        for path in sys.argv[2:]:
            body, name = open(path, "rb").read(), os.path.basename(path)
            for target in (FACTS, FACTS + "&section=z:0.5:positive", PICTURE, PICTURE + "&section=z:0.5"):
                ask(connection, target, body)
            whole, cut = zip(*[(timed(lambda: ask(connection, PICTURE, body)),
                                timed(lambda: ask(connection, PICTURE + "&section=z:0.5", body))) for _ in range(ROUNDS)])
            row(f"{name}: section, whole", cut, whole, 0.5, "studio, a hatched section (ours) beside none (theirs)")
            try:
                clip = make_clip(path)
            except ImportError:
                print("LEFT OUT: VTK for Python is not installed", file=sys.stderr)
                continue
            clip()
            ours, theirs = [], []
            for _ in range(ROUNDS):
                without = timed(lambda: ask(connection, FACTS, body))
                ours.append(timed(lambda: ask(connection, FACTS + "&section=z:0.5:positive", body)) - without)
                theirs.append(timed(clip))
            if sorted(ours)[ROUNDS // 2] <= 0:
                print(f"LEFT OUT: {name}: the machine is too busy to time the cut", file=sys.stderr)
                continue
            row(f"{name}: cut, vtkClipClosedSurface", ours, theirs, 10, "reader kept, no rendering")
    finally:
        daemon.terminate()
        daemon.wait()


main()
