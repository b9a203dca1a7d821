#include "threads.h"

#include <omp.h>

#include <algorithm>
#include <iostream>
#include <latch>
#include <system_error>
#include <thread>
#include <vector>

#include "validators.h"

namespace gaussmesh::app {
namespace {

/// How many of `count` threads can be there at a time.
int count_that_start(int count) {
  std::latch end(1);
  std::vector<std::thread> threads;
  threads.reserve(static_cast<std::size_t>(count));
  try {
    while (static_cast<int>(threads.size()) < count) threads.emplace_back([&end] { end.wait(); });
  } catch (const std::system_error&) {  // as many as there are
  }
  end.count_down();
  for (std::thread& thread : threads) thread.join();
  return static_cast<int>(threads.size());
}

}  // namespace

CLI::Option* add_threads_option(CLI::App& command, int& threads) {
  return command.add_option("--threads", threads, "threads (0 to 4096; default: 0, one for each processor)")
      ->type_name("N")
      ->check(whole_number_between(0, 4096));
}

int take_threads(int wish, FewerThreads message) {
  const int asked = wish > 0 ? wish : std::max(omp_get_num_procs(), omp_get_max_threads());
  const int wanted = std::min(asked, omp_get_thread_limit());
  if (wish > 0) omp_set_num_threads(wish);
  if (wanted < 2) return wish;
  const int started = count_that_start(wanted);  // this one is there already: one of them is for the bar
  if (started == wanted) return wish;
  const int threads = std::max(started, 1);
  omp_set_num_threads(std::min(threads, omp_get_max_threads()));
  if (message == FewerThreads::kWarn) {
    std::cerr << "gaussmesh: warning: expected to start " << wanted << " threads, got " << threads
              << "; a limit on processes or memory (ulimit -u, -v) leaves no room for more\n";
  }
  return threads;
}

}  // namespace gaussmesh::app
