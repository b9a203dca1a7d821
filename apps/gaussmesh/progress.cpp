#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>

namespace gaussmesh::app {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 1s;  // shorter runs have no bar
constexpr auto kRefresh = 200ms;

/// The stages, and what each takes of the whole as measured on proteins; other stages count for nothing. Curves and
/// patches are done again as cells are split, nobody knows how often: that is kAgain.
constexpr const char* kAgain = "split cells";
constexpr const char* kImprove = "improve";
constexpr std::pair<const char*, double> kStages[] = {{"boxes and roots", 0.03}, {"folds", 0.02}, {"curves", 0.15},
                                                      {"patches", 0.05},         {kAgain, 0.18},  {kImprove, 0.53},
                                                      {"verify", 0.04}};

}  // namespace

ProgressBar::ProgressBar(bool improves) {
  double total = 0.0;
  for (const auto& [name, share] : kStages) {
    if (!improves && std::string_view(name) == kImprove) continue;
    stages_.push_back({name, share});
    total += share;
  }
  for (Stage& stage : stages_) stage.share /= total;
  if (!::isatty(STDERR_FILENO)) return;
  try {
    thread_ = std::thread([this] { show_until_done(); });
  } catch (const std::system_error&) {  // the work goes on without a bar
  }
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
  const auto ended = std::find_if(stages_.begin(), stages_.end(), [&](const Stage& s) { return s.name == stage; });
  const auto number = static_cast<std::size_t>(ended - stages_.begin());
  if (number == stages_.size() || number < current_) return;  // done again, with other parameters
  current_ = number + 1;
  part_ = 0.0;
  last_ = Clock::now();
}

void ProgressBar::improving(double share_done) {
  const std::lock_guard lock(mutex_);
  while (current_ + 1 < stages_.size() && stages_[current_].name != kImprove) ++current_;
  part_ = std::max(part_, share_done);
  last_ = Clock::now();
}

/// What has been told, and since then more by time at the pace before. A stage may take longer than it should: the
/// bar then creeps towards the stage's end.
double ProgressBar::share_done() const {
  double done = 0.0;
  for (std::size_t i = 0; i < current_; ++i) done += stages_[i].share;
  if (current_ == stages_.size()) return done;
  const double rest = stages_[current_].share * (1.0 - part_);
  done += stages_[current_].share * part_;
  const double before_s = std::chrono::duration<double>(last_ - start_).count();
  const double since_s = std::chrono::duration<double>(Clock::now() - last_).count();
  const double expected_s = done > 0.0 ? before_s * rest / done : since_s + 1.0;
  return done + rest * since_s / (since_s + expected_s);
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

void ProgressBar::draw() {
  constexpr int kWidth = 30;
  shown_ = std::max(shown_, share_done());
  const int filled = static_cast<int>(shown_ * kWidth);
  const double time_s = std::chrono::duration<double>(Clock::now() - start_).count();
  std::fprintf(stderr, "\r\033[K[%s%s] %.0f %%, %.0f s%s%s", std::string(static_cast<std::size_t>(filled), '#').c_str(),
               std::string(static_cast<std::size_t>(kWidth - filled), '.').c_str(), 100.0 * shown_, time_s,
               current_ < stages_.size() ? ", " : "", current_ < stages_.size() ? stages_[current_].name.c_str() : "");
  std::fflush(stderr);
}

}  // namespace gaussmesh::app
