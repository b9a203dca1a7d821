// How far the work is, shown to a person who waits.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace gaussmesh::app {

/// A bar on the terminal, from the first second on until it is destroyed; nothing is left of it then.
///
/// Where standard error is no terminal there is no bar.
class ProgressBar {
 public:
  /// @param is_wanted  false: no bar at all
  explicit ProgressBar(bool is_wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Takes note that a stage of mesh_surface() has ended.
  void stage_ended(const std::string& stage);

 private:
  void show_until_done();
  void draw() const;

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable wake_;
  bool is_done_ = false;
  double share_ = 0.0;  // of the work, as far as the stages tell
  std::string stage_;
  std::thread thread_;
};

}  // namespace gaussmesh::app
