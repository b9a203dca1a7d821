// Loops over independent slots, on as many threads as OpenMP takes where nothing is said: what is thrown in a parallel
// region must not leave it, and is thrown again behind it. The judge has loops of its own, since it includes nothing of
// the stages that it judges.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <optional>
#include <type_traits>

namespace gaussmesh::verify {

/// Calls worker(i) for i = 0 .. count - 1, in any order; each call writes to its own slot only. Each thread has a
/// worker of its own from make_worker(), which keeps buffers from slot to slot. When calls throw, the
/// exception of the smallest i is thrown again, whatever the number of threads.
template <class MakeWorker>
void parallel_for_workers(std::size_t count, const MakeWorker& make_worker) {
  std::exception_ptr error;
  std::size_t error_at = count;
#pragma omp parallel
  {
    std::optional<std::invoke_result_t<const MakeWorker&>> worker;
#pragma omp for schedule(dynamic)
    for (std::size_t i = 0; i < count; ++i) {
      try {
        if (!worker) worker.emplace(make_worker());
        (*worker)(i);
      } catch (...) {
        worker.reset();  // it may have been left in the middle of something
#pragma omp critical(gaussmesh_verify_error)
        if (i < error_at) {
          error_at = i;
          error = std::current_exception();
        }
      }
    }
  }
  if (error) std::rethrow_exception(error);
}

/// The same with one function for all threads.
template <class Work>
void parallel_for(std::size_t count, const Work& work) {
  parallel_for_workers(count, [&] { return [&](std::size_t i) { work(i); }; });
}

/// How many chunks of `size` there are in `count`; the last may be smaller.
constexpr std::size_t chunk_count(std::size_t count, std::size_t size) { return (count + size - 1) / size; }

/// Calls work(chunk, begin, end) for each of these chunks, which are the same for any number of threads.
template <class Work>
void parallel_for_chunks(std::size_t count, std::size_t size, const Work& work) {
  parallel_for(chunk_count(count, size),
               [&](std::size_t chunk) { work(chunk, chunk * size, std::min((chunk + 1) * size, count)); });
}

}  // namespace gaussmesh::verify
