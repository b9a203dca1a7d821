#!/usr/bin/env python3
"""Each format, read back with the programs that people have: meshio, VTK, Gmsh, TetGen.

    tests/cli/formats_test.py --program build/bin/gaussmesh --data data [CLASS...]

The molecule has a cavity, so that holes and components mean something.
"""

import gzip
import itertools
import json
import re
import shutil
import subprocess
import sys

import meshio
import numpy
import vtk
from support import BAD_INPUT, WRONG_USE, CliTest, run_tests, settings
from vtk.util.numpy_support import vtk_to_numpy

LEVEL = ["--d", 0.6, "--c", 1.7, "--spacing", 1.2]


def read_off(path):
    """Vertices and triangles of the exact dialect; anything else is an assertion."""
    lines = path.read_text().splitlines(keepends=True)
    assert all(line.endswith("\n") and len(line) < 98 for line in lines)
    assert lines[0] == "OFF\n"
    vertices, triangles = map(int, re.fullmatch(r"(\d+) (\d+) 0\n", lines[1]).groups())
    assert len(lines) == 2 + vertices + triangles
    number = r"-?\d+\.\d{9}"
    assert all(re.fullmatch(rf"{number} {number} {number}\n", line) for line in lines[2:2 + vertices])
    assert all(re.fullmatch(r"3 \d+ \d+ \d+\n", line) for line in lines[2 + vertices:])
    points = numpy.array([line.split() for line in lines[2:2 + vertices]], float)
    return points, numpy.array([line.split()[1:] for line in lines[2 + vertices:]], int)


def signed_volume(points, triangles):
    a, b, c = (points[triangles[:, k]] - points[0] for k in range(3))
    return float(numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6)


class FormatTest(CliTest):
    """One mesh in every format, made once."""

    made = None

    def setUp(self):
        super().setUp()
        if FormatTest.made is None:
            FormatTest.made = self.make_all()
        for name, content in FormatTest.made.items():
            (self.folder / name).write_bytes(content)
        self.points, self.triangles = read_off(self.folder / "m.off")

    def make_all(self):
        names = ["m.off", "m.vert", "m.ply", "m.obj", "m.stl", "m.msh", "m.smesh", "m.vtp"]
        outputs = [word for name in names for word in ("-o", name)]
        self.expect(0, self.molecule("fas2"), *LEVEL, *outputs)
        self.expect(0, self.molecule("fas2"), *LEVEL, "--format", "ply-ascii", "-o", "ascii.ply")
        self.expect(0, self.molecule("fas2"), *LEVEL, "--format", "gmsh41", "-o", "m41.msh")
        self.expect(0, self.molecule("fas2"), *LEVEL, "--no-header", "-o", "bare.face")
        made = {path.name: path.read_bytes() for path in self.folder.iterdir()}
        self.assertEqual(sorted(made), sorted([*names, "m.face", "ascii.ply", "m41.msh", "bare.vert", "bare.face"]))
        return made

    def same_mesh(self, points, triangles):
        numpy.testing.assert_array_equal(points, self.points)
        numpy.testing.assert_array_equal(triangles, self.triangles)

    def msms(self, name):
        """Vertex and face columns behind the header."""
        skip = 0 if name == "bare" else 3
        return (numpy.loadtxt(self.folder / f"{name}.vert", skiprows=skip),
                numpy.loadtxt(self.folder / f"{name}.face", skiprows=skip, dtype=int))


class Meshio(FormatTest):
    def test_same_mesh(self):
        for name in ["m.off", "m.ply", "ascii.ply", "m.obj", "m.msh"]:
            with self.subTest(name):
                mesh = meshio.read(self.folder / name)
                self.same_mesh(mesh.points, mesh.cells_dict["triangle"])

    def test_gmsh_41(self):
        """Vertices and triangles come by component; the tags say which they are."""
        mesh = meshio.read(self.folder / "m41.msh")
        corners = numpy.sort(mesh.points[mesh.cells_dict["triangle"]].reshape(-1, 9), axis=0)
        numpy.testing.assert_array_equal(corners, numpy.sort(self.points[self.triangles].reshape(-1, 9), axis=0))
        self.assertEqual(len(mesh.cells), 2)

    def test_stl(self):
        mesh = meshio.read(self.folder / "m.stl")
        corners = mesh.points[mesh.cells_dict["triangle"]]
        numpy.testing.assert_array_equal(corners, self.points[self.triangles].astype(numpy.float32))

    def test_vertex_data(self):
        vertices, _ = self.msms("m")
        for name in ["m.ply", "ascii.ply"]:
            data = meshio.read(self.folder / name).point_data
            normals = numpy.stack([data["nx"], data["ny"], data["nz"]], axis=1)
            numpy.testing.assert_allclose(normals, vertices[:, 3:6], atol=2e-9)
            numpy.testing.assert_array_equal(data["atom"] + 1, vertices[:, 7])
            self.assertEqual(set(data["component"]), {0, 1})
        data = meshio.read(self.folder / "m.msh").point_data
        numpy.testing.assert_allclose(data["normal"], vertices[:, 3:6], atol=2e-9)
        numpy.testing.assert_array_equal(data["atom"] + 1, vertices[:, 7])
        normals = meshio.read(self.folder / "m.obj").point_data["obj:vn"]
        numpy.testing.assert_allclose(normals, vertices[:, 3:6], atol=2e-9)


class Vtk(FormatTest):
    def test_vtp(self):
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(str(self.folder / "m.vtp"))
        reader.Update()
        surface = reader.GetOutput()
        triangles = vtk_to_numpy(surface.GetPolys().GetData()).reshape(-1, 4)
        self.assertTrue((triangles[:, 0] == 3).all())
        self.same_mesh(vtk_to_numpy(surface.GetPoints().GetData()), triangles[:, 1:])
        vertices, _ = self.msms("m")
        data = surface.GetPointData()
        numpy.testing.assert_allclose(vtk_to_numpy(data.GetNormals()), vertices[:, 3:6], atol=2e-9)
        numpy.testing.assert_array_equal(vtk_to_numpy(data.GetArray("atom")) + 1, vertices[:, 7])
        components = vtk_to_numpy(data.GetArray("component"))
        edges = vtk.vtkPolyDataConnectivityFilter()
        edges.SetInputData(surface)
        edges.SetExtractionModeToAllRegions()
        edges.Update()
        self.assertEqual(edges.GetNumberOfExtractedRegions(), len(set(components)))

    def test_binary_ply_and_stl(self):
        for reader, name in [(vtk.vtkPLYReader(), "m.ply"), (vtk.vtkSTLReader(), "m.stl"),
                             (vtk.vtkOBJReader(), "m.obj")]:
            with self.subTest(name):
                reader.SetFileName(str(self.folder / name))
                reader.Update()
                self.assertEqual(reader.GetOutput().GetNumberOfPolys(), len(self.triangles))


class Gmsh(FormatTest):
    def test_reads_both_versions(self):
        for name in ["m.msh", "m41.msh"]:
            with self.subTest(name):
                run = subprocess.run(["gmsh", name, "-save_all", "-format", "msh22", "-o", "back.msh", "-save"],
                                     cwd=self.folder, capture_output=True, text=True, timeout=120, check=True)
                self.assertNotRegex(run.stdout + run.stderr, "(?i)warning|error")
                mesh = meshio.read(self.folder / "back.msh")
                self.assertEqual(len(mesh.cells_dict["triangle"]), len(self.triangles))
                self.assertEqual(set(mesh.cell_data_dict["gmsh:geometrical"]["triangle"]), {1, 2})


class TetGen(FormatTest):
    def tetrahedra(self, name):
        """Volume of the tetrahedra that TetGen makes, and their region numbers."""
        subprocess.run(["tetgen", "-pAQ", name], cwd=self.folder, capture_output=True, timeout=280, check=True)
        stem = name.split(".")[0]
        nodes = numpy.loadtxt(self.folder / f"{stem}.1.node", skiprows=1)
        elements = numpy.loadtxt(self.folder / f"{stem}.1.ele", skiprows=1, dtype=int)
        at = {int(number): row for row, number in enumerate(nodes[:, 0])}
        corners = nodes[numpy.vectorize(at.get)(elements[:, 1:5]), 1:4]
        edges = corners[:, 1:] - corners[:, :1]
        return abs(numpy.linalg.det(edges)).sum() / 6, set(elements[:, 5])

    def test_fills_the_solid_and_not_the_cavity(self):
        volume, regions = self.tetrahedra("m.smesh")
        # TetGen merges facets that are nearly coplanar.
        self.assertAlmostEqual(volume / signed_volume(self.points, self.triangles), 1.0, delta=1e-5)
        self.assertEqual(regions, {1})

    def test_takes_the_triangles_as_they_are_for_a_mesh_of_good_shape(self):
        for name in ["1a1p", "1bna"]:
            with self.subTest(name):
                self.expect(0, self.molecule(name), "-o", f"{name}.off")
                run = subprocess.run(["tetgen", "-pq1.4/0", f"{name}.off"], cwd=self.folder, capture_output=True,
                                     text=True, timeout=280)
                self.assertEqual(run.returncode, 0)
                self.assertNotRegex(run.stdout + run.stderr, "(?i)error|warning|intersect|degenerate|skipped")
                points, triangles = read_off(self.folder / f"{name}.off")
                tetrahedra = int((self.folder / f"{name}.1.ele").read_text().split()[0])
                self.assertGreater(tetrahedra, len(triangles))

    def test_several_solids_and_nested_ones(self):
        """A ball in the cavity of a shell, and one beside it: two holes would be one too many."""
        molecule = ["ATOM 1 C X 1 0.0 0.0 0.0 0.0 1.5", "ATOM 2 C X 1 30.0 0.0 0.0 0.0 1.5"]
        count, golden = 400, numpy.pi * (3 - 5 ** 0.5)
        for i in range(count):
            z = 1 - 2 * (i + 0.5) / count
            x, y = (8 * (1 - z * z) ** 0.5 * f(golden * i) for f in (numpy.cos, numpy.sin))
            molecule.append(f"ATOM {i + 3} C X 1 {x:.6f} {y:.6f} {8 * z:.6f} 0.0 1.5")
        self.write("shell.pqr", "\n".join([*molecule, ""]))
        self.expect(0, "shell.pqr", *LEVEL, "-o", "shell.smesh", "-o", "shell.off")
        lines = (self.folder / "shell.smesh").read_text().splitlines()
        self.assertEqual(lines[-4].split()[0], "3", "solids: the shell, and two balls")
        self.assertEqual(lines[-6].split()[0], "1", "cavities: one")
        volume, regions = self.tetrahedra("shell.smesh")
        # TetGen merges facets that are nearly coplanar.
        self.assertAlmostEqual(volume / signed_volume(*read_off(self.folder / "shell.off")), 1.0, delta=1e-5)
        self.assertEqual(len(regions), 3)

    def test_its_surfaces_are_read(self):
        """Of OFF it makes a .smesh with nodes in a .node file, those inside the solid too."""
        self.expect(0, self.molecule("methanol"), "-o", "p.off")
        subprocess.run(["tetgen", "-pYq", "p.off"], cwd=self.folder, capture_output=True, timeout=280, check=True)
        nodes = int((self.folder / "p.1.node").read_text().split()[0])
        self.assertGreater(nodes, len(read_off(self.folder / "p.off")[0]))
        said = json.loads(self.expect(0, "compare", "p.off", "p.1.smesh", "--json", "-").stdout)
        self.assertLess(said["hausdorff_A"], 1e-9)
        self.expect(0, "check", "p.1.smesh")

    def test_reads_stl_as_text(self):
        self.expect(0, self.molecule("methanol"), "--format", "stl-ascii", "-o", "p.stl")
        self.expect(0, self.molecule("methanol"), "-o", "p.off")
        volume, _ = self.tetrahedra("p.stl")
        self.assertAlmostEqual(volume / signed_volume(*read_off(self.folder / "p.off")), 1.0, delta=1e-5)

    def test_reads_off(self):
        # Without holes it fills the cavity too.
        volume, _ = self.tetrahedra("m.off")
        self.assertGreater(volume, signed_volume(self.points, self.triangles))


class Msms(FormatTest):
    def test_columns(self):
        for name in ["m", "bare"]:
            with self.subTest(name):
                for suffix, columns, count in [("vert", 9, len(self.points)), ("face", 5, len(self.triangles))]:
                    text = (self.folder / f"{name}.{suffix}").read_text()
                    lines = text.splitlines()
                    self.assertTrue(text.endswith("\n"))
                    if name == "m":
                        self.assertTrue(lines[0].startswith("#") and lines[1].startswith("#"))
                        self.assertEqual(int(lines[2].split()[0]), count)
                        lines = lines[3:]
                    self.assertEqual({len(line.split()) for line in lines}, {columns})
                    self.assertEqual(len(lines), count)
                vertices, faces = self.msms(name)
                self.same_mesh(vertices[:, :3], faces[:, :3] - 1)

    def test_headers_have_the_number_of_atoms(self):
        """No vertex is nearest to the last atom of methanol; solvers still have to take its charge."""
        molecule, parts = self.molecule("methanol"), ["vert", "face"]

        def spheres(name):
            return [(self.folder / f"{name}.{part}").read_text().splitlines()[2].split()[1] for part in parts]

        self.expect(0, molecule, "-o", "a.vert", "-o", "a.off")
        self.expect(0, molecule, "--cavities", "separate", "-o", "a.vert")
        self.expect(0, "convert", "a.off", "b.vert", "--molecule", molecule)
        self.expect(0, "convert", "a.face", "c.vert")
        for name in ["a", "a_1", "b", "c"]:
            self.assertEqual(spheres(name), ["3", "3"], name)

    def test_normals_point_into_the_solvent(self):
        vertices, faces = self.msms("m")
        normals = vertices[:, 3:6]
        numpy.testing.assert_allclose(numpy.linalg.norm(normals, axis=1), 1.0, atol=1e-6)
        a, b, c = (self.points[faces[:, k] - 1] for k in range(3))
        along = numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), normals[faces[:, 0] - 1])
        self.assertGreater((along > 0).mean(), 0.99)

    def test_nearest_atoms(self):
        atoms = numpy.array([line.split()[-5:] for line in self.molecule("fas2").read_text().splitlines()
                             if line.startswith("ATOM")], float)
        vertices, _ = self.msms("m")
        chosen = atoms[vertices[:, 7].astype(int) - 1]
        for i in range(0, len(vertices), 50):
            powers = ((atoms[:, :3] - vertices[i, :3]) ** 2).sum(axis=1) - atoms[:, 4] ** 2
            mine = ((chosen[i, :3] - vertices[i, :3]) ** 2).sum() - chosen[i, 4] ** 2
            self.assertAlmostEqual(mine, powers.min(), delta=1e-9)


class Convert(FormatTest):
    def test_vertex_data_survive(self):
        for source in ["m.ply", "m.vtp"]:
            self.expect(0, "convert", source, "n.vert", "n.off", "n.msh", "n.vtp", "n.ply")
            for suffix in ["vert", "face", "off", "msh", "vtp", "ply"]:
                self.assertEqual((self.folder / f"n.{suffix}").read_bytes(), FormatTest.made[f"m.{suffix}"], suffix)

    def test_vtp_as_vtk_writes_it(self):
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(str(self.folder / "m.vtp"))
        writer = vtk.vtkXMLPolyDataWriter()
        writer.SetInputConnection(reader.GetOutputPort())
        writer.SetFileName(str(self.folder / "n.vtp"))
        writer.SetBlockSize(4096)
        modes = [vtk.vtkXMLWriter.Ascii, vtk.vtkXMLWriter.Binary, vtk.vtkXMLWriter.Appended]
        for mode, encoded, compressed, little, wide in itertools.product(modes, (0, 1), (0, 1), (0, 1), (0, 1)):
            with self.subTest(mode=mode, encoded=encoded, compressed=compressed, little=little, wide=wide):
                writer.SetDataMode(mode)
                writer.SetEncodeAppendedData(encoded)
                writer.SetCompressorTypeToZLib() if compressed else writer.SetCompressorTypeToNone()
                writer.SetByteOrderToLittleEndian() if little else writer.SetByteOrderToBigEndian()
                writer.SetHeaderTypeToUInt64() if wide else writer.SetHeaderTypeToUInt32()
                self.assertEqual(writer.Write(), 1)
                self.expect(0, "convert", "n.vtp", "n.ply")
                if mode != vtk.vtkXMLWriter.Ascii:  # whose numbers are not all that they were
                    self.assertEqual((self.folder / "n.ply").read_bytes(), FormatTest.made["m.ply"])
        writer.SetCompressorTypeToLZ4()
        writer.Write()
        self.assertIn("expected vtkZLibDataCompressor", self.expect(BAD_INPUT, "check", "n.vtp").stderr)

    def test_between_text_formats(self):
        for name in ["m.vert", "m.obj", "m.msh", "m.smesh", "ascii.ply", "bare.face"]:
            with self.subTest(name):
                self.assertEqual(self.expect(0, "convert", name, "-").stdout, (self.folder / "m.off").read_text())

    def test_gzipped_where_the_name_says_so(self):
        names = ["m.off", "m.vert", "m.ply", "m.obj", "m.stl", "m.msh", "m.smesh", "m.vtp"]
        self.expect(0, "convert", "m.ply", *(f"n{name[1:]}.gz" for name in names))
        for name in [*names, "m.face"]:
            with self.subTest(name):
                packed = (self.folder / f"n{name[1:]}.gz").read_bytes()
                self.assertEqual(gzip.decompress(packed), FormatTest.made[name])
                self.assertLess(len(packed), 0.8 * len(FormatTest.made[name]))
        self.expect(0, "check", "n.face.gz")
        self.expect(0, "convert", "m.ply", "c.Vert.GZ")
        self.assertEqual(gzip.decompress((self.folder / "c.Vert.GZ").read_bytes()), FormatTest.made["m.vert"])
        self.expect(0, "check", "c.Vert.GZ")
        self.expect(0, self.molecule("dmso"), *LEVEL, "--cavities", "separate", "-o", "s.OFF.GZ", "--format", "ply",
                    "--report", "r.json.gz")
        self.assertTrue(gzip.decompress((self.folder / "s_1.OFF.GZ").read_bytes()).startswith(b"ply\n"))
        self.assertEqual(json.loads(gzip.decompress((self.folder / "r.json.gz").read_bytes()))["atoms"], 10)
        error = self.expect(WRONG_USE, "convert", "m.off", "x.of.gz").stderr
        self.assertIn("got '.of'; did you mean '.off'?", error)

    def test_nearest_atoms_on_request(self):
        self.expect(0, "convert", "m.obj", "n.vert", "--molecule", self.molecule("fas2"))
        self.assertEqual((self.folder / "n.vert").read_bytes(), FormatTest.made["m.vert"])

    def test_normals_that_a_file_has_not_are_averaged(self):
        self.expect(0, "convert", "m.off", "n.ply", "n.obj", "n.vtp", "n.msh", "n.vert", "n.off")
        vertices, _ = self.msms("n")
        self.assertGreater(numpy.einsum("ij,ij->i", vertices[:, 3:6], self.msms("m")[0][:, 3:6]).min(), 0.7)
        data = meshio.read(self.folder / "n.ply").point_data
        normals = numpy.stack([data["nx"], data["ny"], data["nz"]], axis=1)
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(str(self.folder / "n.vtp"))
        reader.Update()
        for got in [normals, meshio.read(self.folder / "n.obj").point_data["obj:vn"],
                    meshio.read(self.folder / "n.msh").point_data["normal"],
                    vtk_to_numpy(reader.GetOutput().GetPointData().GetNormals())]:
            numpy.testing.assert_allclose(got, vertices[:, 3:6], atol=2e-9)
        self.assertEqual((self.folder / "n.off").read_bytes(), FormatTest.made["m.off"])

    def test_files_that_other_programs_wrote(self):
        mesh = meshio.Mesh(self.points, [("triangle", self.triangles)])
        for name, options in [("o.off", {}), ("o.ply", {"binary": True}), ("p.ply", {"binary": False}), ("o.obj", {}),
                              ("o.stl", {"binary": True}), ("p.stl", {"binary": False}),
                              ("o.msh", {"file_format": "gmsh22", "binary": False}),
                              ("p.msh", {"file_format": "gmsh", "binary": False}),
                              ("q.msh", {"file_format": "gmsh22"}), ("r.msh", {"file_format": "gmsh"})]:
            with self.subTest(name):
                mesh.write(self.folder / name, **options)
                judged = self.expect(0, "check", name)
                self.assertIn(f"{len(self.triangles)} triangles", judged.stdout)

    def test_binary_files_of_gmsh(self):
        for version in ["msh22", "msh41"]:
            with self.subTest(version):
                subprocess.run(["gmsh", "m41.msh", "-save_all", "-bin", "-format", version, "-o", "b.msh", "-save"],
                               cwd=self.folder, capture_output=True, timeout=120, check=True)
                self.assertIn(b" 1 8\n", (self.folder / "b.msh").read_bytes()[:32])
                judged = self.expect(0, "check", "b.msh")
                self.assertIn(f"{len(self.triangles)} triangles", judged.stdout)

    def test_surfaces_of_gmsh_that_are_not_of_triangles_are_refused(self):
        (self.folder / "ball.geo").write_text('SetFactory("OpenCASCADE");\nSphere(1) = {0, 0, 0, 1};\n')
        for extra in [["-format", "msh22"], ["-format", "msh41"], ["-format", "msh22", "-bin"],
                      ["-format", "msh41", "-bin"]]:
            with self.subTest(extra):
                subprocess.run(["gmsh", "-2", "-order", "2", "ball.geo", *extra, "-o", "ball.msh"], cwd=self.folder,
                               capture_output=True, timeout=120, check=True)
                result = self.expect(BAD_INPUT, "convert", "ball.msh", "ball.off")
                self.assertIn("expected a triangle of 3 nodes, type 2, got a triangle of 6, type 9", result.stderr)
                self.assertNotIn("ball.off", self.files())

    def test_a_mesh_with_missing_vertices_is_refused(self):
        self.write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n")
        self.expect(BAD_INPUT, "convert", "bad.off", "new.ply")
        self.assertNotIn("new.ply", self.files())

    def test_a_mesh_with_holes_has_no_inside(self):
        self.write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.expect(0, "convert", "bad.off", "new.ply")
        result = self.expect(BAD_INPUT, "convert", "bad.off", "new.smesh")
        self.assertIn("closed", result.stderr)


class Names(CliTest):
    """Which format is chosen, and what is said where there is none."""

    def refused(self, *arguments, names):
        result = self.expect(WRONG_USE, self.molecule("methanol"), *arguments)
        self.assertIn(names, result.stderr)
        self.assertEqual(self.files(), [])

    def test_unknown_extension(self):
        self.refused("-o", "mesh.offf", names="'.off'")
        self.refused("-o", "mesh", names="extension")

    def test_unknown_format(self):
        self.refused("-o", "mesh.off", "--format", "gmesh41", names="'gmsh41'")

    def test_upper_case(self):
        self.expect(0, self.molecule("methanol"), "-o", "M.OFF", "-o", "M.VERT")
        self.assertEqual(self.files(), ["M.OFF", "M.VERT", "M.face"])

    def test_no_second_output_is_written_where_the_first_cannot_be(self):
        self.expect(BAD_INPUT, self.molecule("methanol"), "-o", "good.off", "-o", "no/such/folder.off")
        self.assertEqual(self.files(), [])

    def test_both_files_of_msms_may_be_named(self):
        both = ["-o", "a.vert", "-o", "a.face"]
        said = self.expect(0, self.molecule("methanol"), *both, "-o", "a.off")
        self.assertTrue(said.stdout.startswith("a.vert: "))
        self.assertEqual(self.files(), ["a.face", "a.off", "a.vert"])
        self.expect(0, self.molecule("methanol"), *both, "--cavities", "separate")
        self.expect(0, "convert", "a.off", "b.face", "b.vert")
        self.assertEqual(self.files(), ["a.face", "a.off", "a.vert", "a_1.face", "a_1.vert", "b.face", "b.vert"])
        twice = self.expect(WRONG_USE, self.molecule("methanol"), *both, "-o", "./a.face", "-o", "a.vert")
        self.assertIn("expected each output once", twice.stderr)

    def test_msms_is_two_files(self):
        self.refused("-o", "-", "--format", "msms", names="two files")


if __name__ == "__main__":
    assert shutil.which("gmsh") and shutil.which("tetgen")
    sys.exit(run_tests(__name__))
