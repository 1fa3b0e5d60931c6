#include "records/agreement.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kGroups[] = {"highlight", "effect"};
constexpr std::string_view kViews[] = {"whole", "close-up"};

}  // namespace

const Struct& AgreementEngine::type() {
  return define<AgreementEngine>("An engine that was compared, or why not.", [](auto& t) {
    t.keys({"version", "why"}).if_any();
  });
}

const Struct& Ring::type() {
  return define<Ring>("Pixels on silhouettes, terminators and shadow edges.",
                      [](auto& t) { t.key("maxOfPeak").may_be_nonfinite(); });
}

const Struct& Target::type() {
  return define<Target>("What was asked of a picture.", [](auto& t) {
    t.key("relative", "of maxRelative");
    t.key("ofPeak", "of maxOfPeak");
  });
}

const Struct& AgreementRow::type() {
  return define<AgreementRow>(
      "A picture compared; its figures are of pixels that are not in the ring.", [](auto& t) {
        t.key("group").one_of(kGroups);
        t.key("what", "the light, or the effect");
        t.key("view").one_of(kViews);
        t.keys({"width", "height"}).unit("pixels");
        t.keys({"maxOfPeak", "rmsOfPeak", "maxRelative"}).may_be_nonfinite();
        t.key("why", "in place of figures").if_any();
      });
}

const Struct& SoftCount::type() {
  return define<SoftCount>("A soft effect by a number of points.",
                           [](auto& t) { t.key("rmsOfPeak").may_be_nonfinite(); });
}

const Struct& SoftRow::type() {
  return define<SoftRow>("A soft effect.", [](auto& t) { t.key("why").if_any(); });
}

const Struct& Agreement::type() {
  return define<Agreement>(
      "How far all engines are from the formulas: 'lobelia verify references --json'.",
      [](auto& t) { t.kind("agreement"); });
}

}  // namespace lobelia::records
