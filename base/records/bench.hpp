// How fast the program is, beside others and beside what is asked: `make bench`.
#pragma once

#include "base/records/highlight.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct BenchGoal {
  std::string id, what, unit, against;
  MeasuredRounds ours, other, ratio;
  double goal = 0;
  bool at_least = true, met = false;
};

struct BenchRun {
  std::string commit, committed;
  bool quick = false;
  Host host;
  std::string instruction_set;
  std::vector<BenchGoal> goals;
  Named<std::string> left_out;
};

struct Bench {
  std::vector<BenchRun> runs;
};

void define_bench_tables(Tables& tables);

}  // namespace lobelia::records
