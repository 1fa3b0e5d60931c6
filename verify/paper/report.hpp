// The measured claims for people (a table) and for programs (a record).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "records/paper.hpp"
#include "verify/paper/claim.hpp"
#include "verify/paper/plots.hpp"

namespace lobelia::paper {

/// "1.70e-2 (n = 1024, x = 3.54 degrees)"
std::string text_of(const Figure& figure);
/// "13 confirmed, 9 not reproduced, 9 found beyond the paper"
std::string counts_text(std::span<const Claim> claims);
/// One line a claim: verdict, name, printed, measured; then the counts.
std::string table_text(std::span<const Claim> claims);
/// `command` is what made it. Its figures are the charts of the plots.
records::VerifyPaper paper_record(std::span<const Claim> claims,
                                  const std::vector<std::string>& command = {},
                                  std::span<const Plot> plots = {});

}  // namespace lobelia::paper
