// x y z radius on each line: XYZR, XYZRN and XYZRQ; parse_pqr.cpp reads the rest of what has its own radii.

#include <charconv>

#include "atoms/atom_fields.h"
#include "gaussmesh/error.h"

namespace gaussmesh {
namespace {

constexpr std::size_t kNumbersPerLine = 4;

/// The line at the head of some files that tells how many atoms follow.
struct AtomCount {
  std::size_t value = 0;
  std::size_t line = 0;
};

std::optional<std::size_t> parse_count(std::string_view field) {
  std::size_t value = 0;
  const char* end = field.data() + field.size();
  const auto result = std::from_chars(field.data(), end, value);
  if (result.ec != std::errc{} || result.ptr != end) {
    return std::nullopt;
  }
  return value;
}

Atom read_line(std::span<const std::string_view> fields, std::string_view line, const LinePlace& place) {
  if (fields.size() < kNumbersPerLine) {
    fail_at(place, "four numbers x y z radius", line);
  }
  const AtomFields atom_fields = {fields[0], fields[1], fields[2], fields[3], {}};
  const std::optional<Atom> atom = parse_atom(atom_fields);
  if (!atom) {
    fail_at_number(atom_fields, place);
  }
  require_in_range(*atom, atom_fields, place);
  return *atom;
}

/// Finds files whose lines begin with the number of the atom: five numbers might as well be x y z radius charge.
class NumberedLineCheck {
 public:
  void add(std::span<const std::string_view> fields, std::string_view line, const LinePlace& place) {
    if (lines_++ == 0) {
      first_ = line;
      first_line_ = place.line;
    }
    const auto number = parse_count(fields[0]);
    is_possible_ = is_possible_ && fields.size() > kNumbersPerLine && parse_number(fields[kNumbersPerLine]) && number &&
                   (lines_ == 1 ? *number <= 1 : *number == last_ + 1);
    last_ = number.value_or(0);
  }

  /// Throws InputError if it is one.
  void require_none(std::string_view name) const {
    constexpr std::size_t kFewestToJudge = 4;  // fewer may well be spheres made by hand
    if (!is_possible_ || lines_ < kFewestToJudge) return;
    fail_at({name, first_line_}, "four numbers x y z radius", first_,
            ", whose first counts the lines from here to the last; take it out, or write x with a decimal point");
  }

 private:
  bool is_possible_ = true;
  std::size_t lines_ = 0;
  std::size_t last_ = 0;  // number at the head of a line
  std::string_view first_;
  std::size_t first_line_ = 0;
};

void require_count(const AtomCount& expected, std::size_t atoms, std::string_view name) {
  if (expected.value != atoms) {
    throw InputError(to_string({name, expected.line}) + ": expected as many atoms as this line says, " +
                     std::to_string(expected.value) + ", got " + std::to_string(atoms));
  }
}

}  // namespace

AtomFile parse_xyzr(std::string_view text, std::string_view name) {
  AtomFile file;
  LineReader lines(require_text(text, name));
  FieldSplitter splitter;
  LargeRadii large_radii;
  NumberedLineCheck numbered_line_check;
  std::optional<AtomCount> count;
  while (const auto line = lines.next()) {
    const std::string_view content = trim(line->substr(0, line->find('#')));
    const auto fields = splitter.split(content);
    if (fields.empty()) {
      continue;
    }
    if (fields.size() == 1 && file.atoms.empty() && !count) {
      if (const auto value = parse_count(fields[0])) {
        count = AtomCount{*value, lines.number()};
        continue;
      }
    }
    file.atoms.push_back(read_line(fields, content, {name, lines.number()}));
    file.lines.push_back(lines.number());
    numbered_line_check.add(fields, content, {name, lines.number()});
    large_radii.add(file.atoms.back().radius, lines.number());
  }
  if (file.atoms.empty()) {
    throw InputError(std::string(name) + ": expected lines of x y z radius, got no atoms");
  }
  if (count) {
    require_count(*count, file.atoms.size(), name);
  }
  numbered_line_check.require_none(name);
  large_radii.warn(name, file);
  return file;
}

}  // namespace gaussmesh
