// PLY: a header that describes elements and their properties, then the elements, as text or as bytes of either
// order.
//
// http://paulbourke.net/dataformats/ply/

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/number_text.h"
#include "gaussmesh/error.h"
#include "read/mesh_text.h"

namespace gaussmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "big-endian files are the ones to be turned");

enum class Encoding { kAscii, kLittleEndian, kBigEndian };
enum class Kind { kSigned, kUnsigned, kFloat };

struct Type {
  std::string_view name;
  std::string_view other_name;
  Kind kind;
  std::size_t bytes;
};

constexpr std::array<Type, 8> kTypes = {{{"char", "int8", Kind::kSigned, 1},
                                         {"uchar", "uint8", Kind::kUnsigned, 1},
                                         {"short", "int16", Kind::kSigned, 2},
                                         {"ushort", "uint16", Kind::kUnsigned, 2},
                                         {"int", "int32", Kind::kSigned, 4},
                                         {"uint", "uint32", Kind::kUnsigned, 4},
                                         {"float", "float32", Kind::kFloat, 4},
                                         {"double", "float64", Kind::kFloat, 8}}};

struct Property {
  std::string_view name;
  const Type* type = nullptr;
  const Type* count_type = nullptr;  ///< of a list's length; none where the property is no list
};

struct Element {
  std::string_view name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
  std::size_t size = 0;  ///< bytes
  std::size_t lines = 0;
};

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  Header parse() {
    while (next_line()) {
      const std::string_view keyword = field(0);
      if (keyword == "end_header") {
        header_.size = position_;
        return std::move(header_);
      }
      if (keyword == "format") read_format();
      if (keyword == "element") read_element();
      if (keyword == "property") read_property();
    }
    fail("'end_header'");
  }

 private:
  bool next_line() {
    const std::size_t end = bytes_.find('\n', position_);
    if (end == std::string_view::npos) {
      line_ = "end of file";
      return false;
    }
    line_ = bytes_.substr(position_, end - position_);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    position_ = end + 1;
    ++header_.lines;
    fields_ = splitter_.split(line_);
    return true;
  }

  std::string_view field(std::size_t i) const { return i < fields_.size() ? fields_[i] : std::string_view{}; }

  void read_format() {
    constexpr std::string_view kNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const auto at = std::find(std::begin(kNames), std::end(kNames), field(1));
    if (at == std::end(kNames) || field(2) != "1.0") fail("'format', ascii or binary_..._endian, '1.0'");
    header_.encoding = static_cast<Encoding>(at - std::begin(kNames));
  }

  void read_element() {
    const auto count = parse_integer<std::size_t>(field(2));
    if (!count) fail("'element', a name and a number");
    header_.elements.push_back({field(1), *count, {}});
  }

  void read_property() {
    if (header_.elements.empty()) fail("an element before its properties");
    const bool is_list = field(1) == "list";
    Property property{field(is_list ? 4 : 2), type_of(field(is_list ? 3 : 1)), is_list ? type_of(field(2)) : nullptr};
    if (is_list && property.count_type->kind == Kind::kFloat) fail("a list whose length is a whole number");
    header_.elements.back().properties.push_back(property);
  }

  const Type* type_of(std::string_view name) const {
    const auto at = std::find_if(kTypes.begin(), kTypes.end(),
                                 [&](const Type& t) { return t.name == name || t.other_name == name; });
    if (at == kTypes.end()) fail("a property with a type of PLY");
    return &*at;
  }

  [[noreturn]] void fail(std::string_view expected) const {
    fail_at({name_, std::max<std::size_t>(header_.lines, 1)}, expected, line_);
  }

  std::string_view bytes_;
  std::string_view name_;
  std::size_t position_ = 0;
  std::string_view line_;
  FieldSplitter splitter_;
  std::span<const std::string_view> fields_;
  Header header_;
};

/// Hands out the numbers behind an ascii header, one after the other; line ends do not matter.
class AsciiNumbers {
 public:
  AsciiNumbers(std::string_view text, std::string_view name, std::size_t first_line)
      : text_(text), name_(name), line_(first_line) {}

  double next(const Type&) {
    while (position_ < text_.size() && is_space(text_[position_])) line_ += text_[position_++] == '\n' ? 1 : 0;
    const std::size_t begin = position_;
    while (position_ < text_.size() && !is_space(text_[position_])) ++position_;
    const std::string_view word = text_.substr(begin, position_ - begin);
    const auto value = parse_number(word);
    if (!value) fail_at({name_, line_}, "a finite number", word.empty() ? "end of file" : word);
    return *value;
  }

  [[noreturn]] void fail(std::string_view expected, double got) const {
    throw InputError(to_string({name_, line_}) + ": expected " + std::string(expected) + ", got '" + number_text(got) +
                     "'");
  }

 private:
  static bool is_space(char c) { return is_blank(c) || c == '\n' || c == '\r'; }

  std::string_view text_;
  std::string_view name_;
  std::size_t line_;
  std::size_t position_ = 0;
};

/// Hands out the numbers behind a binary header.
class BinaryNumbers {
 public:
  BinaryNumbers(std::string_view bytes, std::string_view name, std::size_t offset, std::endian order)
      : bytes_(bytes), name_(name), offset_(offset), order_(order) {}

  double next(const Type& type) {
    if (bytes_.size() - position_ < type.bytes) {
      throw InputError(std::string(name_) + ": expected more data, got the end of the file at byte " +
                       std::to_string(offset_ + bytes_.size()));
    }
    std::array<char, 8> value{};
    const char* const from = bytes_.data() + position_;
    if (order_ == std::endian::big) {
      std::reverse_copy(from, from + type.bytes, value.begin());
    } else {
      std::copy(from, from + type.bytes, value.begin());
    }
    position_ += type.bytes;
    const double number = convert(type, value.data());
    if (!std::isfinite(number)) fail("a finite number", number);
    return number;
  }

  [[noreturn]] void fail(std::string_view expected, double got) const {
    throw InputError(std::string(name_) + ": expected " + std::string(expected) + " before byte " +
                     std::to_string(offset_ + position_) + ", got '" + number_text(got) + "'");
  }

 private:
  template <class Number>
  static double as(const char* bytes) {
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return static_cast<double>(number);
  }

  static double convert(const Type& type, const char* bytes) {
    if (type.kind == Kind::kFloat) return type.bytes == 4 ? as<float>(bytes) : as<double>(bytes);
    const bool is_signed = type.kind == Kind::kSigned;
    if (type.bytes == 1) return is_signed ? as<std::int8_t>(bytes) : as<std::uint8_t>(bytes);
    if (type.bytes == 2) return is_signed ? as<std::int16_t>(bytes) : as<std::uint16_t>(bytes);
    return is_signed ? as<std::int32_t>(bytes) : as<std::uint32_t>(bytes);
  }

  std::string_view bytes_;
  std::string_view name_;
  std::size_t offset_;
  std::endian order_;
  std::size_t position_ = 0;
};

/// A number of a vertex, an atom or a component.
template <class Numbers>
std::uint32_t to_index(const Numbers& numbers, double value) {
  constexpr double kMost = 4294967295.0;
  if (!(value >= 0.0 && value <= kMost) || value != std::floor(value)) {
    numbers.fail("a number counted from 0", value);
  }
  return static_cast<std::uint32_t>(value);
}

bool has_all(const Element& element, std::initializer_list<std::string_view> names) {
  return std::all_of(names.begin(), names.end(), [&](std::string_view name) {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [&](const Property& p) { return p.name == name && p.count_type == nullptr; });
  });
}

/// Reads one list, or one number as a list of it.
template <class Numbers>
void read_values(Numbers& numbers, const Property& property, std::vector<double>& values) {
  values.clear();
  const double count = property.count_type ? numbers.next(*property.count_type) : 1.0;
  if (count < 0.0 || count != std::floor(count)) numbers.fail("the length of a list", count);
  for (double i = 0.0; i < count; ++i) values.push_back(numbers.next(*property.type));
}

template <class Numbers>
void read_vertex(Numbers& numbers, const Element& element, std::vector<double>& values, MeshFile& file) {
  Point point{};
  Point normal{};
  for (const Property& property : element.properties) {
    read_values(numbers, property, values);
    if (property.count_type) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr std::string_view kAxes = "xyz";
      if (property.name == kAxes.substr(k, 1)) point[k] = values[0];
      if (property.name.size() == 2 && property.name[0] == 'n' && property.name[1] == kAxes[k]) normal[k] = values[0];
    }
    if (property.name == "atom") file.data.atoms.push_back(to_index(numbers, values[0]));
    if (property.name == "component") file.data.components.push_back(to_index(numbers, values[0]));
  }
  file.mesh.vertices.push_back(point);
  file.data.normals.push_back(to_normal(normal));
}

template <class Numbers>
void read_face(Numbers& numbers, const Element& element, std::vector<double>& values, MeshFile& file) {
  for (const Property& property : element.properties) {
    read_values(numbers, property, values);
    if (!property.count_type || (property.name != "vertex_indices" && property.name != "vertex_index")) continue;
    if (values.size() != 3) numbers.fail("a triangle, three vertex numbers", static_cast<double>(values.size()));
    file.mesh.triangles.push_back(
        {to_index(numbers, values[0]), to_index(numbers, values[1]), to_index(numbers, values[2])});
  }
}

template <class Numbers>
MeshFile read_elements(const Header& header, Numbers numbers) {
  MeshFile file;
  std::vector<double> values;
  bool has_normals = false;
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;  // nothing is there, however many are announced
    if (element.name == "vertex") has_normals = has_all(element, {"nx", "ny", "nz"});
    for (std::size_t i = 0; i < element.count; ++i) {
      if (element.name == "vertex") {
        read_vertex(numbers, element, values, file);
      } else if (element.name == "face") {
        read_face(numbers, element, values, file);
      } else {
        for (const Property& property : element.properties) read_values(numbers, property, values);
      }
    }
  }
  if (!has_normals) file.data.normals.clear();
  // Properties that come twice are no data.
  if (file.data.atoms.size() != file.mesh.vertices.size()) file.data.atoms.clear();
  if (file.data.components.size() != file.mesh.vertices.size()) file.data.components.clear();
  return file;
}

void require_mesh(const Header& header, std::string_view name) {
  const auto has_element = [&](std::string_view wanted) {
    return std::any_of(header.elements.begin(), header.elements.end(), [&](const Element& element) {
      return element.name == wanted && (wanted != "vertex" || has_all(element, {"x", "y", "z"}));
    });
  };
  if (!has_element("vertex") || !has_element("face")) {
    throw InputError(std::string(name) + ": expected elements 'vertex' with x, y, z and 'face', got a header without");
  }
}

}  // namespace

MeshFile parse_ply(std::string_view bytes, std::string_view name) {
  const Header header = HeaderParser(bytes, name).parse();
  require_mesh(header, name);
  const std::string_view body = bytes.substr(header.size);
  if (header.encoding == Encoding::kAscii)
    return read_elements(header, AsciiNumbers(require_text(body, name), name, header.lines + 1));
  const std::endian order = header.encoding == Encoding::kBigEndian ? std::endian::big : std::endian::little;
  return read_elements(header, BinaryNumbers(body, name, header.size, order));
}

}  // namespace gaussmesh
