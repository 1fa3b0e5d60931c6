// lobelia search, and the page that shows it.
#include "tests/json.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class SearchCommand : public testing::Test {
 protected:
  ProcessResult run(const std::string& arguments) const {
    return run_shell("\"$LOBELIA\" search -q " + arguments, directory_.path());
  }
  const TemporaryDirectory directory_;
};

TEST_F(SearchCommand, FindsTheCheapestWithinAnError) {
  const auto cheapest = run("--error 1e-3 --json search.json");
  ASSERT_EQ(cheapest.exit_code, 0) << cheapest.output_tail;
  const Json record = Json::parse(read_file(directory_.path() / "search.json", 1 << 22));
  EXPECT_EQ(record["kind"], "lobe-search");
  EXPECT_EQ(record["chosen"], "pk3.2");
}

TEST_F(SearchCommand, FindsTheNearestForAPrice) {
  const auto nearest = run("--operations 5 --exponents 64 --family pk --certificates");
  EXPECT_EQ(nearest.exit_code, 0);
  EXPECT_THAT(nearest.output_tail, StartsWith("Use pk3.1, "));
  EXPECT_THAT(nearest.output_tail, HasSubstr(" a value, 5 operations: max = "));
  EXPECT_THAT(nearest.output_tail, HasSubstr("pk3.1: no lobe of this shape has a smaller error"));
}

TEST_F(SearchCommand, PrintsTheBestLobeIfNoneMeetsTheRequest) {
  const auto result = run("--error 1e-4 --operations 5");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output_tail,
              StartsWith("No lobe of the family 'all' with at most 5 operations is within 0.0001. "
                         "The best possible is 0.0035"));
  // Between what is proved of pk3.2 and what is proved of all lobes like it.
  const auto undecided = run("--error 4.785e-4 --family pk > all.txt; head -n 14 all.txt");
  EXPECT_THAT(undecided.output_tail, StartsWith("Use pk3.3, "));
  EXPECT_THAT(undecided.output_tail, HasSubstr(" a value, 7 operations"));
  EXPECT_THAT(undecided.output_tail,
              HasSubstr("pk3.2 is cheaper, and whether a lobe of its shape"));
  const auto other = run("--error 1e-3 --operations 7 --family rk");
  EXPECT_EQ(other.exit_code, 1) << other.output_tail;
  EXPECT_THAT(other.output_tail, HasSubstr(": rk1.0."));
}

TEST_F(SearchCommand, RefusesAWrongRequestInOneLine) {
  const std::pair<const char*, const char*> wrong[] = {
      {"--error 1e-9", "is below the rounding of float32"},
      {"--error 1e-4 --precision float16", "is below the rounding of float16"},
      {"--error nan", "--error"},
      {"--error -1", "--error"},
      {"--exponents 64..16", "is empty"},
      {"--exponents 16..x", "is no range"},
      {"--family xk", "--family"},
      {"--metric ssim", "--metric"},
      {"--operations 0", "--operations"},
      {"--operations 99", "--operations"},
      {"--coefficients best", "--coefficients"},
      {"--precision fixed:99", "--precision"},
  };
  for (const auto& [arguments, words] : wrong) {
    SCOPED_TRACE(arguments);
    expect_one_line(run(arguments), 2, words);
  }
  EXPECT_EQ(run("--operations 3 --json none/search.json").exit_code, 4);
}

}  // namespace
}  // namespace lobelia
