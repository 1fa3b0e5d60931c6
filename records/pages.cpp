#include "records/pages.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kMetricUnits[] = {"radiance", "share", "count", "plain"};

}  // namespace

void define_page_tables(Tables& tables) {
  tables.define<GridAxis>("An axis of the grid.", [](auto& t) { t.key("values", "labels"); });
  tables.define<GridEngine>("A reference engine that is there.");
  tables.define<GridLayout>("The order without script; -1: no such axis.");
  tables.define<GridStatus>("A status that a cell may have.");
  tables.define<GridPicture>("A cell's thumbnail.");
  tables.define<GridCell>("A cell of the grid.", [](auto& t) {
    t.key("at", "its value on each axis; -1 where the axis does not know it");
    t.key("metrics", "by engine, a value of each metric").may_be_nonfinite();
    t.key("beside", "of a report: the other pictures, each followed by its difference").if_any();
    t.key("finding", "of a report: a sentence").if_any();
  });
  tables.define<GridMetric>("A metric that a grid can be coloured by.",
                            [](auto& t) { t.key("unit").one_of(kMetricUnits); });
  tables.define<GridPage>("The page of the grid.",
                          [](auto& t) { t.key("noun", "what a cell is called"); });
  tables.define<ShownPicture>("A picture; both files are drawn at this size.", [](auto& t) {
    t.key("small", "shorter to load where src is heavy, else the same");
  });
  tables.define<ShownEngine>("An engine and its picture of a cell.", [](auto& t) {
    t.key("picture").or_null();
    t.key("floatScript", "of a PackedPicture").or_null();
  });
  tables.define<ShownMap>("A difference for each pixel.",
                          [](auto& t) { t.key("script", "of a PackedPicture"); });
  tables.define<ShownComparison>("A comparison of two engines' pictures.", [](auto& t) {
    t.key("picture", "of the difference").or_null();
    t.keys({"whiteAt", "worstY"}).or_null().may_be_nonfinite();
    t.key("relativeToPeak").or_null();
    t.key("worstX", "pixel of the largest difference").or_null().may_be_nonfinite();
    t.key("region", "script with the PixelRuns of the highlight").if_any();
  });
  tables.define<ShownZone>("A zone of a highlight.", [](auto& t) {
    t.keys({"from", "to"}).unit("degrees");
  });
  tables.define<ShownCurve>("A curve of a profile.", [](auto& t) {
    t.key("name", "of an engine, or analytic");
    t.key("values").may_be_nonfinite();
  });
  tables.define<ShownProfile>("A highlight as curves.", [](auto& t) {
    t.key("degrees").may_be_nonfinite();
    t.key("curves", "each as long as degrees");
  });
  tables.define<CellPage>("The page of a cell.", [](auto& t) {
    t.keys({"exposureStops", "profile"}).or_null();
  });
  tables.define<PixelRuns>("Pixels of a picture.", [](auto& t) {
    t.key("runs", "for each run its first pixel in reading order, and its length");
  });
  tables.define<PackedPicture>("A float picture in half floats, as text.", [](auto& t) {
    t.key("fromOurs", "it is the difference from our picture");
    t.key("block", "pixels of the cell that one stands for, each way");
    t.key("least", "what is smaller is 0");
    t.key("planes", "base64, deflated");
  });
  tables.define<StabilitySummary>("The largest errors of a lobe: of the peak, and in ulp.",
                                  [](auto& t) {
                                    t.keys({"naive", "ours"}).may_be_nonfinite();
                                  });
  tables.define<StabilityPage>("The page of the hard cases.");
  tables.define<InlinedPage>("A page of a report in one file.", [](auto& t) {
    t.key("main", "markup of its <main>").most_text(std::size_t{1} << 26);
  });
  tables.define<PaperPage>("The page of the paper's claims.");
}

}  // namespace lobelia::records
