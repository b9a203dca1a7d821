#include "read/vtk_arrays.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "read/mesh_text.h"

namespace gaussmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "big-endian files are the ones to be turned");

/// Bytes as they are.
class RawSource {
 public:
  explicit RawSource(std::string_view text) : left_(text) {}

  /// No more can be taken than this.
  std::size_t most() const { return left_.size(); }

  /// The next bytes, or as many as are left.
  std::string take(std::size_t count) {
    std::string taken(left_.substr(0, count));
    left_.remove_prefix(taken.size());
    return taken;
  }

 private:
  std::string_view left_;
};

/// Base64. What was encoded by itself ends in the middle of a group of four, as `=` tells, and the next begins behind.
class Base64Source {
 public:
  explicit Base64Source(std::string_view text) : left_(text) {}

  std::size_t most() const { return pending_.size() + left_.size() / 4 * 3; }

  std::string take(std::size_t count) {
    while (pending_.size() < count && read_group()) {
    }
    std::string taken = pending_.substr(0, count);
    pending_.erase(0, taken.size());
    return taken;
  }

 private:
  /// Decodes as far as the buffer goes; false where there is no further group.
  bool read_group() {
    constexpr std::size_t kGroups = 4096;
    const std::size_t before = pending_.size();
    for (std::size_t i = 0; i < kGroups; ++i) {
      std::array<unsigned, 4> digits{};
      std::size_t count = 0, padding = 0;
      while (count + padding < digits.size() && !left_.empty()) {
        const char c = left_.front();
        const unsigned digit = digit_of(c);
        const bool is_blank = c == ' ' || c == '\n' || c == '\r' || c == '\t';
        if (!is_blank && digit == kNone && c != '=') return pending_.size() > before;
        left_.remove_prefix(1);
        if (is_blank) continue;
        if (c == '=') ++padding;
        if (c != '=') digits[count++] = digit;
      }
      if (count < 2 || count + padding < digits.size()) break;
      const unsigned bits = digits[0] << 18 | digits[1] << 12 | digits[2] << 6 | digits[3];
      for (std::size_t k = 0; k + 1 < count; ++k) pending_ += static_cast<char>(bits >> (16 - 8 * k) & 0xFF);
    }
    return pending_.size() > before;
  }

  static constexpr unsigned kNone = 64;

  static unsigned digit_of(char c) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    static const std::array<unsigned char, 256> table = [&] {
      std::array<unsigned char, 256> digits{};
      digits.fill(kNone);
      for (std::size_t i = 0; i < kDigits.size(); ++i) digits[static_cast<unsigned char>(kDigits[i])] = i & 0xFF;
      return digits;
    }();
    return table[static_cast<unsigned char>(c)];
  }

  std::string_view left_;
  std::string pending_;
};

template <class Number>
Number number_at(const char* bytes, std::endian order) {
  std::array<char, sizeof(Number)> copy{};
  std::memcpy(copy.data(), bytes, copy.size());
  if (order == std::endian::big) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<Number>(copy);
}

template <class Number>
std::vector<double> numbers_in(std::string_view bytes, std::endian order) {
  std::vector<double> numbers(bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = static_cast<double>(number_at<Number>(bytes.data() + i * sizeof(Number), order));
  return numbers;
}

struct Type {
  std::string_view name;
  std::size_t bytes;
  std::vector<double> (*read)(std::string_view bytes, std::endian order);
};

template <class Number>
constexpr Type type_of(std::string_view name) {
  return {name, sizeof(Number), numbers_in<Number>};
}

constexpr std::array<Type, 10> kTypes = {type_of<std::int8_t>("Int8"),   type_of<std::uint8_t>("UInt8"),
                                         type_of<std::int16_t>("Int16"), type_of<std::uint16_t>("UInt16"),
                                         type_of<std::int32_t>("Int32"), type_of<std::uint32_t>("UInt32"),
                                         type_of<std::int64_t>("Int64"), type_of<std::uint64_t>("UInt64"),
                                         type_of<float>("Float32"),      type_of<double>("Float64")};

std::vector<double> numbers_of_text(const XmlElements& xml, const XmlElement& array) {
  FieldSplitter splitter;
  LineReader lines(array.text);
  std::vector<double> numbers;
  while (const auto line = lines.next()) {
    for (const std::string_view field : splitter.split(*line)) {
      const auto number = parse_number(field);
      if (!number) xml.fail(array, "an array of numbers", field);
      numbers.push_back(*number);
    }
  }
  return numbers;
}

}  // namespace

VtkArrays::VtkArrays(const XmlElements& xml, std::string_view type) : xml_(xml) {
  const XmlElement* const root = xml.find("VTKFile", std::nullopt);
  if (root == nullptr) xml.fail({}, "VTK's XML, with an element VTKFile", "none");
  if (root->attribute("type") != type)
    xml.fail(*root, "a VTKFile of the type " + std::string(type), root->attribute("type"));
  const std::string_view order = root->attribute("byte_order");
  if (order != "LittleEndian" && order != "BigEndian") xml.fail(*root, "byte_order LittleEndian or BigEndian", order);
  byte_order_ = order == "BigEndian" ? std::endian::big : std::endian::little;
  const std::string_view header = root->attribute("header_type");
  if (!header.empty() && header != "UInt32" && header != "UInt64")
    xml.fail(*root, "header_type UInt32 or UInt64", header);
  if (header == "UInt64") size_bytes_ = sizeof(std::uint64_t);
  const std::string_view compressor = root->attribute("compressor");
  is_compressed_ = !compressor.empty();
  if (is_compressed_ && compressor != "vtkZLibDataCompressor")
    xml.fail(*root, "vtkZLibDataCompressor, or none", compressor, "; write it with another compressor");
  appended_ = xml.find("AppendedData", xml.place_of(*root));
}

std::vector<double> VtkArrays::read(const XmlElement& array) const {
  const auto type = std::find_if(kTypes.begin(), kTypes.end(),
                                 [&](const Type& known) { return known.name == array.attribute("type"); });
  if (type == kTypes.end())
    xml_.fail(array, "a type of numbers, Int8 to UInt64 or Float32 or Float64", array.attribute("type"));
  if (array.attribute("format") == "ascii") return numbers_of_text(xml_, array);
  const std::string bytes = bytes_of(array);
  if (bytes.size() % type->bytes != 0)
    xml_.fail(array, "a multiple of " + std::to_string(type->bytes) + " bytes", std::to_string(bytes.size()));
  return type->read(bytes, byte_order_);
}

std::string VtkArrays::bytes_of(const XmlElement& array) const {
  const auto read = [&](auto source) {
    return is_compressed_ ? expanded_bytes(array, source) : plain_bytes(array, source);
  };
  const std::string_view format = array.attribute("format");
  if (format == "binary") return read(Base64Source(array.text));
  if (format != "appended") xml_.fail(array, "format ascii, binary or appended", format);
  const auto offset = parse_integer<std::size_t>(array.attribute("offset"));
  const std::size_t begin = appended_ == nullptr ? std::string_view::npos : appended_->text.find('_');
  if (!offset || begin == std::string_view::npos || *offset >= appended_->text.size() - begin - 1)
    xml_.fail(array, "an offset within AppendedData", array.attribute("offset"));
  const std::string_view rest = appended_->text.substr(begin + 1 + *offset);
  return appended_->attribute("encoding") == "raw" ? read(RawSource(rest)) : read(Base64Source(rest));
}

template <class Source>
std::vector<std::uint64_t> VtkArrays::sizes(const XmlElement& array, Source& source, std::uint64_t count) const {
  if (count > source.most() / size_bytes_) xml_.fail(array, "an array as long as it announces", "the end of the data");
  const std::string bytes = source.take(static_cast<std::size_t>(count) * size_bytes_);
  if (bytes.size() < count * size_bytes_) xml_.fail(array, "an array as long as it announces", "the end of the data");
  std::vector<std::uint64_t> numbers;
  for (std::size_t at = 0; at < bytes.size(); at += size_bytes_) {
    const char* const p = bytes.data() + at;
    numbers.push_back(size_bytes_ == sizeof(std::uint32_t) ? number_at<std::uint32_t>(p, byte_order_)
                                                           : number_at<std::uint64_t>(p, byte_order_));
  }
  return numbers;
}

template <class Source>
std::string VtkArrays::plain_bytes(const XmlElement& array, Source source) const {
  const std::uint64_t size = sizes(array, source, 1)[0];
  if (size > source.most()) xml_.fail(array, std::to_string(size) + " bytes", "the end of the data");
  std::string bytes = source.take(static_cast<std::size_t>(size));
  if (bytes.size() < size) xml_.fail(array, std::to_string(size) + " bytes", "the end of the data");
  return bytes;
}

/// In front of the blocks stand their number, their size before compression, that of the last one if it is smaller
/// (else 0), and their sizes after compression.
template <class Source>
std::string VtkArrays::expanded_bytes(const XmlElement& array, Source source) const {
  constexpr std::uint64_t kMostExpansion = 1040;  // zlib's own limit is 1032
  const std::vector<std::uint64_t> head = sizes(array, source, 3);
  const std::uint64_t blocks = head[0];
  const std::vector<std::uint64_t> packed = sizes(array, source, blocks);
  std::string bytes;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::uint64_t size = i + 1 == blocks && head[2] > 0 ? head[2] : head[1];
    const std::string block = source.take(std::min<std::uint64_t>(packed[i], source.most()));
    if (block.size() < packed[i] || size / kMostExpansion > block.size())
      xml_.fail(array, "a block of " + std::to_string(packed[i]) + " bytes", "the end of the data");
    const std::size_t begin = bytes.size();
    bytes.resize(begin + size);
    uLongf expanded = size;
    const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data() + begin), &expanded,
                                  reinterpret_cast<const Bytef*>(block.data()), block.size());
    if (status != Z_OK || expanded != size) xml_.fail(array, "blocks by zlib", "corrupt data");
  }
  return bytes;
}

}  // namespace gaussmesh
