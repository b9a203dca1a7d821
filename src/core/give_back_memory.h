// Memory that is free, back to the system.
#pragma once

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace gaussmesh {

/// Hands memory that is free to the system: what was given back in many small pieces is of no use to the large arrays
/// that come next. Does nothing where the C library has no such call.
inline void give_back_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace gaussmesh
