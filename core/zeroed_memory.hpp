// Memory for pictures: zero because the system gives it so, in large pages where it has them.
//
// Nobody writes it before the threads that render do, each its own part. A first write to a page costs up
// to 2 us in a virtual machine, and a picture of 12 MB has 3000 pages of the usual size, but six large ones:
// without them they would take three times as long as rendering the picture (`make bench`).
#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <utility>

namespace lobelia {

/// Throws std::bad_alloc.
void* allocate_zeroed(std::size_t bytes);
void free_zeroed(void* memory, std::size_t bytes);

/// For containers that are made with their final size.
template <class T>
struct ZeroedMemory {
  using value_type = T;
  ZeroedMemory() = default;
  template <class U>
  ZeroedMemory(const ZeroedMemory<U>&) {}
  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_alloc();
    return static_cast<T*>(allocate_zeroed(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t count) { free_zeroed(memory, count * sizeof(T)); }
  void construct(T*) {}  // it is zero
  template <class... Arguments>
  void construct(T* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) T(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(ZeroedMemory, ZeroedMemory) { return true; }
};

}  // namespace lobelia
