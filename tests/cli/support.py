"""What all tests of the program from outside share: a folder for each test, running the program, the command line.

Exit codes: 0 good, 1 internal, 2 wrong use, 3 input, 4 cannot mesh, 5 check failed.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
import unittest

WRONG_USE = 2
BAD_INPUT = 3
CANNOT_MESH = 4
CHECK_FAILED = 5

settings = argparse.Namespace(program="", data=pathlib.Path(), update_golden=False)


class CliTest(unittest.TestCase):
    """A fresh folder for each test, and one way to run the program in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="gaussmesh_cli_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.mesh = self.folder / "out.off"

    def run_program(self, *arguments, stdin=""):
        return subprocess.run([settings.program, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              input=stdin, timeout=300, check=False)

    def expect(self, code, *arguments, stdin=""):
        result = self.run_program(*arguments, stdin=stdin)
        said = f"{' '.join(map(str, arguments))}\nstdout: {result.stdout}\nstderr: {result.stderr}"
        self.assertEqual(result.returncode, code, said)
        return result

    def write(self, name, text):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def molecule(self, name):
        return settings.data / f"{name}.pqr"

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())


def run_tests(module_name):
    """The main of each test file."""
    parser = argparse.ArgumentParser(description="Tests of the program from outside.")
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--data", required=True, type=pathlib.Path, help="the folder data/ of the checkout")
    parser.add_argument("--update-golden", action="store_true")
    parser.add_argument("tests", nargs="*", help="classes or Class.test_name; all where none is given")
    parser.parse_args(namespace=settings)
    settings.program, settings.data = settings.program.resolve(), settings.data.resolve()
    loader = unittest.defaultTestLoader
    module = sys.modules[module_name]
    suite = loader.loadTestsFromNames(settings.tests, module) if settings.tests else loader.loadTestsFromModule(module)
    return 0 if unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful() else 1
