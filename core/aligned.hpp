// Memory that vector registers are loaded from in one piece.
#pragma once

#include <cstdlib>
#include <memory>
#include <new>

namespace lobelia {

struct AlignedFree {
  void operator()(void* memory) const { std::free(memory); }
};
using AlignedFloats = std::unique_ptr<float[], AlignedFree>;

/// Uninitialised, from the beginning of a cache line on. Throws std::bad_alloc.
inline AlignedFloats aligned_floats(std::size_t count) {
  constexpr std::size_t kLine = 64;
  void* const memory =
      std::aligned_alloc(kLine, (count * sizeof(float) + kLine - 1) / kLine * kLine);
  if (!memory) throw std::bad_alloc();
  return AlignedFloats(static_cast<float*>(memory));
}

}  // namespace lobelia
