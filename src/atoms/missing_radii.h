// Atoms without a radius: gathered over the whole file, so that one run tells of all of them.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gaussmesh {

struct AtomSite;

class MissingRadii {
 public:
  void add(const AtomSite& site);

  /// Throws InputError if there are any: where the first is, and lines that a file of radii can have for them
  /// (radius_file.h), up to 20. `radii` is what the message calls those that were asked for.
  void require_none(const std::string& radii) const;

 private:
  /// Atoms for which one line would do.
  struct Kind {
    std::string line;  ///< without what it is a comment to
    std::string where;
    std::size_t count = 0;
  };

  std::size_t count_ = 0;
  std::string first_;
  std::vector<Kind> kinds_;                                // in the order of the file
  std::map<std::string, std::size_t, std::less<>> place_;  // of a line in kinds_
};

}  // namespace gaussmesh
