// Any bytes are radii within their range or an InputError, and every line gives the radius that it says.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "atoms/radius_file.h"
#include "gaussmesh/error.h"
#include "text/text_lines.h"

namespace {

void require(bool promise) {
  if (!promise) std::abort();
}

void check_lines(const gaussmesh::RadiusFile& radii, std::string_view text) {
  gaussmesh::LineReader lines(gaussmesh::require_text(text, "fuzz"));
  gaussmesh::FieldSplitter splitter;
  while (const auto line = lines.next()) {
    const auto fields = splitter.split(line->substr(0, line->find('#')));
    if (fields.empty()) continue;
    require(fields.size() == 2 || fields.size() == 3);
    const std::string_view residue = fields.size() == 3 ? fields[0] : std::string_view{};
    const auto radius = radii.find(residue, fields[fields.size() - 2], "");
    require(radius && *radius >= 0.0 && *radius <= gaussmesh::kLargestRadius);
    require(radius == gaussmesh::parse_number(fields.back()));
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const gaussmesh::RadiusFile radii(text, "fuzz");
    check_lines(radii, text);
    gaussmesh::AtomFile file;
    radii.warn(file);
  } catch (const gaussmesh::InputError& error) {
    require(std::string_view(error.what()).starts_with("fuzz:"));
  }
  return 0;
}
