// The claims, measured once for all tests.
#pragma once

#include "studies/paper/claim.hpp"

namespace lobelia::paper {

inline const std::vector<Claim>& measured_claims() {
  static const std::vector<Claim> claims = measure_all();
  return claims;
}

}  // namespace lobelia::paper
