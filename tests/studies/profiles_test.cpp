// The study of the errors of profiles, in part.
#include "studies/profiles/profiles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "farm/profile_scene.hpp"
#include "studies/profiles/made_pictures.hpp"
#include "tests/more_samples.hpp"

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
  EXPECT_NE(alone.figures.at("peak").worst, other.figures.at("peak").worst);
  one.seed = 1;
  EXPECT_EQ(alone.figures.at("peak").worst, measured(one).front().figures.at("peak").worst);
}

TEST(ProfilesStudy, CountsWhatIsMissingAsMissed) {
  Tally tally;
  tally.add(1.01, 1, 0.01, 1);
  tally.add(1.03, 1, 0.01, 1);
  tally.add(std::nan(""), 1, 0.01, 1);
  tally.add(1, 1, std::nan(""), 1);
  EXPECT_EQ(tally.figures, 2);
  EXPECT_EQ(tally.within_two, 1);
  EXPECT_EQ(tally.missing, 2);
  EXPECT_DOUBLE_EQ(tally.share(), 0.25);
  EXPECT_NEAR(tally.worst, 3, 1e-9);
}

TEST(ProfilesStudy, HasKindsOfDifferentNames) {
  std::set<std::string> names;
  for (const Kind& kind : kinds()) names.insert(kind.name);
  EXPECT_EQ(names.size(), kinds().size());
  EXPECT_GE(names.size(), 20u);
}

}  // namespace
}  // namespace lobelia::profile_study
