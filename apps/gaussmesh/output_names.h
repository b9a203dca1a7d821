// Names that follow from that of an output.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "gaussmesh/write_mesh.h"

namespace gaussmesh::app {

/// The name of the file for one of several surfaces: from out.off to out_1.off, from out.off.gz to out_1.off.gz.
std::string numbered(const std::string& output, std::size_t number);

/// The files of such names that are there, from this number up to the first that is not, such as `out_4.off to
/// out_9.off`; empty if there is none.
std::string numbered_from(const std::string& output, std::size_t number, const WriteOptions& writing);

/// Where temporary files for an output belong: beside it, or in the system's folder for them if it is a pipe, a device
/// or standard output. @throws InputError if there is no such folder
std::filesystem::path folder_of_temporary(const std::filesystem::path& output);

}  // namespace gaussmesh::app
