"""run.py BUILD TEST.py...: runs files of unittest with the package of clients/python and the library of BUILD. Prints TAP;
failures and reasons of skips go to standard error."""
import importlib.util
import os
import sys
import traceback
import unittest

here = os.path.dirname(os.path.abspath(__file__))
package = os.path.join(here, "../../clients/python")


class Tap(unittest.TestResult):
    def __init__(self):
        super().__init__()
        self.count = 0

    def put(self, test, verdict, reason="", skip=""):
        self.count += 1
        text = (test.shortDescription() or test.id()).replace("#", "")
        print(f"{verdict} {self.count} - {text}{f' # SKIP {skip}' if skip else ''}", flush=True)
        if reason:
            print(f"{test.id()}: {reason}", file=sys.stderr, flush=True)

    def addSuccess(self, test):
        self.put(test, "ok")

    def addSkip(self, test, reason):
        self.put(test, "ok", f"left out: {reason}", reason)

    def addFailure(self, test, error):
        self.put(test, "not ok", "".join(traceback.format_exception(*error)))
        super().addFailure(test, error)

    def addError(self, test, error):
        self.put(test, "not ok", "".join(traceback.format_exception(*error)))
        super().addError(test, error)

    def addSubTest(self, test, subtest, error):
        if error:
            self.put(subtest, "not ok", "".join(traceback.format_exception(*error)))
        super().addSubTest(test, subtest, error)


def load(path):
    name = os.path.basename(path)[:-3]
    spec = importlib.util.spec_from_file_location(name, path)
    module = sys.modules[name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return unittest.defaultTestLoader.loadTestsFromModule(module)


if __name__ == "__main__":  # spawned workers import this file, too
    build, tests = os.path.abspath(sys.argv[1]), sys.argv[2:]
    os.environ["ZRASTER_BUILD"] = build
    os.environ["ZRASTER_LIBRARY"] = os.path.join(build, "libzraster.so.0")
    os.environ["PYTHONPATH"] = os.pathsep.join([os.path.abspath(package), here])
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    sys.dont_write_bytecode = True
    sys.path[:0] = os.environ["PYTHONPATH"].split(os.pathsep)
    result = Tap()
    unittest.TestSuite(load(test) for test in tests).run(result)
    print(f"1..{result.count}")
    sys.exit(0 if result.wasSuccessful() and result.count else 1)
