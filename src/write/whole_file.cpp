#include "write/whole_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "gaussmesh/error.h"

namespace gaussmesh {

WholeFile::WholeFile(const std::filesystem::path& path) : path_(path), temporary_(path.string() + ".XXXXXX") {
  if (std::filesystem::is_directory(path)) {
    throw InputError(path.string() + ": expected a file to write, got a directory");
  }
  descriptor_ = ::mkstemp(temporary_.data());
  if (descriptor_ < 0) {
    temporary_.clear();
    fail("cannot be created");
  }
}

WholeFile::~WholeFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void WholeFile::fail(const char* what) const {
  throw InputError(path_.string() + ": the output file " + what + ": " + std::strerror(errno));
}

void WholeFile::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(descriptor_, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("cannot be written");
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

void WholeFile::commit() {
  // mkstemp makes files that only their owner reads; give the ones that any new file would get.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  if (::fchmod(descriptor_, 0666 & ~mask) != 0) fail("cannot be given its permissions");
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("cannot be closed");
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot be put in its place");
  temporary_.clear();
}

}  // namespace gaussmesh
