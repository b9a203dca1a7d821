// Lines between atoms that are no records of PDB: counted, and told in one warning.
#pragma once

#include <cstddef>
#include <string_view>

#include "atoms/atom_fields.h"
#include "core/number_text.h"

namespace gaussmesh {

class UnknownLines {
 public:
  /// Counts `content`, a line without the blanks at its ends, which must outlive this.
  ///
  /// @throws InputError where it shows that the file is of another format; `expected` is what it should be
  void add(std::string_view content, std::string_view expected, const LinePlace& place) {
    if (content[0] == '<') fail_at(place, expected, content, "; PQR-XML is not supported, nor PDBML or web pages");
    if (content.starts_with("data_") || content.starts_with("loop_")) {
      fail_at(place, expected, content,
              "; mmCIF is read from files named .cif, or with --input-format mmcif, and --radii");
    }
    if (content.starts_with("@<TRIPOS>")) fail_at(place, expected, content, "; MOL2 is not read");
    if (content.ends_with("V2000") || content.ends_with("V3000")) {
      fail_at(place, expected, content, "; MOL and SDF are not read");
    }
    if (count_++ > 0) return;
    first_line_ = place.line;
    first_ = content;
  }

  /// Adds a warning to `file`, named `name`, if there are any.
  void warn(std::string_view name, AtomFile& file) const {
    if (count_ == 0) return;
    file.warnings.push_back(to_string({name, first_line_}) + ": skipped " + counted(count_, "line", "lines") +
                            " of no known record, the first " + quoted(first_));
  }

 private:
  std::size_t count_ = 0;
  std::size_t first_line_ = 0;
  std::string_view first_;
};

}  // namespace gaussmesh
