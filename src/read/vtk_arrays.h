// The arrays of VTK's XML files, in all ways that they are written: as text, as bytes in the element, as bytes appended
// behind the XML; the bytes as they are or in base64, plain or by zlib in blocks.
//
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "read/xml_elements.h"

namespace gaussmesh {

/// Reads the arrays of one file.
class VtkArrays {
 public:
  /// `xml` must outlive this.
  ///
  /// @throws InputError if its root is no VTKFile of that type, or has a compressor or an order of bytes that is not
  /// read
  VtkArrays(const XmlElements& xml, std::string_view type);

  /// The numbers of a DataArray; whole numbers beyond 2^53 are rounded.
  ///
  /// @throws InputError if it is not what it announces, is cut off, or cannot be expanded
  std::vector<double> read(const XmlElement& array) const;

 private:
  std::string bytes_of(const XmlElement& array) const;
  template <class Source>
  std::string plain_bytes(const XmlElement& array, Source source) const;
  template <class Source>
  std::string expanded_bytes(const XmlElement& array, Source source) const;
  template <class Source>
  std::vector<std::uint64_t> sizes(const XmlElement& array, Source& source, std::uint64_t count) const;

  const XmlElements& xml_;
  std::endian byte_order_ = std::endian::little;
  bool is_compressed_ = false;
  std::size_t size_bytes_ = sizeof(std::uint32_t);  // of each number in front of an array
  const XmlElement* appended_ = nullptr;            // none if nothing is appended
};

}  // namespace gaussmesh
