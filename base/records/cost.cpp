#include "base/records/cost.hpp"

namespace lobelia::records {

void define_cost_tables(Tables& tables) {
  tables.define<CostError>("A kind of error of a table.");
  tables.define<LobeErrors>("Errors of a lobe by itself.",
                            [](auto& t) { t.all().may_be_nonfinite(); });
  tables.define<CostFacts>("What else was counted.");
  tables.define<CostVariant>("A variant of what the table is about.", [](auto& t) {
    t.key("seconds", "of one of what the table counts");
    t.key("errors").at_least(0).may_be_nonfinite();
    t.key("count", "in place of seconds, where there is nothing to time");
    t.key("errorSpreads", "standard deviations, where something is random").may_be_nonfinite();
    t.key("errorsAtMost", "bounds of errors that are only the largest seen");
  });
  tables.define<CostFront>("The variants that no other beats in both time and error.", [](auto& t) {
    t.key("variants", "from the fastest on").renamed("ways");
    t.key("dominatedBy", "the fastest of the front that is as accurate");
    t.key("answers", "which variant to use for which error, where that is a share of the peak");
    t.key("chart").plain_name();
  });
  tables.define<CostTable>("Variants of one thing, measured in one run.", [](auto& t) {
    t.key("id").plain_name();
    t.key("per", "what times are of");
    t.key("variants").renamed("ways");
    t.key("fronts", "by error");
  });
  tables.define<Cost>("What accuracy costs: 'lobelia cost -o DIR'.",
                      [](auto& t) { t.kind("cost"); });
}

}  // namespace lobelia::records
