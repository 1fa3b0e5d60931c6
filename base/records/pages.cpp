#include "base/records/pages.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kMetricUnits[] = {"radiance", "share", "count", "plain"};

}  // namespace

void define_page_tables(Tables& tables) {
  tables.define<GridAxis>("An axis of the grid.", [](auto& t) { t.key("values", "labels"); });
  tables.define<GridEngine>("A reference engine that is there.");
  tables.define<GridLayout>("The order without script; -1: no such axis.");
  tables.define<GridStatus>("A status that a cell may have.");
  tables.define<GridChange>("How a cell may have changed since an earlier run.");
  tables.define<GridPicture>("A thumbnail: many cells have one of the same name and size.");
  tables.define<GridMetric>("A metric that a grid can be coloured by.",
                            [](auto& t) { t.key("unit").one_of(kMetricUnits); });
  tables.define<GridColumn>("A metric of one engine.", [](auto& t) {
    t.key("engine", "its place in the list of engines");
    t.key("values", "a float32 for each cell, NaN where there is none; little endian, in base64");
    t.key("limits", "likewise; one alone holds for every cell; may be empty");
  });
  tables.define<GridColumns>("A metric of all engines.",
                             [](auto& t) { t.key("metric", "its place in the list of metrics"); });
  tables.define<GridLabel>("The label of a cell that has no place on the axes.");
  tables.define<GridPage>("The page of the grid.", [](auto& t) {
    t.key("noun", "what a cell is called");
    t.key("ids", "of the cells; the lists below are in their order");
    t.key("at", "for each cell its value on each axis; -1 where the axis does not know it");
    t.key("status", "its place in the list of statuses");
    t.key("picture", "its place in the list of pictures; -1: there is none");
    t.key("place", "of a site in few files: its place among the thumbnails").if_any();
    t.key("labels", "where the values on the axes do not tell it").if_any();
    t.key("beside", "of a report: the other pictures, each followed by its difference").if_any();
    t.key("findings", "of a report: a sentence, or nothing").if_any();
    t.key("changes", "if there is an earlier run").if_any();
    t.key("change", "its place in the list of changes").if_any();
    t.key("columns", "of a small grid; in a large one each is a file").if_any();
  });
  tables.define<ShownPicture>("A picture; both files are drawn at this size.", [](auto& t) {
    t.key("small", "shorter to load where src is heavy, else the same");
  });
  tables.define<ShownEngine>("An engine and its picture of a cell.", [](auto& t) {
    t.key("picture").or_null();
    t.key("floatScript", "of a PackedPicture").or_null();
    t.key("beforeOf", "of an earlier run's picture: the engine's name").if_any();
  });
  tables.define<ShownMap>("A difference for each pixel.", [](auto& t) {
    t.key("script", "of a PackedPicture");
    t.key("top", "of its scale");
  });
  tables.define<ShownComparison>("A comparison of two engines' pictures.", [](auto& t) {
    t.key("picture", "of the difference").or_null();
    t.keys({"whiteAt", "worstY"}).or_null().may_be_nonfinite();
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
    t.key("fromFormula", "curves with differences from the formula as values").if_any();
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
  tables.define<PackedShown>("An 8-bit picture, as a site in few files has it.", [](auto& t) {
    t.key(
        "way",
        "what its bytes are differences from: 1 a prediction from neighbours, 2 the first picture, 3 both");
  });
  tables.define<PackedCell>("A cell of a site in few files.", [](auto& t) {
    t.key("main", "markup of its <main>").most_text(std::size_t{1} << 26);
    t.key("counts", "numbers of its profile's degrees and of each curve, which CellChunk has");
  });
  tables.define<CellTexts>("The texts of a CellChunk.");
  tables.define<CellChunk>("Neighbouring cells of a site in few files.", [](auto& t) {
    t.key("texts", "CellTexts; base64, deflated");
    t.key(
        "curves",
        "the numbers of all profiles as gallery/packed/packed_numbers.hpp has them; base64, deflated");
    t.key(
        "pixels",
        "for each cell all its pictures as gallery/packed/packed_pixels.hpp has them; base64, deflated");
  });
  tables.define<CellIndex>("The page of all cells.", [](auto& t) {
    t.key("first", "the first id of each CellChunk, percent-encoded, in order");
  });
  tables.define<Thumbnails>("Thumbnails of neighbouring cells.", [](auto& t) {
    t.key("widths", "in pixels; 0 is no picture");
    t.key("ways", "as in PackedShown");
    t.key("pixels", "all pictures as gallery/packed/packed_pixels.hpp has them; base64, deflated");
  });
  tables.define<ExplorerPage>("The explorer's page.", [](auto& t) {
    t.key("search", "studies/shader_check/web as WebAssembly; base64, deflated").if_any();
  });
  tables.define<InlinedPage>("A page of a report in one file.", [](auto& t) {
    t.key("main", "markup of its <main>").most_text(std::size_t{1} << 26);
  });
}

}  // namespace lobelia::records
