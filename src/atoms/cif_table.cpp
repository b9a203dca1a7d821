#include "atoms/cif_table.h"

#include <gemmi/cif.hpp>

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

}  // namespace

CifTable read_cif_table(std::string_view text, std::string_view name, const std::string& prefix,
                        const std::vector<std::string>& tags) {
  cif::Document document = read_document(text, std::string(name));
  CifTable result;
  if (document.blocks.empty()) return result;
  cif::Table table = document.blocks.front().find(prefix, tags);
  result.is_there = table.ok();
  for (cif::Table::Row row : table) {
    std::vector<std::string> values(tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i)
      if (row.has2(i)) values[i] = cif::as_string(row[static_cast<int>(i)]);
    result.rows.push_back(std::move(values));
  }
  return result;
}

}  // namespace gaussmesh
