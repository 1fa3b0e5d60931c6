#include "records/agreement.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kGroups[] = {"highlight", "effect"};
constexpr std::string_view kViews[] = {"whole", "close-up"};

}  // namespace

const Struct& AgreementEngine::type() {
  return define<AgreementEngine>("AgreementEngine", "An engine that was compared, or why not.",
                                 [](Struct& t) {
                                   t.key<&AgreementEngine::name>("name");
                                   t.key<&AgreementEngine::title>("title");
                                   t.key<&AgreementEngine::available>("available");
                                   t.key<&AgreementEngine::state>("state");
                                   t.key<&AgreementEngine::version>("version").if_any();
                                   t.key<&AgreementEngine::why>("why").if_any();
                                 });
}

const Struct& Ring::type() {
  return define<Ring>("Ring", "Pixels on silhouettes, terminators and shadow edges.",
                      [](Struct& t) {
                        t.key<&Ring::pixels>("pixels");
                        t.key<&Ring::over>("over");
                        t.key<&Ring::allowed>("allowed");
                        t.key<&Ring::max_of_peak>("maxOfPeak").may_be_nonfinite();
                      });
}

const Struct& Target::type() {
  return define<Target>("Target", "What was asked of a picture.", [](Struct& t) {
    t.key<&Target::relative>("relative", "of maxRelative");
    t.key<&Target::of_peak>("ofPeak", "of maxOfPeak");
  });
}

const Struct& AgreementRow::type() {
  return define<AgreementRow>(
      "AgreementRow", "A picture compared; its figures are of pixels that are not in the ring.",
      [](Struct& t) {
        t.key<&AgreementRow::group>("group").one_of(kGroups);
        t.key<&AgreementRow::what>("what", "the light, or the effect");
        t.key<&AgreementRow::model>("model");
        t.key<&AgreementRow::lobe>("lobe");
        t.key<&AgreementRow::normalisation>("normalisation");
        t.key<&AgreementRow::exponent>("exponent");
        t.key<&AgreementRow::view>("view").one_of(kViews);
        t.key<&AgreementRow::width>("width").unit("pixels");
        t.key<&AgreementRow::height>("height").unit("pixels");
        t.key<&AgreementRow::witness>("witness");
        t.key<&AgreementRow::max_of_peak>("maxOfPeak").may_be_nonfinite();
        t.key<&AgreementRow::rms_of_peak>("rmsOfPeak").may_be_nonfinite();
        t.key<&AgreementRow::max_relative>("maxRelative").may_be_nonfinite();
        t.key<&AgreementRow::ring>("ring");
        t.key<&AgreementRow::why>("why", "in place of figures").if_any();
        t.key<&AgreementRow::target>("target");
        t.key<&AgreementRow::verdict>("verdict");
      });
}

const Struct& SoftCount::type() {
  return define<SoftCount>("SoftCount", "A soft effect by a number of points.", [](Struct& t) {
    t.key<&SoftCount::points>("points");
    t.key<&SoftCount::values>("values");
    t.key<&SoftCount::beyond>("beyond");
    t.key<&SoftCount::rms_of_peak>("rmsOfPeak").may_be_nonfinite();
  });
}

const Struct& SoftRow::type() {
  return define<SoftRow>("SoftRow", "A soft effect.", [](Struct& t) {
    t.key<&SoftRow::what>("what");
    t.key<&SoftRow::witness>("witness");
    t.key<&SoftRow::counts>("counts");
    t.key<&SoftRow::why>("why").if_any();
    t.key<&SoftRow::verdict>("verdict");
  });
}

const Struct& Agreement::type() {
  return define<Agreement>(
      "Agreement", "How far all engines are from the formulas: 'lobelia verify references --json'.",
      [](Struct& t) {
        t.kind("agreement");
        t.key<&Agreement::command>("command");
        t.key<&Agreement::small>("small");
        t.key<&Agreement::engines>("engines");
        t.key<&Agreement::verdicts>("verdicts");
        t.key<&Agreement::rows>("rows");
        t.key<&Agreement::soft>("soft");
      });
}

}  // namespace lobelia::records
