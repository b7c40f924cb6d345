"""server/deploy/kubernetes: numbers, names and labels of the manifests agree with one another, with the daemon and with the command.
`make manifests` has the schemas of Kubernetes."""
import glob
import os
import re
import subprocess
import tempfile
import unittest
import urllib.request

try:
    import yaml
except ImportError:
    yaml = None
build = os.environ["ZRASTER_BUILD"]
root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
folder = os.path.join(root, "server/deploy/kubernetes")
UNITS = {"Ki": 2**10, "Mi": 2**20, "Gi": 2**30}
# Of a worker that is cancelled, of stacks and connections, and the share of a limit beyond which requests get 503.
CANCELLED_S, PROGRAM_BYTES, FULL = 4, 128 * 2**20, 0.92


def run(program, *arguments, **more):
    return subprocess.run([os.path.join(build, program), *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False, **more)


def amount(quantity):
    number, unit = re.fullmatch(r"([\d.]+)(m|[KMG]i)?", quantity).groups()
    return float(number) * (0.001 if unit == "m" else UNITS.get(unit, 1))


def selects(labels, selector):
    return selector.items() <= labels.items()


@unittest.skipUnless(yaml, "python3-yaml is missing")
class Manifests(unittest.TestCase):
    def setUp(self):
        self.all = {}
        for path in glob.glob(folder + "/*.yaml"):
            with open(path, encoding="utf-8") as file:
                self.all[os.path.basename(path)[:-5]] = yaml.safe_load(file)
        self.deployment, self.job = self.all["deployment"]["spec"], self.all["indexed-job"]["spec"]
        self.pod, self.container = self.deployment["template"]["spec"], self.deployment["template"]["spec"]["containers"][0]
        self.environment = {one["name"]: one["value"] for one in self.container["env"]}

    def settings(self):
        """Returns the daemon's settings in the environment of the pod, and where they come from."""
        run_there = run("zrasterd", "--print-config", env=self.environment)
        self.assertEqual(run_there.returncode, 0, run_there.stderr)
        lines = re.findall(r"^([a-z-]+) = (.*?) *# (.*)$", run_there.stdout, re.M)
        return {key: value for key, value, _ in lines}, {key: source for key, _, source in lines}

    def test_settings(self):
        """the daemon knows all variables of the pod"""
        settings, sources = self.settings()
        for name, value in self.environment.items():
            key = name.removeprefix("ZRASTER_").replace("_", "-").lower()
            self.assertEqual(settings.get(key), value, name)
            self.assertIn(name, sources[key])

    def test_names(self):
        """labels match selectors, ports match, and images have this version"""
        labels = self.deployment["template"]["metadata"]["labels"]
        for selector in (self.deployment["selector"]["matchLabels"], self.all["service"]["spec"]["selector"],
                         self.all["poddisruptionbudget"]["spec"]["selector"]["matchLabels"],
                         self.all["networkpolicy"]["spec"]["podSelector"]["matchLabels"],
                         *(one["labelSelector"]["matchLabels"] for one in self.pod["topologySpreadConstraints"])):
            self.assertTrue(selector and selects(labels, selector), selector)
            self.assertFalse(selects(self.job["template"]["metadata"]["labels"], selector), "pods of the job are no daemons")
        target = self.all["hpa"]["spec"]["scaleTargetRef"]
        self.assertEqual((target["kind"], target["name"], target["apiVersion"]),
                         (self.all["deployment"]["kind"], self.all["deployment"]["metadata"]["name"], self.all["deployment"]["apiVersion"]))
        ports = {one["name"]: one["containerPort"] for one in self.container["ports"]}
        self.assertEqual(ports, {"http": int(self.environment["ZRASTER_PORT"])})
        used = [one["targetPort"] for one in self.all["service"]["spec"]["ports"]]
        used += [one["port"] for rule in self.all["networkpolicy"]["spec"]["ingress"] for one in rule["ports"]]
        used += [self.container[kind]["httpGet"]["port"] for kind in ("startupProbe", "livenessProbe", "readinessProbe")]
        self.assertEqual(set(used), {"http"})
        self.assertEqual(self.deployment["template"]["metadata"]["annotations"]["prometheus.io/port"], self.environment["ZRASTER_PORT"])
        version = run("zrasterd", "--version").stdout.split()[-1]
        for spec in (self.pod, self.job["template"]["spec"]):
            self.assertEqual(spec["containers"][0]["image"].rpartition(":")[2], version)
        for manifest in self.all.values():
            self.assertNotIn("namespace", manifest["metadata"])

    def test_times(self):
        """a pod may live until its requests have ended, and no probe ends it before it has begun"""
        settings, _ = self.settings()
        hook = self.container.get("lifecycle", {}).get("preStop", {}).get("sleep", {}).get("seconds", 0)
        drain = hook + (int(settings["drain-delay-ms"]) + int(settings["drain-timeout-ms"])) / 1000 + CANCELLED_S
        self.assertGreater(self.pod["terminationGracePeriodSeconds"], drain)
        self.assertGreaterEqual(int(settings["drain-timeout-ms"]), int(settings["render-timeout-ms"]))
        self.assertGreaterEqual(int(settings["drain-delay-ms"]), 5000, "nodes hear of an ended pod only then")
        start, live, ready = (self.container[kind] for kind in ("startupProbe", "livenessProbe", "readinessProbe"))
        self.assertGreaterEqual(start["periodSeconds"] * start["failureThreshold"], 10)
        self.assertGreater(live["periodSeconds"] * live["failureThreshold"], ready["periodSeconds"] * ready["failureThreshold"])
        self.assertEqual(self.deployment["strategy"]["rollingUpdate"], {"maxUnavailable": 0, "maxSurge": 1})

    def test_memory(self):
        """the memory limit of a pod exceeds the ceilings of all that the daemon holds"""
        settings = {key: int(value) for key, value in self.settings()[0].items() if value.isdigit()}
        kept = sum(value for key, value in settings.items() if re.fullmatch(r"keep-.*-bytes", key) and key != "keep-memory-bytes")
        render = max(settings["request-memory-bytes"], settings["keep-memory-bytes"])
        ceiling = (settings["workers"] + 1) * render + 2 * settings["upload-memory-bytes"] + settings["answer-memory-bytes"] + kept + PROGRAM_BYTES
        resources = self.container["resources"]
        self.assertLessEqual(ceiling, FULL * amount(resources["limits"]["memory"]))
        self.assertEqual(resources["requests"]["memory"], resources["limits"]["memory"], "a node must have it")
        self.assertEqual({settings["workers"], settings["threads"]}, {amount(resources["limits"]["cpu"])})
        with open(os.path.join(root, "clients/docs/how-to/kubernetes.md"), encoding="utf-8") as file:
            self.assertIn(f"| {ceiling // 2**20} of {int(amount(resources['limits']['memory'])) // 2**20} |", file.read())

    def test_restricted(self):
        """pods meet the standard `restricted` and have no way to the API"""
        for spec in (self.pod, self.job["template"]["spec"]):
            self.assertIs(spec["automountServiceAccountToken"], False)
            self.assertIs(spec["enableServiceLinks"], False)
            self.assertEqual((spec["securityContext"]["runAsNonRoot"], spec["securityContext"]["runAsUser"]), (True, 65532))
            self.assertEqual(spec["securityContext"]["seccompProfile"], {"type": "RuntimeDefault"})
            for key in ("hostNetwork", "hostPID", "hostIPC"):
                self.assertNotIn(key, spec)
            for container in spec["containers"]:
                self.assertEqual(container["securityContext"], {"readOnlyRootFilesystem": True, "allowPrivilegeEscalation": False, "capabilities": {"drop": ["ALL"]}})
                self.assertLessEqual({"cpu", "memory"}, container["resources"]["limits"].keys())
        self.assertEqual(self.all["networkpolicy"]["spec"]["policyTypes"], ["Ingress", "Egress"])
        self.assertEqual(self.all["networkpolicy"]["spec"]["egress"], [])

    def test_paths(self):
        """the daemon has the paths of the probes, and the metric that pods are added by"""
        environment = {**self.environment, "ZRASTER_PORT": "0", "ZRASTER_ADDRESS": "127.0.0.1", "ZRASTER_DRAIN_DELAY_MS": "0"}
        with subprocess.Popen([os.path.join(build, "zrasterd")], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=environment) as daemon:
            try:
                url = re.search(r"listening on (\S+)", daemon.stdout.readline())[1]
                for kind in ("startupProbe", "livenessProbe", "readinessProbe"):
                    with urllib.request.urlopen(url + self.container[kind]["httpGet"]["path"], timeout=10) as answer:
                        self.assertEqual(answer.status, 200)
                with urllib.request.urlopen(url + self.deployment["template"]["metadata"]["annotations"]["prometheus.io/path"], timeout=10) as answer:
                    metrics = answer.read().decode()
                for one in self.all["hpa"]["spec"]["metrics"]:
                    if one["type"] == "Pods":
                        self.assertRegex(metrics, rf"(?m)^# TYPE {one['pods']['metric']['name']} gauge$")
            finally:
                daemon.terminate()

    def test_job(self):
        """the pods of the job draw each file once, and Kubernetes repeats no fault that stays"""
        container = self.job["template"]["spec"]["containers"][0]
        arguments = container["args"]
        self.assertEqual(arguments[0], "batch")
        self.assertEqual(arguments[arguments.index("--shard") + 1], f"$(JOB_COMPLETION_INDEX)/{self.job['completions']}")
        self.assertEqual(float(arguments[arguments.index("-j") + 1]), amount(container["resources"]["limits"]["cpu"]))
        self.assertEqual({one["mountPath"] for one in container["volumeMounts"]}, {one for one in arguments if one.startswith("/")})
        self.assertEqual({one["name"] for one in container["volumeMounts"]}, {one["name"] for one in self.job["template"]["spec"]["volumes"]})
        rule = self.job["podFailurePolicy"]["rules"][0]
        self.assertEqual((rule["action"], rule["onExitCodes"]["containerName"]), ("FailIndex", container["name"]))
        with tempfile.TemporaryDirectory() as place:
            os.mkdir(place + "/models")
            for i in range(3):
                with open(f"{place}/models/{i}.obj", "w", encoding="ascii") as file:
                    file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" if i else "nothing")
            statuses = []
            for index in (0, 1, 2, 99):
                words = [place + one if one.startswith("/") else one.replace("$(JOB_COMPLETION_INDEX)", str(index)) for one in arguments]
                statuses.append(run("zraster", *words).returncode)
            self.assertEqual(statuses, [1, 0, 0, 0])
            self.assertEqual(sorted(os.listdir(place + "/pictures")), [".zraster-batch", "1.png", "2.png"])
            wrong = run("zraster", *[one.replace("$(JOB_COMPLETION_INDEX)", "100") for one in arguments]).returncode
            self.assertEqual(rule["onExitCodes"]["values"], [statuses[0], wrong])

    def test_image(self):
        """the image of the job is a target of the Dockerfile, and that of the daemon is the last one"""
        with open(os.path.join(root, "Dockerfile"), encoding="utf-8") as file:
            stages = re.split(r"(?m)^FROM ", file.read())[1:]
        batch = [stage for stage in stages if re.match(r"scratch AS batch\n", stage)]
        self.assertEqual(len(batch), 1)
        for stage, program in ((batch[0], "zraster"), (stages[-1], "zrasterd")):
            self.assertTrue(stage.startswith("scratch"))
            self.assertIn(f'ENTRYPOINT ["/{program}"]', stage)
            self.assertIn("USER 65532:65532", stage)
