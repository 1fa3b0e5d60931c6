#include "base/records/verdicts.hpp"

namespace lobelia::records {

void define_verdict_tables(Tables& tables) {
  tables.define<VerdictsOfChange>(
      "Verdicts on pairs of which one picture was changed.", [](auto& t) {
        t.key("change", "empty: both have one expectation, and different is a false alarm");
        t.key("dimmer", "share of the light that was taken off").between(0, 1);
        t.keys({"pairs", "same", "undecided", "different"}).at_least(0);
      });
  tables.define<VerdictCell>("Pairs of one kind of noise.", [](auto& t) {
    t.key("size", "of a side").unit("pixels").at_least(1);
    t.key("samples", "of a pixel in each picture").at_least(1);
    t.key("replicates", "pictures of each side").at_least(2);
    t.key("mostFalse",
          "false alarms that a chance of one and a half times the significance exceeds but once "
          "in a thousand such tests")
        .at_least(0);
    t.key("holds", "there are no more");
  });
  tables.define<VerifyVerdicts>(
      "Verdicts on pictures with known noise: 'lobelia verify verdicts --json FILE'.", [](auto& t) {
        t.kind("verify-verdicts");
        t.key("command").if_any();
        t.key("significance", "chance of a false alarm that was promised").between(0, 1);
        t.key("seeds", "pairs of each kind").at_least(1);
        t.key("bootstraps").at_least(4);
        t.key("outside", "kinds of noise with more false alarms than promised").at_least(0);
        t.key("leftOut", "why pictures of an engine are missing").if_any();
      });
}

}  // namespace lobelia::records
