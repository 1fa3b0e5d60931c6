#include "base/pictures/image.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

#include "base/system/scratch_memory.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

/// Smaller pieces come from calloc(): large pages would be mostly empty.
constexpr std::size_t kLarge = 2 * kLargePage;

/// Smaller pieces have few pages.
constexpr std::size_t kNotSmall = std::size_t{64} << 10;

/// Asks for all pages at once: one by one, as they are first written, takes several times as long. Those that are
/// there already stay as they are.
void populate(void* memory, std::size_t bytes) {
  const auto page = std::uintptr_t(::sysconf(_SC_PAGESIZE)),
             begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page,
             end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / page * page;
  if (begin >= end) return;
  ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_POPULATE_WRITE);  // a wish
}

std::size_t in_large_pages(std::size_t bytes) {
  return (bytes + kLargePage - 1) / kLargePage * kLargePage;
}

}  // namespace

void* allocate_zeroed(std::size_t bytes) {
  if (bytes > SIZE_MAX - 2 * kLargePage) throw std::bad_alloc();
  if (bytes < kLarge) {
    void* memory = std::calloc(bytes, 1);
    if (!memory) throw std::bad_alloc();
    if (bytes >= kNotSmall) populate(memory, bytes);
    return memory;
  }
  if (void* mapped = map_file(bytes)) return mapped;
  // One page more than needed: the parts before and behind the aligned large pages are given back.
  const std::size_t size = in_large_pages(bytes), reserved = size + kLargePage;
  void* memory =
      ::mmap(nullptr, reserved, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  auto* begin = static_cast<std::byte*>(memory);
  const std::size_t before = -reinterpret_cast<std::uintptr_t>(begin) % kLargePage;
  if (before > 0) ::munmap(begin, before);
  begin += before;
  ::munmap(begin + size, reserved - size - before);
  ::madvise(begin, size, MADV_HUGEPAGE);  // a wish: without it the memory is as good, but slower
  return begin;
}

void free_zeroed(void* memory, std::size_t bytes) {
  if (bytes < kLarge)
    std::free(memory);
  else if (!unmap_file(memory))
    ::munmap(memory, in_large_pages(bytes));
}

}  // namespace lobelia
