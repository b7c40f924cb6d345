"""datasets.py BUILD FOLDER MODEL: the rate of zraster.bop beside that of the library alone, which draws the same outputs and
drops them. Rounds alternate; VIEWS=1000 of each in all. Files go to FOLDER, which is removed before and after. Each round has
a folder of its own there: ext4 creates files slowly for minutes after many were deleted."""
import ctypes
import itertools
import os
import shutil
import sys
import time
from ctypes import byref, c_void_p

here = os.path.dirname(os.path.abspath(__file__))
build, folder, model = sys.argv[1:4]
os.environ["ZRASTER_LIBRARY"] = os.path.abspath(os.path.join(build, "libzraster.so.0"))
sys.path.insert(0, os.path.join(here, "../../../clients/python"))

from zraster import _library as c  # noqa: E402
from zraster import bop  # noqa: E402
from zraster._renderer import shared  # noqa: E402
from zraster._request import Call, make  # noqa: E402

ROUNDS = 10
VIEWS = int(os.environ.get("VIEWS", 1000)) // ROUNDS
OPTIONS = {"orbit": {"count": VIEWS}, "size": (640, 480)}
OUTPUTS = [
    {"channel": "color", "encoding": "png"},
    {"channel": "depth", "encoding": "png16", "scale": 1e-4},
    {"channel": "masks", "encoding": "zip"},
    {"channel": "masks", "encoding": "json"},
]


rounds = itertools.count()


def now():
    return time.perf_counter(), time.process_time()


def alone(scene, parts, look):
    """Draws the views for a function of C, which needs no interpreter lock."""
    request = make(scene, OUTPUTS, OPTIONS["size"], parts, {"orbit": OPTIONS["orbit"], "look": look})
    call = Call(request.body, request.type, request.query, request.parts, None)
    drop = ctypes.cast(ctypes.CDLL(None).labs, c.TakeView)  # labs(NULL) is 0, which goes on
    error = c_void_p()
    begin = now()
    status = c.library.draw_views(shared()._handle.pointer, byref(call.struct), drop, None, byref(error))
    assert status == c.OK, c.library.error_text(error)
    return [after - before for before, after in zip(begin, now())]


def written(scene, parts, look):
    place = os.path.join(folder, str(next(rounds)))
    begin = now()
    bop.write(place, scene, parts=parts, look=look, **OPTIONS)
    return [after - before for before, after in zip(begin, now())]


def main():
    shutil.rmtree(folder, ignore_errors=True)
    with open(model, "rb") as file:
        parts = {"model.obj": file.read()}
    spread = [(x, z) for x in (-1, 0, 1) for z in (-1, 1)]
    nodes = [{"name": f"n{i}", "mesh": 0, "translation": [0.15 * x, 0, 0.15 * z]} for i, (x, z) in enumerate(spread)]
    view = {"perspective": {"yfovDegrees": 40}}
    scene = {"meshes": [{"name": "model", "asset": "model.obj"}], "nodes": nodes, "view": view}
    for look in ("textbook", "studio"):
        times = [(*alone(scene, parts, look), *written(scene, parts, look)) for _ in range(ROUNDS)]
        first, first_cpu, second, second_cpu = (sum(column) for column in zip(*times))
        rates = [ROUNDS * VIEWS / seconds for seconds in (first, second)]
        print(f"{look}: {ROUNDS * VIEWS} views: alone {rates[0]:.1f}/s, in BOP form {rates[1]:.1f}/s: {first / second:.3f}; "
              f"processor time {first_cpu / second_cpu:.3f}", flush=True)
    shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
