// Files and streams as text in memory, expanded where they are gzip.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>

namespace gaussmesh {

/// What a file is read for, which decides what messages advise.
enum class ReadFor { kMolecule, kMesh };

/// The whole file. Gzip is known by its first bytes; data that expand to more than 64 MiB and 200-fold are refused.
///
/// @throws InputError if it is missing, a directory, unreadable, corrupt gzip, or compressed by bzip2, xz or zstd
std::string read_file(const std::filesystem::path& path, ReadFor purpose = ReadFor::kMolecule);

/// What is left of `input`, in the same way; `name` stands for it in messages.
std::string read_stream(std::istream& input, std::string_view name, ReadFor purpose = ReadFor::kMolecule);

/// `name` without a `.gz` at its end, in any case.
std::string_view without_gzip(std::string_view name);

/// Whether `name` ends in `extension`, in any case, perhaps before a `.gz`. `extension` has its dot.
bool has_extension(std::string_view name, std::string_view extension);

}  // namespace gaussmesh
