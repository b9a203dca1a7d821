// The elements of an XML file, as far as VTK uses XML: no namespaces, no entities in what is read, no document type.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gaussmesh {

/// One element; views into the text of the file.
struct XmlElement {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;
  std::string_view text;              ///< what is between its start and the next element, or its end
  std::optional<std::size_t> parent;  ///< place in the list
  std::size_t position = 0;           ///< in the text, of its `<`

  /// Empty if there is none.
  std::string_view attribute(std::string_view key) const {
    for (const auto& [name_of_it, value] : attributes)
      if (name_of_it == key) return value;
    return {};
  }
};

/// All elements in the order of their starts. Behind the start of one named `last` nothing is read as XML: its text is
/// all the rest.
class XmlElements {
 public:
  /// `bytes` and `file` must outlive this. @throws InputError if the text is no such XML, and names the line
  XmlElements(std::string_view bytes, std::string_view file, std::string_view last);

  const std::vector<XmlElement>& all() const { return elements_; }

  /// The first element of that name whose parent is that one; nothing if there is none.
  const XmlElement* find(std::string_view name, std::optional<std::size_t> parent) const;

  std::size_t place_of(const XmlElement& element) const {
    return static_cast<std::size_t>(&element - elements_.data());
  }

  /// Throws InputError that names the line where the element begins. @param remedy  brings its own "; "
  [[noreturn]] void fail(const XmlElement& element, std::string_view expected, std::string_view got,
                         std::string_view remedy = {}) const {
    fail_at_position(element.position, expected, got, remedy);
  }

 private:
  void read_tag();
  void skip_until(std::string_view end);
  void read_end();
  void read_start();
  std::string_view read_name();
  void skip_blanks();
  void require(char c);
  [[noreturn]] void fail_here(std::string_view expected) const;
  [[noreturn]] void fail_at_position(std::size_t position, std::string_view expected, std::string_view got,
                                     std::string_view remedy) const;

  std::string_view bytes_;
  std::string_view file_;
  std::string_view last_;
  std::size_t position_ = 0;
  std::vector<XmlElement> elements_;
  std::vector<std::size_t> open_;  // elements that have not ended
};

}  // namespace gaussmesh
