// What is made of the measured claims: the errata, the record, the table, the plots, the command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <regex>
#include <set>

#include "lobelia_paths.hpp"
#include "studies/paper/report.hpp"
#include "tests/cli/run_lobelia.hpp"
#include "tests/json.hpp"
#include "tests/studies/measured_claims.hpp"

namespace lobelia::paper {
namespace {

using testing::HasSubstr;

TEST(PaperErrata, are_the_page_in_docs) {
  EXPECT_EQ(read_file(LOBELIA_SOURCE_DIR "/docs/errata.md", 1 << 20),
            errata_document(measured_claims()))
      << "run: lobelia verify paper --errata > docs/errata.md";
}

TEST(PaperErrata, have_tables_whose_rows_have_the_columns_of_their_head) {
  const std::string page = errata_document(measured_claims());
  std::istringstream in(page);
  long columns = 0;
  int rows = 0;
  for (std::string line; std::getline(in, line);) {
    const long bars = std::count(line.begin(), line.end(), '|');
    EXPECT_TRUE(bars == 0 || columns == 0 || bars == columns) << line;
    columns = bars;
    rows += bars > 0;
  }
  EXPECT_GT(rows, 100);
}

TEST(PaperClaims, say_all_that_a_reader_needs_and_have_names_of_their_own) {
  static const std::regex kebab("[a-z0-9.]+(-[a-z0-9.]+)*");
  std::set<std::string_view> names;
  for (const Claim& claim : measured_claims()) {
    EXPECT_TRUE(names.insert(claim.name).second) << claim.name << " twice";
    EXPECT_TRUE(std::regex_match(std::string(claim.name), kebab)) << claim.name;
    EXPECT_FALSE(claim.where.empty()) << claim.name;
    EXPECT_FALSE(claim.statement.empty()) << claim.name;
    EXPECT_FALSE(claim.definition.empty()) << claim.name;
    EXPECT_FALSE(claim.measured.empty()) << claim.name;
    EXPECT_TRUE(claim.verdict != kNotReproduced || !claim.reason.empty()) << claim.name;
    for (const Figure& figure : claim.measured)
      EXPECT_TRUE(std::isfinite(figure.value) && !figure.text.empty()) << claim.name;
  }
}

TEST(PaperTable, has_a_line_for_every_claim_and_the_counts) {
  const std::string table = table_text(measured_claims());
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), long(measured_claims().size()) + 3);
  EXPECT_THAT(table, HasSubstr("22 confirmed, 13 not reproduced, 8 found beyond the paper\n"));
}

/// Drawn once: it takes seconds.
const std::vector<Plot>& drawn_plots() {
  static const std::vector<Plot> drawn = plots();
  return drawn;
}

TEST(PaperPlots, are_well_formed_and_every_line_has_points_inside_the_frame) {
  for (const auto& [file, chart, claims] : drawn_plots()) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(draw_chart_file(chart).c_str())) << file;
    EXPECT_EQ(document.select_nodes("/svg/path").size(), chart.series.size()) << file;
    for (const ChartSeries& series : chart.series) {
      int inside = 0;
      for (const double y : series.y) inside += y >= chart.y.from && y <= chart.y.to;
      EXPECT_GT(4 * inside, int(series.y.size())) << file << ": " << series.label;
    }
  }
}

TEST(PaperPlots, name_claims_that_there_are) {
  std::set<std::string_view> names;
  for (const Claim& claim : measured_claims()) names.insert(claim.name);
  for (const Plot& plot : drawn_plots()) {
    EXPECT_FALSE(plot.claims.empty()) << plot.file;
    for (const std::string_view name : plot.claims) EXPECT_TRUE(names.contains(name)) << name;
  }
}

TEST(PaperCommand, exits_with_0_and_writes_record_and_plots) {
  const TemporaryDirectory directory;
  const auto result = run_lobelia({"verify", "paper", "--json", "paper.json", "--plots", "plots"},
                                  directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr("not reproduced"));
  const Json record = read_json(directory.path() / "paper.json");
  EXPECT_EQ(record["claims"].size(), measured_claims().size());
  EXPECT_EQ(record["notReproduced"], 13);
  const auto& drawn = drawn_plots();
  EXPECT_EQ(record, as_json(paper_record(
                        measured_claims(),
                        {"lobelia", "verify", "paper", "--json", "paper.json", "--plots", "plots"},
                        figure_records(drawn))));
  EXPECT_EQ(files_in(directory.path() / "plots"), drawn.size());
  for (const auto& plot : drawn)
    EXPECT_EQ(read_file(directory.path() / "plots" / plot.file, 1 << 20),
              draw_chart_file(plot.chart));
}

TEST(PaperCommand, prints_the_errata) {
  const TemporaryDirectory directory;
  const auto result = run_shell("\"$LOBELIA\" verify paper --errata > errata.md", directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_EQ(read_file(directory.path() / "errata.md", 1 << 20), errata_document(measured_claims()));
}

}  // namespace
}  // namespace lobelia::paper
