#include "records/stability.hpp"

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

const Struct& StabilityGroup::type() {
  return define<StabilityGroup>("StabilityGroup", "A group of cases.", [](Struct& t) {
    t.key<&StabilityGroup::name>("name");
    t.key<&StabilityGroup::meaning>("meaning");
  });
}

const Struct& StabilityErrors::type() {
  return define<StabilityErrors>("StabilityErrors", "The largest errors.", [](Struct& t) {
    t.key<&StabilityErrors::of_peak>("ofPeak").may_be_nonfinite();
    t.key<&StabilityErrors::ulp>("ulp", "units in the last place").may_be_nonfinite();
    t.key<&StabilityErrors::wrong_pixels>("wrongPixels");
  });
}

const Struct& StabilityAnswer::type() {
  return define<StabilityAnswer>("StabilityAnswer", "A value and its errors.", [](Struct& t) {
    t.key<&StabilityAnswer::value>("value").may_be_nonfinite();
    t.key<&StabilityAnswer::of_peak>("ofPeak").may_be_nonfinite();
    t.key<&StabilityAnswer::ulp>("ulp", "units in the last place").may_be_nonfinite();
    t.key<&StabilityAnswer::wrong_pixels>("wrongPixels");
  });
}

const Struct& StabilityBound::type() {
  return define<StabilityBound>("StabilityBound", "What was promised.", [](Struct& t) {
    t.key<&StabilityBound::of_peak>("ofPeak").may_be_nonfinite();
    t.key<&StabilityBound::ulp>("ulp").may_be_nonfinite();
  });
}

const Struct& StabilityOfLobe::type() {
  return define<StabilityOfLobe>("StabilityOfLobe", "The worst of a lobe.", [](Struct& t) {
    t.key<&StabilityOfLobe::group>("group");
    t.key<&StabilityOfLobe::lobe>("lobe");
    t.key<&StabilityOfLobe::exponent>("exponent");
    t.key<&StabilityOfLobe::cases>("cases");
    t.key<&StabilityOfLobe::outside>("outside");
    t.key<&StabilityOfLobe::not_compared>("notCompared");
    t.key<&StabilityOfLobe::naive>("naive");
    t.key<&StabilityOfLobe::ours>("ours");
    t.key<&StabilityOfLobe::of_bound>("ofBound", "largest part of a stated bound that is used")
        .may_be_nonfinite();
  });
}

const Struct& StabilityOfCase::type() {
  return define<StabilityOfCase>("StabilityOfCase", "The worst of a case.", [](Struct& t) {
    t.key<&StabilityOfCase::group>("group");
    t.key<&StabilityOfCase::name>("case");
    t.key<&StabilityOfCase::meaning>("meaning").if_any();
    t.key<&StabilityOfCase::cases>("cases");
    t.key<&StabilityOfCase::outside>("outside");
    t.key<&StabilityOfCase::not_compared>("notCompared");
    t.key<&StabilityOfCase::naive>("naive");
    t.key<&StabilityOfCase::ours>("ours");
    t.key<&StabilityOfCase::of_bound>("ofBound", "largest part of a stated bound that is used")
        .may_be_nonfinite();
  });
}

const Struct& StabilityCurve::type() {
  return define<StabilityCurve>(
      "StabilityCurve", "One highlight along a line across it, of the peak.", [](Struct& t) {
        t.key<&StabilityCurve::exponent>("exponent");
        t.key<&StabilityCurve::model>("model");
        t.key<&StabilityCurve::lobe>("lobe");
        t.key<&StabilityCurve::degrees>("degrees").unit("degrees");
        t.key<&StabilityCurve::truth>("truth").may_be_nonfinite();
        t.key<&StabilityCurve::naive>("naive").may_be_nonfinite();
        t.key<&StabilityCurve::ours>("ours").may_be_nonfinite();
        t.check<curve_contradiction>();
      });
}

const Struct& StabilityRow::type() {
  return define<StabilityRow>("StabilityRow", "A case.", [](Struct& t) {
    t.key<&StabilityRow::group>("group");
    t.key<&StabilityRow::name>("case");
    t.key<&StabilityRow::model>("model", "missing where the lobe alone is looked at").if_any();
    t.key<&StabilityRow::lobe>("lobe");
    t.key<&StabilityRow::exponent>("exponent");
    t.key<&StabilityRow::truth>("truth").may_be_nonfinite();
    t.key<&StabilityRow::naive>("naive");
    t.key<&StabilityRow::ours>("ours");
    t.key<&StabilityRow::bound>("bound");
    t.key<&StabilityRow::outcome>("outcome",
                                  "not compared: no bound below the whole peak is stated")
        .one_of(kOutcomes);
  });
}

const Struct& Nanoseconds::type() {
  return define<Nanoseconds>(
      "Nanoseconds", "Time of one value. The spread is between the quartiles.", [](Struct& t) {
        t.key<&Nanoseconds::median>("median").unit("ns");
        t.key<&Nanoseconds::spread>("spread").unit("ns");
      });
}

const Struct& StabilityStall::type() {
  return define<StabilityStall>("StabilityStall", "What underflow costs.", [](Struct& t) {
    t.key<&StabilityStall::lobe>("lobe");
    t.key<&StabilityStall::precision>("precision");
    t.key<&StabilityStall::ordinary_nanoseconds>("ordinaryNanoseconds");
    t.key<&StabilityStall::underflow_nanoseconds>("underflowNanoseconds");
  });
}

const Struct& StabilityPrice::type() {
  return define<StabilityPrice>("StabilityPrice", "What precision costs.", [](Struct& t) {
    t.key<&StabilityPrice::lobe>("lobe");
    t.key<&StabilityPrice::model>("model");
    t.key<&StabilityPrice::float32_nanoseconds>("float32Nanoseconds");
    t.key<&StabilityPrice::mixed_nanoseconds>("mixedNanoseconds");
    t.key<&StabilityPrice::float64_nanoseconds>("float64Nanoseconds");
  });
}

const Struct& StabilityPicture::type() {
  return define<StabilityPicture>(
      "StabilityPicture", "Files of a picture, relative to the record.", [](Struct& t) {
        t.key<&StabilityPicture::exr>("exr");
        t.key<&StabilityPicture::png>("png");
        t.key<&StabilityPicture::error>("error");
        t.key<&StabilityPicture::largest_error_of_peak>("largestErrorOfPeak").may_be_nonfinite();
      });
}

const Struct& StabilityPictures::type() {
  return define<StabilityPictures>("StabilityPictures", "A picture by naive formulas and by ours.",
                                   [](Struct& t) {
                                     t.key<&StabilityPictures::exponent>("exponent");
                                     t.key<&StabilityPictures::naive>("naive");
                                     t.key<&StabilityPictures::ours>("ours");
                                   });
}

const Struct& VerifyStability::type() {
  return define<VerifyStability>(
      "VerifyStability", "How stable highlights are: 'lobelia verify stability --json FILE'.",
      [](Struct& t) {
        t.kind("verify-stability");
        t.key<&VerifyStability::command>("command");
        t.key<&VerifyStability::instruction_set>("instructionSet");
        t.key<&VerifyStability::cases>("cases");
        t.key<&VerifyStability::outside>("outside");
        t.key<&VerifyStability::not_compared>("notCompared");
        t.key<&VerifyStability::groups>("groups").if_any();
        t.key<&VerifyStability::by_lobe>("byLobe");
        t.key<&VerifyStability::by_case>("byCase");
        t.key<&VerifyStability::by_exponent>("byExponent");
        t.key<&VerifyStability::curves>("curves").if_any();
        t.key<&VerifyStability::rows>("rows", "what is outside its bound; every case with --all")
            .if_any();
        t.key<&VerifyStability::stalls>("stalls", "missing with --no-timing").if_any();
        t.key<&VerifyStability::price>("price", "missing with --no-timing").if_any();
        t.key<&VerifyStability::pictures>("pictures", "with --pictures").if_any();
      });
}

}  // namespace lobelia::records
