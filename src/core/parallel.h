// Loops over independent slots, on several threads.
#pragma once

#include <omp.h>

#include <cstddef>
#include <exception>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace gaussmesh {

/// How many threads a user's wish means: 0 is one for each processor.
inline int thread_count(int wish) { return wish > 0 ? wish : omp_get_num_procs(); }

/// What OpenMP takes as the number of threads where nothing else is said, as long as this lives.
class DefaultThreads {
 public:
  explicit DefaultThreads(int threads) : before_(omp_get_max_threads()) { omp_set_num_threads(threads); }
  DefaultThreads(const DefaultThreads&) = delete;
  DefaultThreads& operator=(const DefaultThreads&) = delete;
  ~DefaultThreads() { omp_set_num_threads(before_); }

 private:
  int before_;
};

/// Calls worker(i) for i = 0 .. count - 1, in any order and on `threads` threads; each call writes to its own slot
/// only. Each thread has a worker of its own from make_worker(), which keeps buffers from slot to slot, and takes
/// `chunk` slots at a time. When calls throw, the exception of the smallest i is thrown again, whatever the number of
/// threads.
template <typename MakeWorker>
void parallel_for_workers(std::size_t count, int threads, int chunk, const MakeWorker& make_worker) {
  std::exception_ptr error;
  std::size_t error_at = count;
#pragma omp parallel num_threads(threads)
  {
    std::optional<std::invoke_result_t<const MakeWorker&>> worker;
#pragma omp for schedule(dynamic, chunk)
    for (std::size_t i = 0; i < count; ++i) {
      try {
        if (!worker) worker.emplace(make_worker());
        (*worker)(i);
      } catch (...) {
        worker.reset();  // it may have been left in the middle of something
#pragma omp critical(gaussmesh_parallel_for)
        if (i < error_at) {
          error_at = i;
          error = std::current_exception();
        }
      }
    }
  }
  if (error) std::rethrow_exception(error);
}

/// The same with one function for all threads, which take one slot at a time.
template <typename Work>
void parallel_for(std::size_t count, int threads, const Work& work) {
  parallel_for_workers(count, threads, 1, [&] { return [&](std::size_t i) { work(i); }; });
}

/// Calls work(chunk, first, last) for parts of 0 .. count - 1, first .. last - 1 of `size` each but for the last chunk:
/// the same ones for any number of threads.
template <typename Work>
void parallel_for_chunks(std::size_t count, std::size_t size, int threads, const Work& work) {
  parallel_for((count + size - 1) / size, threads, [&](std::size_t chunk) {
    work(chunk, chunk * size, count < (chunk + 1) * size ? count : (chunk + 1) * size);
  });
}

/// Resizes an array on all threads: the system gives memory when it is first written to, page by page, which takes
/// longer than to fill it with zeros.
template <typename T>
void resize_in_parallel(std::vector<T>& array, std::size_t count, int threads) {
  constexpr std::size_t kPage = 4096, kBytesAtOnce = 64 * kPage;
  array.reserve(count);
  if (count > array.size() && threads > 1) {
    auto* const bytes = reinterpret_cast<volatile char*>(array.data() + array.size());
    parallel_for_chunks((count - array.size()) * sizeof(T), kBytesAtOnce, threads,
                        [&](std::size_t, std::size_t first, std::size_t last) {
                          for (std::size_t i = first; i < last; i += kPage) bytes[i] = 0;
                        });
  }
  array.resize(count);
}

/// Calls gather(first, last, list) for the same parts of 0 .. count - 1, each with a list of its own.
/// @return the lists one after the other, in the order of the parts
template <typename Entry, typename Gather>
std::vector<Entry> parallel_gather(std::size_t count, std::size_t size, int threads, const Gather& gather) {
  std::vector<std::vector<Entry>> parts((count + size - 1) / size);
  parallel_for_chunks(count, size, threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    gather(first, last, parts[chunk]);
  });
  if (parts.size() == 1) return std::move(parts[0]);
  std::size_t entries = 0;
  for (const auto& part : parts) entries += part.size();
  std::vector<Entry> all;
  all.reserve(entries);
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace gaussmesh
