"""`facts` beside the reference figures of the 15 tasks that RobertCoop/openscad-mcp (MIT) measures agents by: box, volume or area,
closedness, solids and voids, in millimetres. The models are made here, from the tasks' dimensions. And 30 questions of a reviewer, each
answered by the text of one call."""
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


def obj(**parts):
    """Returns a model with these parts as OBJ."""
    text, count = "", 0
    for name, faces in parts.items():
        text += f"o {name}\n"
        for face in faces:
            text += "".join("v {:.9g} {:.9g} {:.9g}\n".format(*p) for p in face["vertices"])
            text += "f " + " ".join(str(count + 1 + i) for i in range(len(face["vertices"]))) + "\n"
            count += len(face["vertices"])
    return {"text": text}


def drilled(x=0, radius=4, height=6, profile=()):
    """Returns a block of 40 x 40 with a hole, as quadrilaterals. `profile`: radius and height of its steps, from below."""
    directions = ring(1)
    outline = [(20 * c / max(abs(c), abs(s)), 20 * s / max(abs(c), abs(s))) for c, s in directions]
    rings = [(outline, 0), (ring(radius, (x, 0)), 0), *((ring(r, (x, 0)), z) for r, z in profile or [(radius, height)]), (outline, height)]
    return wall(outline, 0, outline, height) + [face for low, high in zip(rings, rings[1:]) for face in wall(*low, *high, True)]


def of(name, **scene):
    """Returns the arguments of facts for a task's model."""
    return {"scene": {"polygons": TASKS[name][0], **scene}}


def shifted(faces, x=0, y=0, z=0):
    return moved(faces, lambda p: [p[0] + x, p[1] + y, p[2] + z])


def pair(z, scene=None):
    """Returns the arguments of facts for a cube of 10 and a second one above its bottom by z."""
    cube = prism(square(0, 0, 10, 10), 0, 10)
    return {"model": obj(low=cube, high=shifted(cube, z=z)), "scene": scene or {}}


def two(a, b, **more):
    """Returns the arguments of compare."""
    return {"a": obj(part=a), "b": obj(part=b), "show": "none", **more}


def top(**more):
    """Returns the arguments of pick for a drilled block, seen from above."""
    return {"model": obj(part=drilled()), "up": "z", "views": ["top"], "width": 200, "height": 200, "x": 150, "y": 100, **more}


# Corners of a part that differs from its mirror image.
WEDGE = [(0, 0, 0), (40, 0, 0), (0, 30, 0), (0, 0, 20)]
LEFT = [{"vertices": [list(WEDGE[i]) for i in face]} for face in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))]
RIGHT = [{"vertices": [[-x, y, z] for x, y, z in face["vertices"]][::-1]} for face in LEFT]

# What a reviewer asks, the call, and what its text has. Numbers are those of the dimensions.
QUESTIONS = (
    ("How large is the bracket, and does it fit into 70 x 50 x 50?", "facts", of("bracket_l"), ["box 60 x 40 x 40 "]),
    ("What are its volume and its area?", "facts", of("bracket_l"), ["volume 22025.6 units^3", "; area 10505.7 units^2"]),
    ("Where is its centre of mass?", "facts", of("bracket_l"), [", centre of mass (30, 11.7921, 11.7921)"]),
    ("How many holes has it, of which size, and where?", "facts", of("bracket_l"), [
        "2 x diameter 5.5, through, 5 deep, along (0, 0, -1), at (15, 25, 5), (45, 25, 5); 2 x diameter 5.5, through, 5 deep, along (0, -1, 0), at (15, 5, 25), (45, 5, 25)"]),
    ("Does the hole of the boss go through, and how deep is it?", "facts", of("insert_boss"), ["1 x diameter 4, blind, 8 deep, along (0, 0, -1), at (0, 0, 13)"]),
    ("Are the holes for screws countersunk?", "facts", of("countersunk_plate"), ["4 x diameter 4.3, through, 3.85 deep, countersink of diameter 8.6, 2.15 deep, 90 degrees"]),
    ("How are they arranged?", "facts", of("countersunk_plate"), [", in a grid of 2 x 2, pitch 20 x 36 around (30, 20, 6)"]),
    ("Does a pin of 3.2 go through a hole of 8 facets?", "facts", {"scene": {"polygons": prism(square(-9, -9, 9, 9), 0, 5, [ring(1.6, count=8)])}}, ["diameter 3.2 (2.9564 across its 8 flats)"]),
    ("How many holes go through, of any shape?", "facts", {"scene": {"polygons": prism(square(-9, -9, 9, 9), 0, 5, [ring(2), square(4, 4, 6, 6)])}}, [
        "\n  holes: 1 x diameter 4, through", "\n  tunnels, round or not: 2\n"]),
    ("Has the enclosure a void, or holes?", "facts", of("hollow_enclosure"), ["1 closed shell, 1 inward shell (a void", "\n  holes: no round one was found"]),
    ("Where is its least wall?", "facts", of("hollow_enclosure"), ["\n  least wall between parallel faces: 2.5 at ("]),
    ("About which planes is the plate symmetric?", "facts", of("countersunk_plate"), ["\n  symmetry: mirror x = 30, y = 20;"]),
    ("Which turns bring the gear onto itself?", "facts", of("gear_polygon"), [", 12-fold about (0, 0, 1) at (0, 0, 3)"]),
    ("Through which pipe does the gear go?", "facts", of("gear_polygon"), ["\n  bounding cylinder: diameter 36, 6 high, along (0, 0, 1)"]),
    ("Which radius has the smallest inner corner?", "facts", of("gridfinity_bin"), ["\n  fillets: 4 x radius 2.8\n  rounds: 4 x radius 4\n"]),
    ("Which faces are flat, where and how large?", "facts", of("plate_simple"), [
        "\n  flat faces by area: 2400 at z = 0; 2400 at z = 5; 300 at y = 0; 300 at y = 40; 200 at x = 60; 200 at x = 0\n"]),
    ("Is the part closed, and if not, where?", "facts", {"scene": {"polygons": TASKS["plate_simple"][0][1:]}}, ["; not closed, so there is no volume: 4 open edges, one at ("]),
    ("Do all faces look outwards?", "facts", {"scene": {"polygons": [{"vertices": TASKS["plate_simple"][0][0]["vertices"][::-1]}] + TASKS["plate_simple"][0][1:]}},
     ["; not closed, so there is no volume: 4 flipped edges, one at ("]),
    ("How many parts are there, and how large is each?", "facts", pair(12.5), ["; 2 parts, whose areas and volumes are summed", "'high': box 10 x 10 x 10 units", ", area 600 units^2, closed, volume 1000 units^3, centre of mass (5, 5, 17.5)"]),
    ("How far apart are two parts?", "facts", pair(12.5, {"distances": [["low", "high"]]}), ["\n- distance of 'low' and 'high': 2.5, from ("]),
    ("Do they overlap, and by how much?", "facts", pair(7.5, {"distances": [["low", "high"]], "csg": {"intersection": ["low", "high"]}}), [
        "\n- distance of 'low' and 'high': 0, they cross", "; solid combined by csg: volume 250 +- ", "; the box may be larger; "]),
    ("Which of two parts is larger?", "compare", two(drilled(), drilled(height=9)), ["\n- a: box 40 x 40 x 6, area ", ", volume 9298.89, 1 tunnel\n", "\n- b: box 40 x 40 x 9, area ", ", volume 13948.3, 1 tunnel\n"]),
    ("Which hole moved?", "compare", two(drilled(), drilled(x=5)), ["volume +0 %", "\n- hole moved: diameter 8, 6 deep, through, from (0, 0, 6) to (5, 0, 6)"]),
    ("Where is material missing, and how much?", "compare", two(drilled(), drilled(radius=5)), [
        "\n- hole changed: diameter 8 to 10, 6 deep, through", "\n- only in a: volume 169.", ", box 10 x 10 x 6 around (0, 0, 3)"]),
    ("Which part of an assembly moved?", "compare", {"a": pair(12.5)["model"], "b": pair(15)["model"], "show": "none"}, ["\n- part moved: 'high' by (0, 0, 2.5)", "\n- only in b, part 'high': volume 250"]),
    ("Is it the same part in other units?", "compare", two(drilled(), moved(drilled(), lambda p: [25.4 * c for c in p])), ["\nwarning: b is 25.4 times as large as a, as if one had other units: inches and millimetres"]),
    ("Is it the left-hand version?", "compare", two(LEFT, RIGHT, align="principal"), ["\nwarning: a mirror image of b fits a much better than b does"]),
    ("Is it the same part, elsewhere?", "compare", two(drilled(x=5), moved(drilled(x=5), lambda p: [100 - p[1], p[0], p[2]])), [
        "\nwarning: b has the area of a, but lies elsewhere: align=principal moves it if it fits"]),
    ("Which surface is at a pixel, and what is behind it?", "pick", top(), [
        "\n- part 'part', face ", ", front side, visible\n- part 'part', face ", ", back side, hidden\nvisible surface, plane, normal (0, 0, 1)"]),
    ("How far apart are two faces, and at which angle?", "pick", top(views=["isometric"], x=140, y=100, toX=140, toY=130), ["\nto the other pixel: distance 11.6575, offset (7.8075, -7.8075, -3.73957), along the first normal -3.73957, angle of the normals 90 degrees"]),
)


def call_all(calls):
    """Returns the results of calls of `zraster mcp`, each a tool and its arguments."""
    lines = [json.dumps({"jsonrpc": "2.0", "id": i, "method": "tools/call", "params": {"name": tool, "arguments": given}}) for i, (tool, given) in enumerate(calls)]
    ran = subprocess.run([os.path.join(build, "zraster"), "mcp", "--root", "."], input="\n".join(lines) + "\n", capture_output=True, text=True, check=True)
    answers = {answer["id"]: answer["result"] for answer in map(json.loads, ran.stdout.splitlines())}
    return [answers[i] for i in range(len(lines))]


class Tasks(unittest.TestCase):
    def test_questions(self):
        """the text of one call answers each of 30 questions of a reviewer"""
        self.assertEqual(len(QUESTIONS), 30)
        for (question, _, _, wanted), result in zip(QUESTIONS, call_all([row[1:3] for row in QUESTIONS])):
            for words in wanted:
                with self.subTest(question):
                    self.assertIn(words, result["content"][0]["text"])

    def test_changed_steps(self):
        """compare names the old and the new counterbore or countersink of a hole"""
        plain, bored, wide, sunk = (drilled(radius=2, profile=p) for p in ((), [(2, 4), (4, 4), (4, 6)], [(2, 4), (5, 4), (5, 6)], [(2, 4), (4, 6)]))
        step = ", through, step of diameter 8, 2 deep, "
        rows = ((bored, wide, step + "now step of diameter 10, 2 deep, at"), (bored, sunk, step + "now countersink of diameter 8, 2 deep, 90 degrees, at"),
                (bored, plain, step + "now no step, at"), (plain, bored, ", through, now step of diameter 8, 2 deep, at"))
        for (_, _, wanted), result in zip(rows, call_all([("compare", two(a, b)) for a, b, _ in rows])):
            self.assertRegex(result["content"][0]["text"], r"\n- hole changed: diameter 4, \d( to \d)? deep" + wanted)

    def test_words(self):
        """texts have what is there and no more: steps of one hole, tunnels of shells that touch, far places, motions, rows, parts inside out"""
        cube = prism(square(0, 0, 10, 10), 0, 10)
        stepped = drilled(radius=2, height=5, profile=[(2, 3), (3, 3), (3, 4), (4.5, 4), (4.5, 5)])
        touching = [face for i in range(3) for face in shifted(cube, 10 * i, 10 * i, 10 * i)]
        row = prism(square(0, 0, 60, 20), 0, 5, [ring(3, (x, 10)) for x in (10, 25, 40)])
        inverted = [{"vertices": face["vertices"][::-1]} for face in wall(square(0, 0, 10, 10), 0, square(0, 0, 10, 10), 10)] + [
            {"vertices": [[x, y, z] for x, y in square(0, 0, 10, 10)[::1 if z == 0 else -1]]} for z in (0, 10)]
        rows = (
            ("facts", {"model": obj(part=stepped), "scene": {}}, r"\n  holes: 1 x diameter 4, through, 3 deep, step of diameter 9, 1 deep, step of diameter 6, 1 deep, along [^;]*\n"),
            ("facts", {"model": obj(part=touching), "scene": {}}, r"\n  tunnels, round or not: 0\n"),
            ("facts", {"scene": {"polygons": row}}, r", in a row of 3, pitch 15 around"),
            ("facts", {"model": obj(good=cube, bad=shifted(inverted, x=100)), "scene": {}}, r"^box 110 x 10 x 10 units \([^)]*\); area [^;]*; closed, volume [-0-9.e]+ units\^3;"),
            ("facts", {"model": obj(part=shifted(cube, x=1e6)), "scene": {}}, r"\(x 1000000\.\.1000010, y 0\.\.10, "),
            ("compare", two(shifted(drilled(), x=1e6), shifted(drilled(x=5), x=1e6)), r"from \(1000000[.0-9]*, 0, 6\) to \(1000005[.0-9]*, 0, 6\)"),
            ("compare", two(cube, shifted(cube, x=100)), r"\nwarning: b has the area of a, but lies elsewhere: align=principal "),
            ("compare", two(LEFT, shifted(LEFT, x=100), align="principal"), r"\n- before that, b was moved to fit a: then shifted by \(-100, 0, 0\)$"),
        )
        for (_, _, wanted), result in zip(rows, call_all([row[:2] for row in rows])):
            with self.subTest(wanted):
                self.assertRegex(result["content"][0]["text"], wanted)

    def test_open_below(self):
        """facts says that it is not known whether a hole of an open part goes through"""
        result, = call_all([("facts", {"scene": {"polygons": TASKS["insert_boss"][0][1:]}})])
        self.assertIn("\n  holes: 1 x diameter 4, not known if through, 8 deep, ", result["content"][0]["text"])

    def test_tasks(self):
        """facts agrees with the figures of 15 tasks"""
        answers = dict(zip(TASKS, call_all([("facts", of(name)) for name in TASKS])))
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
