// Tests a set of limits: compares changed copies of a picture with it, and tells which changes the limits find.
#pragma once

#include "compare/compare.hpp"

namespace lobelia {

/// Whether a change should be found.
enum class Expected : std::uint8_t {
  kFound,
  kNotFound,  ///< it only rounds, or is within the known noise
  kEither,
};

/// One changed copy.
struct Change {
  std::string name;  ///< "2 % dimmer"
  Expected expected;
  Verdict verdict;
  std::string found_by;  ///< the limits that fail, joined by ", "

  bool is_found() const { return !is_pass(verdict) && verdict != Verdict::kUndecided; }
  bool is_as_expected() const {
    return expected == Expected::kEither || is_found() == (expected == Expected::kFound);
  }
};

/// Compares changed copies of `reference` with it: blackened, shifted, dimmed, blurred, with another exponent, without
/// its brightest highlight, with each of the eight largest highlights gone, dimmer and moved in turn, and copies that
/// only round or have known noise. Each highlight is also alone in `a`: then the reference is compared with the copy that
/// lacks it. `options` without noise and without tolerance for edges. Throws Error(kInput) if the picture has no positive
/// value or one that is not finite.
std::vector<Change> sensitivity(const Image& reference, const ComparisonOptions& options);

/// Whether every change is as expected.
bool are_as_expected(std::span<const Change> changes);

/// `a` is the file of the picture.
records::Sensitivity sensitivity_record(const std::string& a, std::span<const Change> changes,
                                        const ComparisonOptions& options);

}  // namespace lobelia
