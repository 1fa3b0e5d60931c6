#include "base/system/scratch_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>

#include <atomic>
#include <cstdlib>
#include <map>
#include <mutex>

#include "base/system/descriptor.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kMostLookedAt = std::size_t{32} << 20;

/// A mask has a twelfth of its picture's bytes. While a large piece is in a file, pieces this many times smaller are too.
constexpr std::size_t kSmaller = 16;

std::atomic<std::size_t> g_least{0};  ///< bytes of a piece in a file; 0: none is
std::atomic<std::size_t> g_looked_at{0};

struct Piece {
  std::size_t size;
  bool is_large;  ///< by itself, not beside another
};

struct Pieces {
  std::mutex mutex;
  std::map<void*, Piece> at;
};

std::atomic<int> g_large{0};  ///< large pieces that are there

Pieces& pieces() {
  static auto* all = new Pieces;  // some pictures live until the process ends
  return *all;
}

}  // namespace

void keep_large_pieces_in_files(std::size_t least) { g_least = least; }

void looked_at(std::size_t bytes) {
  if (g_least == 0 || (g_looked_at += bytes) < kMostLookedAt) return;
  g_looked_at = 0;
  const std::lock_guard lock(pieces().mutex);
  // The file keeps what is in a shared mapping, also what was written.
  for (const auto& [memory, piece] : pieces().at) ::madvise(memory, piece.size, MADV_DONTNEED);
}

bool is_kept_in_file(std::size_t bytes) {
  const std::size_t least = g_least;
  return least > 0 && bytes >= (g_large > 0 ? least / kSmaller : least);
}

void* map_file(std::size_t bytes) {
  if (!is_kept_in_file(bytes)) return nullptr;
  const char* directory = std::getenv("TMPDIR");
  const Descriptor file(::open(directory && *directory ? directory : "/tmp",
                               O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR));
  // Without room for all of it, a write would end the process.
  if (!file || ::posix_fallocate(file.get(), 0, off_t(bytes)) != 0) return nullptr;
  void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
  if (memory == MAP_FAILED) return nullptr;
  const bool is_large = bytes >= g_least;
  g_large += is_large;
  const std::lock_guard lock(pieces().mutex);
  pieces().at.emplace(memory, Piece{bytes, is_large});
  return memory;
}

bool unmap_file(void* memory) {
  const std::lock_guard lock(pieces().mutex);
  const auto found = pieces().at.find(memory);
  if (found == pieces().at.end()) return false;
  ::munmap(memory, found->second.size);
  g_large -= found->second.is_large;
  pieces().at.erase(found);
  return true;
}

}  // namespace lobelia
