// Writing meshes, and other files, so that each appears whole or not at all.
//
// Reading them is read_mesh.h.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "gaussmesh/vertex_data.h"

namespace gaussmesh {

/// How much of VertexData a format holds.
enum class HeldData { kNothing, kNormals, kAll };

/// A format that meshes can be written in.
struct MeshFormat {
  std::string_view name;                     ///< what WriteOptions::format calls it
  std::vector<std::string_view> extensions;  ///< names of files that mean this format, with their dot
  std::string_view description;              ///< one line: what it holds, and who reads it
  HeldData held = HeldData::kNothing;        ///< of what write_mesh() is given
};

/// All of them. Coordinates have nine decimals in text and 64 bits in binary formats, so that a reader gets back
/// the bits that are in memory; only binary STL has 32 bits, and merges vertices nearer than that.
const std::vector<MeshFormat>& mesh_formats();

struct WriteOptions {
  std::string format;       ///< a name of mesh_formats(); empty: the extension decides, perhaps before a `.gz`, and
                            ///< standard output is OFF
  bool msms_header = true;  ///< the three lines in front of MSMS vertices and faces
  int threads = 0;          ///< 0: as many as there are processors
};

/// Several files that appear together: each is written beside its place, and commit() renames them all. What is not
/// committed leaves nothing behind, and old files are as they were.
///
/// The path `-` is standard output, and devices and pipes are written where they are; there, nothing can be taken
/// back. A symbolic link is followed. What has a name that ends in `.gz`, in any case, is gzipped.
///
/// One object is for one thread at a time; several may be at work at once. Of two that write to one path, the last to
/// commit is there, whole.
class OutputFiles {
 public:
  OutputFiles();
  ~OutputFiles();
  OutputFiles(OutputFiles&&) noexcept;
  OutputFiles& operator=(OutputFiles&&) noexcept;

  /// Writes a mesh; MSMS makes the two files PATH.vert and PATH.face, whichever of them is named.
  ///
  /// Vertex data that are not known are left out; normals and, for MSMS, all of them are replaced as write_mesh()
  /// says.
  /// @param mesh  every vertex number is there
  /// @param data  each list has one entry for each vertex of the mesh, or is empty
  /// @throws OptionError if the format is unknown, or cannot go to standard output
  /// @throws InputError  if a file cannot be written
  ///
  /// Cost: about 0.05 us a triangle for OFF on one core.
  void add_mesh(const TriangleMesh& mesh, const VertexData& data, const std::filesystem::path& path,
                const WriteOptions& options = {});

  /// Makes a file of a text. @throws InputError if it cannot be written
  void add_text(std::string_view text, const std::filesystem::path& path);

  /// @throws InputError if a file cannot be put in its place: then all are as they were, but for what was replaced
  ///                    where the file system knows no hard links
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes one mesh by OutputFiles, whose add_mesh() says what is asked of mesh and data.
///
/// | format | what is written of the vertex data |
/// |---|---|
/// | off | none |
/// | msms | normals (averaged over the triangles if not known), atoms from 1 (else 0), in the header their number |
/// | ply, ply-ascii, vtp | normals, atoms and components from 0 |
/// | obj | normals |
/// | stl, stl-ascii | none |
/// | gmsh22, gmsh41 | components from 1 as tags of the triangles; normals, atoms and components as NodeData |
/// | smesh | components from 1 as markers; a point in each cavity (hole) and in each solid (region) |
///
/// Thread-safe, as OutputFiles says.
void write_mesh(const TriangleMesh& mesh, const VertexData& data, const std::filesystem::path& path,
                const WriteOptions& options = {});

/// Writes one text by OutputFiles.
void write_text(std::string_view text, const std::filesystem::path& path);

/// The format that a mesh of this name is written in. @throws OptionError as OutputFiles::add_mesh() does
const MeshFormat& format_of(const std::filesystem::path& path, const WriteOptions& options = {});

/// The files that a mesh of this name is written to: one, or two of MSMS.
/// @throws OptionError as OutputFiles::add_mesh() does
std::vector<std::filesystem::path> files_of(const std::filesystem::path& path, const WriteOptions& options = {});

/// Throws what writing would, if it is already certain that a file cannot be written: no such folder, no permission.
/// Leaves nothing behind.
void require_writable(const std::filesystem::path& path);

/// Deletes what was begun and is not committed. For signal handlers: nothing but unlink() is called.
///
/// @return false, with nothing done, while OutputFiles::commit() is putting files in their places: these would be
///         torn apart. It takes a moment; the program should end itself when it is back.
[[nodiscard]] bool remove_unfinished_files() noexcept;

}  // namespace gaussmesh
