#include "records/pages.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kMetricUnits[] = {"radiance", "share", "count", "plain"};

}  // namespace

const Struct& GridAxis::type() {
  return define<GridAxis>("GridAxis", "An axis of the grid.", [](Struct& t) {
    t.key<&GridAxis::name>("name");
    t.key<&GridAxis::values>("values", "labels");
  });
}

const Struct& GridEngine::type() {
  return define<GridEngine>("GridEngine", "A reference engine that is there.", [](Struct& t) {
    t.key<&GridEngine::name>("name");
    t.key<&GridEngine::title>("title");
    t.key<&GridEngine::short_title>("shortTitle");
  });
}

const Struct& GridLayout::type() {
  return define<GridLayout>("GridLayout", "The order without script; -1: no such axis.",
                            [](Struct& t) {
                              t.key<&GridLayout::rows>("rows");
                              t.key<&GridLayout::groups>("groups");
                              t.key<&GridLayout::columns>("columns");
                            });
}

const Struct& GridStatus::type() {
  return define<GridStatus>("GridStatus", "A status that a cell may have.", [](Struct& t) {
    t.key<&GridStatus::name>("name");
    t.key<&GridStatus::word>("word");
    t.key<&GridStatus::mark>("mark");
  });
}

const Struct& GridPicture::type() {
  return define<GridPicture>("GridPicture", "A cell's thumbnail.", [](Struct& t) {
    t.key<&GridPicture::src>("src");
    t.key<&GridPicture::width>("width");
    t.key<&GridPicture::height>("height");
  });
}

const Struct& GridCell::type() {
  return define<GridCell>("GridCell", "A cell of the grid.", [](Struct& t) {
    t.key<&GridCell::id>("id");
    t.key<&GridCell::label>("label");
    t.key<&GridCell::href>("href");
    t.key<&GridCell::status>("status");
    t.key<&GridCell::at>("at", "its value on each axis; -1 where the axis does not know it");
    t.key<&GridCell::metrics>("metrics", "by engine, a value of each metric").may_be_nonfinite();
    t.key<&GridCell::picture>("picture");
  });
}

const Struct& GridMetric::type() {
  return define<GridMetric>("GridMetric", "A metric that a grid can be coloured by.",
                            [](Struct& t) {
                              t.key<&GridMetric::id>("id");
                              t.key<&GridMetric::title>("title");
                              t.key<&GridMetric::meaning>("meaning");
                              t.key<&GridMetric::unit>("unit").one_of(kMetricUnits);
                              t.key<&GridMetric::more_is_better>("moreIsBetter");
                            });
}

const Struct& GridPage::type() {
  return define<GridPage>("GridPage", "The page of the grid.", [](Struct& t) {
    t.key<&GridPage::axes>("axes");
    t.key<&GridPage::engines>("engines");
    t.key<&GridPage::layout>("layout");
    t.key<&GridPage::statuses>("statuses");
    t.key<&GridPage::cells>("cells");
    t.key<&GridPage::metrics>("metrics");
  });
}

const Struct& ShownPicture::type() {
  return define<ShownPicture>(
      "ShownPicture", "A picture; both files are drawn at this size.", [](Struct& t) {
        t.key<&ShownPicture::src>("src");
        t.key<&ShownPicture::small>("small", "shorter to load where src is heavy, else the same");
        t.key<&ShownPicture::width>("width");
        t.key<&ShownPicture::height>("height");
      });
}

const Struct& ShownEngine::type() {
  return define<ShownEngine>("ShownEngine", "An engine and its picture of a cell.", [](Struct& t) {
    t.key<&ShownEngine::name>("name");
    t.key<&ShownEngine::title>("title");
    t.key<&ShownEngine::short_title>("shortTitle");
    t.key<&ShownEngine::picture>("picture").or_null();
    t.key<&ShownEngine::float_script>("floatScript", "of a PackedPicture").or_null();
  });
}

const Struct& ShownMap::type() {
  return define<ShownMap>("ShownMap", "A difference for each pixel.", [](Struct& t) {
    t.key<&ShownMap::id>("id");
    t.key<&ShownMap::title>("title");
    t.key<&ShownMap::meaning>("meaning");
    t.key<&ShownMap::script>("script", "of a PackedPicture");
  });
}

const Struct& ShownComparison::type() {
  return define<ShownComparison>(
      "ShownComparison", "A comparison of two engines' pictures.", [](Struct& t) {
        t.key<&ShownComparison::a>("a");
        t.key<&ShownComparison::b>("b");
        t.key<&ShownComparison::picture>("picture", "of the difference").or_null();
        t.key<&ShownComparison::white_at>("whiteAt").or_null().may_be_nonfinite();
        t.key<&ShownComparison::relative_to_peak>("relativeToPeak").or_null();
        t.key<&ShownComparison::maps>("maps");
        t.key<&ShownComparison::worst_x>("worstX", "pixel of the largest difference")
            .or_null()
            .may_be_nonfinite();
        t.key<&ShownComparison::worst_y>("worstY").or_null().may_be_nonfinite();
      });
}

const Struct& ShownZone::type() {
  return define<ShownZone>("ShownZone", "A zone of a highlight.", [](Struct& t) {
    t.key<&ShownZone::title>("title");
    t.key<&ShownZone::from>("from").unit("degrees");
    t.key<&ShownZone::to>("to").unit("degrees");
  });
}

const Struct& ShownCurve::type() {
  return define<ShownCurve>("ShownCurve", "A curve of a profile.", [](Struct& t) {
    t.key<&ShownCurve::name>("name", "of an engine, or analytic");
    t.key<&ShownCurve::values>("values").may_be_nonfinite();
  });
}

const Struct& ShownProfile::type() {
  return define<ShownProfile>("ShownProfile", "A highlight as curves.", [](Struct& t) {
    t.key<&ShownProfile::angle>("angle");
    t.key<&ShownProfile::degrees>("degrees").may_be_nonfinite();
    t.key<&ShownProfile::zones>("zones");
    t.key<&ShownProfile::curves>("curves", "each as long as degrees");
  });
}

const Struct& CellPage::type() {
  return define<CellPage>("CellPage", "The page of a cell.", [](Struct& t) {
    t.key<&CellPage::id>("id");
    t.key<&CellPage::label>("label");
    t.key<&CellPage::exposure_stops>("exposureStops").or_null();
    t.key<&CellPage::engines>("engines");
    t.key<&CellPage::comparisons>("comparisons");
    t.key<&CellPage::profile>("profile").or_null();
  });
}

const Struct& PackedPicture::type() {
  return define<PackedPicture>(
      "PackedPicture", "A float picture in half floats, as text.", [](Struct& t) {
        t.key<&PackedPicture::width>("width");
        t.key<&PackedPicture::height>("height");
        t.key<&PackedPicture::from_ours>("fromOurs", "it is the difference from our picture");
        t.key<&PackedPicture::block>("block", "pixels of the cell that one stands for, each way");
        t.key<&PackedPicture::scale_log2>("scaleLog2");
        t.key<&PackedPicture::mantissa_bits>("mantissaBits");
        t.key<&PackedPicture::least>("least", "what is smaller is 0");
        t.key<&PackedPicture::predicted>("predicted");
        t.key<&PackedPicture::planes>("planes", "base64, deflated");
      });
}

const Struct& StabilitySummary::type() {
  return define<StabilitySummary>(
      "StabilitySummary", "The largest errors of a lobe: of the peak, and in ulp.", [](Struct& t) {
        t.key<&StabilitySummary::group>("group");
        t.key<&StabilitySummary::lobe>("lobe");
        t.key<&StabilitySummary::exponent>("exponent");
        t.key<&StabilitySummary::naive>("naive").may_be_nonfinite();
        t.key<&StabilitySummary::ours>("ours").may_be_nonfinite();
      });
}

const Struct& StabilityPage::type() {
  return define<StabilityPage>("StabilityPage", "The page of the hard cases.", [](Struct& t) {
    t.key<&StabilityPage::summaries>("summaries");
    t.key<&StabilityPage::curves>("curves");
  });
}

const Struct& PaperPage::type() {
  return define<PaperPage>("PaperPage", "The page of the paper's claims.",
                           [](Struct& t) { t.key<&PaperPage::charts>("charts"); });
}

}  // namespace lobelia::records
