// How far the work is, shown to a person who waits.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace gaussmesh::app {

/// A bar on the terminal, from the first second on until it is destroyed; nothing is left of it then.
///
/// Where standard error is no terminal, or no thread can be started, there is no bar.
class ProgressBar {
 public:
  /// @param improves  whether there is a stage that improves the triangles
  explicit ProgressBar(bool improves);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Takes note that a stage of mesh_surface() has ended.
  void stage_ended(const std::string& stage);

  /// Takes note of the share of the improvement that is done. On any thread.
  void improving(double share_done);

 private:
  void show_until_done();
  void draw();

  using Clock = std::chrono::steady_clock;

  struct Stage {
    std::string name;
    double share = 0.0;  // of the whole work
  };

  double share_done() const;

  std::vector<Stage> stages_;
  std::size_t current_ = 0;  // stage that is under way
  Clock::time_point start_ = Clock::now();
  double part_ = 0.0;                // of that stage that is done, as told
  double shown_ = 0.0;               // the bar never goes back
  Clock::time_point last_ = start_;  // when something was told
  std::mutex mutex_;
  std::condition_variable wake_;
  bool is_done_ = false;
  std::thread thread_;
};

}  // namespace gaussmesh::app
