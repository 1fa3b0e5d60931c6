#include "records/pages.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kMetricUnits[] = {"radiance", "share", "count", "plain"};

}  // namespace

const Struct& GridAxis::type() {
  return define<GridAxis>("An axis of the grid.", [](auto& t) { t.key("values", "labels"); });
}

const Struct& GridEngine::type() { return define<GridEngine>("A reference engine that is there."); }

const Struct& GridLayout::type() {
  return define<GridLayout>("The order without script; -1: no such axis.");
}

const Struct& GridStatus::type() { return define<GridStatus>("A status that a cell may have."); }

const Struct& GridPicture::type() { return define<GridPicture>("A cell's thumbnail."); }

const Struct& GridCell::type() {
  return define<GridCell>("A cell of the grid.", [](auto& t) {
    t.key("at", "its value on each axis; -1 where the axis does not know it");
    t.key("metrics", "by engine, a value of each metric").may_be_nonfinite();
  });
}

const Struct& GridMetric::type() {
  return define<GridMetric>("A metric that a grid can be coloured by.",
                            [](auto& t) { t.key("unit").one_of(kMetricUnits); });
}

const Struct& GridPage::type() { return define<GridPage>("The page of the grid."); }

const Struct& ShownPicture::type() {
  return define<ShownPicture>("A picture; both files are drawn at this size.", [](auto& t) {
    t.key("small", "shorter to load where src is heavy, else the same");
  });
}

const Struct& ShownEngine::type() {
  return define<ShownEngine>("An engine and its picture of a cell.", [](auto& t) {
    t.key("picture").or_null();
    t.key("floatScript", "of a PackedPicture").or_null();
  });
}

const Struct& ShownMap::type() {
  return define<ShownMap>("A difference for each pixel.",
                          [](auto& t) { t.key("script", "of a PackedPicture"); });
}

const Struct& ShownComparison::type() {
  return define<ShownComparison>("A comparison of two engines' pictures.", [](auto& t) {
    t.key("picture", "of the difference").or_null();
    t.keys({"whiteAt", "worstY"}).or_null().may_be_nonfinite();
    t.key("relativeToPeak").or_null();
    t.key("worstX", "pixel of the largest difference").or_null().may_be_nonfinite();
  });
}

const Struct& ShownZone::type() {
  return define<ShownZone>("A zone of a highlight.", [](auto& t) {
    t.keys({"from", "to"}).unit("degrees");
  });
}

const Struct& ShownCurve::type() {
  return define<ShownCurve>("A curve of a profile.", [](auto& t) {
    t.key("name", "of an engine, or analytic");
    t.key("values").may_be_nonfinite();
  });
}

const Struct& ShownProfile::type() {
  return define<ShownProfile>("A highlight as curves.", [](auto& t) {
    t.key("degrees").may_be_nonfinite();
    t.key("curves", "each as long as degrees");
  });
}

const Struct& CellPage::type() {
  return define<CellPage>("The page of a cell.", [](auto& t) {
    t.keys({"exposureStops", "profile"}).or_null();
  });
}

const Struct& PackedPicture::type() {
  return define<PackedPicture>("A float picture in half floats, as text.", [](auto& t) {
    t.key("fromOurs", "it is the difference from our picture");
    t.key("block", "pixels of the cell that one stands for, each way");
    t.key("least", "what is smaller is 0");
    t.key("planes", "base64, deflated");
  });
}

const Struct& StabilitySummary::type() {
  return define<StabilitySummary>("The largest errors of a lobe: of the peak, and in ulp.",
                                  [](auto& t) {
                                    t.keys({"naive", "ours"}).may_be_nonfinite();
                                  });
}

const Struct& StabilityPage::type() { return define<StabilityPage>("The page of the hard cases."); }

const Struct& PaperPage::type() { return define<PaperPage>("The page of the paper's claims."); }

}  // namespace lobelia::records
