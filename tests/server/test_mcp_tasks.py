"""`facts` beside the reference figures of the 15 tasks that RobertCoop/openscad-mcp (MIT) measures agents by: box, volume or area,
closedness, solids and voids, in millimetres. The models are made here, from the tasks' dimensions."""
import json
import math
import os
import subprocess
import unittest

build = os.environ["ZRASTER_BUILD"]


# ---- polygons with holes, counter-clockwise from outside ----


def ring(radius, center=(0, 0), count=64):
    return [(center[0] + radius * math.cos(2 * math.pi * i / count), center[1] + radius * math.sin(2 * math.pi * i / count)) for i in range(count)]


def square(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def rounded(side, radius, count=12):
    """Returns a square around the origin with round corners."""
    corner = side / 2 - radius
    middles = [(corner, corner), (-corner, corner), (-corner, -corner), (corner, -corner)]
    return [(x + radius * math.cos(a), y + radius * math.sin(a)) for k, (x, y) in enumerate(middles) for a in (math.pi / 2 * (k + i / count) for i in range(count + 1))]


def cap(outline, z, up, holes=()):
    """Returns a level face that looks up or down."""
    turn = lambda points: [[x, y, z] for x, y in (points if up else points[::-1])]
    return {"vertices": turn(outline), **({"holes": [turn(hole) for hole in holes]} if holes else {})}


def wall(low, z0, high, z1, inwards=False):
    """Returns the faces between two rings of as many points."""
    faces = []
    for i in range(len(low)):
        k = (i + 1) % len(low)
        face = [[*low[i], z0], [*low[k], z0], [*high[k], z1], [*high[i], z1]]
        faces.append({"vertices": face[::-1] if inwards else face})
    return faces


def prism(outline, z0, z1, holes=(), top=None):
    """Returns a solid between two heights; `top` is its upper outline, if it is another one."""
    faces = [cap(outline, z0, False, holes), cap(top or outline, z1, True, holes), *wall(outline, z0, top or outline, z1)]
    return faces + [face for hole in holes for face in wall(hole, z0, hole, z1, True)]


def tub(outer, inner, height, floor):
    """Returns a container that is open at its top."""
    return [
        cap(outer, 0, False), *wall(outer, 0, outer, height), cap(outer, height, True, [inner]), *wall(inner, floor, inner, height, True),
        cap(inner, floor, True),
    ]


def moved(faces, place):
    """Returns faces whose points went through a function that keeps their sides."""
    return [{key: [place(p) for p in rings] if key == "vertices" else [[place(p) for p in hole] for hole in rings] for key, rings in face.items()} for face in faces]


def turned(profile, count=96):
    """Returns a profile of (radius, z), counter-clockwise, turned about the z axis."""
    faces = []
    for i in range(count):
        a, b = 2 * math.pi * i / count, 2 * math.pi * (i + 1) / count
        for k, (r0, z0) in enumerate(profile):
            r1, z1 = profile[(k + 1) % len(profile)]
            points = [[r0 * math.cos(a), r0 * math.sin(a), z0], [r0 * math.cos(b), r0 * math.sin(b), z0], [r1 * math.cos(b), r1 * math.sin(b), z1], [r1 * math.cos(a), r1 * math.sin(a), z1]]
            points = [p for j, p in enumerate(points) if p not in points[:j]]
            if len(points) > 2:
                faces.append({"vertices": points})
    return faces


def torus(radius, thickness):
    return turned([(radius + x, z) for x, z in ring(thickness, count=32)], 64)


def along_x(faces):
    """Returns faces whose z axis became x."""
    return moved(faces, lambda p: [p[2], p[0], p[1]])


# ---- the tasks ----


def bracket():
    circles = [ring(2.75, (15, 25)), ring(2.75, (45, 25))]
    flat = [face for hole in circles for face in wall(hole, 0, hole, 5, True)]
    upright = moved(flat, lambda p: [p[0], 5 - p[2], p[1]])
    front = moved([cap(square(0, 0, 60, 40), 5, True, circles), cap(square(0, 5, 60, 40), 0, False, circles)], lambda p: [p[0], 5 - p[2], p[1]])
    profile = [(0, 0), (40, 0), (40, 5), (5, 5), (5, 40), (0, 40)]  # y, z
    ends = along_x([cap(profile, 0, False), cap(profile, 60, True)])
    edges = along_x(wall([(40, 0), (40, 5)], 0, [(40, 0), (40, 5)], 60)[:1] + wall([(5, 40), (0, 40)], 0, [(5, 40), (0, 40)], 60)[:1])
    floor = [cap(square(0, 0, 60, 40), 0, False, circles), cap(square(0, 5, 60, 40), 5, True, circles)]
    return flat + upright + front + ends + edges + floor


def countersunk():
    holes = [(x, y) for x in (12, 48) for y in (10, 30)]
    plate = square(0, 0, 60, 40)
    faces = [cap(plate, 0, False, [ring(2.15, c) for c in holes]), cap(plate, 6, True, [ring(4.3, c) for c in holes]), *wall(plate, 0, plate, 6)]
    for c in holes:
        faces += wall(ring(2.15, c), 0, ring(2.15, c), 3.85, True) + wall(ring(2.15, c), 3.85, ring(4.3, c), 6, True)
    return faces


def gear():
    teeth = [(r, 30 * i + d - 15) for i in range(12) for d, r in ((8, 15), (12, 18), (18, 18), (22, 15))]
    outline = [(r * math.cos(math.radians(a)), r * math.sin(math.radians(a))) for r, a in teeth]
    return prism(outline, 0, 6, [ring(3)])


def handle():
    """A bar with round ends on two posts: fans around each post, from its rim to the bar's outline, above and below."""
    angles = sorted([2 * math.pi * i / 64 - math.pi for i in range(64)] + [math.atan2(7, 30), -math.atan2(7, 30)])
    rows = [math.sin(math.pi / 2 * k / 8) for k in range(9)]

    def ray(angle):
        x, y = math.cos(angle), math.sin(angle)
        end = 7 if x <= 0 else min(30 / x, 7 / abs(y) if y else 60)
        return [((5 + (end - 5) * t) * x, (5 + (end - 5) * t) * y) for t in rows]

    def at(point, side):
        rest = 49 - point[1] ** 2 - min(point[0], 0) ** 2
        return [*point, 18 + side * math.sqrt(rest if rest > 1e-6 else 0)]

    faces = [cap([ray(angle)[0] for angle in angles], 0, False)]
    for angle, following in zip(angles, angles[1:] + angles[:1]):
        a, b = ray(angle), ray(following)
        faces += [{"vertices": [at((0, 0), 1), at(a[0], 1), at(b[0], 1)]}, {"vertices": [[*a[0], 0], [*b[0], 0], at(b[0], -1), at(a[0], -1)]}]
        for k in range(8):
            for side in (1, -1):
                for corners in ((a[k], a[k + 1], b[k + 1]), (a[k], b[k + 1], b[k])):
                    faces.append({"vertices": [at(corner, side) for corner in corners[::side]]})
    return faces + moved(faces, lambda p: [60 - p[0], -p[1], p[2]])


def leaf(sections):
    """Returns a plate along x with knuckles; `sections`: begin, end, and whether there is a knuckle."""
    start = math.atan2(1.5, -math.sqrt(16 - 1.5**2))
    knuckle = [(4 * math.cos(a), 4 * math.sin(a)) for a in (start * (i / 24 - 1) for i in range(49))] + [(-6, 1.5), (-6, -1.5)]
    plate, bore, faces = [(-6, 1.5), (-26, 1.5), (-26, -1.5), (-6, -1.5)], ring(2.1), []
    whole = knuckle[:-2] + plate
    for i, (x0, x1, is_knuckle) in enumerate(sections):
        outline, holes = (whole, [bore]) if is_knuckle else (plate, [])
        faces += wall(outline, x0, outline, x1) + [face for hole in holes for face in wall(hole, x0, hole, x1, True)]
        for x, up, is_end in ((x0, False, i == 0), (x1, True, i + 1 == len(sections))):
            if is_end or is_knuckle:
                faces.append(cap(outline if is_end else knuckle, x, up, holes))
    return along_x(faces)


def hinge():
    a = leaf([(0, 12, True), (12, 24, False), (24, 36, True)])
    b = leaf([(0, 12.3, False), (12.3, 23.7, True), (23.7, 36, False)])
    return a + moved(b, lambda p: [p[0], -p[1], -p[2]])


def enclosure():
    void = prism(square(-22.5, -17.5, 22.5, 17.5), -12.5, 12.5)
    return prism(square(-25, -20, 25, 20), -15, 15) + [{"vertices": face["vertices"][::-1]} for face in void]


def boss():
    plate, out, bore = square(-15, -15, 15, 15), ring(4), ring(2)
    return [
        cap(plate, 0, False), *wall(plate, 0, plate, 3), cap(plate, 3, True, [out]), *wall(out, 3, out, 13), cap(out, 13, True, [bore]),
        *wall(bore, 5, bore, 13, True), cap(bore, 5, True),
    ]


def lid():
    lip, plate = square(72.2, 2.2, 127.8, 37.8), square(70, 0, 130, 40)
    return [cap(plate, 0, False), *wall(plate, 0, plate, 3), cap(plate, 3, True, [lip]), *wall(lip, 3, lip, 7), cap(lip, 7, True)]


# Sides of the box and their tolerance; volume and its tolerance in percent; whether the surface is closed; its solids and voids.
TASKS = {
    "box_with_lid": (tub(square(0, 0, 60, 40), square(2, 2, 58, 38), 25, 2) + lid(), (130, 40, 25), 0.2, 28749.4, 3, True, (2, 0)),
    "bracket_l": (bracket(), (60, 40, 40), 0.2, 22025.6, 2, True, (1, 0)),
    "chain_link_pair": (torus(10, 2.5) + moved(torus(10, 2.5), lambda p: [p[0] + 10, -p[2], p[1]]), (35, 25, 25), 0.3, 2447.6, 5, True, (2, 0)),
    "countersunk_plate": (countersunk(), (60, 40, 6), 0.2, 13885.8, 3, True, (1, 0)),
    "gear_polygon": (gear(), (35.95, 35.95, 6), 0.3, 4660.5, 10, True, (1, 0)),
    "gridfinity_bin": (tub(rounded(41.5, 4), rounded(39.1, 2.8), 40, 2), (41.5, 41.5, 40), 0.2, 10498.5, 5, True, (1, 0)),
    "handle_hull": (handle(), (74, 14, 25), 0.2, 12478.6, 8, True, (1, 0)),
    "hinge_two_leaves": (hinge(), (36, 52, 8), 0.2, None, 0, True, (2, 0)),
    "hollow_enclosure": (enclosure(), (50, 40, 30), 0.2, 20625, 1, True, (1, 1)),
    "insert_boss": (boss(), (30, 30, 13), 0.2, 3101.5, 2, True, (1, 0)),
    "laser_plate_2d": (
        [cap(square(0, 0, 120, 80), 0, True, [ring(2.5, (x, y)) for x in (10, 110) for y in (10, 70)] + [square(40, 30, 80, 50)])],
        (120, 80, 0), 0.2, 8721.6, 2, False, (0, 0),
    ),
    "nameplate_chamfer": (
        [cap(square(0, 0, 80, 30), 0, False)] + wall(square(0, 0, 80, 30), 0, square(0, 0, 80, 30), 2.5)
        + wall(square(0, 0, 80, 30), 2.5, square(1.5, 1.5, 78.5, 28.5), 4) + [cap(square(1.5, 1.5, 78.5, 28.5), 4, True)],
        (80, 30, 4), 0.2, 9357, 3, True, (1, 0),
    ),
    "peg_and_hole": (prism(square(-15, -15, 15, 15), 0, 10, [ring(4.2)]) + prism(ring(4), 0, 20), (30, 30, 20), 0.2, 9450.4, 2, True, (2, 0)),
    "plate_simple": (prism(square(0, 0, 60, 40), 0, 5), (60, 40, 5), 0.2, 12000, 1, True, (1, 0)),
    "vase_rotate_extrude": (turned([(0, 0), (22, 0), (18, 50), (16, 50), (19.76, 3), (0, 3)]), (44, 44, 50), 0.2, 16087.4, 10, True, (1, 0)),
}


class Tasks(unittest.TestCase):
    def test_tasks(self):
        """facts agrees with the figures of 15 tasks"""
        command = [os.path.join(build, "zraster"), "mcp", "--root", "."]
        lines = [
            json.dumps({"jsonrpc": "2.0", "id": name, "method": "tools/call", "params": {"name": "facts", "arguments": {"scene": {"polygons": task[0]}}}})
            for name, task in TASKS.items()
        ]
        ran = subprocess.run(command, input="\n".join(lines) + "\n", capture_output=True, text=True, check=True)
        answers = {answer["id"]: answer["result"] for answer in map(json.loads, ran.stdout.splitlines())}
        self.assertEqual(len(answers), 15)
        for name, (_, sides, tolerance, measure, percent, is_closed, shells) in TASKS.items():
            with self.subTest(name):
                self.assertFalse(answers[name]["isError"], answers[name]["content"])
                facts = answers[name]["structuredContent"]
                self.assertEqual(facts["closed"], is_closed)
                self.assertEqual(facts["shells"], {"outward": shells[0], "inward": shells[1], "open": 0 if is_closed else 1})
                for side, wanted in zip(facts["box"]["size"], sides):
                    self.assertAlmostEqual(side, wanted, delta=tolerance)
                if measure:
                    self.assertAlmostEqual(facts["volume"] if is_closed else facts["area"], measure, delta=measure * percent / 100)


if __name__ == "__main__":
    unittest.main()
