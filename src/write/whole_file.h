// A file that appears whole or not at all.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "write/gzip_encoder.h"

namespace gaussmesh {

/// Collects output in a temporary file beside `path`; commit() renames it. Without commit() nothing is left behind.
///
/// Where there is no file that could be replaced - `-` for standard output, devices, pipes, also those that the shell
/// names /dev/fd/N - the output goes there at once. A symbolic link is followed, also where it leads to nothing yet.
/// What is replaced keeps its permissions. Names that end in `.gz`, in any case, get their text gzipped.
class WholeFile {
 public:
  /// @throws InputError if no file can be made there
  explicit WholeFile(const std::filesystem::path& path);

  /// Throws what the constructor would. A pipe is not opened: who reads it would take its closing for the end.
  static void require_writable(const std::filesystem::path& path);

  ~WholeFile();
  WholeFile(WholeFile&& other) noexcept;
  WholeFile& operator=(WholeFile&&) = delete;

  void write(std::string_view text);

  /// Ends the writing; what has been written is where it can be committed, and no file stays open.
  void close();

  void commit();

  /// Has undo() bring back what commit() replaces, where the file system knows hard links.
  void keep_old();

  /// Takes a commit() back: what was there at keep_old() is there again. What could not be kept stays replaced.
  void undo() noexcept;

  /// While there is one, remove_unfinished_files() does nothing: for the commits of several files that belong together.
  class CommitsUnderWay {
   public:
    CommitsUnderWay() noexcept { ++commits_under_way_; }
    ~CommitsUnderWay() { --commits_under_way_; }
    CommitsUnderWay(const CommitsUnderWay&) = delete;
    CommitsUnderWay& operator=(const CommitsUnderWay&) = delete;
  };

 private:
  /// A temporary file, in a list that only grows: a signal may come at any time, on any thread.
  struct Unfinished {
    std::string path;
    std::atomic<bool> is_there{false};  // or about to be
    Unfinished* next = nullptr;
  };
  friend bool remove_unfinished_files() noexcept;
  static std::atomic<Unfinished*> unfinished_;
  static std::atomic<int> commits_under_way_;

  void make_temporary();
  void put(std::string_view bytes);
  std::string beside_target() const;
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path path_;       // as given, for messages
  std::filesystem::path target_;     // what is replaced
  Unfinished* temporary_ = nullptr;  // none where the output goes to its place at once
  std::string old_;                  // another name of what is replaced, where it is kept
  bool old_is_lost_ = false;         // there is something to replace, and it cannot be kept
  bool is_committed_ = false;
  int descriptor_ = -1;
  std::unique_ptr<GzipEncoder> gzip_;  // none where the text is written as it is
};

}  // namespace gaussmesh
