// Meshes and texts that appear together or not at all; each by whole_file.h.

#include <utility>

#include "core/parallel.h"
#include "gaussmesh/write_mesh.h"
#include "write/mesh_formats.h"

namespace gaussmesh {

struct OutputFiles::State {
  std::vector<WholeFile> files;
};

OutputFiles::OutputFiles() : state_(std::make_unique<State>()) {}
OutputFiles::~OutputFiles() = default;
OutputFiles::OutputFiles(OutputFiles&&) noexcept = default;
OutputFiles& OutputFiles::operator=(OutputFiles&&) noexcept = default;

void OutputFiles::add_mesh(const TriangleMesh& mesh, const VertexData& data, const std::filesystem::path& path,
                           const WriteOptions& options) {
  const MeshView view{mesh, data, options.msms_header};
  const DefaultThreads threads(thread_count(options.threads));
  for (const FormatPart& part : find_format(path, options).parts) {
    if (part.write == nullptr) continue;
    WholeFile file(part_path(path, part));
    part.write(view, file);
    file.close();
    state_->files.push_back(std::move(file));
  }
}

void OutputFiles::add_text(std::string_view text, const std::filesystem::path& path) {
  WholeFile file(path);
  file.write(text);
  file.close();
  state_->files.push_back(std::move(file));
}

void OutputFiles::commit() {
  const WholeFile::CommitsUnderWay guard;
  if (state_->files.size() > 1) {
    for (WholeFile& file : state_->files) file.keep_old();
  }
  try {
    for (WholeFile& file : state_->files) file.commit();
  } catch (...) {
    for (WholeFile& file : state_->files) file.undo();
    throw;
  }
  state_->files.clear();
}

void write_mesh(const TriangleMesh& mesh, const VertexData& data, const std::filesystem::path& path,
                const WriteOptions& options) {
  OutputFiles files;
  files.add_mesh(mesh, data, path, options);
  files.commit();
}

void write_text(std::string_view text, const std::filesystem::path& path) {
  OutputFiles files;
  files.add_text(text, path);
  files.commit();
}

std::vector<std::filesystem::path> files_of(const std::filesystem::path& path, const WriteOptions& options) {
  std::vector<std::filesystem::path> files;
  for (const FormatPart& part : find_format(path, options).parts) {
    if (part.write != nullptr) files.push_back(part_path(path, part));
  }
  return files;
}

void require_writable(const std::filesystem::path& path) { WholeFile::require_writable(path); }

}  // namespace gaussmesh
