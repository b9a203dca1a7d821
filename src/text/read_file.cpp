#include "text/read_file.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <istream>
#include <limits>
#include <system_error>
#include <utility>

#include "gaussmesh/error.h"
#include "text/text_lines.h"

namespace gaussmesh {
namespace {

constexpr std::string_view kGzipMagic = "\x1f\x8b";

/// How other compressed data are known, and the program that expands them.
struct Compression {
  std::string_view name;
  std::size_t offset;
  std::string_view magic;
  std::string_view program;
};
constexpr std::array<Compression, 3> kUnknownCompressions = {
    {{"bzip2", 4, "1AY&SY", "bzcat"},  // of its first block; the letters at the beginning could be text
     {"xz", 0, std::string_view("\xfd\x37zXZ\0", 6), "xzcat"},
     {"zstd", 0, "\x28\xb5\x2f\xfd", "zstdcat"}}};

/// Gzip makes atoms and meshes 3 to 10 times smaller, and other data up to 1032 times: what expands more than this, and
/// to more than is always expanded, is neither.
constexpr std::size_t kLargestExpansion = 200;
constexpr std::size_t kAlwaysExpanded = std::size_t{64} << 20;

[[noreturn]] void fail_to_read(std::string_view name, std::string_view reason) {
  throw InputError(std::string(name) + ": expected a readable file, got " + quoted(reason));
}

[[noreturn]] void fail_to_expand(std::string_view name, std::string_view got) {
  throw InputError(std::string(name) + ": expected gzip data, got " + std::string(got));
}

/// What is left of `input`, of which about `size` bytes are expected.
std::string read_all(std::istream& input, std::string_view name, std::uintmax_t size) {
  std::string text;
  text.reserve(size);
  std::array<char, 1 << 16> chunk{};
  while (input.read(chunk.data(), chunk.size()) || input.gcount() > 0) {
    text.append(chunk.data(), static_cast<std::size_t>(input.gcount()));
  }
  if (input.bad()) {
    fail_to_read(name, "read error");
  }
  return text;
}

/// Expands one gzip file held in memory, of one or more members.
class GzipReader {
 public:
  GzipReader(std::string_view data, std::string_view name)
      : data_(data), name_(name), limit_(std::max(kAlwaysExpanded, kLargestExpansion * data.size())) {
    constexpr int kGzipOnly = 16;  // what zlib adds to the window to read no other header
    if (inflateInit2(&stream_, MAX_WBITS + kGzipOnly) != Z_OK) {
      throw InternalError("expected zlib to start, got no memory");
    }
  }
  ~GzipReader() { inflateEnd(&stream_); }
  GzipReader(const GzipReader&) = delete;
  GzipReader& operator=(const GzipReader&) = delete;

  std::string expand() {
    do {
      expand_member();
      inflateReset(&stream_);
    } while (data_.substr(position_).starts_with(kGzipMagic));
    if (data_.find_first_not_of('\0', position_) != std::string_view::npos) {  // tapes pad with NUL
      fail_to_expand(name_, "other data after it; the file is corrupt");
    }
    return std::move(text_);
  }

 private:
  void expand_member() {
    int status = Z_OK;
    while (status != Z_STREAM_END) {
      status = expand_chunk();
      if (text_.size() > limit_) {
        fail_to_expand(name_, "data that expand more than " + std::to_string(kLargestExpansion) +
                                  "-fold; if that is meant, expand them with gunzip first");
      }
    }
  }

  int expand_chunk() {
    const std::size_t given = std::min<std::size_t>(data_.size() - position_, std::numeric_limits<uInt>::max());
    // zlib declares its input as not const, but does not write to it.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data_.data() + position_));
    stream_.avail_in = static_cast<uInt>(given);
    stream_.next_out = reinterpret_cast<Bytef*>(chunk_.data());
    stream_.avail_out = static_cast<uInt>(chunk_.size());
    const int status = inflate(&stream_, Z_NO_FLUSH);
    position_ += given - stream_.avail_in;
    text_.append(chunk_.data(), chunk_.size() - stream_.avail_out);
    if (status == Z_BUF_ERROR && position_ == data_.size()) {
      fail_to_expand(name_, "only its beginning; the file is cut off");
    }
    if (status != Z_OK && status != Z_STREAM_END) {
      fail_to_expand(name_, std::string("corrupt data (") + (stream_.msg != nullptr ? stream_.msg : "damaged") + ")");
    }
    return status;
  }

  std::string_view data_;
  std::string_view name_;
  std::size_t limit_ = 0;
  std::size_t position_ = 0;
  z_stream stream_{};
  std::array<char, 1 << 16> chunk_{};
  std::string text_;
};

/// Whether `name` ends in `ending`, in any case.
bool ends_in(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() &&
         std::equal(ending.begin(), ending.end(), name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                    [](char a, char b) { return to_upper(a) == to_upper(b); });
}

/// Throws InputError for compressed data of the kinds that are not expanded here.
void require_known_compression(std::string_view data, std::string_view name, ReadFor purpose) {
  const bool is_mesh = purpose == ReadFor::kMesh;
  for (const Compression& kind : kUnknownCompressions) {
    if (data.size() < kind.offset || !data.substr(kind.offset).starts_with(kind.magic)) continue;
    throw InputError(std::string(name) + ": expected plain or gzipped data, got " + std::string(kind.name) +
                     "; expand it first, or on the way to standard input as in '" + std::string(kind.program) +
                     (is_mesh ? " FILE | gaussmesh check -'"
                              : " FILE | gaussmesh -', with --input-format for molecules that are not PQR"));
  }
}

std::string expand(std::string data, std::string_view name, ReadFor purpose) {
  if (data.starts_with(kGzipMagic)) return GzipReader(data, name).expand();
  require_known_compression(data, name, purpose);
  return data;
}

}  // namespace

std::string read_file(const std::filesystem::path& path, ReadFor purpose) {
  const std::string name = path.string();
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    fail_to_read(name, "Is a directory");
  }
  errno = 0;
  std::ifstream input(path, std::ios::binary);
  if (!input) {
    fail_to_read(name, errno != 0 ? std::generic_category().message(errno) : "an unknown error");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return expand(read_all(input, name, error ? 0 : size), name, purpose);  // a pipe has no size
}

std::string read_stream(std::istream& input, std::string_view name, ReadFor purpose) {
  return expand(read_all(input, name, 0), name, purpose);
}

std::string_view without_gzip(std::string_view name) {
  constexpr std::string_view kEnding = ".gz";
  return ends_in(name, kEnding) ? name.substr(0, name.size() - kEnding.size()) : name;
}

bool has_extension(std::string_view name, std::string_view extension) { return ends_in(without_gzip(name), extension); }

}  // namespace gaussmesh
