// The PQR reader: from line to line, and what is left out on the way.
//
// Which fields of a record are its numbers is pqr_record.h; what the whole file gives away is pqr_checks.h.
#include "atoms/atom_fields.h"
#include "atoms/pqr_checks.h"
#include "atoms/pqr_names.h"
#include "atoms/pqr_record.h"
#include "atoms/unknown_lines.h"
#include "core/number_text.h"
#include "gaussmesh/error.h"

namespace gaussmesh {
namespace {

struct FoundAtom {
  Atom atom;
  NumberFields numbers;
};

/// Reads one text; made anew for each.
class PqrParser {
 public:
  PqrParser(std::string_view text, std::string_view name, AtomNames names) : name_(name), names_(names), lines_(text) {
    constexpr std::size_t kTypicalRecord = 70;
    file_.atoms.reserve(text.size() / kTypicalRecord);
    file_.lines.reserve(text.size() / kTypicalRecord);
  }

  AtomFile parse();

 private:
  void read_line(std::string_view line);
  void read_atom(std::string_view line, std::string_view rest);
  FoundAtom find_atom(std::string_view line, std::string_view rest);
  [[noreturn]] void fail_at_layout(std::string_view line) const;
  void start_model();
  void end_model();
  void warn_of_models();
  void note_names(std::string_view line, std::string_view rest, std::string_view x);
  LinePlace place() const { return {name_, lines_.number()}; }

  std::string_view name_;
  AtomNames names_;
  LineReader lines_;
  FieldSplitter splitter_;
  AtomFile file_;
  LargeRadii large_radii_;
  PdbCheck pdb_check_;
  MissingFieldCheck missing_field_check_;
  EndCheck end_check_;

  bool has_model_ = false;
  std::optional<std::size_t> model_end_line_;  // of the first model
  std::size_t atoms_in_other_models_ = 0;
  UnknownLines unknown_lines_;
};

AtomFile PqrParser::parse() {
  while (const auto line = lines_.next()) {
    read_line(*line);
  }
  if (file_.atoms.empty()) {
    throw InputError(std::string(name_) +
                     ": expected ATOM or HETATM records, got no atoms; besides PQR are read XYZR, " +
                     "lines of x y z radius, PDB and mmCIF, from files named .xyzr, .pdb or .cif, or with " +
                     "--input-format; no other formats are");
  }
  missing_field_check_.require_complete(name_);
  pdb_check_.require_pqr(file_.atoms.size(), name_);
  end_check_.require_other_atoms(name_);
  large_radii_.warn(name_, file_);
  warn_of_models();
  end_check_.warn(name_, file_);
  unknown_lines_.warn(name_, file_);
  return std::move(file_);
}

void PqrParser::read_line(std::string_view line) {
  const std::string_view content = trim(line);
  const Record record = classify_record(content);
  switch (record.kind) {
    case RecordKind::kAtom:
      if (model_end_line_) {
        ++atoms_in_other_models_;
      } else {
        read_atom(line, record.rest);
      }
      break;
    case RecordKind::kModel:
      start_model();
      break;
    case RecordKind::kEndOfModel:
      end_model();
      break;
    case RecordKind::kEnd:
      end_check_.end(lines_.number());
      break;
    case RecordKind::kPassedOver:
      break;
    case RecordKind::kUnknown:
      unknown_lines_.add(content, "PQR records", place());
      break;
  }
}

// A second MODEL ends the first as well as ENDMDL does, which some files lack.
void PqrParser::start_model() {
  if (has_model_) {
    end_model();
  }
  has_model_ = true;
}

void PqrParser::end_model() {
  if (!model_end_line_ && !file_.atoms.empty()) {
    model_end_line_ = lines_.number();
  }
}

void PqrParser::read_atom(std::string_view line, std::string_view rest) {
  const FoundAtom found = find_atom(line, rest);
  require_in_range(found.atom, found.numbers.fields, place());
  missing_field_check_.add(found.numbers, lines_.number());
  pdb_check_.add(found.atom, found.numbers.fields, line, lines_.number());
  large_radii_.add(found.atom.radius, lines_.number());
  file_.atoms.push_back(found.atom);
  file_.lines.push_back(lines_.number());
  note_names(line, rest, found.numbers.fields[0]);
}

/// @param rest  of the line, behind ATOM or HETATM
/// @param x     in the same line, where the numbers begin
void PqrParser::note_names(std::string_view line, std::string_view rest, std::string_view x) {
  const std::string_view leading = trim(rest.substr(0, static_cast<std::size_t>(x.data() - rest.data())));
  if (names_ == AtomNames::kKeep) file_.names.push_back(name_of(splitter_.split(leading)));
  const std::size_t end_of_serial = std::min(leading.find_first_of(" \t\v\f"), leading.size());
  end_check_.add(leading.substr(end_of_serial), trim(line), lines_.number());
}

FoundAtom PqrParser::find_atom(std::string_view line, std::string_view rest) {
  const auto by_fields = find_by_fields(splitter_.split(rest));
  if (by_fields) {
    if (const auto atom = parse_atom(by_fields->fields)) {
      return {*atom, *by_fields};
    }
  }
  const auto by_columns = find_by_columns(line, splitter_);
  if (by_columns) {
    if (const auto atom = parse_atom(by_columns->fields)) {
      return {*atom, *by_columns};
    }
  }
  if (by_fields) {
    fail_at_number(by_fields->fields, place());
  }
  if (by_columns && !has_pdb_columns(line)) {
    fail_at_number(by_columns->fields, place());
  }
  fail_at_layout(line);
}

void PqrParser::fail_at_layout(std::string_view line) const {
  const char* remedy =
      has_pdb_columns(line)
          ? "; is it a PDB file? pdb2pqr gives it charges and radii, or read it with --input-format pdb and "
            "--radii"
      : lines_.is_cut() ? "; the file ends here, is it cut off?"
                        : "";
  fail_at(place(), "serial, atom, residue, [chain,] residue number, x, y, z, charge, radius in an atom record",
          trim(line), remedy);
}

void PqrParser::warn_of_models() {
  if (atoms_in_other_models_ > 0) {
    file_.warnings.push_back(to_string({name_, *model_end_line_}) + ": the first model ends here; left out " +
                             counted(atoms_in_other_models_, "atom", "atoms") + " of other models");
  }
}

}  // namespace

AtomFile parse_pqr(std::string_view text, std::string_view name, AtomNames names) {
  return PqrParser(require_text(text, name), name, names).parse();
}

}  // namespace gaussmesh
