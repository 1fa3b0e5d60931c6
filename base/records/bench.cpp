#include "base/records/bench.hpp"

namespace lobelia::records {

void define_bench_tables(Tables& tables) {
  tables.define<BenchGoal>("A goal, measured in turn with what it is held to.", [](auto& t) {
    t.key("id").plain_name();
    t.key("against", "what ours is held to: another program, or a limit");
    t.key("ratio",
          "of each round: how many times faster ours is, or the part of a limit that it takes");
    t.key("atLeast", "whether the ratio is to be at least the goal; otherwise at most");
  });
  tables.define<BenchRun>("All goals, measured in one run.", [](auto& t) {
    t.key("commit", "of the source; ends with '+' if it was changed since").if_any();
    t.key("committed", "day of the commit, as 2026-01-31").if_any();
    t.key("quick", "fewer rounds, and without what takes minutes");
    t.key("leftOut", "goals that were not measured, and why").if_any();
  });
  tables.define<Bench>("Goals of speed, and what was measured: 'make bench'.", [](auto& t) {
    t.kind("bench");
    t.key("runs", "the latest last");
  });
}

}  // namespace lobelia::records
