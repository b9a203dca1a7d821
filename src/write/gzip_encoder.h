// Output as gzip, piece by piece. Reading it is text/read_file.h.
#pragma once

#include <zlib.h>

#include <string>
#include <string_view>

namespace gaussmesh {

/// Makes one gzip member of all that it is given; the same bytes for the same pieces, since it notes neither name nor
/// time.
class GzipEncoder {
 public:
  /// @throws std::bad_alloc
  GzipEncoder();
  ~GzipEncoder();
  GzipEncoder(const GzipEncoder&) = delete;
  GzipEncoder& operator=(const GzipEncoder&) = delete;

  /// Takes the next piece; returns what is ready, which may be nothing.
  std::string encode(std::string_view text) { return run(text, Z_NO_FLUSH); }

  /// The rest. Nothing may follow.
  std::string finish() { return run({}, Z_FINISH); }

 private:
  std::string run(std::string_view text, int flush);

  z_stream stream_{};
};

}  // namespace gaussmesh
