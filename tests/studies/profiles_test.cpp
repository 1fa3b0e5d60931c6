// The study of the errors of profiles, in part.
#include "studies/profiles/profiles.hpp"

#include "farm/profile_scene.hpp"
#include "studies/profiles/made_pictures.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia::profile_study {
namespace {

std::vector<Row> measured(const Options& options) {
  return measure(
      options,
      [](const Scene& scene, const NamedImages& images) {
        return profile_scene(scene, 0, 0, images, true);
      },
      [](double) {});
}

TEST(ProfilesStudy, FindsTheTruthWithinTwoErrorsInEveryKind) {
  Options options;
  options.pictures = 6 * more_samples();
  options.seed = 20261130;
  for (const Row& row : measured(options)) {
    int figures = 0;
    for (const auto& [name, tally] : row.figures) figures += tally.figures + tally.missing;
    ASSERT_GE(figures, options.pictures) << row.kind;
    // Figures of one picture deviate together, so a picture counts once.
    const double spread = std::sqrt(kGoal * (1 - kGoal) / options.pictures);
    EXPECT_GE(row.share(), kGoal - 3 * spread) << row.kind;
  }
}

/// Whether errors are stated neither too small nor far too large, if these are `stretched` so many times.
bool are_right(const Row& row, double stretched) {
  std::vector<double> distances = row.figures.at("lobe").distances;
  for (double& distance : distances) distance /= stretched;
  std::ranges::sort(distances);
  const auto within =
      double(std::ranges::upper_bound(distances, 2.0) - distances.begin()) / row.pictures;
  const double spread = std::sqrt(kGoal * (1 - kGoal) / row.pictures);
  return within >= kGoal - 2 * spread && distances[distances.size() / 2] >= 0.3;
}

TEST(ProfilesStudy, RefusesErrorsOfLobesOfHalfTheSizeOrThrice) {
  Options options;
  options.pictures = 60 * more_samples();
  for (const char* kind : {"scene: no noise", "scene: half floats", "scene: gamma"}) {
    options.only = kind;
    const Row row = measured(options).front();
    EXPECT_TRUE(are_right(row, 1)) << kind << ' ' << row.share() << ' ' << row.median_distance();
    EXPECT_FALSE(are_right(row, 0.5)) << kind;
    EXPECT_FALSE(are_right(row, 3)) << kind;
  }
}

TEST(ProfilesStudy, RecordsTheFiguresOfTheTable) {
  Options options;
  options.pictures = 2;
  options.only = std::string(kinds().back().name);
  const std::vector<Row> rows = measured(options);
  const records::VerifyProfiles record = report_record(rows, options.seed);
  ASSERT_EQ(record.kinds.size(), 1u);
  EXPECT_EQ(record.outside, meets_goal(rows) ? 0u : 1u);
  EXPECT_EQ(record.kinds[0].name, options.only);
  EXPECT_EQ(record.kinds[0].share, rows[0].share());
  int within = 0, all = 0;
  for (const records::FigureCoverage& figure : record.kinds[0].figures) {
    within += figure.within_two;
    all += figure.figures + figure.missing;
    EXPECT_LE(figure.median_distance, figure.worst_distance) << figure.figure;
  }
  EXPECT_EQ(all, 2 * 8) << "peak, energy, and two each of place, centroid and half-width";
  EXPECT_DOUBLE_EQ(record.kinds[0].share, double(within) / all);
}

TEST(ProfilesStudy, MakesTheSamePicturesOfASeed) {
  Options one;
  one.pictures = 2;
  one.only = std::string(kinds().back().name);
  const Row alone = measured(one).front();
  EXPECT_EQ(alone.kind, one.only);
  EXPECT_EQ(alone.pictures, 2);
  // Another seed, other pictures.
  one.seed = 2;
  const Row other = measured(one).front();
  EXPECT_NE(alone.figures.at("peak").worst(), other.figures.at("peak").worst());
  one.seed = 1;
  EXPECT_EQ(alone.figures.at("peak").worst(), measured(one).front().figures.at("peak").worst());
}

TEST(ProfilesStudy, CountsMissingFiguresAsMissed) {
  Tally tally;
  tally.add(1.01, 1, 0.01, 1);
  tally.add(1.03, 1, 0.01, 1);
  tally.add(std::nan(""), 1, 0.01, 1);
  tally.add(1, 1, std::nan(""), 1);
  EXPECT_EQ(tally.figures, 2);
  EXPECT_EQ(tally.within_two, 1);
  EXPECT_EQ(tally.missing, 2);
  EXPECT_DOUBLE_EQ(tally.share(), 0.25);
  EXPECT_NEAR(tally.worst(), 3, 1e-9);
}

TEST(ProfilesStudy, HasKindsOfDifferentNames) {
  std::set<std::string> names;
  for (const Kind& kind : kinds()) names.insert(kind.name);
  EXPECT_EQ(names.size(), kinds().size());
  EXPECT_GE(names.size(), 20u);
}

}  // namespace
}  // namespace lobelia::profile_study
