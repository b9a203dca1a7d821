#include "write/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <random>
#include <string>
#include <utility>

#include "gaussmesh/error.h"
#include "gaussmesh/write_mesh.h"
#include "text/read_file.h"

namespace gaussmesh {
namespace {

namespace fs = std::filesystem;

/// What a chain of links leads to, which need not be there.
fs::path end_of_links(fs::path path) {
  constexpr int kMostLinks = 40;  // as in Linux
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, error); ++i) {
    const fs::path next = fs::read_symlink(path, error);
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

/// Whether something is there that is written to and not replaced: devices, pipes, and what has no name in any folder.
///
/// The system follows the links of /dev/fd to what is open, whatever their text says: `pipe:[17]`, or a name that has
/// been taken away. So the path itself tells what is there, and not where its links seem to lead.
bool is_written_in_place(const fs::path& path, const fs::path& target) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !(fs::is_regular_file(status) && fs::equivalent(path, target, error));
}

std::string random_letters() {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  std::random_device random;
  std::string text(6, ' ');
  for (char& c : text) c = kLetters[random() % kLetters.size()];
  return text;
}

/// What temporary names begin with: a name may be as long as the file system takes, and has to leave room for letters.
std::string beginning(std::string name) {
  constexpr std::size_t kMost = 100;  // bytes; encrypted folders take 143, others 255
  if (name.size() <= kMost) return name;
  std::size_t end = kMost;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;  // not amid a character of UTF-8
  name.resize(end);
  return name;
}

}  // namespace

std::atomic<WholeFile::Unfinished*> WholeFile::unfinished_{nullptr};
std::atomic<int> WholeFile::commits_under_way_{0};

WholeFile::WholeFile(const fs::path& path) : path_(path), target_(end_of_links(path)) {
  if (without_gzip(path.native()) != path.native()) gzip_ = std::make_unique<GzipEncoder>();
  if (path == "-") {
    descriptor_ = ::dup(STDOUT_FILENO);
    if (descriptor_ < 0) fail("cannot be opened");
    return;
  }
  std::error_code error;
  if (fs::is_directory(path, error)) {
    throw InputError(path.string() + ": expected a file to write, got a directory");
  }
  if (is_written_in_place(path, target_)) {
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot be opened");
    return;
  }
  if (fs::is_symlink(target_, error)) {
    errno = ELOOP;
    fail("cannot be found");
  }
  if (fs::exists(target_, error) && ::access(target_.c_str(), W_OK) != 0) fail("cannot be replaced");
  make_temporary();
}

void WholeFile::require_writable(const fs::path& path) {
  std::error_code error;  // the constructor tells what is wrong
  if (!fs::is_fifo(path, error)) {
    const WholeFile probe(path);
  } else if (::access(path.c_str(), W_OK) != 0) {
    throw InputError(path.string() + ": the output file cannot be opened: " + std::strerror(errno));
  }
}

WholeFile::WholeFile(WholeFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, nullptr)),
      old_(std::exchange(other.old_, {})),
      old_is_lost_(std::exchange(other.old_is_lost_, false)),
      is_committed_(std::exchange(other.is_committed_, false)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      gzip_(std::move(other.gzip_)) {}

WholeFile::~WholeFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!old_.empty()) ::unlink(old_.c_str());
  if (temporary_ == nullptr) return;
  ::unlink(temporary_->path.c_str());
  temporary_->is_there = false;
}

void WholeFile::make_temporary() {
  static std::mutex list_mutex;
  const std::lock_guard lock(list_mutex);
  temporary_ = new Unfinished;
  temporary_->next = unfinished_;
  unfinished_ = temporary_;
  constexpr int kAttempts = 100;
  for (int attempt = 0; attempt < kAttempts && descriptor_ < 0; ++attempt) {
    temporary_->path = beside_target();
    // Known before it is there: a signal at any moment from here on finds it.
    temporary_->is_there = true;
    descriptor_ = ::open(temporary_->path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
      temporary_->is_there = false;
      if (errno != EEXIST) break;
    }
  }
  if (descriptor_ < 0) {
    temporary_ = nullptr;
    fail("cannot be created");
  }
}

/// A name beside the target that is not likely to be taken.
std::string WholeFile::beside_target() const {
  return target_.parent_path() / (beginning(target_.filename().string()) + "." + random_letters());
}

void WholeFile::fail(const char* what) const {
  throw InputError(path_.string() + ": the output file " + what + ": " + std::strerror(errno));
}

void WholeFile::write(std::string_view text) {
  if (gzip_) {
    put(gzip_->encode(text));
  } else {
    put(text);
  }
}

void WholeFile::put(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("cannot be written");
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void WholeFile::close() {
  if (descriptor_ < 0) return;
  if (gzip_) put(gzip_->finish());
  if (temporary_ != nullptr) {
    struct stat old {};
    if (::stat(target_.c_str(), &old) == 0 && ::fchmod(descriptor_, old.st_mode & 0777) != 0) {
      fail("cannot be given the permissions of what it replaces");
    }
  }
  if (::close(std::exchange(descriptor_, -1)) != 0) fail("cannot be closed");
}

void WholeFile::commit() {
  close();
  if (temporary_ == nullptr) return;
  if (std::rename(temporary_->path.c_str(), target_.c_str()) != 0) fail("cannot be put in its place");
  temporary_->is_there = false;
  temporary_ = nullptr;
  is_committed_ = true;
}

void WholeFile::keep_old() {
  if (temporary_ == nullptr) return;
  const std::string name = beside_target();
  if (::link(target_.c_str(), name.c_str()) == 0) {
    old_ = name;
  } else {
    old_is_lost_ = errno != ENOENT;
  }
}

void WholeFile::undo() noexcept {
  if (!std::exchange(is_committed_, false)) return;
  if (old_.empty()) {
    if (!old_is_lost_) ::unlink(target_.c_str());
  } else if (std::rename(old_.c_str(), target_.c_str()) == 0) {
    old_.clear();
  }
}

bool remove_unfinished_files() noexcept {
  if (WholeFile::commits_under_way_ > 0) return false;
  for (WholeFile::Unfinished* entry = WholeFile::unfinished_; entry != nullptr; entry = entry->next) {
    if (entry->is_there) ::unlink(entry->path.c_str());
  }
  return true;
}

}  // namespace gaussmesh
