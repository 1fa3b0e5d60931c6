// Limits on layers of which none was compared are mistakes, and are said.
#include "compare/set/unjudged_limits.hpp"

#include "compare/set/run.hpp"
#include "tests/compare/layer_files.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

class UnjudgedLimits : public LayerFiles {
 protected:
  static std::vector<ExrChannel> depth(float value) {
    return {{"Z", std::vector<float>(kPixels, value)}};
  }
  CompareChoice choice(const std::vector<std::string>& fail) const {
    CompareChoice choice;
    choice.given = {path("a.exr").string(), path("b.exr").string()};
    choice.fail = fail;
    return choice;
  }
  static SetReport run(const CompareChoice& choice) {
    const CompareJob job = make_job(choice, nullptr);
    return compare_pairs(job, pair_pictures(job.pictures), [](std::size_t) {});
  }
  /// Why the limits are refused; empty if they are not.
  static std::string refusal(const CompareChoice& choice) {
    const Error error = thrown_by([&] { run(choice); });
    EXPECT_TRUE(error.code() == ExitCode::kSuccess || error.code() == ExitCode::kUsage);
    return error.what();
  }
  /// A folder with a picture that has depth, if a value is given, and one that has not.
  void folder(const std::string& name, const std::optional<float>& value) {
    std::filesystem::create_directory(path(name));
    file(name + "/flat.exr", {});
    file(name + "/deep.exr", value ? depth(*value) : std::vector<ExrChannel>{});
  }
};

TEST_F(UnjudgedLimits, AreRefusedWithTheLayersThatThereWere) {
  file("a.exr", depth(1));
  file("b.exr", depth(2));
  CompareChoice asked = choice({"depth.relative.max=0.01"});
  EXPECT_EQ(refusal(asked),
            "the limit on 'depth.relative.max' judged nothing: it needs a layer of type depth; "
            "compared: the picture (colour); not compared: 'Z' (try --all-layers)");
  asked.no_default_limits = true;
  EXPECT_NE(refusal(asked), "") << "nothing at all would be judged";
  asked.all_layers = true;
  EXPECT_EQ(refusal(asked), "");
  EXPECT_EQ(run(asked).pairs.front().verdict(), Verdict::kDiffers);
}

TEST_F(UnjudgedLimits, AreThoseOfEveryTypeAndWarningsToo) {
  file("a.exr", {});
  file("b.exr", {});
  EXPECT_THAT(refusal(choice({"identifier.pixels=3"})), HasSubstr("a layer of type identifier;"));
  EXPECT_THAT(refusal(choice({"coverage.max=0.01"})), HasSubstr("a Cryptomatte;"));
  EXPECT_THAT(refusal(choice({"vector.angle.max=1"})), HasSubstr("a layer of type vector;"));
  CompareChoice asked = choice({});
  asked.warn = {"depth.relative.max=0.01"};
  EXPECT_THAT(refusal(asked), HasSubstr("'depth.relative.max'"));
  EXPECT_EQ(refusal(choice({"rmse=1", "highlights.energy=0.1"})), "");
}

TEST_F(UnjudgedLimits, AreThoseOfColoursWhereTheLayerIsAnother) {
  file("a.exr", depth(1));
  file("b.exr", depth(1));
  CompareChoice asked = choice({"highlights.energy=0.1"});
  asked.layer = "Z";
  EXPECT_THAT(refusal(asked),
              AllOf(HasSubstr("a layer of type colour;"), HasSubstr("compared: layer Z (depth)")));
  asked.fail = {"rmse=0.1"};
  EXPECT_EQ(refusal(asked), "") << "a metric of all values";
}

TEST_F(UnjudgedLimits, NeedOnlyOnePairOfASetWithSuchALayer) {
  folder("a", 1.0f);
  folder("b", 2.0f);
  CompareChoice asked = choice({"depth.relative.max=0.01"});
  asked.given = {path("a").string(), path("b").string()};
  EXPECT_THAT(refusal(asked), HasSubstr("try --all-layers"));
  asked.all_layers = true;
  EXPECT_EQ(refusal(asked), "");
  folder("a", std::nullopt);
  folder("b", std::nullopt);
  EXPECT_THAT(refusal(asked), HasSubstr("compared: the picture (colour)"));
}

TEST_F(UnjudgedLimits, DoNotHideThatALayerIsMissing) {
  file("a.exr", {});
  file("b.exr", depth(2));
  CompareChoice asked = choice({"depth.relative.max=0.01"});
  asked.all_layers = true;
  EXPECT_EQ(run(asked).pairs.front().verdict(), Verdict::kDiffers) << "only b has its depth";
}

}  // namespace
}  // namespace lobelia
