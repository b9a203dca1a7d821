#!/usr/bin/env python3
"""Limits on memory: the same mesh within them, and what is said where they cannot be kept.

    tests/cli/memory_test.py --program build/bin/gaussmesh --data data [CLASS...]
"""

import filecmp
import json
import os
import resource
import shutil
import subprocess
import sys
import unittest

from support import BAD_INPUT, CANNOT_MESH, WRONG_USE, CliTest, run_tests, settings

MIB = 1 << 20


class Memory(CliTest):
    def peak(self, *arguments):
        """Runs the program; returns the most of it that was in memory (bytes), or of this test if that was more."""
        command = [settings.program, *map(str, arguments)]
        with subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
            message = process.stderr.read()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0, message)
        return usage.ru_maxrss * 1024

    def both(self, limit, *arguments):
        """One molecule without and with the limit; returns both peaks. The meshes are the same, bit by bit."""
        molecule = self.molecule("fas2")
        free = self.peak(molecule, *arguments, "--quiet", "-o", "free.off", "--report", "free.json")
        limited = self.peak(molecule, *arguments, "--quiet", "-o", "limited.off", "--report", "limited.json",
                            "--max-memory", limit)
        self.assertTrue(filecmp.cmp(self.folder / "free.off", self.folder / "limited.off", shallow=False))
        reports = [json.loads((self.folder / name).read_text()) for name in ("free.json", "limited.json")]
        for report in reports:
            self.assertEqual([c["kind"] for c in report["components"]], ["outside", "cavity"])
            del report["stages"]
        self.assertEqual(*reports)
        self.assertEqual(self.files(), ["free.json", "free.off", "limited.json", "limited.off"])
        return free, limited

    def test_keeps_the_limit_and_the_mesh(self):
        free, limited = self.both("128M", "--raw", "--spacing", 0.06, "--threads", 2)
        self.assertGreater(free, 140 * MIB, "a limit of 128M is one")
        self.assertLess(limited, 128 * MIB)

    def test_improved_meshes_are_the_same(self):
        self.both("128MiB", "--spacing", 0.3, "--threads", 2)

    def test_sizes(self):
        for size in ("127M", "0", "-1G", "1X", "G", "1.2.3G", "4 apples", "1e8", "-1e9", "1e9M", ""):
            result = self.expect(WRONG_USE, self.molecule("methanol"), "-o", self.mesh, "--max-memory", size)
            self.assertIn("expected a size of at least 128M such as 500M or 4G", result.stderr, size)
        for size in ("128M", "0.25G", "4GB", "2TiB", "200000k", "134217728", "1e9"):
            self.expect(0, self.molecule("methanol"), "-o", self.mesh, "--max-memory", size)

    def test_says_what_there_is_too_little_of(self):
        limit = (1 << 40, 1 << 40)  # less than the addresses of the temporary file
        result = subprocess.run([settings.program, self.molecule("methanol"), "-o", self.mesh, "--max-memory", "128M"],
                                capture_output=True, text=True, check=False,
                                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit))
        self.assertEqual(result.returncode, BAD_INPUT)
        self.assertIn("max-memory: 8 TiB of addresses for the temporary file cannot be had, see ulimit -v: ",
                      result.stderr)

    def test_fewer_threads_than_asked_for(self):
        """Stacks of 1 GiB in 4 GiB of addresses."""
        run = f"ulimit -s {1 << 20}; ulimit -v {4 << 20}; exec {settings.program} "
        self.expect(0, self.molecule("dmso"), "-o", self.mesh)

        def said_by(command):
            result = subprocess.run(["bash", "-c", run + command], cwd=self.folder, capture_output=True, text=True,
                                    check=False, env={**os.environ, "OMP_NUM_THREADS": "20"})
            self.assertEqual(result.returncode, 0, result.stderr)
            return result.stderr

        for command in (f"{self.molecule('dmso')} -o a.off --threads 20", f"convert {self.mesh} a.off"):
            said = said_by(command)
            self.assertRegex(said, "^gaussmesh: warning: expected to start 20 threads, got [1-4]; a limit on "
                                   r"processes or memory \(ulimit -u, -v\) leaves no room for more$")
            self.assertEqual((self.folder / "a.off").read_bytes(), self.mesh.read_bytes())
        for command in (f"convert {self.mesh} a.off", f"check {self.mesh}", f"measure {self.mesh}",
                        f"compare {self.mesh} {self.mesh}"):
            self.assertEqual(said_by(command + " --threads 1"), "", "no more threads are asked for")

    @unittest.skipUnless(os.geteuid() == 0 and shutil.which("mke2fs"), "mounting is for root")
    def test_says_that_a_disk_is_full_that_sets_no_room_aside(self):
        """On ext2, a page that is written to by its mapping would end the program."""
        image, disk = self.folder / "image", self.folder / "disk"
        disk.mkdir()
        with open(image, "wb") as file:
            file.truncate(8 * MIB)
        subprocess.run(["mke2fs", "-q", "-F", image], check=True)
        if subprocess.run(["mount", "-o", "loop", image, disk], capture_output=True, check=False).returncode != 0:
            self.skipTest("no file system can be mounted here")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        error = self.expect(CANNOT_MESH, self.molecule("fas2"), "--raw", "--spacing", 0.1, "-o", disk / "out.off",
                            "--max-memory", "128M").stderr
        self.assertIn("max-memory: no room for the temporary file", error)
        self.assertEqual([path.name for path in disk.iterdir()], ["lost+found"])

    def test_says_that_the_disk_is_full(self):
        """Wherever the file ends: the larger rooms last until the mesh is judged."""
        command = [settings.program, self.molecule("fas2"), "--raw", "--spacing", 0.1, "-o", self.mesh, "--max-memory",
                   "128M", "--quiet"]
        codes = set()
        for room in (8, 100, 190, 195, 200, 205, 210, 400):  # MiB
            limits = (room * MIB, room * MIB)
            result = subprocess.run(list(map(str, command)), cwd=self.folder, capture_output=True, text=True,
                                    timeout=200, check=False,
                                    preexec_fn=lambda limits=limits: resource.setrlimit(resource.RLIMIT_FSIZE, limits))
            codes.add(result.returncode)
            self.assertIn(result.returncode, (0, CANNOT_MESH), f"{room} MiB: {result.stderr}")
            if result.returncode == CANNOT_MESH:
                self.assertIn("max-memory: no room for the temporary file", result.stderr)
                self.assertEqual(self.files(), [])
        self.assertEqual(codes, {0, CANNOT_MESH})


if __name__ == "__main__":
    sys.exit(run_tests(__name__))
