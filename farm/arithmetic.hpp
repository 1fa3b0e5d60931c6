// This machine's arithmetic, as far as it shows in the last bits of a result.
#pragma once

#include "records/result.hpp"

namespace lobelia {

/// `libm` is a hash of what the C library's functions return at fixed arguments: glibc chooses among several of each by the
/// processor and $GLIBC_TUNABLES. `kernels` is the instruction set of our kernels. Engines choose by `processor`.
using records::Arithmetic;

/// Asked once; takes some milliseconds.
const Arithmetic& arithmetic();

}  // namespace lobelia
