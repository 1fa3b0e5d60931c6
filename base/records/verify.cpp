#include "base/records/verify.hpp"

namespace lobelia::records {

void define_verify_tables(Tables& tables) {
  tables.define<FigureCoverage>(
      "How far one figure of pictures of one kind is from the truth, in stated standard errors.",
      [](auto& t) {
        t.key("figures", "that have a standard error").at_least(0);
        t.keys({"withinOne", "withinTwo"}).at_least(0);
        t.key("missing", "not measured, or without a standard error").at_least(0);
        t.keys({"medianDistance", "worstDistance"}).at_least(0).may_be_nonfinite();
        t.key("medianError", "a share of the true value, or pixels of a place")
            .at_least(0)
            .may_be_nonfinite();
      });
  tables.define<KindCoverage>("Made pictures of one kind.", [](auto& t) {
    t.key("pictures").at_least(0);
    t.key("share", "of all figures within two stated errors").within(0, 1);
    t.key("medianDistance", "of all figures from the truth, in stated errors")
        .at_least(0)
        .may_be_nonfinite();
  });
  tables.define<VerifyProfiles>(
      "Standard errors of profiles of made highlights: 'lobelia verify profiles --json FILE'.",
      [](auto& t) {
        t.kind("verify-profiles");
        t.key("command").if_any();
        t.key("seed", "of the pictures").at_least(0);
        t.key("goal", "share that is to lie within two stated errors").between(0, 1);
        t.key("outside", "kinds that miss the goal").at_least(0);
      });
  tables.define<LightBeside>("A picture with one light in view, and the changed one.", [](auto& t) {
    t.key("light", "times the highlight's peak").at_least(0);
    t.key("differs", "by the default limits");
  });
  tables.define<ChangedHighlight>("One change of one highlight.", [](auto& t) {
    t.key("shouldDiffer", "rounding alone should not");
  });
  tables.define<VerifyHighlights>(
      "Changed highlights beside a light: 'lobelia verify highlights --json FILE'.", [](auto& t) {
        t.kind("verify-highlights");
        t.key("command").if_any();
        t.key("wrong", "pairs that are missed, or called different by rounding").at_least(0);
      });
}

}  // namespace lobelia::records
