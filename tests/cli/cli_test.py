#!/usr/bin/env python3
"""What the program says and how it exits, seen from outside.

    tests/cli/cli_test.py --program build/bin/gaussmesh --data data [CLASS...]

Standard library only. `--update-golden` writes the help texts anew instead of comparing them.
"""

import gzip
import json
import math
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import time
import unittest

from support import BAD_INPUT, CANNOT_MESH, CHECK_FAILED, WRONG_USE, CliTest, run_tests, settings

GOLDEN = pathlib.Path(__file__).resolve().parent / "golden"


class Meshing(CliTest):
    def test_small_molecules_pass_the_check(self):
        for name in ["methanol", "dmso"]:
            with self.subTest(name):
                made = self.expect(0, self.molecule(name), "--d", 0.6, "--c", 1.7, "-o", self.mesh)
                self.assertEqual(made.stderr, "")
                self.assertLessEqual(len(made.stdout.splitlines()), 3, "what was made, its quality, what was proven")
                judged = self.expect(0, "check", self.mesh)
                self.assertIn("OK", judged.stdout)
                self.expect(0, "check", self.mesh, self.molecule(name), "--d", 0.6, "--c", 1.7)

    def test_nothing_is_left_beside_the_mesh(self):
        self.expect(0, self.molecule("methanol"), "--d", 0.6, "--c", 1.7, "-o", self.mesh)
        self.assertEqual(self.files(), ["out.off"])

    def test_an_old_mesh_is_replaced(self):
        self.mesh.write_text("old")
        self.expect(0, self.molecule("methanol"), "--d", 0.6, "--c", 1.7, "-o", self.mesh)
        self.assertTrue(self.mesh.read_text().startswith("OFF"))

    def test_same_bits_for_any_threads_and_atom_order(self):
        lines = self.molecule("dmso").read_text().splitlines(keepends=True)
        seed = random.randrange(2**32)
        random.Random(seed).shuffle(lines)
        shuffled = self.write("shuffled.pqr", "".join(lines))
        bits = set()
        for molecule, threads in [(self.molecule("dmso"), 1), (self.molecule("dmso"), 2), (shuffled, 2)]:
            self.expect(0, molecule, "--d", 0.6, "--c", 1.7, "--threads", threads, "-o", self.mesh)
            bits.add(self.mesh.read_bytes())
        self.assertEqual(len(bits), 1, f"shuffled with seed {seed}")

    def test_gzipped_input(self):
        packed = self.write("methanol.pqr.gz", gzip.compress(self.molecule("methanol").read_bytes()))
        self.expect(0, packed, "--d", 0.6, "--c", 1.7, "-o", self.mesh)
        from_gzip = self.mesh.read_bytes()
        self.expect(0, self.molecule("methanol"), "--d", 0.6, "--c", 1.7, "-o", self.mesh)
        self.assertEqual(from_gzip, self.mesh.read_bytes())

    def test_spacing_sets_the_size_of_the_triangles(self):
        counts = []
        for spacing in [0.3, 0.6]:
            self.expect(0, self.molecule("dmso"), "--d", 0.6, "--c", 1.7, "--spacing", spacing, "-o", self.mesh)
            counts.append(int(self.mesh.read_text().split()[2]))
        self.assertGreater(counts[0], 2.5 * counts[1])

    def test_two_far_spheres(self):
        atom = "ATOM {0} C X 1 {1} 0.0 0.0 0.0 2.0\n"
        molecule = self.write("far.pqr", atom.format(1, "0.0") + atom.format(2, "1000000.0"))
        report = self.folder / "far.json"
        self.expect(0, molecule, "--d", 0.6, "--c", 1.7, "-o", self.mesh, "--report", report)
        self.assertEqual(len(json.loads(report.read_text())["components"]), 2)
        self.expect(0, "check", self.mesh)


class Structures(CliTest):
    """PDB with radii from a set."""

    def pdb(self):
        lines = []
        for line in self.molecule("1ubq").read_text().splitlines():
            words = line.split()
            if words[0] == "ATOM":
                name = words[2] if len(words[2]) > 3 else " " + words[2]
                x, y, z = map(float, words[-5:-2])
                lines.append(f"ATOM  {1:5d} {name:4s} {words[3]:>3s} A{int(words[-6]):4d}    {x:8.3f}{y:8.3f}{z:8.3f}"
                             f"  1.00 10.00          {words[2].lstrip('0123456789')[0]:>2s}\n")
        return "".join(lines)

    def test_sets_of_radii(self):
        self.write("ubq.pdb", self.pdb())
        volumes = {}
        for radii in ["bondi", "amber", "charmm"]:
            self.expect(0, "ubq.pdb", "--radii", radii, "--raw", "--spacing", 1, "-o", self.mesh, "--report", "r.json")
            volumes[radii] = json.loads((self.folder / "r.json").read_text())["volume_A3"]
            self.expect(0, "check", self.mesh, "ubq.pdb", "--radii", radii, "--d", 0.6, "--c", 1.7)
        self.expect(0, self.molecule("1ubq"), "--raw", "--spacing", 1, "-o", self.mesh, "--report", "r.json")
        from_pqr = json.loads((self.folder / "r.json").read_text())["volume_A3"]
        self.assertAlmostEqual(volumes["amber"] / from_pqr, 1.0, delta=1e-3)  # the ends of the chain differ
        self.assertEqual(len(set(volumes.values())), 3)

    def test_from_standard_input_and_gzip(self):
        self.write("ubq.pdb.gz", gzip.compress(self.pdb().encode()))
        self.expect(0, "ubq.pdb.gz", "--radii", "bondi", "--raw", "--spacing", 1, "-o", self.mesh)
        piped = self.expect(0, "-", "--input-format", "pdb", "--radii", "bondi", "--raw", "--spacing", 1, "-o", "-",
                            stdin=self.pdb())
        self.assertEqual(piped.stdout, self.mesh.read_text())

    def test_radii_are_not_guessed(self):
        self.write("ubq.pdb", self.pdb())
        self.assertIn("--radii", self.expect(WRONG_USE, "ubq.pdb", "-o", self.mesh).stderr)
        self.assertIn("'amber'", self.expect(WRONG_USE, "ubq.pdb", "--radii", "ambr", "-o", self.mesh).stderr)
        said = self.expect(WRONG_USE, self.molecule("methanol"), "--radii", "bondi", "-o", self.mesh).stderr
        self.assertIn("expected no --radii", said)

    def test_radii_of_ones_own(self):
        self.write("ubq.pdb", self.pdb())
        self.write("my.radii", "C 1.7\nN 1.55\nO 1.52\nS 1.8\nH 1.2 # all of Bondi that it takes\n")
        meshes = [self.expect(0, "ubq.pdb", *radii, "--raw", "--spacing", 2, "-o", "-").stdout
                  for radii in (["--radii", "bondi"], ["--radii-file", "my.radii"])]
        self.assertEqual(*meshes)
        self.write("my.radii", "H 0.5\n")
        both = self.expect(0, "ubq.pdb", "--radii", "bondi", "--radii-file", "my.radii", "--raw", "--spacing", 2,
                           "-o", "-")
        self.assertNotEqual(both.stdout, meshes[0])
        alone = ["ubq.pdb", "--radii-file", "my.radii", "-o", "-"]
        self.assertIn("'my.radii' know", self.expect(BAD_INPUT, *alone).stderr)
        self.write("my.radii", "H\n")
        self.assertIn("my.radii:1: expected", self.expect(BAD_INPUT, *alone).stderr)


class BadInput(CliTest):
    GOOD = "ATOM      1  C   X       1       0.000   0.000   0.000  0.00 2.00\n"

    def refused(self, text, where):
        """Exit 3, a message that begins with the place, no mesh, and an older mesh left as it was."""
        molecule = self.write("bad.pqr", text)
        for old in [None, "an older mesh\n"]:
            if old is not None:
                self.mesh.write_text(old)
            result = self.expect(BAD_INPUT, molecule, "--d", 0.6, "--c", 1.7, "-o", self.mesh)
            self.assertRegex(result.stderr, rf"bad\.pqr{where}: .+")
            self.assertEqual(result.stdout, "")
            self.assertEqual(self.files(), ["bad.pqr"] if old is None else ["bad.pqr", "out.off"])
            if old is not None:
                self.assertEqual(self.mesh.read_text(), old)

    def test_text_for_a_number(self):
        self.refused(self.GOOD + self.GOOD.replace("0.000  0.00 2.00", "zero  0.00 2.00"), ":2")

    def test_negative_radius(self):
        self.refused(self.GOOD * 2 + self.GOOD.replace("2.00", "-1.20"), ":3")

    def test_the_message_quotes_what_it_got(self):
        molecule = self.write("bad.pqr", self.GOOD.replace("2.00", "-1.20"))
        result = self.expect(BAD_INPUT, molecule, "--d", 0.6, "--c", 1.7, "-o", self.mesh)
        self.assertIn("'-1.20'", result.stderr)

    def test_infinite_coordinate(self):
        self.refused(self.GOOD.replace("   0.000   0.000   0.000", "   inf   0.000   0.000"), ":1")

    def test_missing_radius(self):
        self.refused(self.GOOD + self.GOOD.replace(" 2.00", ""), ":2")

    def test_empty_file(self):
        self.refused("", "(:[0-9]+)?")

    def test_no_atoms(self):
        self.refused("REMARK nothing here\nEND\n", "(:[0-9]+)?")

    def test_binary(self):
        self.refused(bytes(random.Random(1).randrange(256) for _ in range(5000)), "(:[0-9]+)?")

    def test_missing_file(self):
        result = self.expect(BAD_INPUT, "no_such_file.pqr", "--d", 0.6, "--c", 1.7, "-o", self.mesh)
        self.assertIn("no_such_file.pqr: ", result.stderr)
        self.assertEqual(self.files(), [])


class WrongUse(CliTest):
    def refused(self, *arguments, names="."):
        self.mesh.write_text("an older mesh\n")
        result = self.expect(WRONG_USE, *arguments)
        self.assertRegex(result.stderr, names)
        self.assertEqual(self.mesh.read_text(), "an older mesh\n")

    def test_unknown_option(self):
        self.refused(self.molecule("methanol"), "-o", self.mesh, "--no-such-option", names="--no-such-option")

    def test_no_molecule(self):
        self.refused("-o", self.mesh)

    def test_values_out_of_range(self):
        bad = ["0", "-1", "nan", "inf", "-inf", "1e400", "x", "0.5x", ""]
        for option, long_name, values in [("--d", "decay", bad), ("--c", "isovalue", bad),
                                          ("--spacing", "spacing", bad),
                                          ("--threads", "threads", ["-1", "1.5", "2.0", "1e1", "x"])]:
            for value in values:
                with self.subTest(option=option, value=value):
                    self.refused(self.molecule("methanol"), "-o", self.mesh, f"{option}={value}",
                                 names=f"{option}|{long_name}")

    def test_messages_are_readable(self):
        result = self.expect(WRONG_USE, self.molecule("methanol"), "-o", self.mesh, "--d=-1")
        self.assertLess(max(map(len, result.stderr.splitlines())), 200)

    def test_options_that_are_wrong_together_are_named(self):
        for options, said in [(["--spacing", 300],
                               "--spacing: expected a number from 0.01 to 200 without --raw, got '300'"),
                              (["--density", 1e-5],
                               "--density: expected a number from 3e-05 to 10000 without --raw, got '1e-05'"),
                              (["--spacing", 0], "--spacing: expected a number from 0.01 to 200, with --raw to 1000, "
                                                 "got '0'"),
                              (["--density", 1e-6], "--density: expected a number from 3e-05 to 10000, with --raw "
                                                    "from 2e-06, got '1e-06'"),
                              (["--tolerance", 1e-12], "--tolerance: expected 0 or a number from 1e-06 to 1000, since "
                                                       "vertices may be 1e-06 A from the surface, got '1e-12'"),
                              (["--min-cavity-volume", -1], "--min-cavity-volume: expected a number >= 0, got '-1'"),
                              (["--d", 0.5, "--d", 0.6], "--d: expected once, got 2 values: '0.5', '0.6'"),
                              (["--spacings", 0.5],
                               "expected an option of gaussmesh, got '--spacings'; did you mean '--spacing'?"),
                              (["--format", "mmcif"],
                               "--format: expected off, msms, ply, ply-ascii, obj, stl, stl-ascii, gmsh22, gmsh41, "
                               "smesh, vtp, got 'mmcif'\n")]:
            error = self.expect(WRONG_USE, self.molecule("methanol"), "-o", self.mesh, *options).stderr
            self.assertEqual(error[:len(said) + 11], "gaussmesh: " + said)
        for option in [["--spacing", 300], ["--density", 1e-5]]:
            self.expect(0, self.molecule("methanol"), "--raw", *option, "-o", self.mesh)
        error = self.expect(WRONG_USE, "check", self.mesh, self.molecule("methanol"), "third").stderr
        self.assertIn("gaussmesh: check: expected no further file, got 'third'", error)

    def test_what_is_missing_or_does_not_go_together_is_told(self):
        molecule, write = self.molecule("methanol"), ["-o", self.mesh]
        for arguments, said in [
                (["compare", "a.off"], "compare: expected A B, got 'a.off'"),
                (["convert"], "convert: expected MESH OUT..., got nothing"),
                ([molecule, "-o"], "--output: expected FILE behind it, got nothing"),
                (["check", "a.off", "--json"], "--json: expected FILE behind it, got nothing"),
                ([molecule, *write, "--threads", "1.5"],
                 "--threads: expected a whole number from 0 to 4096, got '1.5'"),
                ([molecule, *write, "--threads", "2.0"],
                 "--threads: expected a whole number from 0 to 4096, got '2.0'"),
                ([molecule, *write, "--raw=maybe"], "--raw: expected true or false, got 'maybe'"),
                (["measure", "a.off", "--atom-areas", "a"], "--atom-areas: expected MOL too, got none"),
                (["convert", "a.off", "b.off", "--probe", 1], "--probe: expected --molecule too, got none"),
                ([molecule, *write, "--quiet", "--verbose"], "expected --quiet or --verbose, got both"),
                ([molecule, *write, "--report", ""], "--report: expected the name of a file, got ''"),
                (["check", "a.off", "--json", ""], "--json: expected the name of a file, got ''"),
                (["check", "a.off", "--json", "--min-separation", 1],
                 "--json: expected the name of a file, got '--min-separation'; if it is one, write ./--min-separation"),
                ([molecule, "-o", "--raw"], "--output: expected the name of a file, got '--raw'; if it is one"),
                ([molecule, *write, "--config", ""], "--config: expected the name of a file, got ''"),
                ([molecule, *write, "check", self.mesh],
                 f"expected 'check' as the first word, got '{molecule}' before"),
                (["--spacing", 1, "measure", self.mesh],
                 "expected 'measure' as the first word, got '--spacing' before"),
                (["check", "-", "-"], "expected '-' for one of the inputs, got it for two"),
                (["compare", "-", "-"], "expected '-' for one of the inputs, got it for two")]:
            self.refused(*arguments, names="^gaussmesh: " + re.escape(said))
        error = self.expect(BAD_INPUT, molecule, *write, "--config", "none.toml").stderr
        self.assertEqual(error.splitlines()[0], "gaussmesh: none.toml: expected a readable file of options, got none")

    def test_names_that_begin_with_a_dash(self):
        """Behind `--` nothing is an option, wherever it stands."""
        self.write("-x.pqr", self.molecule("methanol").read_bytes())
        for words in [["-o", "b.off", "--", "-x.pqr"], ["-o", "b.off", "--quiet", "--", "-x.pqr"],
                      ["-o", "b.off", "./-x.pqr"], ["-o", "a.off", "-o", "b.off", "--", "-x.pqr"]]:
            self.expect(0, *words)
            (self.folder / "b.off").unlink()
        self.refused("--", "mol.pqr", "-o", "b.off", names="^gaussmesh: expected one molecule, got 'mol.pqr' and '-o', "
                                                           "'b.off'; nothing behind -- is an option\n")
        self.refused("check", "--", "a.off", "a.pqr", "--json",
                     names="gaussmesh: check: expected no further file, got '--json'; nothing behind -- is an option\n")
        self.refused("--raww", "--", "a", "b", names="^gaussmesh: expected an option of gaussmesh, got '--raww'; did")

    def test_check_of_nothing(self):
        self.refused("check")

    def test_a_mistyped_command_is_guessed(self):
        for words, command in [(["chek"], "check"), (["chek", self.mesh], "check"), (["CHECK", self.mesh], "check"),
                               (["mesure", self.mesh, self.molecule("methanol"), "--atom-areas", "a"], "measure"),
                               (["conv", self.mesh, "a.ply"], "convert"),
                               (["compair", "a.off", "-o", self.mesh], "compare")]:
            self.refused(*words, names=f"^gaussmesh: expected a file of atoms or a command, got '{words[0]}'; "
                                       f"did you mean '{command}'\\?\n")
        self.refused("chain", self.mesh, names="^gaussmesh: expected one molecule, got 'chain' and '.*out.off'\n")
        self.expect(BAD_INPUT, "chain", "-o", self.mesh)
        self.write("chek", self.molecule("methanol").read_bytes())
        self.refused("chek", "second", names="^gaussmesh: expected one molecule, got 'chek' and 'second'\n")
        self.expect(0, "chek", "-o", self.mesh)

    def test_no_header_is_for_msms(self):
        self.expect(0, self.molecule("methanol"), "-o", self.mesh)
        for command in [[self.molecule("methanol"), "-o", "new.off", "-o", "new.ply"],
                        [self.molecule("methanol"), "-o", "new.off", "--cavities", "separate"],
                        ["convert", self.mesh, "new.off"]]:
            error = self.expect(WRONG_USE, *command, "--no-header").stderr
            self.assertEqual(error, "gaussmesh: --no-header: expected a mesh to write in the format msms, got off for "
                                    "'new.off'\n")
        self.assertEqual(self.files(), ["out.off"])
        self.expect(0, "convert", self.mesh, "new.off", "new.vert", "--no-header")
        self.assertNotIn("#", (self.folder / "new.vert").read_text())


class NothingToMesh(CliTest):
    def test_level_above_phi_everywhere(self):
        for old in [None, "an older mesh\n"]:
            if old is not None:
                self.mesh.write_text(old)
            result = self.expect(CANNOT_MESH, self.molecule("methanol"), "--d", 0.6, "--c", 1e6, "-o", self.mesh)
            self.assertRegex((result.stdout + result.stderr).lower(), "nothing to mesh")
            self.assertEqual(self.files(), [] if old is None else ["out.off"])
            if old is not None:
                self.assertEqual(self.mesh.read_text(), old)


class TooLarge(CliTest):
    """A sphere of 50,000 A: at the least spacing it has more triangles than can be numbered, at others more than any
    machine has room for."""

    def test_a_mesh_that_is_too_large_is_not_begun(self):
        atom = self.write("large.xyzr", "0 0 0 50000\n")
        for options, said in [(["--spacing", 0.01], r"some 7\.3e\+14 .* can be numbered; choose a larger spacing$"),
                              (["--spacing", 0.01, "--raw"], r"some 7\.3e\+14 triangles .* choose a larger spacing$"),
                              (["--spacing", 3], r"some 8\.1e\+09 triangles .* can be numbered"),
                              (["--tolerance", 1e-6, "--spacing", 9], r"choose a larger spacing or tolerance$")]:
            error = self.expect(CANNOT_MESH, atom, *options, "-o", self.mesh).stderr
            self.assertRegex(error.strip(), said)
            self.assertEqual(self.files(), ["large.xyzr"])


class NearCritical(CliTest):
    """Two atoms at the very isovalue where their spheres touch: phi at the middle is c up to rounding."""

    def setUp(self):
        super().setUp()
        atom = "ATOM {0} C X 1 {1} 0.0 0.0 0.0 1.0\n"
        self.touching = self.write("touching.pqr", atom.format(1, "-1.5") + atom.format(2, "1.5"))
        # phi(0) = 2 exp(-0.6 (1.5^2 - 1)) = 2 exp(-0.75), a saddle point.
        self.level = repr(2 * 0.4723665527410147)

    def test_names_the_place_and_exits_4(self):
        result = self.expect(CANNOT_MESH, self.touching, "--d", 0.6, "--c", self.level, "-o", self.mesh)
        self.assertIn("critical", result.stderr)
        self.assertEqual(self.files(), ["touching.pqr"])

    def test_can_be_told_to_go_on(self):
        report = self.folder / "report.json"
        self.expect(0, self.touching, "--d", 0.6, "--c", self.level, "-o", self.mesh, "--allow-uncertified",
                    "--report", report)
        self.assertIs(json.loads(report.read_text())["certified"], False)


class Report(CliTest):
    def report(self):
        file = self.folder / "report.json"
        self.expect(0, self.molecule("dmso"), "--d", 0.6, "--c", 1.7, "-o", self.mesh, "--report", file)
        return json.loads(file.read_text(), parse_constant=lambda text: self.fail(f"{text} is not JSON"))

    def test_what_was_made(self):
        said = self.report()
        self.assertEqual(said["atoms"], 10)
        self.assertIs(said["certified"], True)
        self.assertEqual(said["chi"], 2)
        vertices, triangles = map(int, self.mesh.read_text().split()[1:3])
        self.assertEqual((said["vertices"], said["triangles"]), (vertices, triangles))
        self.assertEqual((said["options"]["decay_per_A2"], said["options"]["isovalue"]), (0.6, 1.7))
        self.assertEqual(said["options"]["spacing_A"], 0.5)
        self.assertLess(said["vertex_distance_max_A"], 1e-6)

    def test_the_proof(self):
        proof = self.report()["proof"]
        levels = proof["boxes_per_level"]
        self.assertGreater(sum(level["boxes"] for level in levels), 0)
        smallest = min(level["size_A"] for level in levels if level["boxes"] > 0)
        self.assertAlmostEqual(smallest / proof["smallest_box_A"], 1.0, places=12)
        for key in ["cells", "cells_cut_by_folds", "cells_split"]:
            self.assertGreaterEqual(proof[key], 0)
        self.assertEqual(proof["critical_places"], [])

    def test_each_component(self):
        said = self.report()
        self.assertEqual(len(said["components"]), 1)
        component = said["components"][0]
        self.assertEqual((component["genus"], component["chi"]), (0, 2))
        self.assertAlmostEqual(component["area_A2"], said["area_A2"])
        self.assertAlmostEqual(component["volume_A3"], 99.0, delta=2.0)  # of the exact surface, data/

    def test_time_and_memory_of_each_stage(self):
        stages = self.report()["stages"]
        self.assertGreaterEqual(len(stages), 5)
        for stage in stages:
            self.assertGreaterEqual(stage["time_s"], 0.0, stage)
            self.assertGreater(stage["peak_memory_MB"], 0.0, stage)


class Surfaces(CliTest):
    """Presets, probe and cavities."""

    def report(self, *arguments):
        self.expect(0, *arguments, "-o", self.mesh, "--report", self.folder / "r.json")
        return json.loads((self.folder / "r.json").read_text())

    def test_presets_are_their_parameters(self):
        pairs = {"ses-volume": (0.6, 1.7), "ses-area": (0.4, 1.8), "ses-hausdorff": (0.4, 1.2), "vdw": (2.0, 1.0)}
        for name, (decay, isovalue) in pairs.items():
            with self.subTest(name):
                options = self.report(self.molecule("methanol"), "--preset", name)["options"]
                self.assertEqual((options["decay_per_A2"], options["isovalue"]), (decay, isovalue))
                by_name = self.mesh.read_bytes()
                self.expect(0, self.molecule("methanol"), "--d", decay, "--c", isovalue, "-o", self.mesh)
                self.assertEqual(self.mesh.read_bytes(), by_name)

    def test_probe_is_added_to_every_radius(self):
        atom = "ATOM 1 C X 1 0.0 0.0 0.0 0.0 {}\n"
        self.write("large.pqr", atom.format(3.4))
        self.write("small.pqr", atom.format(2.0))
        said = self.report("small.pqr", "--preset", "sas")
        self.assertEqual(said["options"]["probe_radius_A"], 1.4)
        grown = self.mesh.read_bytes()
        self.expect(0, "large.pqr", "--d", 2.0, "--c", 1.0, "-o", self.mesh)
        self.assertEqual(self.mesh.read_bytes(), grown)
        self.expect(0, "small.pqr", "--d", 2.0, "--c", 1.0, "--probe", 1.4, "-o", self.mesh)
        self.assertEqual(self.mesh.read_bytes(), grown)

    def test_a_preset_and_a_parameter_are_too_much(self):
        self.expect(WRONG_USE, self.molecule("methanol"), "--preset", "vdw", "--d", 1.0, "-o", self.mesh)
        self.assertEqual(self.files(), [])

    def shell(self):
        """A ball in a shell: two outsides, one cavity."""
        atoms, count = ["ATOM 1 C X 1 0.0 0.0 0.0 0.0 1.5"], 300
        for i in range(count):
            z = 1 - 2 * (i + 0.5) / count
            x, y = (7 * (1 - z * z) ** 0.5 * f(2.399963 * i) for f in (math.cos, math.sin))
            atoms.append(f"ATOM {i + 2} C X 1 {x:.6f} {y:.6f} {7 * z:.6f} 0.0 1.5")
        return self.write("shell.pqr", "\n".join([*atoms, ""]))

    def kinds(self, said):
        return [component["kind"] for component in said["components"]]

    def test_cavities(self):
        shell = self.shell()
        kept = self.report(shell, "--spacing", 1)
        self.assertEqual(self.kinds(kept), ["outside", "cavity", "outside"])
        self.assertEqual(kept["left_out"]["components"], 0)
        self.expect(0, "check", self.mesh)
        cavity, ball = -kept["components"][1]["volume_A3"], kept["components"][2]["volume_A3"]
        for options in [["--cavities", "drop"], ["--min-cavity-volume", cavity + 1]]:
            with self.subTest(options):
                dropped = self.report(shell, "--spacing", 1, *options)
                self.assertEqual(self.kinds(dropped), ["outside"])
                self.assertEqual(dropped["left_out"]["components"], 2, "the ball goes with the hole that it is in")
                self.assertAlmostEqual(dropped["left_out"]["volume_A3"], cavity - ball, places=6)
                self.assertAlmostEqual(dropped["volume_A3"], kept["components"][0]["volume_A3"], places=6)
                self.expect(0, "check", self.mesh)
        same = self.report(shell, "--spacing", 1, "--min-cavity-volume", cavity - 1)
        self.assertEqual(self.kinds(same), self.kinds(kept))

    def test_separate_surfaces(self):
        kept = self.report(self.shell(), "--spacing", 1)
        self.mesh.unlink()
        self.expect(0, "shell.pqr", "--spacing", 1, "--cavities", "separate", "-o", self.mesh, "-o", "s.ply")
        self.assertEqual(self.files(), [*(f"out_{i}.off" for i in (1, 2, 3)), "r.json",
                                        *(f"s_{i}.ply" for i in (1, 2, 3)), "shell.pqr"])
        volumes = []
        for i in (1, 2, 3):
            self.run_program("check", f"out_{i}.off", "--json", "c.json")
            volumes.append(json.loads((self.folder / "c.json").read_text())["volume_A3"])
        self.assertEqual([c["parent"] for c in kept["components"]], [None, 0, 1])
        said = self.expect(0, "shell.pqr", "--spacing", 1, "--cavities", "separate", "-o", self.mesh,
                           "--report", "s.json")
        self.assertRegex(said.stdout, "out_1.off to .*out_3.off: ")
        report = json.loads((self.folder / "s.json").read_text())
        self.assertEqual(self.kinds(report), ["outside", "outside", "cavity"])
        self.assertEqual([c["parent"] for c in report["components"]], [None, 2, 0])
        wanted = [c["volume_A3"] for c in report["components"]]
        self.assertEqual(wanted, [kept["components"][i]["volume_A3"] for i in (0, 2, 1)], "outsides first")
        for got, volume in zip(volumes, wanted):
            self.assertAlmostEqual(got, volume, places=6)
        self.assertNotIn("cavity by itself", self.expect(0, "check", "out_1.off").stdout)
        self.assertIn("is this a cavity by itself", self.expect(CHECK_FAILED, "check", "out_3.off").stdout)


    def test_files_of_more_surfaces_are_told(self):
        for name in ["out_2.off", "out_3.off", "out_5.off", "s_2.face"]:
            self.write(name, "old\n")
        atom = self.write("atom.pqr", BadInput.GOOD)
        separate = [atom, "--cavities", "separate", "--spacing", 1, "-o", "out.off", "-o", "s.vert"]
        said = self.expect(0, *separate).stderr
        self.assertEqual(said, "gaussmesh: warning: expected no more than out_1.off, got out_2.off to out_3.off too, "
                               "which an earlier run may have left\n")
        self.assertEqual((self.folder / "out_2.off").read_text(), "old\n")
        self.assertEqual(self.expect(0, *separate, "--quiet").stderr, "")


class Running(CliTest):
    """Streams, what is said, configuration, and being stopped."""

    def test_standard_input_and_output(self):
        self.expect(0, self.molecule("methanol"), "-o", self.mesh)
        piped = self.expect(0, "-", "-o", "-", stdin=self.molecule("methanol").read_text())
        self.assertEqual(piped.stdout, self.mesh.read_text(), "nothing else on standard output")
        self.assertIn("certified", piped.stderr)
        report = self.expect(0, self.molecule("methanol"), "-o", self.mesh, "--report", "-")
        self.assertEqual(json.loads(report.stdout)["atoms"], 3)

    @unittest.skipUnless(sys.platform == "linux", "elsewhere the program begins only once")
    def test_threads_sleep_while_they_wait(self):
        """The program gives itself the policy, unless the user has said something, and keeps its name."""
        def policy(**said):
            environment = {k: v for k, v in os.environ.items() if k not in ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT")}
            with subprocess.Popen([settings.program, self.molecule("fas2"), "--spacing", "0.1", "-o", self.mesh],
                                  env={**environment, **said}, stdout=subprocess.DEVNULL) as process:
                until = time.monotonic() + 60
                while time.monotonic() < until:
                    has = pathlib.Path(f"/proc/{process.pid}/environ").read_bytes()
                    found = re.search(rb"OMP_WAIT_POLICY=(\w+)", has)
                    if found:
                        break
                name = pathlib.Path(f"/proc/{process.pid}/comm").read_text(encoding="utf-8").strip()
                process.terminate()
            self.assertEqual(name, settings.program.name[:15])
            return found and found[1].decode()
        self.assertEqual(policy(), "passive")
        self.assertEqual(policy(OMP_WAIT_POLICY="active"), "active")

    def test_quiet_and_verbose(self):
        quiet = self.expect(0, self.molecule("methanol"), "-o", self.mesh, "--quiet")
        self.assertEqual(quiet.stdout + quiet.stderr, "")
        self.assertIn("boxes", self.expect(0, self.molecule("methanol"), "-o", self.mesh, "--verbose").stdout)
        wrong = self.expect(BAD_INPUT, "none.pqr", "-o", self.mesh, "--quiet")
        self.assertNotEqual(wrong.stderr, "")

    def test_configuration_file(self):
        self.write("run.toml", 'decay = 0.4\nisovalue = 1.8\noutput = ["a.off", "a.ply"]\nquiet = true\n')
        self.expect(0, self.molecule("methanol"), "--config", "run.toml")
        self.expect(0, self.molecule("methanol"), "--preset", "ses-area", "-o", self.mesh)
        self.assertEqual((self.folder / "a.off").read_bytes(), self.mesh.read_bytes())
        self.assertIn("a.ply", self.files())
        self.write("run.toml", b'\xef\xbb\xbfoutput = "b.off"\r\n')
        self.expect(0, self.molecule("methanol"), "--config", "run.toml")
        self.assertIn("b.off", self.files())
        self.write("wrong.toml", "# decay\nspacing = 1\ndecya = 0.4\n")
        self.assertEqual(self.expect(WRONG_USE, self.molecule("methanol"), "--config", "wrong.toml").stderr,
                         "gaussmesh: wrong.toml:3: expected an option of gaussmesh, got 'decya'; did you mean "
                         "'decay'?\n")
        self.expect(BAD_INPUT, self.molecule("methanol"), "--config", "none.toml")

    def test_the_command_line_comes_before_the_configuration_file(self):
        """Also where the file has what excludes an option on the line."""
        def options(text, *arguments):
            self.write("run.toml", text)
            self.expect(0, self.molecule("methanol"), "--config", "run.toml", "-o", self.mesh, "--report", "r.json",
                        *arguments)
            return json.loads((self.folder / "r.json").read_text())["options"]

        said = options('preset = "vdw"\n', "--d", 0.5)
        self.assertEqual((said["decay_per_A2"], said["isovalue"]), (0.5, 1.7))
        said = options("d = 0.5\nc = 1.2\n", "--preset", "vdw")
        self.assertEqual((said["decay_per_A2"], said["isovalue"]), (2.0, 1.0))
        self.assertEqual(options("decay = 0.5\n", "--d", 0.7)["decay_per_A2"], 0.7)
        self.assertEqual(options("spacing = 1\n", "--density", 2)["spacing_A"], (2 / (3**0.5 * 2)) ** 0.5)
        self.assertEqual(options("density = 2\n", "--spacing", 1)["spacing_A"], 1.0)
        self.assertEqual(options("tolerance = 0.5\n", "--raw")["tolerance_A"], 0.0)
        self.assertIs(options("raw = true\n", "--tolerance", 0.5)["improve"], True)
        self.assertIs(options("raw = false\ntolerance = 0.5\n")["improve"], True)
        self.write("run.toml", f'molecule = "{self.molecule("methanol")}"\nquiet = true\no = "{self.mesh}"\n')
        self.assertIn("cells", self.expect(0, "--config", "run.toml", "--verbose").stdout)

    def test_the_configuration_file_is_named_with_its_line(self):
        molecule = self.molecule("methanol")
        for text, said in [("# no option\n\nspacing = 0\n",
                            "3: --spacing: expected a number from 0.01 to 200, with --raw to 1000, got '0'"),
                           ('preset = "vdv"\n', "1: --preset: expected ses-volume"),
                           ("c = 1.2\nthreads = 1.5\n",
                            "2: --threads: expected a whole number from 0 to 4096, got '1.5'"),
                           ("quiet = maybe\n", "1: --quiet: expected true or false, got 'maybe'"),
                           ('decay = 0.5\nc = 1\npreset = "vdw"\n',
                            "[13]: expected --(d or --preset|preset or --d), got both"),
                           ("d = 0.5\nc = 1\ndecay = 0.6\n", "3: expected each option once, got 'decay' again"),
                           ("d = 0.5\nc = 1\nd = 0.6\n", "3: expected each option once, got 'd' again"),
                           ("c = 1\n[foo]\nbar = 1\n", r"2: expected options without sections, got '\[foo\]'"),
                           ("[check]\njson = \"x\"\n", "1: expected options without sections"),
                           ("c.d = 1\n", "1: expected an option of gaussmesh, got 'c.d'"),
                           ("help = true\n", "1: expected an option of gaussmesh, got 'help'")]:
            self.write("run.toml", text)
            error = self.expect(WRONG_USE, molecule, "--config", "run.toml", "-o", self.mesh).stderr
            self.assertRegex(error, r"^gaussmesh: run\.toml:" + said)
        self.write("run.toml", "spacing = 1\n")
        error = self.expect(WRONG_USE, molecule, "--config", "run.toml", "-o", self.mesh, "--spacing", 0).stderr
        self.assertRegex(error, "^gaussmesh: --spacing: ")

    def test_the_nearest_name_is_told(self):
        for word, meant in [("--tread", "--threads"), ("--isovalu", "--isovalue"), ("--spacin=3", "--spacing")]:
            self.assertIn(f"'{meant}'", self.expect(WRONG_USE, self.molecule("methanol"), word).stderr)
        self.assertIn("'vdw'", self.expect(WRONG_USE, self.molecule("methanol"), "--preset", "vwd").stderr)
        self.assertIn("'drop'", self.expect(WRONG_USE, self.molecule("methanol"), "--cavities", "dorp").stderr)
        self.assertIn("'check'", self.expect(WRONG_USE, "chek", self.mesh).stderr)
        self.assertIn("'--json'", self.expect(WRONG_USE, "check", self.mesh, "--jason").stderr)
        self.assertIn("did you mean 'sas'", self.expect(WRONG_USE, self.molecule("methanol"), "--preset", "SAS").stderr)
        for words in [["--radii", "parse"], ["--preset", "spheres"], ["second.pqr"], ["--nothing-like-it"]]:
            self.assertNotIn("did you mean", self.expect(WRONG_USE, self.molecule("methanol"), *words).stderr)
        self.assertIn("'--tolerance'", self.expect(WRONG_USE, "check", self.mesh, "--tol", 1).stderr)

    def test_the_report_cannot_be_written(self):
        self.mesh.write_text("an older mesh\n")
        self.expect(BAD_INPUT, self.molecule("methanol"), "-o", self.mesh, "--report", "no/such/folder.json")
        self.assertEqual(self.mesh.read_text(), "an older mesh\n")

    def test_one_file_for_two_outputs(self):
        for other in ["./out.off", self.mesh]:
            self.expect(WRONG_USE, self.molecule("methanol"), "-o", "out.off", "-o", other)
        self.expect(WRONG_USE, self.molecule("methanol"), "-o", "out.off", "--report", "out.off")
        self.assertEqual(self.files(), [])

    def test_what_is_read_is_not_replaced(self):
        molecule = self.write("mol.pqr", self.molecule("methanol").read_text())
        text = molecule.read_bytes()
        (self.folder / "link.off").symlink_to("mol.pqr")
        self.expect(0, "mol.pqr", "-o", self.mesh)
        mesh = self.mesh.read_bytes()
        for command in [["mol.pqr", "-o", "mol.pqr", "--format", "off"], ["mol.pqr", "-o", "link.off"],
                        ["mol.pqr", "-o", "new.off", "--report", "./mol.pqr"],
                        ["check", "out.off", "mol.pqr", "--json", "out.off"],
                        ["compare", "out.off", "out.off", "--json", "./out.off"],
                        ["convert", "out.off", "mol.pqr", "--format", "off", "--molecule", "mol.pqr"],
                        ["measure", "out.off", "mol.pqr", "--atom-areas", "mol.pqr"],
                        ["mol.pdb", "--radii-file", "mol.pqr", "-o", "new.off", "--report", "mol.pqr"],
                        ["check", "out.off", "mol.pdb", "--radii-file", "mol.pqr", "--json", "mol.pqr"],
                        ["convert", "out.off", "mol.pqr", "--format", "off", "--molecule", "m.pdb", "--radii-file",
                         "mol.pqr"],
                        ["measure", "out.off", "mol.pdb", "--radii-file", "mol.pqr", "--json", "mol.pqr"]]:
            self.assertIn("which is read", self.expect(WRONG_USE, *command).stderr)
        self.assertEqual((molecule.read_bytes(), self.mesh.read_bytes()), (text, mesh))
        self.assertEqual(self.files(), ["link.off", "mol.pqr", "out.off"])
        self.write("run.toml", "spacing = 1\n")
        for outputs in [["-o", "run.toml", "--format", "off"], ["-o", "new.off", "--report", "./run.toml"]]:
            self.assertIn("than 'run.toml', which is read",
                          self.expect(WRONG_USE, "--config", "run.toml", "mol.pqr", *outputs).stderr)
        self.assertEqual((self.folder / "run.toml").read_text(), "spacing = 1\n")

    def test_separate_surfaces_replace_nothing_that_is_read_or_written(self):
        molecule = self.write("mol_1.pqr", self.molecule("methanol").read_text())
        text = molecule.read_bytes()
        separate = ["mol_1.pqr", "--cavities", "separate", "--format", "off"]
        error = self.expect(WRONG_USE, *separate, "-o", "mol.pqr").stderr
        self.assertIn("expected another file to write than 'mol_1.pqr'", error)
        error = self.expect(WRONG_USE, *separate, "-o", "out.off", "--report", "out_1.off").stderr
        self.assertIn("expected each output once, got 'out_1.off' again", error)
        self.assertIn("got smesh", self.expect(WRONG_USE, *separate[:3], "-o", "out.smesh").stderr)
        self.assertEqual(molecule.read_bytes(), text)
        self.assertEqual(self.files(), ["mol_1.pqr"])

    def test_links_and_permissions(self):
        (self.folder / "link.off").symlink_to("out.off")
        self.expect(0, self.molecule("methanol"), "-o", "link.off")
        self.assertTrue((self.folder / "link.off").is_symlink())
        self.mesh.chmod(0o640)
        self.expect(0, self.molecule("methanol"), "-o", "link.off")
        self.assertEqual(self.mesh.stat().st_mode & 0o777, 0o640)
        (self.folder / "loop.off").symlink_to("loop.off")
        self.assertIn("symbolic links", self.expect(BAD_INPUT, self.molecule("methanol"), "-o", "loop.off").stderr)
        self.assertEqual(self.files(), ["link.off", "loop.off", "out.off"])

    def test_a_named_pipe(self):
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        with subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE) as reader:
            self.expect(0, self.molecule("methanol"), "-o", pipe, "--format", "off", "-o", self.mesh)
            self.assertEqual(reader.communicate()[0], self.mesh.read_bytes())

    @unittest.skipUnless(sys.platform == "linux", "elsewhere the names in /dev/fd are no links")
    def test_pipes_of_the_shell(self):
        """`>(command)` is a name in /dev/fd; what is said goes elsewhere where standard output is the mesh."""
        self.expect(0, self.molecule("methanol"), "-o", self.mesh)
        run = f"{settings.program} {self.molecule('methanol')} --format off --max-memory 1G"
        for command in [f"{run} -o >(cat > a.off) -o >(cat > b.off)",
                        f"{run} -o /dev/stdout | cat > a.off; {run} -o /dev/fd/1 | cat > b.off"]:
            made = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertEqual(made.returncode, 0, made.stderr)
            until = time.monotonic() + 20  # the shell does not wait for the commands in >()
            for name in ["a.off", "b.off"]:
                while (self.folder / name).stat().st_size < self.mesh.stat().st_size and time.monotonic() < until:
                    time.sleep(0.01)
                self.assertEqual((self.folder / name).read_bytes(), self.mesh.read_bytes(), command)

    def test_full_disk(self):
        """The first file fits the limit, the second does not: neither appears."""
        self.mesh.write_text("an older mesh\n")
        command = f"ulimit -f 8; exec {settings.program} {self.molecule('fas2')} --spacing 2 -o out.off -o out.ply"
        result = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, BAD_INPUT, result.stderr)
        self.assertRegex(result.stderr, "out.off: .*too large")
        self.assertEqual(self.files(), ["out.off"])
        self.assertEqual(self.mesh.read_text(), "an older mesh\n")
        self.expect(BAD_INPUT, self.molecule("methanol"), "-o", "/dev/full", "--format", "off")
        with open("/dev/full", "w", encoding="utf-8") as full:
            for command in [["--help"], [self.molecule("methanol"), "-o", "good.off"]]:
                self.assertEqual(subprocess.run([settings.program, *command], cwd=self.folder, stdout=full,
                                                stderr=subprocess.DEVNULL, check=False).returncode, BAD_INPUT)

    def test_nothing_is_replaced_where_nothing_can_be_said(self):
        self.expect(0, self.molecule("methanol"), "-o", "m.off")
        self.mesh.write_text("an older mesh\n")
        for command in ([self.molecule("methanol"), "-o", "out.off"],
                        [self.molecule("methanol"), "-o", "out.off", "--max-memory", "1G"],
                        ["check", "m.off", "--json", "out.off"], ["compare", "m.off", "m.off", "--json", "out.off"],
                        ["measure", "m.off", self.molecule("methanol"), "--atom-areas", "out.off"]):
            for out in (">/dev/full", ">&-"):
                run = " ".join(map(str, [settings.program, *command, out]))
                result = subprocess.run(["bash", "-c", run], cwd=self.folder, capture_output=True, text=True,
                                        check=False)
                self.assertEqual((result.returncode, result.stderr),
                                 (BAD_INPUT, "gaussmesh: standard output: cannot be written to\n"), run)
                self.assertEqual(self.mesh.read_text(), "an older mesh\n")
        self.assertEqual(self.files(), ["m.off", "out.off"])

    def test_closed_streams(self):
        """The molecule is no part of what is said, and what is said none of the mesh."""
        self.expect(0, self.molecule("methanol"), "-o", self.mesh)
        run = f"{settings.program} {self.molecule('methanol')} -o a.off 2>&- <&-; echo $?"
        said = subprocess.run(["bash", "-c", run], cwd=self.folder, capture_output=True, text=True, check=True).stdout
        self.assertEqual(said.splitlines()[-1], "0")
        self.assertEqual((self.folder / "a.off").read_bytes(), self.mesh.read_bytes())

    def test_folders_that_are_not_there(self):
        (self.folder / "gone").mkdir()
        run = f"cd gone && rmdir ../gone && {settings.program} {self.molecule('methanol')} -o "
        for output, code in [("b.off", BAD_INPUT), (self.mesh, 0)]:
            result = subprocess.run(["bash", "-c", f"{run} {output}"], cwd=self.folder, capture_output=True, text=True,
                                    check=False)
            self.assertEqual(result.returncode, code, result.stderr)
            (self.folder / "gone").mkdir()
            if code != 0:
                self.assertRegex(result.stderr, "^gaussmesh: b.off: expected an output file in the working directory, "
                                                "which cannot be found: No such file")
        result = subprocess.run([settings.program, self.molecule("methanol"), "-o", "-", "--max-memory", "1G"],
                                env={**os.environ, "TMPDIR": "/no/such"}, capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stderr),
                         (BAD_INPUT, "gaussmesh: max-memory: expected a folder for the temporary file in the variable "
                                     "TMPDIR, got '/no/such'\n"))

    def test_long_names(self):
        """As long as the file system takes them, which temporary names have to be too."""
        for name in ["a" * 251 + ".off", "\u00fc" * 125 + ".off", "b" * 256 + ".off"]:
            fits = len(name.encode()) <= 255
            result = self.expect(0 if fits else BAD_INPUT, self.molecule("methanol"), "-o", name, "-o", "x.ply")
            self.assertEqual(self.files(), sorted([name, "x.ply"]) if fits else [], result.stderr)
            for file in self.folder.iterdir():
                file.unlink()

    def test_a_signal_while_writing(self):
        """A pipe that nobody reads holds the program in the middle of its second output; the first is temporary."""
        for name in ["SIGINT", "SIGTERM", "SIGHUP"]:
            with self.subTest(name):
                self.mesh.write_text("an older mesh\n")
                pipe = self.folder / "pipe"
                if not pipe.exists():
                    os.mkfifo(pipe)
                reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
                process = subprocess.Popen([settings.program, self.molecule("fas2"), "--spacing", "1.5", "--quiet",
                                            "--format", "off", "-o", self.mesh, "-o", pipe], cwd=self.folder)
                deadline = time.monotonic() + 60
                while len(self.files()) < 3 and time.monotonic() < deadline:
                    time.sleep(0.01)
                self.assertEqual(len(self.files()), 3, "a temporary file beside the mesh")
                time.sleep(0.2)
                process.send_signal(getattr(signal, name))
                self.assertEqual(process.wait(30), -getattr(signal, name))
                os.close(reader)
                self.assertEqual(self.files(), ["out.off", "pipe"])
                self.assertEqual(self.mesh.read_text(), "an older mesh\n")

    def test_two_runs_at_once_in_one_folder(self):
        runs = [subprocess.Popen([settings.program, self.molecule("dmso"), "--quiet", "-o", self.mesh], cwd=self.folder)
                for _ in range(4)]
        self.assertEqual([run.wait(60) for run in runs], [0] * 4)
        self.assertEqual(self.files(), ["out.off"])
        self.expect(0, "check", self.mesh)

    def test_a_bar_on_a_terminal_for_long_runs_only(self):
        for arguments, is_long in [(["methanol"], False), (["fas2", "--spacing", "0.2", "--threads", "1"], True)]:
            mine, theirs = os.openpty()
            command = [settings.program, self.molecule(arguments[0]), *arguments[1:], "-o", self.mesh]
            start = time.monotonic()
            subprocess.run(command, stdout=subprocess.DEVNULL, stderr=theirs, timeout=200, check=True)
            is_long = is_long or time.monotonic() - start > 1.0  # on a machine that is busy
            os.close(theirs)
            drawn = b""
            try:
                while piece := os.read(mine, 65536):
                    drawn += piece
            except OSError:  # the end of a terminal
                pass
            os.close(mine)
            self.assertEqual(b"[#" in drawn or b"[.." in drawn, is_long, drawn)
            if is_long:
                self.assertTrue(drawn.endswith(b"\r\x1b[K"), "and nothing is left of it")


class Manual(CliTest):
    def test_every_option_is_there(self):
        pages = {kind: self.expect(0, "--print-manual", kind).stdout for kind in ("man", "bash", "zsh")}
        for command in [[], ["check"], ["convert"], ["measure"], ["compare"]]:
            for option in re.findall(r"--[a-z][a-z-]*", self.expect(0, *command, "--help").stdout):
                self.assertIn(option.replace("-", "\\-"), pages["man"])
                self.assertIn(option, pages["bash"])
                self.assertIn(option, pages["zsh"])

    def test_every_line_of_help_has_a_default(self):
        for command in [[], ["check"], ["convert"], ["measure"], ["compare"]]:
            text = self.expect(0, *command, "--help").stdout
            self.assertLessEqual(max(map(len, text.splitlines())), 112)
            entries = re.split(r"\n  (?=-)", text.split("\n\nCommands", 1)[0].split("\n\nExamples", 1)[0])[1:]
            self.assertGreater(len(entries), 1)
            for entry in entries:
                if not re.match("-h|--version", entry):
                    self.assertRegex(entry, r"default:|required", entry)

    def test_bash_completes(self):
        script = self.write("complete", self.expect(0, "--print-manual", "bash").stdout)
        for words, wanted in [("gaussmesh --pres", "--preset"), ("gaussmesh che", "check"),
                              ("gaussmesh check --js", "--json"), ("gaussmesh m.pqr --preset s", "ses-volume ses-area "
                               "ses-hausdorff sas"), ("gaussmesh m.pqr -o m", "")]:
            line = words.split()
            ask = (f"source {script}; COMP_WORDS=({words}); COMP_CWORD={len(line) - 1}; _gaussmesh; "
                   "echo ${COMPREPLY[@]}")
            said = subprocess.run(["bash", "-c", ask], capture_output=True, text=True, check=True).stdout
            self.assertEqual(said.strip(), wanted)


class Check(CliTest):
    VERTICES = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"]
    FACES = ["3 0 2 1", "3 0 1 3", "3 0 3 2", "3 1 2 3"]

    def off(self, faces, vertices=None):
        vertices = vertices or self.VERTICES
        return self.write("mesh.off", "\n".join(["OFF", f"{len(vertices)} {len(faces)} 0", *vertices, *faces, ""]))

    def test_tetrahedron(self):
        self.assertIn("OK", self.expect(0, "check", self.off(self.FACES)).stdout)

    def test_hole(self):
        self.assertNotIn("OK", self.expect(CHECK_FAILED, "check", self.off(self.FACES[:3])).stdout)

    def test_one_face_turned(self):
        self.expect(CHECK_FAILED, "check", self.off([*self.FACES[:3], "3 1 3 2"]))

    def test_inside_out(self):
        turned = [" ".join([f, a, c, b]) for f, a, b, c in map(str.split, self.FACES)]
        self.expect(CHECK_FAILED, "check", self.off(turned))

    def test_one_is_no_plural(self):
        said = self.expect(CHECK_FAILED, "check", self.off(["3 0 1 7"], self.VERTICES[:3])).stdout
        self.assertIn("3 vertices, 1 triangle\n", said)
        self.assertIn("FAILED: 1 triangle that names a missing vertex; 3 vertices in no triangle", said)
        said = self.expect(CHECK_FAILED, "check", self.off(self.FACES, [*self.VERTICES, "9 9 9"]),
                           "--min-separation", 1.3)
        self.assertIn("FAILED: 1 vertex in no triangle; 3 pairs of vertices too near to each other", said.stdout)
        self.assertIn("3 pairs, 3 of them joined", said.stdout)

    def test_crossing_tetrahedra(self):
        moved = ["0.1 0.1 0.1", "1.1 0.1 0.1", "0.1 1.1 0.1", "0.1 0.1 1.1"]
        shifted = [" ".join(["3", *(str(int(v) + 4) for v in face.split()[1:])]) for face in self.FACES]
        self.expect(CHECK_FAILED, "check", self.off(self.FACES + shifted, self.VERTICES + moved))

    def test_not_a_mesh(self):
        result = self.expect(BAD_INPUT, "check", self.write("mesh.off", "OFF\n1 1 0\n0 0 zero\n3 0 0 0\n"))
        self.assertRegex(result.stderr, r"mesh\.off:3: .+")

    def test_reads_standard_input(self):
        mesh = self.off(self.FACES)
        self.assertIn("OK", self.expect(0, "check", "-", stdin=mesh.read_text()).stdout)
        self.expect(0, "convert", "-", "-", "--format", "off", stdin=mesh.read_text())

    def test_reads_what_is_written_for_paraview(self):
        self.expect(0, self.molecule("methanol"), "-o", "m.vtp")
        self.expect(0, "check", "m.vtp", self.molecule("methanol"))

    def test_presets_and_defaults_are_those_of_meshing(self):
        self.expect(0, self.molecule("methanol"), "-o", self.mesh)
        self.expect(0, "check", self.mesh, self.molecule("methanol"))
        self.expect(CHECK_FAILED, "check", self.mesh, self.molecule("methanol"), "--preset", "sas")
        self.expect(0, self.molecule("methanol"), "--preset", "sas", "-o", self.mesh)
        self.expect(0, "check", self.mesh, self.molecule("methanol"), "--preset", "sas")
        self.expect(WRONG_USE, "check", self.mesh, "--preset", "sas")

    def test_off_the_surface(self):
        self.expect(0, self.molecule("methanol"), "--d", 0.6, "--c", 1.7, "-o", self.mesh)
        self.expect(0, "check", self.mesh, self.molecule("methanol"), "--d", 0.6, "--c", 1.7)
        self.expect(CHECK_FAILED, "check", self.mesh, self.molecule("methanol"), "--d", 0.6, "--c", 1.6)


class CheckForSolvers(CliTest):
    def setUp(self):
        super().setUp()
        self.expect(0, self.molecule("dmso"), "--d", 0.6, "--c", 1.7, "-o", self.mesh)

    def findings(self, *arguments, code=0):
        return json.loads(self.expect(code, "check", self.mesh, *arguments, "--json", "-").stdout)

    def test_the_mesh_of_another_surface(self):
        """The cavity of fas2 is not there at (0.4, 1.2)."""
        self.expect(0, self.molecule("fas2"), "--spacing", 0.8, "-o", self.mesh)
        other = self.expect(CHECK_FAILED, "check", self.mesh, self.molecule("fas2"), "--d", 0.4, "--c", 1.2)
        self.assertIn("inf: from some of these no way leads to the surface", other.stdout)
        near = self.expect(CHECK_FAILED, "check", self.mesh, self.molecule("fas2"), "--c", 1.69)
        self.assertNotIn("inf", near.stdout)

    def test_charges_outside_are_named(self):
        atoms = self.molecule("dmso").read_text()
        self.assertEqual(self.findings(self.molecule("dmso"), "--d", 0.6, "--c", 1.7)["charges_outside"], [])
        stray = "HETATM   99  CL  ION     9      90.000   0.000   0.000 -1.000  0.00\n"
        molecule = self.write("stray.pqr", stray + atoms)
        said = self.expect(CHECK_FAILED, "check", self.mesh, molecule, "--d", 0.6, "--c", 1.7).stdout
        self.assertIn("1 charge outside the mesh", said.splitlines()[-1])
        self.assertEqual(self.findings(molecule, "--d", 0.6, "--c", 1.7, code=CHECK_FAILED)["charges_outside"], [0])

    def test_charges_are_not_judged_by_a_mesh_with_a_hole(self):
        lines = self.mesh.read_text().splitlines()
        vertices, triangles, _ = map(int, lines[1].split())
        self.mesh.write_text("\n".join(["OFF", f"{vertices} {triangles - 1} 0", *lines[2:-1], ""]))
        said = self.expect(CHECK_FAILED, "check", self.mesh, self.molecule("dmso")).stdout
        self.assertIn("which ones turn the wrong way, and which charges are outside, is not known\n", said)
        self.assertNotIn("outside the mesh", said)
        self.assertIsNone(self.findings(self.molecule("dmso"), code=CHECK_FAILED)["charges_outside"])
        self.assertNotIn("charges", self.expect(CHECK_FAILED, "check", self.mesh).stdout)

    def test_vertices_that_are_too_near(self):
        near = self.findings("--min-separation", 1e-9)["near_vertices"]
        self.assertEqual((near["separation_A"], near["pairs"], near["short_edges"]), (1e-9, 0, 0))
        failed = self.expect(CHECK_FAILED, "check", self.mesh, "--min-separation", 0.5)
        self.assertRegex(failed.stdout.splitlines()[-1], r"FAILED: [0-9]+ pairs of vertices too near")
        self.expect(WRONG_USE, "check", self.mesh, "--min-separation", 0)

    def test_a_warning_of_slivers_and_not_of_small_triangles(self):
        self.expect(0, self.molecule("dmso"), "--raw", "-o", self.folder / "raw.off")
        for mesh, is_warned in [(self.mesh, False), (self.folder / "raw.off", True)]:
            self.assertEqual("WARNING" in self.expect(0, "check", mesh).stdout, is_warned, mesh)
        self.expect(0, self.molecule("dmso"), "--spacing", 0.04, "-o", self.mesh)
        near = self.findings()["near_vertices"]
        self.assertGreater(near["pairs"], 1000)
        self.assertEqual(near["crowded"], 0)

    def test_a_cavity_turned_the_wrong_way(self):
        def sphere(size, order):
            corners = [(size, 0, 0), (-size, 0, 0), (0, size, 0), (0, -size, 0), (0, 0, size), (0, 0, -size)]
            faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
            return corners, [tuple(face[i] for i in order) for face in faces]

        def mesh(*parts):
            corners, faces = [], []
            for part_corners, part_faces in parts:
                faces += [[v + len(corners) for v in face] for face in part_faces]
                corners += part_corners
            rows = [" ".join(map(str, p)) for p in corners] + [" ".join(map(str, [3, *f])) for f in faces]
            return self.write("nested.off", "\n".join(["OFF", f"{len(corners)} {len(faces)} 0", *rows, ""]))

        out, inwards = (0, 1, 2), (0, 2, 1)
        self.expect(0, "check", mesh(sphere(5, out), sphere(1, inwards)))
        cavity = self.expect(CHECK_FAILED, "check", mesh(sphere(5, out), sphere(1, out))).stdout
        self.assertIn("1 cavity whose faces turn outwards", cavity.splitlines()[-1])
        corners, faces = sphere(5, out)
        opened = self.expect(CHECK_FAILED, "check", mesh((corners, faces[1:]), sphere(1, inwards))).stdout
        self.assertNotIn("inwards", opened.splitlines()[-1], "the cavity is turned as it should be")
        outside = self.expect(CHECK_FAILED, "check", mesh(sphere(5, inwards), sphere(1, inwards))).stdout
        self.assertIn("1 outer surface whose faces turn inwards", outside.splitlines()[-1])


class Measure(CliTest):
    def setUp(self):
        super().setUp()
        self.atom = self.write("atom.pqr", "ATOM 1 C X 1 1.0 2.0 3.0 0.5 2.0\n")
        self.expect(0, self.atom, "--d", 0.6, "--c", 1.7, "--spacing", 0.2, "-o", self.mesh)
        self.radius = (2.0**2 - math.log(1.7) / 0.6) ** 0.5

    def test_a_sphere(self):
        said = json.loads(self.expect(0, "measure", self.mesh, self.atom, "--json", "-").stdout)
        self.assertAlmostEqual(said["area_A2"], 4 * math.pi * self.radius**2, delta=0.3)
        self.assertAlmostEqual(said["volume_A3"], 4 / 3 * math.pi * self.radius**3, delta=0.3)
        self.assertEqual([c["kind"] for c in said["components"]], ["outside"])
        self.assertAlmostEqual(said["mean_relative_vdw_distance"], self.radius / 2.0 - 1, places=6)
        self.assertAlmostEqual(said["atom_areas_A2"][0], said["area_A2"], places=6)

    def test_areas_in_a_file(self):
        areas = self.folder / "areas.txt"
        text = self.expect(0, "measure", self.mesh, self.atom, "--atom-areas", areas).stdout
        self.assertIn("Atoms with a share of the area: 1 of 1", text)
        number, area, *names = areas.read_text().split()
        self.assertEqual((number, names), ("1", ["C", "X", ".", "1"]))
        self.assertAlmostEqual(float(area), 4 * math.pi * self.radius**2, delta=0.3)
        self.expect(WRONG_USE, "measure", self.mesh, "--atom-areas", areas)

    def test_areas_have_the_names_of_their_atoms(self):
        records = ["ATOM      1  CA  GLY B  12A     -1.000   2.000   3.000  1.00 10.00           C",
                   "HETATM    2 FE   HEM C  13       1.000   2.000   3.000  1.00 10.00          FE"]
        columns = ["group_PDB", "type_symbol", "label_atom_id", "label_comp_id", "label_asym_id", "auth_asym_id",
                   "auth_seq_id", "pdbx_PDB_ins_code", "Cartn_x", "Cartn_y", "Cartn_z"]
        rows = ["ATOM C CA GLY A B 12 A -1.0 2.0 3.0", "HETATM FE FE HEM D C 13 ? 1.0 2.0 3.0"]
        self.write("m.pdb", "\n".join(records))
        self.write("m.cif", "\n".join(["data_M", "loop_", *("_atom_site." + c for c in columns), *rows, ""]))
        self.write("m.pqr", "ATOM 1 CA GLY B 12A -1.0 2.0 3.0 0 1.7\nHETATM 2 FE HEM C 13 1.0 2.0 3.0 0 1.7\n")
        self.write("m.xyzr", "-1.0 2.0 3.0 1.7\n1.0 2.0 3.0 1.7\n")
        self.write("my.radii", "C 1.7\nFE 1.7\n")
        self.expect(0, "m.pqr", "-o", self.mesh)
        tables = {}
        for molecule in ["m.pdb", "m.cif", "m.pqr", "m.xyzr"]:
            radii = ["--radii-file", "my.radii"] if molecule in ("m.pdb", "m.cif") else []
            said = self.expect(0, "measure", self.mesh, molecule, *radii, "--atom-areas", "-").stdout
            tables[molecule] = [line.split() for line in said.splitlines()]
            self.assertEqual([row[:2] for row in tables[molecule]], [row[:2] for row in tables["m.pdb"]], molecule)
        wanted = [["CA", "GLY", "B", "12A"], ["FE", "HEM", "C", "13"]]
        for molecule in ["m.pdb", "m.cif", "m.pqr"]:
            self.assertEqual([row[2:] for row in tables[molecule]], wanted, molecule)
        self.assertEqual([row[2:] for row in tables["m.xyzr"]], [["."] * 4] * 2)

    def test_files_appear_together(self):
        error = self.expect(WRONG_USE, "measure", self.mesh, self.atom, "--atom-areas", "x", "--json", "./x").stderr
        self.assertIn("expected each output once, got 'x' again", error)
        self.expect(BAD_INPUT, "measure", self.mesh, self.atom, "--atom-areas", "x", "--json", "no/such/x")
        self.assertEqual(self.files(), ["atom.pqr", "out.off"])
        piped = self.expect(0, "measure", self.mesh, self.atom, "--atom-areas", "-", "--json", "x")
        self.assertRegex(piped.stdout, r"^1 [\d.]+ C X \. 1\n$", "nothing else on standard output")
        self.assertIn("Atoms with a share", piped.stderr)

    def test_without_a_molecule(self):
        self.assertNotIn("van der Waals", self.expect(0, "measure", self.mesh).stdout)

    def test_no_mesh_to_measure(self):
        bad = self.write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")
        self.assertIn("got 1 triangle that names a missing vertex and 0 vertices without usable coordinates",
                      self.expect(BAD_INPUT, "measure", bad).stderr)


class Compare(CliTest):
    def sphere(self, name, radius):
        molecule = self.write(f"{name}.pqr", f"ATOM 1 C X 1 0.0 0.0 0.0 0.0 {radius}\n")
        self.expect(0, molecule, "--d", 0.6, "--c", 1.0, "--spacing", 0.2, "-o", self.folder / f"{name}.off")
        return self.folder / f"{name}.off"

    def test_two_spheres(self):
        small, large = self.sphere("small", 1.5), self.sphere("large", 1.7)
        said = json.loads(self.expect(0, "compare", small, large, "--density", 100, "--json", "-").stdout)
        self.assertAlmostEqual(said["hausdorff_A"], 0.2, delta=0.01)
        self.assertGreaterEqual(said["hausdorff_bound_A"], said["hausdorff_A"])
        for side in ["first_to_second", "second_to_first"]:
            self.assertAlmostEqual(said[side]["mean_A"], 0.2, delta=0.01)
            self.assertGreaterEqual(said[side]["rms_A"], said[side]["mean_A"])
        self.assertIn("Hausdorff distance: 0.", self.expect(0, "compare", small, large).stdout)
        same = json.loads(self.expect(0, "compare", small, small, "--json", "-").stdout)
        self.assertLess(same["hausdorff_A"], 1e-12)

    def test_wrong_use(self):
        mesh = self.sphere("small", 1.5)
        self.expect(WRONG_USE, "compare", mesh)
        self.expect(WRONG_USE, "compare", mesh, mesh, "--density", 0)
        self.expect(BAD_INPUT, "compare", mesh, self.write("empty.off", "OFF\n0 0 0\n"))


class Help(CliTest):
    """Help texts are golden files, compared word by word: line breaks are the argument parser's business."""

    def same_as_golden(self, name, *arguments):
        text = self.expect(0, *arguments).stdout.replace(str(settings.program), "gaussmesh")
        golden = GOLDEN / f"{name}.txt"
        if settings.update_golden:
            golden.parent.mkdir(exist_ok=True)
            golden.write_text(text)
        self.assertEqual(text.lower().split(), golden.read_text().lower().split())

    def test_program(self):
        self.same_as_golden("help", "--help")

    def test_check(self):
        self.same_as_golden("help_check", "check", "--help")

    def test_convert(self):
        self.same_as_golden("help_convert", "convert", "--help")

    def test_measure(self):
        self.same_as_golden("help_measure", "measure", "--help")

    def test_compare(self):
        self.same_as_golden("help_compare", "compare", "--help")

    def test_version(self):
        self.assertRegex(self.expect(0, "--version").stdout, re.compile(r"^(gaussmesh )?\d+\.\d+\.\d+\n$"))


if __name__ == "__main__":
    sys.exit(run_tests(__name__))
