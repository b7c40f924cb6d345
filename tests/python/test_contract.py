"""The contract for programs: every row of the tables is in the schema, in OpenAPI, in help and in v1.md; scenes are valid."""
import glob
import json
import os
import subprocess
import unittest
import urllib.error
import urllib.request

import support

try:
    import jsonschema
except ImportError:
    jsonschema = None

# Rows as BUILD/zraster-tables prints them, which asks the readers themselves for the keys that they know.
TABLES = subprocess.run([os.path.join(support.build, "zraster-tables")], capture_output=True, text=True, check=True).stdout
CONTRACT = support.read(os.path.join(support.root, "server/api/v1.md")).decode()


def rows(kind):
    return sorted({line.split(" ", 1)[1] for line in TABLES.splitlines() if line.startswith(kind + " ")})


def help_of(*words):
    return subprocess.run([os.path.join(support.build, "zraster"), "help", *words], capture_output=True, text=True)


def all_keys(schema):
    """Returns the names of all properties of the objects of a schema."""
    return {key for one in schema.values() for key in one.get("properties", {})}


class Contract(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = support.Daemon().__enter__()
        cls.schema = cls.get("/v1/scene.schema.json")[0]
        cls.openapi = cls.get("/v1/openapi.json")[0]

    @classmethod
    def tearDownClass(cls):
        cls.daemon.__exit__()

    @classmethod
    def get(cls, path, **headers):
        request = urllib.request.Request(cls.daemon.address + path, headers={k.replace("_", "-"): v for k, v in headers.items()})
        with urllib.request.urlopen(request) as answer:
            return json.load(answer), answer.headers

    def refused(self, path, **headers):
        with self.assertRaises(urllib.error.HTTPError) as caught:
            self.get(path, **headers)
        with caught.exception as error:
            return error.code, error.read()

    def test_every_key_that_a_reader_knows_shows_everywhere(self):
        for key in rows("key"):
            with self.subTest(key):
                self.assertIn(key, all_keys(self.schema["$defs"]))
                self.assertIn(key, all_keys(self.openapi["components"]["schemas"]))
                self.assertRegex(CONTRACT, rf"`[^`]*\b{key}\b[^`]*`")

    def test_no_key_is_in_the_schema_that_no_reader_knows(self):
        # Objects that stand for lists are not asked for by zraster-tables, so those of arrays and animations are named.
        known = set(rows("key")) | {"uri", "asset"}
        strange = all_keys(self.schema["$defs"]) - known
        self.assertLessEqual(strange, {"rotate", "times", "translation", "rotation", "scale", "interpolation", "axis", "degrees", "model", "k", "p", "to", "poses"})

    def test_help_explains_every_key_of_every_object(self):
        shown = help_of("scene").stdout
        for key, value in self.schema["$defs"]["scene"]["properties"].items():
            self.assertIn(f"  {key} ", shown)
            self.assertIn(value["description"], shown)
        for name in ["view.znear", "spotLight.outerConeAngle", "mesh.positions", "window.width"]:
            told = help_of(name)
            self.assertEqual(told.returncode, 0)
            self.assertIn("Value: ", told.stdout)
        self.assertIn("znear: key of view (/view/znear)", help_of("znear").stdout)
        self.assertIn("Default: just in front of the geometry", help_of("znear").stdout)
        self.assertIn("number from 0 to 0.45. Default: 0.05.", help_of("padding").stdout)
        self.assertIn("did you mean znear?", help_of("zneer").stderr)
        self.assertEqual(help_of("zneer").returncode, 2)

    def test_help_explains_the_words_of_keys(self):
        key = self.schema["$defs"]["scene"]["properties"]
        output = self.schema["$defs"]["output"]["properties"]
        words = {"channel": rows("channel"), "look": rows("look"), "shading": key["shading"]["enum"], "encoding": output["encoding"]["enum"],
                 "space": output["space"]["enum"], "format": ["json", "obj", "3mf", "zip", "stl", "ply", "glb", "gltf"]}
        for kind, names in words.items():
            listed = help_of(kind + "s").stdout if kind != "look" else ""
            for name in names:
                with self.subTest(name):
                    told = help_of(name).stdout
                    if name not in ["info", "render"]:  # commands of these names come first
                        self.assertRegex(told, rf"(?m)^{name}: {kind}\n    [A-Z0-9].{{4,}}\.$")
                    if listed:
                        self.assertRegex(listed, rf"(?m)^  {name} +[^ ].{{4,}}$")
        self.assertIn("nocs: value of space (/outputs/N/space)\n", help_of("nocs").stdout)
        self.assertIn("halfspace: value of algorithm (/algorithm)\n", help_of("halfspace").stdout)
        self.assertIn("studio: look\n", help_of("studio@1").stdout)
        self.assertEqual(help_of("studio@99").returncode, 2)
        self.assertIn("did you mean masks?", help_of("maskz").stderr)

    def test_every_parameter_channel_and_type_shows_in_openapi_and_in_the_contract(self):
        post = self.openapi["paths"]["/v1/render"]["post"]
        parameters = {one["name"]: one for one in post["parameters"]}
        self.assertEqual(sorted(parameters), rows("parameter"))
        self.assertEqual(sorted(parameters["channel"]["schema"]["items"]["enum"]), rows("channel"))
        for types in rows("types"):
            for one in types.split():
                self.assertIn(one, post["requestBody"]["content"])
                self.assertIn(one, CONTRACT)
        shown = help_of("render").stdout
        for name, one in parameters.items():
            if name != "look":
                self.assertIn(one["description"].removesuffix(" For models, not for scenes.")[1:-1], shown)

    def test_every_route_is_in_openapi(self):
        known = json.loads(self.refused("/nowhere")[1])["detail"].split("there are ")[1].split(", ")
        paths = set(self.openapi["paths"])
        known.remove("/docs")  # leads to /docs/, whose pages have one path in OpenAPI
        for path in [path for path in known if path.endswith("/") and path != "/"]:
            known.remove(path)
            self.assertTrue([one for one in paths if one.startswith(path + "{")], path)
        self.assertLessEqual(set(known), paths)
        self.assertEqual(paths - set(known), {"/docs/{address}", "/engine/{name}", "/v1/assets/{sha256}", "/v1/scenes/{sha256}", "/v1/renders/{sha256}",
                                             "/v1/renders/{sha256}/{preset}", "/v1/schema/{object}.json", "/v1/examples/{name}"})
        for methods in self.openapi["paths"].values():
            for method, operation in methods.items():
                if method != "parameters":
                    self.assertRegex(operation["summary"], r"^[A-Z].{5}")

    def test_an_object_alone_is_part_of_the_whole(self):
        for name in ["light", "view", "spotLight", "output"]:
            alone = self.get(f"/v1/schema/{name}.json")[0]
            for key, value in alone["$defs"].items():
                self.assertEqual(value, self.schema["$defs"][key])
        status, problem = self.refused("/v1/schema/lamp.json")
        self.assertEqual(status, 404)
        self.assertIn(b"light", problem)
        self.assertEqual(self.refused("/v1/schema/light")[0], 404)

    def test_a_client_that_has_the_schema_gets_304(self):
        headers = self.get("/v1/scene.schema.json")[1]
        self.assertEqual(headers["Content-Type"], "application/schema+json")
        self.assertEqual(self.refused("/v1/scene.schema.json", If_None_Match=headers["ETag"]), (304, b""))
        self.get("/v1/scene.schema.json", If_None_Match='"another"')

    def test_python_has_the_schema_of_the_daemon(self):
        import zraster

        self.assertEqual(zraster.Renderer().schema, self.schema)

    @unittest.skipUnless(jsonschema, "there is no jsonschema (python3-jsonschema)")
    def test_the_scenes_and_examples_are_valid(self):
        jsonschema.Draft202012Validator.check_schema(self.schema)
        validator = jsonschema.Draft202012Validator(self.schema)
        files = glob.glob(os.path.join(support.scenes, "*.json")) + glob.glob(os.path.join(support.root, "clients/examples/*.json"))
        self.assertGreater(len(files), 150)
        scenes = [(file, json.loads(support.read(file))) for file in files if os.path.getsize(file) < 30000]
        for name in ["scene", "view", "mesh", "output"]:
            one = jsonschema.Draft202012Validator({"$ref": f"#/$defs/{name}", "$defs": self.schema["$defs"]})
            for example in self.schema["$defs"][name]["examples"]:
                self.assertEqual([error.message for error in one.iter_errors(example)], [])
        for file, scene in scenes:
            with self.subTest(file):
                self.assertEqual([error.message[:200] for error in validator.iter_errors(scene)], [])

    @unittest.skipUnless(jsonschema, "there is no jsonschema (python3-jsonschema)")
    def test_wrong_scenes_are_not(self):
        polygon = {"polygons": [{"vertices": [[0, 0, 0], [2, 0, 0], [1, 2, 0]]}]}
        spot = {"type": "spot", "position": [0, 1, 0], "direction": [0, -1, 0]}
        wrong = [
            {},
            {"meshes": []},
            {**polygon, "colour": "red"},
            {**polygon, "background": "#12"},
            {**polygon, "window": {"width": 0}},
            {**polygon, "samples": 2},
            {**polygon, "view": {"preset": "front", "eye": [0, 0, 5]}},
            {**polygon, "view": {"target": [0, 0, 0]}},
            {**polygon, "view": {"direction": [0, 0, 0]}},
            {**polygon, "view": {"orthographic": {"xmag": 1}}},
            {**polygon, "lights": [{**spot, "sky": "white"}]},
            {**polygon, "lights": [{"type": "point"}]},
            {**polygon, "lights": [{**spot, "shadows": True, "outerConeAngleDegrees": 85}]},
            {**polygon, "lights": [{**spot, "innerConeAngle": 0.1, "innerConeAngleDegrees": 5}]},
            {**polygon, "outputs": []},
            {**polygon, "outputs": [{"channel": "depth", "encoding": "svg"}]},
            {**polygon, "outputs": [{"channel": "thickness", "encoding": "png16"}]},
            {**polygon, "outputs": [{"channel": "fragments", "x": 1}]},
            {**polygon, "turntable": {}, "orbit": {"count": 3}},
            {"meshes": [{"positions": [[0, 0, 0]]}]},
            {"meshes": [{"uri": "data:;base64,", "asset": "a"}]},
            {"meshes": [{"positions": [[0, 0, 0]], "points": [0], "heights": [[0, 0], [0, 0]]}]},
        ]
        validator = jsonschema.Draft202012Validator(self.schema)
        self.assertTrue(validator.is_valid({**polygon, "lights": [spot]}))
        for scene in wrong:
            with self.subTest(json.dumps(scene)):
                self.assertFalse(validator.is_valid(scene))
                with self.assertRaises(urllib.error.HTTPError) as caught:
                    self.daemon.post(json.dumps(scene).encode())
                with caught.exception as error:
                    self.assertEqual(error.code, 422)
