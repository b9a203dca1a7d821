// Which format a file of atoms is in; the formats themselves are parse_pqr.cpp, parse_xyzr.cpp, parse_pdb.cpp and
// parse_mmcif.cpp.
#include "gaussmesh/read_atoms.h"

#include <algorithm>

#include "atoms/close_atoms.h"
#include "atoms/radii.h"
#include "gaussmesh/error.h"
#include "gaussmesh/nearest_name.h"
#include "text/read_file.h"

namespace gaussmesh {
namespace {

/// Other formats of molecules, by the ends of names. The PQR reader would say that they have no atoms, or are no text.
struct OtherFormat {
  const char* extension;
  const char* name;
};
constexpr OtherFormat kNotRead[] = {{".bcif", "BinaryCIF"}, {".gro", "GRO"}, {".mmtf", "MMTF"}, {".mol", "MOL"},
                                    {".mol2", "MOL2"},      {".sdf", "SDF"}, {".xyz", "XYZ"}};

/// Throws InputError if `name` means one of these.
void require_read(std::string_view name) {
  for (const OtherFormat& other : kNotRead) {
    if (!has_extension(name, other.extension)) continue;
    throw InputError(std::string(name) + ": expected PQR, XYZR, PDB or mmCIF, got " + other.name +
                     " by its name, which is not read; have another program write it as one of these, or if it is one, "
                     "say so with --input-format");
  }
}

/// The format that the name of a file means. @throws InputError if that is not read
std::string format_of_name(std::string_view name) {
  for (const char* extension : {".xyzr", ".xyzrn", ".xyzrq"}) {
    if (has_extension(name, extension)) return "xyzr";
  }
  for (const char* extension : {".pdb", ".ent", ".pdbqt"}) {
    if (has_extension(name, extension)) return "pdb";
  }
  if (has_extension(name, ".cif") || has_extension(name, ".mmcif")) return "mmcif";
  require_read(name);
  return "pqr";
}

std::string choose_format(std::string_view name, const ReadOptions& options) {
  if (options.format.empty()) return format_of_name(name);
  const std::vector<std::string>& known = atom_formats();
  if (std::find(known.begin(), known.end(), options.format) != known.end()) return options.format;
  throw OptionError("input format: expected pqr, xyzr, pdb or mmcif, got '" + options.format + "'" +
                    did_you_mean(options.format, known));
}

/// Throws OptionError if `options` give radii to a file of `format`, which has its own.
void require_no_radii(const std::string& format, std::string_view name, const ReadOptions& options) {
  if (options.radii.empty() && options.radii_file.empty()) return;
  const bool is_set = !options.radii.empty();
  throw OptionError(std::string(name) + ": expected no --radii" + (is_set ? "" : "-file") +
                    " for a file that has its own radii, as " + (format == "pqr" ? "PQR" : "XYZR") + " does, got '" +
                    (is_set ? options.radii : options.radii_file.string()) +
                    "'; if it is another format, say so with --input-format");
}

AtomFile parse_format(std::string_view data, std::string_view name, const std::string& format,
                      const ReadOptions& options) {
  if (format == "xyzr" || format == "pqr") {
    require_no_radii(format, name, options);
    return format == "xyzr" ? parse_xyzr(data, name) : parse_pqr(data, name, options.names);
  }
  if (options.radii.empty() && options.radii_file.empty()) {
    throw OptionError(std::string(name) +
                      ": expected radii for a file that has none: choose --radii bondi, amber or charmm, or "
                      "--radii-file, or make a PQR file of it with pdb2pqr");
  }
  return format == "pdb" ? parse_pdb(data, name, options.radii, options.radii_file, options.names)
                         : parse_mmcif(data, name, options.radii, options.radii_file, options.names);
}

AtomFile parse_data(std::string_view data, std::string_view name, const ReadOptions& options) {
  const std::string format = choose_format(name, options);
  AtomFile file = parse_format(data, name, format, options);
  warn_of_close_atoms(name, format == "mmcif" ? PlaceKind::kAtom : PlaceKind::kLine, file);
  return file;
}

}  // namespace

const std::vector<std::string>& atom_formats() {
  static const std::vector<std::string> formats = {"pqr", "xyzr", "pdb", "mmcif"};
  return formats;
}

AtomFile read_atoms(const std::filesystem::path& path, const ReadOptions& options) {
  return parse_data(read_file(path), path.string(), options);
}

AtomFile read_atoms(std::istream& input, std::string_view name, const ReadOptions& options) {
  return parse_data(read_stream(input, name), name, options);
}

}  // namespace gaussmesh
