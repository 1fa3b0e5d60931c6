// How this machine calculates, as far as it shows in the last bits of a result.
#pragma once

#include "records/result.hpp"

namespace lobelia {

/// `libm` is a hash of what the C library's functions return at fixed arguments: glibc has several of each, and chooses by
/// the processor and by $GLIBC_TUNABLES. `kernels` is the instruction set that our kernels run with. By `processor` engines
/// choose, whatever their environment.
using records::Arithmetic;

/// Asked once; takes some milliseconds.
const Arithmetic& arithmetic();

}  // namespace lobelia
