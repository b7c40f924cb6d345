"""Headers of all answers: methods that a path takes, and those that keep browsers and caches within bounds."""
import http.client
import json

import daemon

SHUT = "default-src 'none'; style-src 'unsafe-inline'; sandbox"


class Case(daemon.Case):
    flags = ["--token=secret"]

    def send(self, path, body=None, method=None, **headers):
        return self.daemon.send(path, body, method, Authorization="Bearer secret", **headers)

    def paths(self):
        """Path: methods, of the contract for machines."""
        paths = json.loads(self.send("/v1/openapi.json")[2])["paths"]
        return {path.split("{")[0]: {method.upper() for method in row} - {"PARAMETERS"} for path, row in paths.items()}


class Methods(Case):
    def test_options(self):
        """OPTIONS of each path names its methods, without a token"""
        paths = self.paths()
        self.assertGreater(len(paths), 12)
        for path, methods in paths.items():
            status, headers, data = self.daemon.send(path, None, "OPTIONS")
            self.assertEqual((status, data), (204, b""), path)
            self.assertEqual(set(headers["Allow"].split(", ")) - {"OPTIONS", "HEAD"}, methods - {"HEAD"}, path)
            self.assertEqual("HEAD" in headers["Allow"], "GET" in methods, path)

    def test_options_of_all(self):
        """OPTIONS * names all methods; OPTIONS of no path is an error"""
        host = self.daemon.address.removeprefix("http://")
        connection = http.client.HTTPConnection(host)
        connection.request("OPTIONS", "*")
        answer = connection.getresponse()
        self.assertEqual((answer.status, answer.headers["Allow"], answer.read()), (204, "GET, HEAD, POST, PUT, OPTIONS", b""))
        connection.close()
        self.assertEqual(self.send("/none", None, "OPTIONS")[0], 404)

    def test_wrong_method(self):
        """another method is refused, and the methods are named"""
        for path in self.paths():
            status, headers, _ = self.send(path, None, "DELETE")
            self.assertEqual((status, headers["Allow"]), (405, self.daemon.send(path, None, "OPTIONS")[1]["Allow"]), path)

    def test_head(self):
        """HEAD has the headers of GET"""
        for path in ("/", "/docs/", "/v1/limits", "/v1/looks", "/v1/examples", "/v1/examples/pawns", "/v1/openapi.json", "/healthz"):
            got, asked = self.send(path), self.send(path, method="HEAD")
            self.assertEqual((got[0], asked[0], asked[2]), (200, 200, b""), path)
            self.assertEqual(set(got[1]), set(asked[1]), path)
            self.assertEqual(int(asked[1]["Content-Length"]), len(got[2]), path)


class Safety(Case):
    def test_bounds(self):
        """each answer is what its type says, and runs nothing; only pages have policies of their own"""
        answers = {"picture": self.send("/v1/render", b'{"polygons": []}'), "limits": self.send("/v1/limits"),
                   "none": self.send("/none"), "unknown": self.daemon.send("/v1/limits"), "options": self.send("/", None, "OPTIONS"),
                   "page": self.send("/"), "manual": self.send("/docs/"), "healthz": self.send("/healthz")}
        for name, (_, headers, _) in answers.items():
            self.assertEqual(headers.get_all("X-Content-Type-Options"), ["nosniff"], name)
            self.assertEqual(headers.get_all("Cross-Origin-Resource-Policy"), ["same-origin"], name)
            self.assertEqual(headers.get_all("Referrer-Policy"), ["no-referrer"], name)
            self.assertEqual(len(headers.get_all("Content-Security-Policy")), 1, name)
            self.assertEqual(headers["Content-Security-Policy"] == SHUT, name not in ("page", "manual"), name)

    def test_faults_are_not_kept(self):
        """errors say that no cache may keep them"""
        for status, answer in ((401, self.daemon.send("/v1/limits")), (404, self.send("/none")), (404, self.send("/docs/none")),
                               (405, self.send("/v1/limits", b"", "PUT")), (400, self.send("/v1/render", b"{")),
                               (422, self.send("/v1/render", b'{"a": 1}')), (415, self.send("/v1/render", b"{", Content_Encoding="br"))):
            self.assertEqual((answer[0], answer[1].get_all("Cache-Control")), (status, ["no-store"]))
