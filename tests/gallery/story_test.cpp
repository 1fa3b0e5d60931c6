// The words of a cell's page and of the index.
#include "gallery/cells/cell_page.hpp"
#include "gallery/site/gallery.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"
#include "tests/test.hpp"

namespace lobelia::gallery {
namespace {

CheckedComparison compared(double worst) {
  CheckedComparison comparison;
  comparison.record.metrics = {
      {"max_rel_peak", worst}, {"max_abs.x", 156.0}, {"max_abs.y", 99.0}, {"outliers", 0.0}};
  comparison.record.tolerance = records::Tolerance{};
  comparison.record.tolerance->relative = 0x1p-11;
  comparison.record.tolerance->of_peak = 1e-5;
  comparison.record.tolerance->allowed_outliers = 3;
  comparison.verdict = "pass";
  return comparison;
}

TEST(Story, NamesTheLargestDifferenceWithItsPlace) {
  EXPECT_EQ(story_of(compared(0.00041), "POV-Ray"),
            "Largest difference 0.041 % of the peak at (156, 99): POV-Ray writes half floats, "
            "whose rounding is 0.049 % of the value; 0.001 % of the peak is allowed for "
            "arithmetic.");
}

TEST(Story, BlamesHalfFloatsOnlyWhereTheToleranceIsTheirs) {
  CheckedComparison comparison = compared(0.00041);
  for (const double relative : {0.0, 0x1p-24, 0x1p-10}) {
    comparison.record.tolerance->relative = relative;
    EXPECT_THAT(story_of(comparison, "POV-Ray"), Not(HasSubstr("half floats"))) << relative;
  }
}

TEST(Story, TellsEdgesFromPixelsWithoutAKnownCause) {
  CheckedComparison comparison = compared(0.3);
  records::Named<double>& metrics = comparison.record.metrics;
  std::erase_if(metrics, [](const auto& metric) { return metric.first == "outliers"; });
  metrics.emplace_back("outliers", 2.0);
  metrics.emplace_back("outliers.off_edge", 0.0);
  EXPECT_THAT(story_of(comparison, "POV-Ray"),
              HasSubstr("2 pixels are beyond that, on edges alone"));
  metrics.back().second = 1;
  EXPECT_THAT(story_of(comparison, "POV-Ray"), HasSubstr("The record does not say why."));
}

TEST(Story, OmitsUntrustedFigures) {
  CheckedComparison comparison = compared(0.00041);
  comparison.doubt = CellStatus::kDamaged;
  EXPECT_EQ(story_of(comparison, "POV-Ray"), "");
  comparison.doubt.reset();
  comparison.record.nonfinite.b = 7;
  EXPECT_THAT(story_of(comparison, "POV-Ray"), HasSubstr("7 values are NaN or infinite"));
}

TEST(FirstScreen, LinksTheFarthestCell) {
  const FakeFarm farm;
  farm.change<records::Comparison>(FakeFarm::kDiffers, "lobelia-povray.json",
                                   [](records::Comparison& comparison) {
                                     for (auto& [metric, value] : comparison.metrics)
                                       if (metric == "max_rel_peak") value = 0.02;
                                   });
  GalleryOptions options;
  options.metrics = some_metrics();
  write_gallery(farm.directory(), options);
  const Site site(farm.directory());
  const auto& index = site.page("index.html");
  EXPECT_THAT(index.select_node("//p[@class='lead']").node().text().get(),
              HasSubstr("1 of 4 highlights agree with POV-Ray; 1 differs."));
  EXPECT_EQ(
      std::string(index.select_node("//section[@class='findings']//a/@href").attribute().value()),
      "cells/" + FakeFarm::kDiffers + "/index.html");
  EXPECT_EQ(index.select_nodes("//div[@class='pair']//img").size(), 2u);
  EXPECT_THAT(index.select_node("//section[@class='findings']//li").node().text().get(),
              HasSubstr("Farthest beyond its limit"));
}

TEST(FirstScreen, CountsCellsByVerdict) {
  for (const auto& [pass, differ, sentence] :
       {std::tuple(1, 0, "All 1 highlights agree with POV-Ray, "),
        {3, 0, "All 3 highlights agree with POV-Ray, "},
        {2, 2, "2 of 4 highlights agree with POV-Ray; 2 differ."},
        {0, 1, "0 of 1 highlights agree with POV-Ray; 1 differs."}}) {
    FakeFarm farm;
    farm.leave_out({FakeFarm::kPass, FakeFarm::kDiffers, FakeFarm::kFailed, FakeFarm::kMissing});
    for (int i = 0; i < pass + differ; ++i)
      farm.add_cell("cell" + std::to_string(i), i < pass ? "pass" : "differs",
                    {{"model", "phong_rdf"}, {"exponent", std::to_string(16 + i)}});
    write_gallery(farm.directory());
    EXPECT_THAT(Site(farm.directory())
                    .page("index.html")
                    .select_node("//p[@class='lead']")
                    .node()
                    .text()
                    .get(),
                HasSubstr(sentence));
  }
}

TEST(FirstScreen, CitesTheStudyWhereItsGridNamesTheAuthors) {
  FakeFarm farm;
  write_gallery(farm.directory());
  const char* citation = "//section[@class='citation']//code";
  EXPECT_TRUE(Site(farm.directory()).page("index.html").select_nodes(citation).empty());
  farm.farm().authors = "A. Author and {B} & C_D";
  farm.farm().url = "https://example.org/a_b";
  farm.write();
  write_gallery(farm.directory());
  const Site site(farm.directory());
  const std::string entry = site.page("index.html").select_node(citation).node().text().get();
  EXPECT_THAT(entry, HasSubstr("author = {A. Author and B \\& C\\_D},"));
  EXPECT_THAT(entry, HasSubstr("url = {https://example.org/a_b},"));
}

}  // namespace
}  // namespace lobelia::gallery
