#include "write/gzip_encoder.h"

#include <algorithm>
#include <array>
#include <limits>
#include <new>

namespace gaussmesh {

GzipEncoder::GzipEncoder() {
  constexpr int kGzip = 16;  // what zlib adds to the window to write a header of gzip
  constexpr int kMemoryLevel = 8;
  if (deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzip, kMemoryLevel, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw std::bad_alloc();
  }
}

GzipEncoder::~GzipEncoder() { deflateEnd(&stream_); }

std::string GzipEncoder::run(std::string_view text, int flush) {
  std::string ready;
  std::array<char, 1 << 16> chunk{};
  do {
    const std::size_t given = std::min<std::size_t>(text.size(), std::numeric_limits<uInt>::max());
    // zlib declares its input as not const, but does not write to it.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream_.avail_in = static_cast<uInt>(given);
    stream_.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream_.avail_out = static_cast<uInt>(chunk.size());
    deflate(&stream_, flush);  // has no errors but those of wrong use
    text.remove_prefix(given - stream_.avail_in);
    ready.append(chunk.data(), chunk.size() - stream_.avail_out);
  } while (!text.empty() || stream_.avail_out == 0);
  return ready;
}

}  // namespace gaussmesh
