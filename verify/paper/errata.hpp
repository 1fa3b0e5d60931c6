// docs/errata.md, made from the measured claims.
#pragma once

#include <span>
#include <string>

#include "verify/paper/claim.hpp"

namespace lobelia::paper {

std::string errata_document(std::span<const Claim> claims);

}  // namespace lobelia::paper
