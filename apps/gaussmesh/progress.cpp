#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace gaussmesh::app {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 1s;  // shorter runs have no bar
constexpr auto kRefresh = 200ms;

/// The share of the work that is done when a stage ends, as measured on proteins; others leave the bar where it is.
constexpr std::pair<const char*, double> kShares[] = {{"boxes and roots", 0.10}, {"folds", 0.14}, {"curves", 0.34},
                                                      {"patches", 0.42},         {"improve", 0.93}, {"verify", 1.0}};

}  // namespace

ProgressBar::ProgressBar(bool is_wanted) {
  if (is_wanted && ::isatty(STDERR_FILENO)) thread_ = std::thread([this] { show_until_done(); });
}

ProgressBar::~ProgressBar() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_done_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void ProgressBar::stage_ended(const std::string& stage) {
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  for (const auto& [name, share] : kShares)
    if (name == stage) share_ = std::max(share_, share);
}

void ProgressBar::show_until_done() {
  std::unique_lock lock(mutex_);
  if (wake_.wait_for(lock, kPatience, [this] { return is_done_; })) return;
  while (!is_done_) {
    draw();
    wake_.wait_for(lock, kRefresh, [this] { return is_done_; });
  }
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

void ProgressBar::draw() const {
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(share_ * kWidth);
  const double time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::fprintf(stderr, "\r\033[K[%s%s] %.0f s%s%s", std::string(static_cast<std::size_t>(filled), '#').c_str(),
               std::string(static_cast<std::size_t>(kWidth - filled), '.').c_str(), time_s,
               stage_.empty() ? "" : ", done: ", stage_.c_str());
  std::fflush(stderr);
}

}  // namespace gaussmesh::app
