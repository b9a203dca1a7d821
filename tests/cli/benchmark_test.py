#!/usr/bin/env python3
"""The scripts that measure whole runs: their tables, a plot, and what they do where a program fails.

    tests/cli/benchmark_test.py --program build/bin/gaussmesh --data data [CLASS...]
"""

import csv
import subprocess
import sys

from support import CliTest, run_tests, settings

# Two triangles, whatever the molecule is.
REFERENCE = """#!/bin/sh
[ "$3 $5 $7" = "-s -d -c" ] || exit 1
printf 'OFF\\n4 2 0\\n' > "$2"
"""


class Benchmark(CliTest):
    def measure(self, *arguments):
        command = [sys.executable, settings.data.parent / "scripts" / "benchmark.py", *arguments, "--program",
                   settings.program, "--output", "results", "--runs", 1, "--spacings", 1.2]
        return subprocess.run(list(map(str, command)), cwd=self.folder, capture_output=True, text=True, timeout=200,
                              check=False)

    def rows(self):
        lines = (self.folder / "results" / "benchmark.tsv").read_text().splitlines()
        return list(csv.DictReader((line for line in lines if not line.startswith("#")), delimiter="\t"))

    def test_gives_time_and_memory_for_each_triangle(self):
        result = self.measure(self.molecule("methanol"))
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = self.rows()
        self.assertEqual([(row["molecule"], row["mesh"]) for row in rows],
                         [("methanol", "raw"), ("methanol", "default")])
        self.expect(0, self.molecule("methanol"), "--spacing", 1.2, "--raw", "-o", self.mesh)
        triangles = int(self.mesh.read_text().split()[2])
        self.assertEqual(int(rows[0]["triangles"]), triangles)
        for row in rows:
            self.assertEqual(row["times_reference"], "")
            self.assertGreater(float(row["two_thread_speed_up"]), 0)
            self.assertAlmostEqual(float(row["cpu_us_per_triangle"]) / 1e6 * int(row["triangles"]), float(row["cpu_s"]),
                                   delta=0.001)
            self.assertAlmostEqual(float(row["peak_bytes_per_triangle"]) * int(row["triangles"]) / 1e6,
                                   float(row["peak_MB"]), delta=0.1)
        table = (self.folder / "results" / "benchmark.md").read_text()
        for fact in ("processor", "compiler", "date"):
            self.assertIn(f"- {fact}: ", table)
        self.assertIn("<svg", (self.folder / "results" / "benchmark.svg").read_text())

    def test_compares_with_a_reference(self):
        self.write("reference", REFERENCE).chmod(0o755)
        result = self.measure(self.molecule("methanol"), "--reference", "reference", "--reference-name", "what it is",
                              "--two-thread-runs", 0)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("- reference: what it is\n", (self.folder / "results" / "benchmark.md").read_text())
        rows = self.rows()
        self.assertEqual([row["mesh"] for row in rows], ["reference", "raw", "default"])
        self.assertEqual(rows[0]["triangles"], "2")
        self.assertEqual(rows[0]["times_reference"], "1.00")
        for row in rows[1:]:
            self.assertEqual(row["two_thread_speed_up"], "")
            ratio = float(row["cpu_us_per_triangle"]) / float(rows[0]["cpu_us_per_triangle"])
            self.assertAlmostEqual(float(row["times_reference"]), ratio, delta=0.01 * ratio + 0.01)

    def test_names_the_program_that_fails(self):
        self.write("bad.pqr", "ATOM 1 C X 1 0 0 0 0 x\n")
        result = self.measure("bad.pqr", "--two-thread-runs", 0)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"bad.pqr.*exit 3: .*bad.pqr:1: ")
        self.assertEqual(self.measure("none.pqr").returncode, 2)


class Matrix(CliTest):
    def matrix(self, *arguments):
        command = [sys.executable, settings.data.parent / "scripts" / "mesh_matrix.py", "--program", settings.program,
                   *arguments]
        return subprocess.run(list(map(str, command)), cwd=self.folder, capture_output=True, text=True, timeout=200,
                              check=False)

    def test_a_row_for_each_run(self):
        arguments = [self.molecule("methanol"), "--levels", "0.6,1.7", "--spacings", 1, 2, "--topology",
                     settings.data / "reference_topology.tsv"]
        result = self.matrix(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = list(csv.DictReader((self.folder / "matrix.tsv").read_text().splitlines(), delimiter="\t"))
        self.assertEqual([(row["spacing"], row["components"], row["chi"], row["verdict"]) for row in rows],
                         [("1", "1", "2", "ok"), ("2", "1", "2", "ok")])
        self.assertEqual(self.matrix(*arguments, "--resume").stdout, "2 ok, 0 FAIL; table in matrix.tsv\n")
        self.assertEqual(self.matrix(self.molecule("methanol"), "--levels", "0.6,1e8").returncode, 1)

    def test_wrong_use_is_told_before_anything_is_run(self):
        self.write("cut.pqr.gz", b"\x1f\x8b")
        (self.folder / "empty").mkdir()
        good = self.molecule("methanol")
        for arguments, said in [(["none.pqr"], "expected a file or a folder, got 'none.pqr'"),
                                (["empty"], "expected molecules, got none"),
                                (["cut.pqr.gz"], "mesh_matrix.py: "),
                                ([good, "--program", "/none"], "--program: expected a program to run, got '/none'"),
                                ([good, "--judge", "/none"], "--judge: expected a program to run, got '/none'"),
                                ([good, "--topology", good], "expected a table with the columns molecule, "),
                                ([good, "--topology", "none"], "'none'"),
                                ([good, "--output", "empty"], "'empty'"),
                                ([good, "--jobs", 0], "--jobs: expected 1 or more")]:
            result = self.matrix(*arguments)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(said, result.stderr)
            self.assertNotIn("Traceback", result.stderr)
        self.assertEqual(self.files(), ["cut.pqr.gz", "empty"])


if __name__ == "__main__":
    sys.exit(run_tests(__name__))
