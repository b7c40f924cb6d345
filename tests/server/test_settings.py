"""Settings: the file of --config, --check-config, --print-config, names that are none."""
import os
import re
import subprocess
import tempfile
import unittest

import daemon

PROGRAM = os.path.join(daemon.build, "zrasterd")


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def run_with(self, *flags, text=None, **variables):
        """Runs the daemon in a folder, with `text` as its file c.conf."""
        if text is not None:
            with open(os.path.join(self.folder.name, "c.conf"), "wb") as out:
                out.write(text if isinstance(text, bytes) else text.encode())
            flags = ("--config", "c.conf", *flags)
        command = [os.path.abspath(PROGRAM), *flags]
        environment = {name: value for name, value in os.environ.items() if not name.startswith("ZRASTER_")} | variables
        return subprocess.run(command, capture_output=True, text=True, check=False, cwd=self.folder.name, env=environment, timeout=20)

    def faults(self, *flags, **rest):
        done = self.run_with("--check-config", *flags, **rest)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        lines = done.stderr.splitlines()
        self.assertTrue(all(line.startswith("zrasterd: ") for line in lines))
        return [line[len("zrasterd: "):] for line in lines]

    def printed(self, *flags, **rest):
        """Key: (value, source) of --print-config."""
        done = self.run_with("--print-config", *flags, **rest)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return {key: (value, source) for key, value, source in re.findall(r"^(?:# )?([a-z-]+) = ?(.*?)  # (.*)$", done.stdout, re.M)}


class Strangers(Case):
    """Names and values that would command the terminal, and files that never end."""

    def test_control_bytes(self):
        """no fault has a byte that commands the terminal, be it of a file's name, a key or a value"""
        odd = "a\x1b[31m\x7f\u009b2J\u202e"
        said = self.faults(f"--config={odd}") + self.faults(text=f"{odd} = 1\nport = {odd}\n") + self.faults(f"--{odd}=1")
        said += self.faults(f"--assets-dir={odd}") + self.faults(f"--token-file={odd}")
        self.assertGreaterEqual(len(said), 6)
        self.assertEqual([c for line in said for c in line if c < " " or c in "\x7f\x9b\u202e"], [])
        self.assertIn("a?[31m", " ".join(said))

    def test_pipe(self):
        """a file of settings that is a pipe is refused, and not waited for"""
        os.mkfifo(os.path.join(self.folder.name, "pipe"))
        self.assertEqual(self.faults("--config=pipe"), ["the file of settings 'pipe' is no regular file"])

    def test_all_proxies(self):
        """a network of all addresses is no list of trusted proxies"""
        for text in ("0.0.0.0/0", "::/0"):
            self.assertRegex(self.faults(f"--trusted-proxies={text}")[0], "would let each client choose its own")


class Order(Case):
    def test_order(self):
        """a flag is before a variable, a variable before the file, the file before the default"""
        text = "port=1\nworkers = 1\nqueue\t=\t1\n"
        got = self.printed("--port", "3", text=text, ZRASTER_PORT="2", ZRASTER_WORKERS="2")
        self.assertEqual([got[key] for key in ("port", "workers", "queue", "max-streams")],
                         [("3", "--port"), ("2", "ZRASTER_WORKERS"), ("1", "c.conf:3"), ("16", "default")])

    def test_variable_names_the_file(self):
        """ZRASTER_CONFIG names the file, --config another one, and an empty name none"""
        for name in ("a.conf", "b.conf"):
            with open(os.path.join(self.folder.name, name), "w", encoding="utf-8") as out:
                out.write(f"# {name}\n\nport = {len(name)}\n")
        self.assertEqual(self.printed(ZRASTER_CONFIG="a.conf")["port"], ("6", "a.conf:3"))
        self.assertEqual(self.printed("--config=b.conf", ZRASTER_CONFIG="a.conf")["port"], ("6", "b.conf:3"))
        self.assertEqual(self.printed("--config=", ZRASTER_CONFIG="a.conf")["port"], ("8080", "default"))

    def test_help(self):
        """--help names the three ways"""
        text = self.run_with("--help").stdout
        for way in ("body-max-bytes = 1000000", "ZRASTER_BODY_MAX_BYTES=1000000", "--body-max-bytes=1000000"):
            self.assertIn(way, text)

    def test_daemon(self):
        """a daemon serves by a file, and its health check finds it there"""
        path = os.path.join(self.folder.name, "d.conf")
        with open(path, "w", encoding="utf-8") as out:
            out.write("body-max-bytes = 77\n")
        server = daemon.Daemon("--config", path)
        self.addCleanup(server.stop)
        self.assertIn(b'"bodyMaxBytes":\t77', server.request("/v1/limits")[2])
        with open(path, "a", encoding="utf-8") as out:
            out.write("port = " + server.address.rsplit(":", 1)[1] + "\n")
        self.assertEqual(subprocess.run([PROGRAM, "--health", "--config", path], check=False).returncode, 0)


class Lines(Case):
    def test_forms(self):
        """comments, quotes, ends of lines and a mark of the order of bytes are read"""
        text = b'\xef\xbb\xbf# first\r\n  cgroup = a # b\r\nisa="scalar" # c\r\n\r\nassets-dir = "a # \\" \\\\"\r\ntoken = a#b'
        got = self.printed(text=text)
        self.assertEqual(got["cgroup"][0], "a")
        self.assertEqual(got["isa"], ("scalar", "c.conf:3"))
        self.assertEqual(got["assets-dir"], ('"a # \\" \\\\"', "c.conf:5"))
        self.assertEqual(got["token"], ("(set)", "c.conf:6"))

    def test_faults(self):
        """all faults of a file, of variables and of flags are told at once, each with its place"""
        text = "port = 70000\nbody_max_byte = 5\nqueue = 1\nqueue = 2\nnonsense SECRET\nxyzzyfoo = 1\nconfig = a\nassets-dir = \"a\n" \
               "cgroup = \"a\" b\npage = yes\naddress =\n= 5\n"
        self.assertEqual(self.faults("--prot=SECRET", "--queue=x", text=text, ZRASTER_WORKERS="many"), [
            "c.conf:1: port: '70000' is not a whole number from 0 to 65535",
            "c.conf:2: 'body_max_byte' is no setting; did you mean body-max-bytes?",
            "c.conf:4: queue: is set in line 3, too",
            "c.conf:5: 'nonsense' has no =; a line is KEY = VALUE",
            "c.conf:6: 'xyzzyfoo' is no setting; --help lists the known ones",
            "c.conf:7: config: a file of settings cannot name another one",
            "c.conf:8: assets-dir: the value in quotes does not end, or something follows it",
            "c.conf:9: cgroup: the value in quotes does not end, or something follows it",
            "c.conf:10: page: 'yes' is neither on nor off",
            "c.conf:11: address: '' is not a numeric IPv4 or IPv6 address",
            "c.conf:12: '' is no setting; --help lists the known ones",
            "ZRASTER_WORKERS: 'many' is not a whole number from 0 to 256",
            "unknown argument '--prot'; did you mean --port?",
            "--queue: 'x' is not a whole number from 0 to 65536 requests"])

    def test_many(self):
        """20 faults are told, and how many more there are"""
        lines = self.faults(text="a\n" * 1000)
        self.assertEqual((len(lines), lines[-1]), (21, "and 980 more"))

    def test_bounds(self):
        """a file has at most 64 KiB, and no zero bytes or control characters"""
        self.assertIn("has more than 65536 bytes", self.faults(text="#" * 65537)[0])
        self.assertEqual(self.run_with("--check-config", text="#" * 65536).returncode, 0)
        self.assertEqual(self.faults(text="port = 1\0\n"), ["c.conf:1: the line has a zero byte"])
        self.assertEqual(self.faults(text="cgroup = \x1b[1m"), ["c.conf:1: cgroup: the value has a control character"])
        self.assertIn("longer than the 255 bytes", self.faults(text="cgroup = " + "a" * 256)[0])

    def test_unreadable(self):
        """a file that cannot be read stops the daemon"""
        self.assertEqual(self.faults("--config", "none"), ["cannot read the file of settings 'none': No such file or directory"])
        self.assertEqual(self.faults("--config", "."), ["the file of settings '.' is no regular file"])


class Names(Case):
    def test_variables(self):
        """an unknown variable is a fault"""
        self.assertEqual(self.faults(ZRASTER_BODY_MAX_BYTE="5", ZRASTER_TYPO="", PATH="/"), [
            "ZRASTER_BODY_MAX_BYTE is no variable of a setting; did you mean ZRASTER_BODY_MAX_BYTES?",
            "ZRASTER_TYPO is no variable of a setting; --help lists the known ones"])

    def test_others(self):
        """service links of Kubernetes, of this service and of zraster-canary, and the command's variables are none of ours"""
        links = {}
        for name in ("ZRASTER", "ZRASTER_CANARY"):
            links |= {name + "_SERVICE_HOST": "10.0.0.1", name + "_SERVICE_PORT": "8080", name + "_SERVICE_PORT_HTTP": "8080",
                      name + "_PORT": "tcp://10.0.0.1:8080"}
            for protocol in ("TCP", "UDP"):
                port = f"{name}_PORT_8080_{protocol}"
                links |= {port: "tcp://10.0.0.1:8080", port + "_PROTO": "tcp", port + "_PORT": "8080", port + "_ADDR": "10.0.0.1"}
        self.assertEqual(self.printed(ZRASTER_SERVER="http://a", ZRASTER_FRONT=":80", ZRASTER_TOKEN="", **links)["port"], ("8080", "default"))
        self.assertEqual(len(self.faults(ZRASTER_PORT_8080_ICMP="1", ZRASTER_PORT_TCP="1", ZRASTER_A_PORT="80")), 3)


class Check(Case):
    def test_right(self):
        """--check-config says one line, and listens nowhere"""
        done = self.run_with("--check-config", "--port=1", text="assets-dir = .\n", ZRASTER_ADDRESS="203.0.113.1")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, "the settings are valid: 1 from the file, 1 from variables, 2 from flags; the others are defaults\n")

    def test_folder(self):
        """--check-config looks for the folder of assets"""
        self.assertEqual(self.faults(text="\nassets-dir = none\n"), ["c.conf:2: assets-dir: cannot use 'none': No such file or directory"])
        self.assertEqual(self.faults(text="assets-dir = c.conf\n"), ["c.conf:1: assets-dir: 'c.conf' is no folder"])

    def test_files_of_the_gate(self):
        """--check-config reads the files that SIGHUP reads anew"""
        lines = self.faults(text="assets-dir = none\ntoken-file = nobody\n")
        self.assertEqual(len(lines), 2)
        self.assertIn("nobody", lines[1])


class Print(Case):
    def test_again(self):
        """what is printed is a file with the same settings"""
        flags = ("--assets-dir", ' a "\\ # ', "--token=hidden-token", "--allow-origin=https://a.example, http://b.example", "--workers=5")
        done = self.run_with("--print-config", *flags)
        self.assertNotIn("hidden-token", done.stdout)
        self.assertIn("# token = (set)  # --token\n", done.stdout)
        first = self.printed(*flags)
        flags_of_help = re.findall("^  --([a-z-]+)=", self.run_with("--help").stdout, re.M)
        self.assertEqual({*first, "config"}, set(flags_of_help))
        again = self.printed(text=done.stdout)
        del first["token"], again["token"]
        self.assertEqual({key: value for key, (value, _) in first.items()}, {key: value for key, (value, _) in again.items()})
        self.assertTrue(all(source.startswith("c.conf:") for _, source in again.values()), again)

    def test_machine(self):
        """0 stays 0 where the machine decides, beside what it is here"""
        value, source = self.printed()["threads"]
        self.assertEqual(value, "0")
        self.assertRegex(source, "^default; here [1-9][0-9]*$")
