#include "base/records/paper.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kClaimVerdicts[] = {"confirmed", "not reproduced", "found"};

}  // namespace

void define_paper_tables(Tables& tables) {
  tables.define<Measured>("What was measured.", [](auto& t) {
    t.key("value").may_be_nonfinite();
    t.key("text", "the value with the digits that are the same on every machine");
    t.key("at", "where the value was found").if_any();
  });
  tables.define<Claim>("A claim of the paper, or a finding.", [](auto& t) {
    t.key("where", "in the paper");
    t.key("printed", "figure or formula as printed; empty without one");
    t.key("measured", "the verdict is about the first").items(1);
    t.key("definition", "what was measured");
    t.key("verdict", "found: the paper does not speak of it").one_of(kClaimVerdicts);
  });
  tables.define<PaperFigure>("A chart and the claims that it shows.");
  tables.define<VerifyPaper>("The paper, measured: 'lobelia verify paper --json FILE'.",
                             [](auto& t) {
                               t.kind("verify-paper");
                               t.key("command").if_any();
                               t.key("figures", "with --plots").if_any();
                             });
}

}  // namespace lobelia::records
