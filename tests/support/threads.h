// Work on a number of threads that the test chooses.
#pragma once

#include "core/parallel.h"

namespace gaussmesh::testing {

/// What work() returns where OpenMP takes `threads` threads unless it is told otherwise.
template <typename Work>
auto on_threads(int threads, const Work& work) {
  const DefaultThreads chosen(threads);
  return work();
}

}  // namespace gaussmesh::testing
