// A limit on the memory of the program: what does not fit is kept in a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <new>

namespace gaussmesh::app {

/// What --max-memory takes at least (bytes): an eighth for the heap, and more than half for what is touched before
/// the limit is looked at again.
inline constexpr std::uint64_t kLeastMemory = std::uint64_t{128} << 20;

/// Memory of the machine with its swap (bytes), or 0 if that is not known.
double physical_memory();

/// There is no room on the disk for what does not fit into memory.
struct NoRoomOnDisk : std::bad_alloc {
  const char* what() const noexcept override {
    return "max-memory: no room for the temporary file in the folder of the mesh; expected a disk with more space, "
           "or a larger limit";
  }
};

/// From now on at most an eighth of `limit` (bytes) is taken from the heap. Everything beyond is in a file in
/// `folder`, which has no name and is gone when the program ends, and is mapped into memory. When more than the
/// limit would be resident, pages of the file are unmapped, one stretch of it after another, until they are asked
/// for again.
///
/// Results are the same; only time is lost. Whatever is resident counts: program, heap, stacks, and mapped pages of
/// the file. Pages that are unmapped may still be in the system's cache, as those of any file, while nobody else
/// needs the room. A thread watches what is resident, and SIGPROF makes the others look at it too, and wait where there
/// is no room: for some milliseconds it may be more than it should, which the limit has a margin for.
///
/// Linux. To be called once, before other threads are started.
/// @param limit  at least kLeastMemory
/// @throws InputError      if the file cannot be made, or not be mapped
/// @throws CannotMeshError if no thread can be started
/// Afterwards `new` throws NoRoomOnDisk where the file cannot grow.
void limit_memory(std::uint64_t limit, const std::filesystem::path& folder);

}  // namespace gaussmesh::app
