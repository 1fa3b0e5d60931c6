// The parts of this program that decide a result: its build, its libraries, and its arithmetic on this machine.
#pragma once

#include <string>
#include <vector>

#include "reference_scenes/content.hpp"

namespace lobelia {

struct OwnIdentity {
  std::string program;    ///< "lobelia 0.1.0 BUILD-ID"
  std::string libraries;  ///< SHA-256 of the image module, the picture reader, and all libraries
  /// `libm` is a hash of what the C library's functions return at fixed arguments: glibc chooses among several variants by
  /// the processor and $GLIBC_TUNABLES. `kernels` is our kernels' instruction set. Engines choose by `processor`.
  records::Arithmetic arithmetic;

  bool operator==(const OwnIdentity&) const = default;
  std::string text() const;  ///< for a key
  template <class T>
  void put_into(T& record) const {
    record.program = program;
    record.libraries = libraries;
    record.arithmetic = arithmetic;
  }
  template <class T>
  static OwnIdentity of_record(const T& record) {
    return {record.program, record.libraries, record.arithmetic};
  }
};

/// The identity of this process, found once in some milliseconds. Throws Error(kInternal) if a file of ours is missing,
/// Error(kInput) if one or a library cannot be read.
const OwnIdentity& own_identity();

/// The files that own_identity().libraries hashes.
const Content& own_libraries();

/// A few words for each difference: "libm: other results", "libraries: other files".
std::vector<std::string> identity_differences(const OwnIdentity& planned, const OwnIdentity& here);

}  // namespace lobelia
