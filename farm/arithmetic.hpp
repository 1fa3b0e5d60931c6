// How this machine calculates, as far as it shows in the last bits of a result.
#pragma once

#include <string>

namespace lobelia {

struct Arithmetic {
  /// SHA-256 over what the C library's functions return at fixed arguments: glibc has several of each, and chooses by the
  /// processor and by $GLIBC_TUNABLES.
  std::string libm;
  std::string kernels;    ///< the instruction set that our kernels are run for: "AVX3"
  std::string processor;  ///< what engines choose by, whose environment has no say: "avx avx2 fma"

  bool operator==(const Arithmetic&) const = default;
};

/// Asked once; takes some milliseconds.
const Arithmetic& arithmetic();

}  // namespace lobelia
