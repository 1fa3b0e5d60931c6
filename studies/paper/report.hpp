// The measured claims as a table, as docs/errata.md and as a record.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "studies/paper/claim.hpp"

namespace lobelia::paper {

/// One line a claim: verdict, name, printed, measured; then the counts.
std::string table_text(std::span<const Claim> claims);
/// docs/errata.md
std::string errata_document(std::span<const Claim> claims);
/// `command` is what made it.
records::VerifyPaper paper_record(std::vector<Claim> claims, std::vector<std::string> command = {},
                                  std::vector<records::PaperFigure> figures = {});

}  // namespace lobelia::paper
