#include "records/cost.hpp"

namespace lobelia::records {

const Struct& CostError::type() {
  return define<CostError>("CostError", "A kind of error of a table.", [](Struct& t) {
    t.key<&CostError::id>("id");
    t.key<&CostError::meaning>("meaning");
  });
}

const Struct& CostSeconds::type() {
  return define<CostSeconds>(
      "CostSeconds",
      "Time of one of what the table counts. The spread is half the distance of the quartiles, of the median.",
      [](Struct& t) {
        t.key<&CostSeconds::median>("median");
        t.key<&CostSeconds::spread>("spread");
        t.key<&CostSeconds::least>("least");
        t.key<&CostSeconds::most>("most");
        t.key<&CostSeconds::rounds>("rounds");
      });
}

const Struct& LobeErrors::type() {
  return define<LobeErrors>("LobeErrors", "Errors of a lobe by itself.", [](Struct& t) {
    t.key<&LobeErrors::max>("max").may_be_nonfinite();
    t.key<&LobeErrors::rms>("rms").may_be_nonfinite();
    t.key<&LobeErrors::energy>("energy").may_be_nonfinite();
    t.key<&LobeErrors::max_at_most>("maxAtMost").may_be_nonfinite();
  });
}

const Struct& CircuitErrors::type() {
  return define<CircuitErrors>(
      "CircuitErrors", "Errors of a circuit in fixed point, by source.", [](Struct& t) {
        t.key<&CircuitErrors::shape>("shape").may_be_nonfinite();
        t.key<&CircuitErrors::rounding>("rounding").may_be_nonfinite();
        t.key<&CircuitErrors::quantisation>("quantisation").may_be_nonfinite();
        t.key<&CircuitErrors::steps>("steps");
        t.key<&CircuitErrors::steps_looked_at>("stepsLookedAt");
      });
}

const Struct& CostFacts::type() {
  return define<CostFacts>("CostFacts", "What else was counted.", [](Struct& t) {
    t.key<&CostFacts::operations>("operations");
    t.key<&CostFacts::shape>("shape");
    t.key<&CostFacts::rounding>("rounding");
    t.key<&CostFacts::numbers_looked_at>("numbersLookedAt");
    t.key<&CostFacts::circuit>("circuit");
    t.key<&CostFacts::samples>("samples");
    t.key<&CostFacts::kernel>("kernel").if_any();
    t.key<&CostFacts::predicted_cost>("predictedCost");
    t.key<&CostFacts::rays>("rays");
    t.key<&CostFacts::rays_saved>("raysSaved");
    t.key<&CostFacts::seconds_saved>("secondsSaved").unit("seconds");
    t.key<&CostFacts::work>("work", "by effect");
    t.key<&CostFacts::stage_seconds>("stageSeconds").unit("seconds");
    t.key<&CostFacts::seconds_of_tiny_call>("secondsOfTinyCall").unit("seconds");
  });
}

const Struct& CostWay::type() {
  return define<CostWay>(
      "CostWay", "A variant: one way of making what the table is about.", [](Struct& t) {
        t.key<&CostWay::name>("name");
        t.key<&CostWay::settings>("settings");
        t.key<&CostWay::errors>("errors").at_least(0).may_be_nonfinite();
        t.key<&CostWay::seconds>("seconds");
        t.key<&CostWay::count>("count", "in place of seconds, where there is nothing to time");
        t.key<&CostWay::error_spreads>("errorSpreads",
                                       "standard deviations, where something is random")
            .may_be_nonfinite();
        t.key<&CostWay::errors_at_most>("errorsAtMost",
                                        "bounds of errors that are only the largest seen");
        t.key<&CostWay::facts>("facts");
      });
}

const Struct& CostFront::type() {
  return define<CostFront>("CostFront", "The variants that no other beats in both time and error.",
                           [](Struct& t) {
                             t.key<&CostFront::ways>("ways", "from the fastest on");
                             t.key<&CostFront::dominated_by>(
                                 "dominatedBy", "the fastest of the front that is as accurate");
                             t.key<&CostFront::in_words>("inWords");
                             t.key<&CostFront::chart>("chart").plain_name();
                           });
}

const Struct& CostTable::type() {
  return define<CostTable>("CostTable", "Variants of one thing, measured in one run.",
                           [](Struct& t) {
                             t.key<&CostTable::id>("id").plain_name();
                             t.key<&CostTable::level>("level");
                             t.key<&CostTable::title>("title");
                             t.key<&CostTable::unit>("unit");
                             t.key<&CostTable::per>("per", "what times are of");
                             t.key<&CostTable::errors>("errors");
                             t.key<&CostTable::ways>("ways");
                             t.key<&CostTable::fronts>("fronts", "by error");
                             t.key<&CostTable::remarks>("remarks");
                           });
}

const Struct& Cost::type() {
  return define<Cost>("Cost", "What accuracy costs: 'lobelia cost -o DIR'.", [](Struct& t) {
    t.kind("cost");
    t.key<&Cost::command>("command");
    t.key<&Cost::host>("host");
    t.key<&Cost::instruction_set>("instructionSet");
    t.key<&Cost::tables>("tables");
  });
}

}  // namespace lobelia::records
