// The program's own `new` and `delete`: malloc and free until there is a limit, and pieces of the file beyond it.
//
// The file is cut into units of 1 MiB. A large piece has units of its own, which go back to the disk with it and
// are not used again: addresses, and offsets in a file with holes, are not scarce. Small pieces of one size share a
// unit, and are used again for that size.

#include "memory_limit.h"

#include <fcntl.h>
#include <malloc.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/sysinfo.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "gaussmesh/error.h"

namespace {

using gaussmesh::app::NoRoomOnDisk;

constexpr std::size_t kUnit = std::size_t{1} << 20;
constexpr std::size_t kUnits = std::size_t{1} << 23;  // 8 TiB: what an ext4 file can hold, with room
constexpr std::size_t kSpan = kUnits * kUnit;

// Sizes of small pieces: 16, 32, ... 1024, then four for each doubling up to kLargestSmall.
constexpr std::size_t kStep = 16;
constexpr std::size_t kFineSizes = 64;
constexpr std::size_t kDoublings = 8;
constexpr std::size_t kSizes = kFineSizes + 4 * kDoublings;
constexpr std::size_t kLargestSmall = (kStep * kFineSizes) << kDoublings;

struct PieceSize {
  std::size_t number;
  std::size_t bytes;
};

/// The smallest size that holds `bytes`, 1 to kLargestSmall.
PieceSize piece_size(std::size_t bytes) {
  if (bytes <= kStep * kFineSizes) {
    const std::size_t number = (bytes - 1) / kStep;
    return {number, (number + 1) * kStep};
  }
  const auto doubling = static_cast<std::size_t>(std::bit_width(bytes - 1)) - 1;
  const std::size_t low = std::size_t{1} << doubling;
  const std::size_t quarter = (bytes - 1 - low) / (low / 4);
  return {kFineSizes + 4 * (doubling - std::bit_width(kStep * kFineSizes) + 1) + quarter,
          low + (quarter + 1) * (low / 4)};
}

struct FreePiece {
  FreePiece* next;
};

/// Small pieces of one size.
struct Shelf {
  std::mutex mutex;
  FreePiece* free = nullptr;
  char* fresh = nullptr;  ///< never used so far, up to `end`
  char* end = nullptr;
};

struct Spool {
  std::atomic<bool> is_on = false;
  std::atomic<std::int64_t> on_heap = 0;  ///< bytes
  std::int64_t most_on_heap = 0;
  std::uint64_t most_resident = 0, enough_resident = 0;  ///< bytes: where pages are unmapped, and until when
  int file = -1;
  int statm = -1;  ///< /proc/self/statm
  char* base = nullptr;
  std::mutex mutex;
  std::atomic<std::size_t> units = 0;  ///< taken so far
  std::array<Shelf, kSizes> shelves;
  std::uint64_t page_size = 0;  ///< bytes
  std::atomic_flag is_swept;    ///< by some thread, now
  std::size_t sweep_at = 0;     ///< unit that is next to be unmapped
  std::size_t sweep_left = 0;   ///< units from there on that belong to the same piece, or 0 where one begins
};

// Neither is ever destroyed: pieces are given back until the very end.
constinit Spool spool;
/// By unit: the number of the size of its pieces, or kSizes and the units of the large piece that begins there, with
/// kGivenBack once that is not used any more.
constinit std::uint32_t unit_use[kUnits];
constexpr std::uint32_t kGivenBack = std::uint32_t{1} << 31;

/// What is given back, or taken, by one thread is swept by another.
std::atomic_ref<std::uint32_t> use_of(std::size_t unit) { return std::atomic_ref(unit_use[unit]); }

std::size_t units_of(std::uint32_t use) {
  const std::uint32_t size = use & ~kGivenBack;
  return size > kSizes ? size - kSizes : 1;
}

/// Bytes of the program that are in memory.
std::uint64_t resident() {
  char text[128] = {};
  if (::pread(spool.statm, text, sizeof text - 1, 0) <= 0) return 0;
  char* second = text;
  std::strtoull(text, &second, 10);
  return std::strtoull(second, nullptr, 10) * spool.page_size;
}

/// Whether this thread is in make_room(): a signal that interrupts it there must not wait for it.
constinit thread_local std::atomic<bool> makes_room = false;

/// Unmaps pages of the file if too many are resident, or will be once `soon` bytes more are, or waits while another
/// thread does so: nobody touches pages faster than they are unmapped. Nothing gets lost: what was written to a shared
/// mapping is in the file. Takes no locks and no memory, for signal handlers.
void make_room(std::uint64_t soon) {
  constexpr std::size_t kAtOnce = 8;  // units
  soon = std::min(soon, spool.enough_resident / 2);
  if (makes_room || resident() + soon < spool.most_resident) return;
  makes_room = true;  // before the flag is this thread's, and until it is not any more
  if (spool.is_swept.test_and_set()) {
    while (spool.is_swept.test()) ::sched_yield();
    makes_room = false;
    return;
  }
  const std::size_t all = spool.units;
  for (std::size_t seen = 0; seen < all && resident() + soon > spool.enough_resident;) {
    // What was given back is most of the file after a while, and takes no time.
    while (spool.sweep_left == 0 && seen < all) {
      if (spool.sweep_at >= all) spool.sweep_at = 0;
      const std::uint32_t use = use_of(spool.sweep_at);
      if ((use & kGivenBack) == 0) {
        spool.sweep_left = units_of(use);
      } else {
        spool.sweep_at += units_of(use);
        seen += units_of(use);
      }
    }
    const std::size_t count = std::min(spool.sweep_left, kAtOnce);
    ::madvise(spool.base + spool.sweep_at * kUnit, count * kUnit, MADV_DONTNEED);
    spool.sweep_at += count;
    spool.sweep_left -= count;
    seen += count;
  }
  spool.is_swept.clear();
  makes_room = false;
}

/// Zeros to the file, where the file system cannot set room aside: a page that is written to by its mapping alone has
/// none there until the system puts it on the disk. @return whether there is room
bool write_zeros(off_t offset, std::size_t bytes) {
  static constexpr char kZeros[std::size_t{1} << 16] = {};
  while (bytes > 0) {
    const ssize_t n = ::pwrite(spool.file, kZeros, std::min(bytes, sizeof kZeros), offset);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    offset += n;
    bytes -= static_cast<std::size_t>(n);
  }
  // Only then is it known whether a disk of another machine is full.
  while (::fdatasync(spool.file) != 0) {
    if (errno != EINTR) return false;
  }
  return true;
}

/// Sets room aside for a part of the file, behind all that is there. @return whether there is room
bool set_aside(off_t offset, std::size_t bytes) {
  int result = 0;
  do {
    result = ::fallocate(spool.file, 0, offset, static_cast<off_t>(bytes));
  } while (result != 0 && errno == EINTR);
  return result == 0 || ((errno == EOPNOTSUPP || errno == ENOSYS) && write_zeros(offset, bytes));
}

/// New units, of which the first `bytes` are used.
char* take_units(std::size_t units, std::size_t bytes, std::uint32_t use) {
  make_room(bytes);  // a large array is filled as soon as it is there
  const std::lock_guard lock(spool.mutex);
  const std::size_t first = spool.units;
  if (units > kUnits - first) throw NoRoomOnDisk();
  // Room is set aside now, since a page that cannot be written later is a signal and not an error.
  const auto offset = static_cast<off_t>(first * kUnit);
  if (!set_aside(offset, bytes)) throw NoRoomOnDisk();
  use_of(first) = use;
  spool.units = first + units;
  return spool.base + offset;
}

void* take_piece(std::size_t bytes) {
  if (bytes > kLargestSmall) {
    if (bytes > kSpan) throw std::bad_alloc();
    const std::size_t units = (bytes + kUnit - 1) / kUnit;
    return take_units(units, bytes, static_cast<std::uint32_t>(kSizes + units));
  }
  const PieceSize size = piece_size(bytes);
  Shelf& shelf = spool.shelves[size.number];
  const std::lock_guard lock(shelf.mutex);
  if (shelf.free != nullptr) return std::exchange(shelf.free, shelf.free->next);
  if (static_cast<std::size_t>(shelf.end - shelf.fresh) < size.bytes) {
    shelf.fresh = take_units(1, kUnit, static_cast<std::uint32_t>(size.number));
    shelf.end = shelf.fresh + kUnit;
  }
  return std::exchange(shelf.fresh, shelf.fresh + size.bytes);
}

bool is_in_spool(const void* piece) {
  return reinterpret_cast<std::uintptr_t>(piece) - reinterpret_cast<std::uintptr_t>(spool.base) < kSpan &&
         spool.base != nullptr;
}

void give_back_piece(void* piece) {
  const auto unit = static_cast<std::size_t>(static_cast<char*>(piece) - spool.base) / kUnit;
  const std::uint32_t use = use_of(unit);
  if (use > kSizes) {
    use_of(unit) = use | kGivenBack;
    // Not every file system can make holes; then the room comes back at the end of the program.
    const std::size_t bytes = units_of(use) * kUnit;
    if (::madvise(piece, bytes, MADV_REMOVE) != 0) ::madvise(piece, bytes, MADV_DONTNEED);
    return;
  }
  Shelf& shelf = spool.shelves[use];
  const std::lock_guard lock(shelf.mutex);
  shelf.free = ::new (piece) FreePiece{shelf.free};
}

/// Looks at the limit twice in a millisecond, as long as there is a processor for it.
void watch_limit() {
  constexpr auto kPause = std::chrono::microseconds(500);
  for (;; std::this_thread::sleep_for(kPause)) make_room(0);
}

/// So does whoever has had a processor for a while, and waits where there is no room.
void look_at_limit(int) {
  const int error = errno;
  make_room(0);
  errno = error;
}

[[noreturn]] void fail(const std::string& what) {
  throw gaussmesh::InputError("max-memory: " + what + ": " + std::strerror(errno));
}

}  // namespace

namespace gaussmesh::app {

double physical_memory() {
  struct sysinfo info {};
  if (::sysinfo(&info) != 0) return 0.0;
  return (static_cast<double>(info.totalram) + static_cast<double>(info.totalswap)) *
         static_cast<double>(info.mem_unit);
}

void limit_memory(std::uint64_t limit, const std::filesystem::path& folder) {
  std::string name = (folder / "gaussmesh.XXXXXX").string();
  // No signal ends the program while the file has a name.
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  spool.file = ::mkostemp(name.data(), O_CLOEXEC);
  const bool is_made = spool.file >= 0 && ::unlink(name.c_str()) == 0;
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (!is_made) fail(folder.string() + ": the temporary file cannot be created");
  void* const base = ::mmap(nullptr, kSpan, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE, spool.file, 0);
  if (base == MAP_FAILED) {
    fail(std::to_string(kSpan >> 40) + " TiB of addresses for the temporary file cannot be had, see ulimit -v");
  }
  spool.statm = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (spool.statm < 0) fail("/proc/self/statm, which tells what is in memory, cannot be opened");
  spool.base = static_cast<char*>(base);
  spool.page_size = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  // Processor time is counted in ticks of the system's clock, of some milliseconds: pages that are in the system's
  // cache can be mapped at 30 GB/s meanwhile.
  constexpr std::uint64_t kTouchedMeanwhile = std::uint64_t{192} << 20;
  spool.most_on_heap = static_cast<std::int64_t>(limit / 8);
  spool.most_resident = limit - std::max(limit / 8, std::min(limit * 3 / 4, kTouchedMeanwhile));
  spool.enough_resident = spool.most_resident - limit / 8;
  struct sigaction action {};
  action.sa_handler = look_at_limit;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGPROF, &action, nullptr);
  const itimerval often{{0, 1000}, {0, 1000}};  // 1 ms of processor time, on all threads together
  ::setitimer(ITIMER_PROF, &often, nullptr);
  try {
    std::thread(watch_limit).detach();
  } catch (const std::system_error& error) {
    throw CannotMeshError(std::string("max-memory: the thread that watches the limit cannot be started: ") +
                          error.code().message());
  }
  spool.is_on = true;
}

}  // namespace gaussmesh::app

void* operator new(std::size_t size) {
  const std::size_t bytes = size > 0 ? size : 1;
  const bool is_limited = spool.is_on.load(std::memory_order_relaxed);
  if (is_limited &&
      spool.on_heap.load(std::memory_order_relaxed) + static_cast<std::int64_t>(bytes) > spool.most_on_heap) {
    return take_piece(bytes);
  }
  void* const piece = std::malloc(bytes);
  if (piece == nullptr) throw std::bad_alloc();
  if (is_limited) spool.on_heap += static_cast<std::int64_t>(::malloc_usable_size(piece));
  return piece;
}

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void operator delete(void* piece) noexcept {
  if (piece == nullptr) return;
  if (is_in_spool(piece)) return give_back_piece(piece);
  if (spool.is_on.load(std::memory_order_relaxed))
    spool.on_heap -= static_cast<std::int64_t>(::malloc_usable_size(piece));
  std::free(piece);
}

void operator delete(void* piece, std::size_t) noexcept { operator delete(piece); }
