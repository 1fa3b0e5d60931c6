#include "base/records/stability.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kOutcomes[] = {"within", "outside", "not compared"};

std::string curve_contradiction(const StabilityCurve& curve) {
  const std::size_t length = curve.degrees.size();
  return curve.truth.size() == length && curve.naive.size() == length && curve.ours.size() == length
             ? ""
             : "its columns are not equally long";
}

}  // namespace

void define_stability_tables(Tables& tables) {
  tables.define<StabilityGroup>("A group of cases.");
  tables.define<StabilityErrors>("The largest errors.", [](auto& t) {
    t.key("ofPeak").may_be_nonfinite();
    t.key("ulp", "units in the last place").may_be_nonfinite();
  });
  tables.define<StabilityAnswer>("A value and its errors.", [](auto& t) {
    t.keys({"value", "ofPeak"}).may_be_nonfinite();
    t.key("ulp", "units in the last place").may_be_nonfinite();
  });
  tables.define<StabilityBound>("What was promised.", [](auto& t) { t.all().may_be_nonfinite(); });
  tables.define<StabilityOfLobe>("The worst of a lobe.", [](auto& t) {
    t.key("ofBound", "largest part of a stated bound that is used").may_be_nonfinite();
  });
  tables.define<StabilityOfCase>("The worst of a case.", [](auto& t) {
    t.key("name").renamed("case");
    t.key("meaning").if_any();
    t.key("ofBound", "largest part of a stated bound that is used").may_be_nonfinite();
  });
  tables.define<StabilityCurve>("One highlight along a line across it, of the peak.", [](auto& t) {
    t.key("degrees").unit("degrees");
    t.keys({"truth", "naive", "ours"}).may_be_nonfinite();
    t.check(curve_contradiction);
  });
  tables.define<StabilityRow>("A case.", [](auto& t) {
    t.key("name").renamed("case");
    t.key("model", "missing where the lobe alone is looked at").if_any();
    t.key("truth").may_be_nonfinite();
    t.key("outcome", "not compared: no bound below the whole peak is stated").one_of(kOutcomes);
  });
  tables.define<StabilityPicture>("Files of a picture, relative to the record.",
                                  [](auto& t) { t.key("largestErrorOfPeak").may_be_nonfinite(); });
  tables.define<StabilityPictures>("A picture by naive formulas and by ours.");
  tables.define<VerifyStability>(
      "How stable highlights are: 'lobelia verify stability --json FILE'.", [](auto& t) {
        t.kind("verify-stability");
        t.keys({"groups", "curves"}).if_any();
        t.key("rows", "what is outside its bound; every case with --all").if_any();
        t.key("pictures", "with --pictures").if_any();
      });
}

}  // namespace lobelia::records
