// Reading meshes in the formats that write_mesh.h writes, and as other programs write them.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string_view>

#include "gaussmesh/triangle_mesh.h"
#include "gaussmesh/vertex_data.h"

namespace gaussmesh {

/// What a mesh file holds.
struct MeshFile {
  TriangleMesh mesh;
  VertexData data;  ///< what the format has of it; lists that it has not are empty
};

/// Reads a mesh of triangles, plain or gzipped.
///
/// PLY, VTP and Gmsh files are known by their first bytes; OFF, OBJ, STL, TetGen .smesh and MSMS by their extension, in
/// any case, before a `.gz` if there is one; files of any other name, and streams, by what is in them, which tells all
/// but MSMS. Of MSMS either file may be named: both are read.
///
/// - OFF: comments, blank lines, colours of faces, and colours and places in a texture of vertices (`COFF`, `STOFF`)
///   are passed over. Normals of `NOFF` and `CNOFF` are kept. Binary OFF, and vertices in four or more dimensions, are
///   refused.
/// - PLY: ascii and binary of either byte order; other properties and elements are passed over.
/// - OBJ: `v`, `vn` and `f`, the rest is passed over. Normals are kept where every corner has that of its vertex.
/// - STL: binary and ascii. Corners at the very same place become one vertex, in the order in which they first
///   appear; corners that are merely near each other do not.
/// - Gmsh: versions 2.2 and 4.1, in ASCII and in binary with the least significant byte first. Triangles of 3 nodes are
///   kept, points, lines and solids passed over; then nodes in no triangle are left out. Triangles of more nodes and
///   quadrangles are refused, and a file that has elements but no triangles.
/// - smesh: nodes and facets of one triangle each, counted from 0 or from 1. Where it has no nodes, as TetGen writes
///   it, they are those of the .node file beside it that are in a triangle.
/// - VTP: triangles of all pieces; arrays as text, in base64 or as they are in memory, plain or by zlib, in the element
///   or appended. Normals, and arrays `atom` and `component` of whole numbers, are kept; vertices and lines are passed
///   over. Strips, and data by LZ4 or LZMA, are refused.
/// - MSMS: with header or without; normals, and the nearest atom where every vertex has one; the number of atoms, which
///   are its spheres, from the header of the vertices.
///
/// Normals are scaled to length 1. Nothing is judged here but the format: a vertex number that is too large is left to
/// check_mesh() in all formats where vertices are numbered by their place. What a file announces is believed only as
/// far as it is long.
///
/// @throws InputError if the file cannot be read, or is not what its format says; the message names the line, or the
///         byte of a binary file. Polygons of more than three corners are refused.
///
/// Cost: one pass over the file in memory, about 0.1 us a triangle; STL sorts nothing, it hashes. Thread-safe.
MeshFile read_mesh(const std::filesystem::path& path);

/// Reads what is left of `input`, plain or gzipped; as parse_mesh() with that name.
MeshFile read_mesh(std::istream& input, std::string_view name);

/// Reads what is already in memory, except MSMS, which is two files; `name` decides the format as above, and stands
/// for the file in messages.
MeshFile parse_mesh(std::string_view bytes, std::string_view name);

/// Reads the two texts of MSMS.
MeshFile parse_msms(std::string_view vertices, std::string_view vertices_name, std::string_view faces,
                    std::string_view faces_name);

}  // namespace gaussmesh
