"""Several files of one answer in parts, read by the parser of Python's email package."""
import email
import email.policy
import io
import unittest
import zipfile

import daemon

SCENE = b"""{"window": {"width": 160, "height": 120}, "polygons": [{"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]%s}"""
CHANNELS = "color,depth,faceId"
FILES = ["color.png", "depth.npy", "faceId.npy"]
TYPES = ["image/png", "application/x-npy", "application/x-npy"]
MIXED, FORM = "multipart/mixed", "multipart/form-data"


def parsed(headers, data):
    """Returns the parts of an answer. Fails where the parser found a defect."""
    head = f"Content-Type: {headers['Content-Type']}\r\n\r\n".encode()
    message = email.message_from_bytes(head + data, policy=email.policy.HTTP)
    parts = list(message.iter_parts())
    assert not message.defects and not any(part.defects for part in parts), [message.defects]
    return parts


class Parts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = daemon.Daemon()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()

    def render(self, accept, more=b"", query="?channel=" + CHANNELS):
        status, headers, data = self.daemon.send("/v1/render" + query, SCENE % more, Content_Type="application/json", Accept=accept)
        self.assertEqual(status, 200, data)
        return headers, data

    def test_bytes(self):
        """each part has the name, the type and the bytes of its output asked for alone"""
        for accept in (MIXED, FORM):
            headers, data = self.render(accept)
            self.assertEqual((headers.get_content_type(), headers["Vary"], headers["Zraster-Look"]), (accept, "Accept", "textbook@1"))
            parts = parsed(headers, data)
            self.assertEqual([part.get_filename() for part in parts], FILES)
            self.assertEqual([part.get_content_type() for part in parts], TYPES)
            for part, channel in zip(parts, CHANNELS.split(",")):
                alone = self.render(accept, query="?channel=" + channel)[1]
                self.assertEqual((part.get_payload(decode=True), part["Content-Length"]), (alone, str(len(alone))))
                disposition = part["Content-Disposition"]
                self.assertEqual(disposition.content_disposition, "attachment" if accept == MIXED else "form-data")
                self.assertEqual(disposition.params.get("name"), None if accept == MIXED else channel)

    def test_two_encodings(self):
        """fields of a channel in two encodings have their endings, so that a form has both; streams, too"""
        outputs = b', "outputs": [{"channel": "color"}, {"channel": "depth"}, {"channel": "color", "encoding": "jpeg"}]'
        names = lambda *more: [part["Content-Disposition"].params["name"] for part in parsed(*self.render(FORM, *more))]
        self.assertEqual(names(outputs, ""), ["color.png", "depth", "color.jpg"])
        self.assertEqual(names(outputs + b', "views": ["top"]', ""), ["top.color.png", "top.depth", "top.color.jpg"])

    def test_one(self):
        """one file is answered as it is"""
        headers, data = self.render(FORM, query="")
        self.assertEqual((headers.get_content_type(), data), ("image/png", self.render("*/*", query="")[1]))

    def test_archive(self):
        """an archive is preferred where its weight is higher, and its files are those of the parts"""
        headers, data = self.render("application/zip, multipart/form-data;q=0.9")
        self.assertEqual(headers.get_content_type(), "application/zip")
        files = zipfile.ZipFile(io.BytesIO(data))
        self.assertEqual([(name, files.read(name)) for name in files.namelist()],
                         [(part.get_filename(), part.get_payload(decode=True)) for part in parsed(*self.render(MIXED))])

    def test_sheet(self):
        """the files of a sheet come in parts, too"""
        parts = parsed(*self.render(FORM, b', "sheet": "balanced"', "?channel=color,info"))
        self.assertEqual([part.get_filename() for part in parts], ["color.png", "info.json"])

    def test_stream(self):
        """views are streamed as either type, a part for each view and output"""
        for accept in (MIXED, FORM):
            headers, data = self.render(accept, b', "views": ["top", "front"]', "?channel=color,info")
            self.assertEqual((headers.get_content_type(), headers["Content-Length"]), (accept, None))
            parts = parsed(headers, data)
            names = ["top.color", "top.info", "front.color", "front.info"]
            self.assertEqual([part.get_filename().rsplit(".", 1)[0] for part in parts], names)
            self.assertEqual([part["Content-Disposition"].params.get("name") for part in parts], [None] * 4 if accept == MIXED else names)

    def test_refusal(self):
        """a refusal is a problem as ever"""
        status, headers, _ = self.daemon.send("/v1/render?channel=color,depths", SCENE % b"", Content_Type="application/json", Accept=FORM)
        self.assertEqual((status, headers.get_content_type()), (400, "application/problem+json"))
