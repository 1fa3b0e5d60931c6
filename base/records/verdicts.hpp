// How often pictures with noise are called different.
#pragma once

#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct VerdictsOfChange {
  std::string change;
  double dimmer = 0;
  int pairs = 0, same = 0, undecided = 0, different = 0;
};

struct VerdictCell {
  std::string noise;
  int size = 0, samples = 0, replicates = 0;
  std::vector<VerdictsOfChange> changes;
  int most_false = 0;
  bool holds = false;
};

struct VerifyVerdicts {
  std::vector<std::string> command;
  double significance = 0;
  int seeds = 0, bootstraps = 0;
  std::size_t outside = 0;
  std::string left_out;
  std::vector<VerdictCell> cells;
};

void define_verdict_tables(Tables& tables);

}  // namespace lobelia::records
