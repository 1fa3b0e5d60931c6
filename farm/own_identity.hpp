// What of ours decides a result: this program, the libraries that it uses, and how it calculates here.
#pragma once

#include <string>
#include <vector>

#include "farm/arithmetic.hpp"
#include "reference_scenes/content.hpp"

namespace lobelia {

struct OwnIdentity {
  std::string program;  ///< "lobelia 0.1.0 BUILD-ID"
  std::string
      libraries;  ///< SHA-256 of the image module, the picture reader, and all libraries that these and we use
  Arithmetic arithmetic;

  bool operator==(const OwnIdentity&) const = default;
  /// In a key.
  std::string text() const;
  /// Members of a record that has such, and back.
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

/// Of this process, found out once. Throws Error(kInternal) if a file of ours is not there.
const OwnIdentity& own_identity();

/// The files that own_identity().libraries is of.
const Content& own_libraries();

/// What is not the same in both, in a few words each: "libm: other results", "libraries: other files". Empty: nothing.
std::vector<std::string> identity_differences(const OwnIdentity& planned, const OwnIdentity& here);

}  // namespace lobelia
