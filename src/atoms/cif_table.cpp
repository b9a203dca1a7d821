#include "atoms/cif_table.h"

#include <algorithm>
#include <gemmi/cif.hpp>
#include <optional>

#include "gaussmesh/error.h"

namespace gaussmesh {
namespace {

namespace cif = gemmi::cif;

cif::Document read_document(std::string_view text, const std::string& name) {
  try {
    return cif::read_memory(text.data(), text.size(), name.c_str());
  } catch (const std::exception& error) {
    const std::string message = error.what();
    throw InputError(message.compare(0, name.size(), name) == 0 ? message : name + ": " + message);
  }
}

/// The line of the loop or of the first pair whose tags begin with `prefix`; nothing if there are none.
std::optional<std::size_t> find_line(const cif::Block& block, const std::string& prefix) {
  const auto begins_so = [&](const std::string& tag) { return gemmi::istarts_with(tag, prefix); };
  for (const cif::Item& item : block.items) {
    const bool is_it = item.type == cif::ItemType::Loop
                           ? std::any_of(item.loop.tags.begin(), item.loop.tags.end(), begins_so)
                           : item.type == cif::ItemType::Pair && begins_so(item.pair[0]);
    if (is_it) return static_cast<std::size_t>(item.line_number);
  }
  return std::nullopt;
}

/// _atom_site, of `_atom_site.`
std::string loop_of(const std::string& prefix) { return prefix.substr(0, prefix.find('.')); }

/// A block, and the line where the tags that were asked for are.
struct Found {
  cif::Block* block = nullptr;
  std::size_t line = 0;
};

/// Throws the error for a file without tags that begin with `prefix`. Crystallographic CIF has others that look like
/// them.
[[noreturn]] void fail_without(const cif::Document& document, const std::string& prefix, const std::string& file) {
  const std::string expected = "expected a loop " + loop_of(prefix) + " of mmCIF, tags " + prefix + "*, got ";
  const std::string other = loop_of(prefix) + "_";
  for (const cif::Block& block : document.blocks) {
    const auto line = find_line(block, other);
    if (!line) continue;
    throw InputError(file + ":" + std::to_string(*line) + ": " + expected + other +
                     "* of crystallographic CIF; have another program write it as PDB or mmCIF");
  }
  throw InputError(file + ": " + expected + "none");
}

/// The block whose tags begin with `prefix`.
///
/// @throws InputError if there is none, or more than one, as in files that were joined
Found find_block(cif::Document& document, const std::string& prefix, const std::string& file) {
  Found found;
  for (cif::Block& block : document.blocks) {
    const auto line = find_line(block, prefix);
    if (!line) continue;
    if (found.block != nullptr) {
      throw InputError(file + ":" + std::to_string(*line) + ": expected one loop " + loop_of(prefix) + ", in line " +
                       std::to_string(found.line) + ", got another in block '" + block.name +
                       "'; make a file of each block");
    }
    found = {&block, *line};
  }
  if (found.block == nullptr) fail_without(document, prefix, file);
  return found;
}

/// The tag that `column` has in `block`, behind a `?` if it may be missing, as gemmi wants it.
std::string choose_tag(const cif::Block& block, const std::string& prefix, const CifColumn& column,
                       const std::string& where) {
  const bool has_other = !column.other_tag.empty();
  if (block.has_tag(prefix + column.tag)) return column.tag;
  if (has_other && block.has_tag(prefix + column.other_tag)) return column.other_tag;
  if (column.need == CifColumn::Need::kOptional) return "?" + column.tag;
  throw InputError(where + ": expected a column " + prefix + column.tag +
                   (has_other ? " or " + prefix + column.other_tag : "") + ", got none");
}

}  // namespace

CifTable read_cif_table(std::string_view text, std::string_view name, const std::string& prefix,
                        const std::vector<CifColumn>& columns) {
  const std::string file(name);
  cif::Document document = read_document(text, file);
  const auto [found, line] = find_block(document, prefix, file);
  cif::Block& block = *found;
  const std::string where = file + ":" + std::to_string(line);
  std::vector<std::string> tags;
  tags.reserve(columns.size());
  for (const CifColumn& column : columns) tags.push_back(choose_tag(block, prefix, column, where));
  cif::Table table = block.find(prefix, tags);
  if (!table.ok())
    throw InputError(where + ": expected all columns of " + loop_of(prefix) + " in one loop, got several");
  CifTable result;
  for (cif::Table::Row row : table) {
    std::vector<std::string> values(tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i)
      if (row.has2(i)) values[i] = cif::as_string(row[static_cast<int>(i)]);
    result.rows.push_back(std::move(values));
  }
  return result;
}

}  // namespace gaussmesh
