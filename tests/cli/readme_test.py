#!/usr/bin/env python3
"""The README's commands from a PDB file to a mesh and on, the batch script, and the schema of the report.

    tests/cli/readme_test.py --program build/bin/gaussmesh --data data [CLASS...]
"""

import gzip
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys

import jsonschema
from support import CliTest, run_tests, settings

SECTION = "## From a PDB file to a mesh, and on"


def pdb_text(pqr):
    """A PDB file of the atoms of a PQR file, without its hydrogens."""
    lines = []
    for words in map(str.split, pqr.read_text().splitlines()):
        if words and words[0] == "ATOM" and not words[2].lstrip("0123456789").startswith("H"):
            x, y, z = map(float, words[-5:-2])
            lines.append(f"ATOM  {len(lines) + 1:5d}  {words[2]:3s} {words[3]:>3s} A{int(words[-6]):4d}    "
                         f"{x:8.3f}{y:8.3f}{z:8.3f}  1.00 10.00          {words[2][0]:>2s}\n")
    return "".join([*lines, "TER\n", "END\n"])


def numbers_of(text):
    """All numbers in a text but those with a unit of time or memory, which depend on the machine."""
    words = [word.replace("triangles", "") for word in re.sub(r"[\d.]+ (s|MB)\b", "", text).split()]
    return [float(word) for word in (word.strip(",:;") for word in words) if re.fullmatch(r"[\d.]+", word)]


class Readme(CliTest):
    def test_the_first_mesh_is_what_it_says(self):
        text = (settings.data.parent / "README.md").read_text(encoding="utf-8")
        said = text.split("For `data/fas2.pqr` it says\n\n", 1)[1].split("\n\n", 1)[0]
        out = self.expect(0, self.molecule("fas2"), "--d", "0.6", "--c", "1.7", "-o", "out.off").stdout
        wanted, got = numbers_of(said), numbers_of(out)
        self.assertGreater(len(wanted), 12)
        self.assertEqual(len(wanted), len(got), out)
        for one, other in zip(wanted, got):  # processors round differently, and a triangle more or less follows
            self.assertAlmostEqual(one, other, delta=0.01 * one, msg=out)

    def test_commands_run_as_they_stand(self):
        root = settings.data.parent
        text = (root / "README.md").read_text(encoding="utf-8")
        section = text[text.index(SECTION):].split("\n## ", 1)[0]
        commands = [line.strip() for line in section.splitlines() if line.startswith("    ")]
        self.assertGreater(len(commands), 7)
        (self.folder / "molecules").mkdir()
        self.write("mol.pdb", pdb_text(self.molecule("1l2y")))
        shutil.copy(self.molecule("methanol"), self.folder / "molecules")
        shutil.copy(self.folder / "mol.pdb", self.folder / "molecules")
        (self.folder / "bin").mkdir()
        (self.folder / "bin" / "gaussmesh-batch").symlink_to(root / "scripts" / "mesh_batch.py")
        path = f"{self.folder / 'bin'}:{settings.program.parent}:/usr/bin:{os.environ['PATH']}"
        for command in commands:
            result = subprocess.run(["bash", "-c", command], cwd=self.folder, env={**os.environ, "PATH": path},
                                    capture_output=True, text=True, timeout=200, check=False)
            self.assertEqual(result.returncode, 0, f"{command}\n{result.stdout}{result.stderr}")
        made = ["mol.off", "bondi.off", "mol.vert", "mol.face", "surf_1.vert", "mol.msh", "mol.smesh", "mol.1.ele",
                "mol.ply", "mol.vtp", "meshes"]
        self.assertEqual(set(made) - set(self.files()), set())
        self.assertEqual(sorted(p.name for p in (self.folder / "meshes").glob("[a-z]*")),
                         ["failures.tsv", "methanol.json", "methanol.off", "mol.json", "mol.off", "table.csv"])


class Batch(CliTest):
    def batch(self, *arguments):
        command = ["/usr/bin/python3", settings.data.parent / "scripts" / "mesh_batch.py", "--program",
                   settings.program, *arguments]
        return subprocess.run(list(map(str, command)), cwd=self.folder, capture_output=True, text=True, timeout=200,
                              check=False)

    def test_goes_on_past_failures_and_takes_up_where_it_stopped(self):
        good = [self.molecule(name) for name in ("methanol", "dmso")]
        self.write("bad.pqr", "ATOM 1 C X 1 0 0 0 0 x\n")
        self.write("list.txt", "\n".join(map(str, [*good, " # two that fail", "bad.pqr", "none.pqr", ""])))
        first = self.batch("--list", "list.txt", "--output", "out", "--jobs", 2)
        self.assertEqual(first.returncode, 1, first.stderr)
        rows = (self.folder / "out" / "table.csv").read_text().splitlines()
        self.assertEqual([row.split(",")[0] for row in rows], ["molecule", "methanol", "dmso"])
        self.assertTrue(all(row.endswith(",certified") for row in rows[1:]))
        failures = (self.folder / "out" / "failures.tsv").read_text()
        self.assertRegex(failures, r"bad.pqr\tgaussmesh: exit 3: .*bad.pqr:1: ")
        self.assertIn("none.pqr\tno such file", failures)
        stamps = [(self.folder / "out" / f"{name}.off").stat().st_ino for name in ("methanol", "dmso")]
        (self.folder / "out" / "dmso.off").unlink()
        self.batch("--list", "list.txt", "--output", "out")
        again = [(self.folder / "out" / f"{name}.off").stat().st_mtime_ns for name in ("methanol", "dmso")]
        self.assertEqual((self.folder / "out" / "methanol.off").stat().st_ino, stamps[0], "it was there")
        self.batch("--list", "list.txt", "--output", "out", "--", "--spacing", 0.7)
        third = [(self.folder / "out" / f"{name}.off").stat().st_mtime_ns for name in ("methanol", "dmso")]
        self.assertTrue(all(new > old for new, old in zip(third, again)), "other options, other meshes")

    def said_of(self, *arguments):
        """Whether the mesh of the one molecule, x, is said to be made or kept."""
        result = self.batch(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return re.fullmatch(r"\[1/1\] x: (\w+)\n", result.stderr)[1]

    def test_keeps_what_would_be_made_the_same(self):
        """Contents decide, of all files that a mesh comes from, and not their times."""
        old = 1e9
        for folder, molecule in [("a", "methanol"), ("b", "dmso")]:
            (self.folder / folder).mkdir()
            shutil.copy(self.molecule(molecule), self.folder / folder / "x.pqr")
            os.utime(self.folder / folder / "x.pqr", (old, old))
        mesh = self.folder / "out" / "x.off"
        self.assertEqual(self.said_of("a", "--output", "out"), "made")
        of_a = mesh.read_bytes()
        os.utime(self.folder / "a" / "x.pqr")
        self.assertEqual(self.said_of("a", "--output", "out"), "kept")
        self.assertEqual(self.said_of("b", "--output", "out"), "made")
        self.expect(0, "b/x.pqr", "-o", self.mesh)
        self.assertEqual(mesh.read_bytes(), self.mesh.read_bytes())
        self.assertIn("x,10,", (self.folder / "out" / "table.csv").read_text())
        self.assertEqual(self.said_of("a", "--output", "out", "--extension", "ply"), "made")
        self.assertEqual(self.said_of("b", "--output", "out"), "made", "the report was that of another mesh")
        self.assertEqual(self.said_of("a", "--output", "out"), "made")
        for name in ("x.off", "x.json"):
            (self.folder / "out" / name).write_text("")
            self.assertEqual(self.said_of("a", "--output", "out"), "made", name)
        self.assertEqual(mesh.read_bytes(), of_a)
        self.assertEqual(self.said_of("a", "--output", "out", "--again"), "made")
        self.write("newer", f"#!/bin/sh\n[ $1 = --version ] && echo gaussmesh 99 || exec {settings.program} \"$@\"\n")
        (self.folder / "newer").chmod(0o755)
        for said in ("made", "kept"):
            self.assertEqual(self.said_of("a", "--output", "out", "--program", "./newer"), said)

    def test_files_that_options_name_count(self):
        self.write("x.pdb", pdb_text(self.molecule("1l2y")))
        radii = "C 1.7\nN 1.55\nO {}\n"
        config = 'raw = true\nspacing = {}\ncavities = "separate"\nradii-file = "my.radii"\n'
        self.write("my.radii", radii.format(1.52))
        self.write("o.toml", config.format(2))
        for form, spacing, oxygen in [(["--config", "o.toml"], 3, 1.62), (["--config=o.toml"], 2, 1.52)]:
            arguments = ["x.pdb", "--radii", "bondi", "--output", "out", "--", *form]
            self.assertEqual(self.said_of(*arguments), "made")
            self.assertEqual(self.said_of(*arguments), "kept")
            for name, text in [("o.toml", config.format(spacing)), ("my.radii", radii.format(oxygen))]:
                os.utime(self.write(name, text), (1e9, 1e9))
                self.assertEqual(self.said_of(*arguments), "made", name)
            self.assertEqual(self.said_of(*arguments), "kept")
        missing = self.batch("x.pdb", "--radii", "bondi", "--output", "out", "--", "--config", "none.toml")
        self.assertEqual(missing.returncode, 2)
        self.assertIn("--config: expected a file, got 'none.toml'", missing.stderr)

    def test_what_cannot_be_written_is_told(self):
        shutil.copy(self.molecule("methanol"), self.folder / "m.pqr")
        (self.folder / "out" / "table.csv").mkdir(parents=True)
        result = self.batch("m.pqr", "--output", "out")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, "^mesh_batch.py: .*'out/table.csv'\n$")
        (self.folder / "out" / "table.csv").rmdir()
        (self.folder / "out" / "m.off" / "x").mkdir(parents=True)
        result = self.batch("m.pqr", "--output", "out")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertRegex((self.folder / "out" / "failures.tsv").read_text(), "^m.pqr\t.*out/m.off'\n$")
        self.assertEqual([p.name for p in (self.folder / "out").glob(".*")], [], "nothing is left of the attempt")

    def test_a_program_that_writes_nothing_has_failed(self):
        shutil.copy(self.molecule("methanol"), self.folder / "m.pqr")
        for script, said in [("exit 0", "exit 0, but it wrote no mesh with a report"),
                             ('for f in "$@"; do case $f in *.off|*.json) echo [] >$f; esac; done',
                              "exit 0, but its report is not one of gaussmesh"),
                             ("[ $1 = --version ] || printf 'b\\344d\\n' >&2; [ $1 = --version ]", "exit 1: b\ufffdd")]:
            self.write("fake", f"#!/bin/sh\n{script}\n").chmod(0o755)
            result = self.batch("m.pqr", "--output", "out", "--program", "./fake")
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn(said, (self.folder / "out" / "failures.tsv").read_text())
        self.assertEqual(self.batch("m.pqr", "--output", "out", "--program", "/bin/false").returncode, 2)
        said = self.batch("m.pqr", "--output", "out", "--extension", "none")
        self.assertIn("out/m.none: expected a format", said.stderr)

    def test_finds_the_program_beside_it(self):
        shutil.copy(settings.data.parent / "scripts" / "mesh_batch.py", self.folder / "gaussmesh-batch")
        (self.folder / "gaussmesh").symlink_to(settings.program)
        result = subprocess.run(["./gaussmesh-batch", self.molecule("methanol"), "--output", "out"], cwd=self.folder,
                                env={"PATH": "/usr/bin:/bin"}, capture_output=True, text=True, timeout=200, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, "^1 of 1 molecules meshed, 1 now and 0 before; ")

    def test_several_files_for_a_molecule(self):
        """What is missing is made again: one of two files, the first of separate surfaces."""
        shutil.copy(self.molecule("methanol"), self.folder / "m.pqr")
        for options, files in [(["--extension", ".vert"], ["m.vert", "m.face"]),
                               (["--extension", "face.gz"], ["m.vert.gz", "m.face.gz"]),
                               (["--", "--cavities", "separate"], ["m_1.off"]),
                               (["--extension", "ply", "--", "--format", "msms"], ["m.ply.vert", "m.ply.face"])]:
            for missing in files:
                self.assertEqual(self.batch("m.pqr", "./m.pqr", "--output", "out", *options).returncode, 0)
                times = {name: (self.folder / "out" / name).stat().st_mtime_ns for name in files}
                self.batch("m.pqr", "--output", "out", *options)
                self.assertEqual({name: (self.folder / "out" / name).stat().st_mtime_ns for name in files}, times)
                (self.folder / "out" / missing).unlink()
                self.batch("m.pqr", "--output", "out", *options)
                self.assertTrue((self.folder / "out" / missing).exists(), missing)

    def test_says_what_the_program_said(self):
        self.batch(self.molecule("methanol"), "--output", "out", "--", "--spacing", "0")
        self.assertIn("exit 2: --spacing: expected a number", (self.folder / "out" / "failures.tsv").read_text())
        self.assertEqual(self.batch(self.molecule("methanol"), "--output", "out", "--jobs", "0").returncode, 2)
        self.write("file", "")
        self.assertEqual(self.batch(self.molecule("methanol"), "--output", "file").returncode, 2)

    def test_says_what_pdb2pqr_said(self):
        """Its last line is an error without a text."""
        self.write("none.pdb", "ATOM      1  N   XXX A   1       0.000   0.000   0.000  1.00 10.00           N\n")
        self.batch("none.pdb", "--output", "out", "--pdb2pqr", "/usr/bin/pdb2pqr")
        self.assertRegex((self.folder / "out" / "failures.tsv").read_text(), "pdb2pqr: exit 1: .*heavy atoms")

    def test_radii_of_structures(self):
        """From pdb2pqr, gzipped or not, from a set, or from a file, beside files that have radii of their own."""
        text = pdb_text(self.molecule("1l2y"))
        self.write("a.pdb", text)
        self.write("b.pdb.gz", gzip.compress(text.encode()))
        self.write("cut.pdb.gz", gzip.compress(text.encode())[:-9])
        shutil.copy(self.molecule("methanol"), self.folder / "m.pqr")
        self.write("my.radii", "C 1.7\nN 1.55\nO 1.52\n")
        rest = ["--output", "out", "--", "--raw", "--spacing", 2]
        made = self.batch("a.pdb", "b.pdb.gz", "cut.pdb.gz", "m.pqr", "--pdb2pqr", "/usr/bin/pdb2pqr", *rest)
        self.assertEqual(made.returncode, 1, made.stderr)
        out = self.folder / "out"
        self.assertRegex((out / "failures.tsv").read_text(), "^cut.pdb.gz\tcut.pdb.gz: Compressed file ended.*\n$")
        with_hydrogens = (out / "a.off").read_text()
        self.assertEqual((out / "b.off").read_text(), with_hydrogens)
        made = self.batch("a.pdb", "m.pqr", "--radii-file", "my.radii", *rest)
        self.assertEqual(made.returncode, 0, made.stderr)
        by_file = (out / "a.off").read_text()
        self.assertNotEqual(by_file, with_hydrogens)
        self.write("my.radii", "O 2.52\n")
        self.assertEqual(self.batch("a.pdb", "--radii", "bondi", "--radii-file", "my.radii", *rest).returncode, 0)
        by_both = (out / "a.off").read_text()
        self.assertNotEqual(by_both, by_file)
        self.write("my.radii", "O 2.51\n")
        later = (out / "a.json").stat().st_mtime + 1
        os.utime(self.folder / "my.radii", (later, later))
        self.batch("a.pdb", "--radii", "bondi", "--radii-file", "my.radii", *rest)
        self.assertNotEqual((out / "a.off").read_text(), by_both, "the file of radii has changed")

    def test_what_is_wrong_for_all_is_told_once(self):
        shutil.copy(self.molecule("methanol"), self.folder / "m.pqr")
        for arguments, said in [(["m.pqr", "--", "-o", "x.off"], "expected --extension before --, got '-o'"),
                                (["m.pqr", "--", "-ox.off"], "expected --extension before --, got '-ox.off'"),
                                (["m.pqr", "--", "--radii=bondi"], "expected --radii before --, got '--radii=bondi'"),
                                (["m.pqr", "--radii-file", "none"], "--radii-file: expected a file, got 'none'"),
                                (["m.pdb", "--pdb2pqr", "none"], "expected a program to run, got 'none'"),
                                (["m.pqr", "--timeout", "-1"], "--timeout: more than 0")]:
            result = self.batch("--output", "out", *arguments)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(said, result.stderr)
        self.assertEqual(self.files(), ["m.pqr"])

    def test_an_extension_without_its_dot(self):
        shutil.copy(self.molecule("methanol"), self.folder / "m.pqr")
        made = self.batch("m.pqr", "--output", "out", "--extension", "msh")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertTrue((self.folder / "out" / "m.msh").exists())

    def test_stops_when_told_to(self):
        for i in range(8):
            shutil.copy(self.molecule("dmso"), self.folder / f"m{i}.pqr")
        command = ["/usr/bin/python3", settings.data.parent / "scripts" / "mesh_batch.py",
                   *sorted(self.folder.glob("m*.pqr")), "--output", "out", "--program", settings.program,
                   "--", "--spacing", "0.1"]
        batch = subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        batch.stderr.readline()  # the first is made
        batch.send_signal(signal.SIGINT)
        said, _ = batch.communicate(timeout=100)
        self.assertEqual(batch.returncode, 1)
        self.assertRegex(said, "^[1-4] of 8 molecules meshed")
        self.assertIn("m7.pqr\tnot reached", (self.folder / "out" / "failures.tsv").read_text())

    def test_molecules_of_one_name(self):
        """A file with radii comes before the one that it was made from; what nothing decides fails alone."""
        text = self.molecule("methanol").read_text()
        for folder in ["in", "other"]:
            (self.folder / folder).mkdir()
        for name in ["in/a.pqr", "in/b.pqr", "in/c.pqr", "other/c.pqr"]:
            self.write(name, text)
        for name in ["in/a.pdb", "in/a.xyzr", "in/d.pdb", "in/d.ent"]:
            self.write(name, "no molecule")
        said = self.batch("in", "in/b.pqr", "other", "--output", "out", "--pdb2pqr", "none")
        self.assertEqual(said.returncode, 1, said.stderr)
        skipped = "".join(f"a: skipped in/a.{kind}, which would become the mesh of in/a.pqr\n"
                          for kind in ["pdb", "xyzr"])
        self.assertTrue(said.stderr.startswith(skipped + "["), said.stderr)
        self.assertIn("] c: expected one molecule for a mesh, got in/c.pqr and other/c.pqr\n", said.stderr)
        self.assertIn("] d: expected one molecule for a mesh, got in/d.ent and in/d.pdb\n", said.stderr)
        self.assertEqual((self.folder / "out" / "failures.tsv").read_text().count("\n"), 2)
        table = (self.folder / "out" / "table.csv").read_text().splitlines()
        self.assertEqual([row.split(",")[0] for row in table], ["molecule", "a", "b"])


class Schema(CliTest):
    def test_reports_are_as_the_schema_says(self):
        schema = json.loads((settings.data / "report.schema.json").read_text())
        jsonschema.Draft7Validator.check_schema(schema)
        validator = jsonschema.Draft7Validator(schema)
        self.expect(0, self.molecule("fas2"), "--spacing", 1, "-o", self.mesh, "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        validator.validate(report)
        for key in schema["required"]:
            self.assertFalse(validator.is_valid({k: v for k, v in report.items() if k != key}), key)
        self.assertEqual(set(report), set(schema["properties"]), "no key is without its description")
        atom = "ATOM {0} C X 1 {1} 0.0 0.0 0.0 1.0\n"
        self.write("touching.pqr", atom.format(1, "-1.5") + atom.format(2, "1.5"))
        for arguments in [[self.molecule("fas2"), "--raw", "--cavities", "drop", "--spacing", 2],
                          [self.molecule("dmso"), "--preset", "sas", "--tolerance", 0.05],
                          [self.molecule("dmso"), "--cavities", "separate", "-o", "s.off"],
                          ["touching.pqr", "--c", repr(2 * 0.4723665527410147), "--allow-uncertified"]]:  # its saddle
            self.expect(0, *arguments, "-o", self.mesh, "--report", "r.json")
            validator.validate(json.loads((self.folder / "r.json").read_text()))


    def test_the_input_and_what_was_done_with_cavities_are_told(self):
        water = "HETATM  999  O   HOH A 999       9.000   9.000   9.000  1.00 10.00           O\n"
        self.write("mol.pdb", water + pdb_text(self.molecule("1l2y")))
        self.expect(0, "mol.pdb", "--radii", "bondi", "--raw", "--spacing", 1, "--min-cavity-volume", 20,
                    "-o", self.mesh, "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual((report["input"]["file"], report["input"]["radii"]), ("mol.pdb", "bondi"))
        self.assertIsNone(report["input"]["radii_file"])
        self.write("my.radii", "N 1.6\n")
        self.expect(0, "mol.pdb", "--radii", "bondi", "--radii-file", "my.radii", "--raw", "--spacing", 2,
                    "-o", self.mesh, "--report", "own.json")
        self.assertEqual(json.loads((self.folder / "own.json").read_text())["input"]["radii_file"], "my.radii")
        self.assertIn("mol.pdb", "".join(report["input"]["warnings"]))
        self.assertEqual(report["options"]["cavities"], "keep")
        self.assertEqual(report["options"]["min_cavity_volume_A3"], 20)


if __name__ == "__main__":
    assert pathlib.Path("/usr/bin/pdb2pqr").exists()
    sys.exit(run_tests(__name__))
