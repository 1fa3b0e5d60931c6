#include "base/records/agreement.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kGroups[] = {"highlight", "effect"};
constexpr std::string_view kViews[] = {"whole", "close-up"};

}  // namespace

void define_agreement_tables(Tables& tables) {
  tables.define<AgreementEngine>("An engine that was compared, or why not.", [](auto& t) {
    t.keys({"version", "why"}).if_any();
  });
  tables.define<Ring>("Pixels on silhouettes, terminators and shadow edges.",
                      [](auto& t) { t.key("maxOfPeak").may_be_nonfinite(); });
  tables.define<Target>("What was asked of a picture.", [](auto& t) {
    t.key("relative", "of maxRelative");
    t.key("ofPeak", "of maxOfPeak");
  });
  tables.define<AgreementRow>(
      "A picture compared; its figures are of pixels that are not in the ring.", [](auto& t) {
        t.key("group").one_of(kGroups);
        t.key("what", "the light, or the effect");
        t.key("variant").renamed("witness");
        t.key("view").one_of(kViews);
        t.keys({"width", "height"}).unit("pixels");
        t.keys({"maxOfPeak", "rmsOfPeak", "maxRelative"}).may_be_nonfinite();
        t.key("why", "in place of figures").if_any();
      });
  tables.define<SoftCount>("A soft effect by a number of points.",
                           [](auto& t) { t.key("rmsOfPeak").may_be_nonfinite(); });
  tables.define<SoftRow>("A soft effect.", [](auto& t) {
    t.key("variant").renamed("witness");
    t.key("why").if_any();
  });
  tables.define<Agreement>(
      "How far all engines are from the formulas: 'lobelia verify references --json FILE'.",
      [](auto& t) { t.kind("agreement"); });
}

}  // namespace lobelia::records
