// Pictures with noise, from rendering to a verdict.
#include "base/pictures/image_io.hpp"
#include "compare/uncertainty/noise_draws.hpp"
#include "run_lobelia.hpp"
#include "tests/base/picture_files.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

void render_area_light(const TemporaryDirectory& directory, const std::string& output,
                       std::vector<std::string> more) {
  std::vector<std::string> arguments{
      "render", kScenes + "effects/area_light.xml", "--width", "64", "--height", "64", "-q", "-o",
      output};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const auto result = run_lobelia(arguments, directory.path());
  ASSERT_EQ(result.exit_code, 0) << result.output_tail;
}

TEST(CompareWithNoise, ExitsWith0ForSame1ForDifferentAnd6ForUndecided) {
  const TemporaryDirectory directory;
  for (const char* seed : {"1", "2", "3", "4"})
    render_area_light(directory, std::string("half") + seed + ".exr",
                      {"--samples", "32", "--seed", seed});
  for (const char* seed : {"5", "6"})
    render_area_light(directory, std::string("other") + seed + ".exr",
                      {"--samples", "32", "--seed", seed, "--exponent", "12"});
  const auto compare = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"compare", "half1.exr", "half3.exr", "--a-replicate",
                                       "half2.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lobelia(arguments, directory.path());
  };
  const auto same = compare({"--b-replicate", "half4.exr", "--fail", "flip.ldr.mean=0.05"});
  EXPECT_EQ(same.exit_code, 0) << same.output_tail;
  EXPECT_THAT(same.output_tail, HasSubstr("verdict: same"));
  EXPECT_THAT(same.output_tail, HasSubstr("±"));
  const auto open = compare({"--b-replicate", "half4.exr", "--fail", "max_rel_peak=1e-4"});
  EXPECT_EQ(open.exit_code, 6) << open.output_tail;
  EXPECT_THAT(open.output_tail, HasSubstr("verdict: undecided"));
  EXPECT_THAT(open.output_tail, HasSubstr("MAY BE ON EITHER SIDE OF 0.0001"));
  const auto different =
      run_lobelia({"compare", "half1.exr", "other5.exr", "--a-replicate", "half2.exr",
                   "--b-replicate", "other6.exr", "--json", "record.json"},
                  directory.path());
  EXPECT_EQ(different.exit_code, 1) << different.output_tail;
  const Json record = read_json(directory.path() / "record.json");
  EXPECT_EQ(record["verdict"], "different");
  EXPECT_EQ(record["uncertainty"]["a"]["freedom"], 1);
  EXPECT_EQ(compare({"--b-replicate", "missing.exr"}).exit_code, 3);
}

TEST(RenderCommand, WritesAnErrorCoveringAnotherSeed) {
  const TemporaryDirectory directory;
  render_area_light(directory, "plain.exr", {"--samples", "64"});
  render_area_light(directory, "a.exr", {"--samples", "64", "--standard-error", "error.exr"});
  render_area_light(directory, "b.exr", {"--samples", "64", "--seed", "99"});
  EXPECT_EQ(read_file(directory.path() / "a.exr", 1 << 24),
            read_file(directory.path() / "plain.exr", 1 << 24))
      << "the picture is not changed by it";
  const auto result =
      run_lobelia({"compare", "a.exr", "b.exr", "--a-error", "error.exr", "--b-error", "error.exr",
                   "--shared-noise", "none", "--fail", "z.beyond=0", "--fail", "z.regions=0",
                   "--fail", "flip.ldr.mean=0.05"},
                  directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr("verdict: same"));
}

/// An EXR with a layer of X, Y and Z, and the squares of samples that scatter by `deviation` around them.
void write_moments(const std::filesystem::path& path, float value, float deviation) {
  std::vector<fixtures::ExrChannel> channels;
  for (const char* axis : {"X", "Y", "Z"}) {
    channels.push_back({std::string("path.") + axis, std::vector<float>(256, value)});
    channels.push_back({std::string("m2_path.") + axis,
                        std::vector<float>(256, value * value + deviation * deviation)});
  }
  fixtures::write_exr_channels(path, 16, 16, channels);
}

TEST(CompareWithNoise, ReadsItFromTheLayersOfTheFilesThemselves) {
  const TemporaryDirectory directory;
  write_moments(directory.path() / "a.exr", 1, 0.5f);
  write_moments(directory.path() / "b.exr", 1, 0.5f);
  write_moments(directory.path() / "other.exr", 2, 0.5f);
  const auto compare = [&](const char* b, std::vector<std::string> more) {
    std::vector<std::string> arguments{"compare", "a.exr", b, "--layer", "path"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lobelia(arguments, directory.path());
  };
  const std::vector<std::string> both{"--noise-from-layers", "both", "--a-samples", "64",
                                      "--b-samples",         "64"};
  const auto same = compare("b.exr", both);
  EXPECT_NE(same.exit_code, 1) << same.output_tail;
  auto with_record = both;
  with_record.insert(with_record.end(), {"--json", "record.json"});
  EXPECT_EQ(compare("other.exr", with_record).exit_code, 1);
  const auto record = read_json(directory.path() / "record.json");
  EXPECT_EQ(record["uncertainty"]["a"]["layer"], "m2_path");
  EXPECT_EQ(record["uncertainty"]["a"]["freedom"], 63);
  const auto unknown = compare("b.exr", {"--noise-from-layers", "a"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.output_tail, HasSubstr("does not say how many samples a pixel has"));
  EXPECT_EQ(compare("b.exr", {"--a-samples", "64"}).exit_code, 2);
  EXPECT_EQ(compare("b.exr", {"--noise-from-layers", "a", "--a-replicate", "b.exr"}).exit_code, 2);
}

/// Every value a normal number of this mean and deviation, from a seed.
Image scattered(float mean, float deviation, std::uint64_t seed) {
  Image image(32, 32);
  for (std::size_t i = 0; i < image.values().size(); ++i)
    image.values()[i] = mean + deviation * float(gaussian(seed, i));
  return image;
}

class CompareWithVariances : public testing::Test {
 protected:
  /// Pictures of samples of variance 4: 100 of each pixel.
  void SetUp() override {
    for (const char* folder : {"mine", "references", "variances"})
      std::filesystem::create_directory(at(folder));
    write_exr(at("mine/x.exr"), scattered(1, 0.2f, 1), {});
    write_exr(at("references/x.exr"), scattered(1, 0.2f, 2), {});
    write_exr(at("brighter.exr"), scattered(1.2f, 0.2f, 3), {});
    for (const char* file : {"mine/x_var.exr", "references/x_var.exr", "variances/x.exr"})
      write_exr(at(file), scattered(4, 0, 0), {});
    write_exr(at("of_mean.exr"), scattered(0.04f, 0, 0), {});
    write_exr(at("negative.exr"), scattered(-1, 0, 0), {});
  }
  std::filesystem::path at(const std::string& file) const { return directory_.path() / file; }
  ProcessResult compare(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "compare");
    return run_lobelia(arguments, directory_.path());
  }
  /// The record, of one limit that noise alone does not break.
  Json record(std::vector<std::string> arguments, ExitCode code) const {
    arguments.insert(arguments.end(),
                     {"--no-default-limits", "--fail", "drift=0.05", "--json", "record.json"});
    const auto result = compare(arguments);
    EXPECT_EQ(result.exit_code, int(code)) << result.output_tail;
    return read_json(at("record.json"));
  }
  TemporaryDirectory directory_;
};

TEST_F(CompareWithVariances, TakeThemOfOneSampleOrOfTheMean) {
  const std::vector<std::string> of_sample{
      "mine/x.exr", "references/x.exr", "--b-variance",   "of_mean.exr", "--b-samples",
      "1",          "--a-variance",     "mine/x_var.exr", "--a-samples", "100"};
  const Json same = record(of_sample, ExitCode::kSuccess);
  EXPECT_EQ(same["uncertainty"]["a"]["freedom"], 99);
  EXPECT_EQ(same["uncertainty"]["b"]["freedom"], 15);
  EXPECT_EQ(same["uncertainty"]["a"]["shared"], false);
  // Both have the same error, 0.2, so drift has that over the root of the number of pixels, for grey noise.
  EXPECT_NEAR(double(same["errorBars"]["drift"]["standardError"]), 0.2 * std::sqrt(2 / 1024.0),
              3e-3);
  record({"brighter.exr", "references/x.exr", "--b-variance", "references/x_var.exr", "--b-samples",
          "100"},
         ExitCode::kDiffers);
}

TEST_F(CompareWithVariances, FindVariancesBesideTheirPictures) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--b-variance", "*_var.exr", "--b-samples", "100", "--a-variance",
                                 "*_var.exr", "--a-samples", "100"},
        {"--project", "project.toml"}}) {
    write_file(at("project.toml"),
               "referenceVariance = \"*_var.exr\"\nreferenceSamples = 100\n"
               "judgedVariance = \"*_var.exr\"\njudgedSamples = 100\n");
    auto arguments = more;
    arguments.insert(arguments.begin(), {"mine", "references"});
    const Json set = record(arguments, ExitCode::kSuccess);
    ASSERT_EQ(set["pairs"].size(), 1u);
    EXPECT_EQ(set["summary"]["missing"], 0);
    EXPECT_EQ(set["pairs"][0]["comparison"]["uncertainty"]["b"]["freedom"], 99);
  }
  std::filesystem::remove(at("references/x_var.exr"));
  std::filesystem::remove(at("mine/x_var.exr"));
  record({"mine", "references", "--b-variance", "variances", "--b-samples", "100"},
         ExitCode::kSuccess);
}

TEST_F(CompareWithVariances, RefuseIncompleteVariances) {
  const auto refused = [&](std::vector<std::string> more, int code, const char* why) {
    more.insert(more.begin(), {"mine/x.exr", "references/x.exr"});
    const auto result = compare(more);
    EXPECT_EQ(result.exit_code, code);
    EXPECT_THAT(result.output_tail, HasSubstr(why));
  };
  refused({"--b-variance", "of_mean.exr"}, 2, "or 1 if the variance is that of the mean");
  refused({"--b-variance", "negative.exr", "--b-samples", "9"}, 3,
          "a variance is -1 at pixel (0, 0)");
  refused({"--b-variance", "references/*_var.exr", "--b-samples", "9"}, 2, "comes first");
  refused({"--b-variance", "*_none.exr", "--b-samples", "9"}, 3, "references/x_none.exr");
  refused({"--b-samples", "9"}, 2, "--b-variance");
  refused({"--b-variance", "of_mean.exr", "--b-error", "of_mean.exr"}, 2, "excludes");
}

}  // namespace
}  // namespace lobelia
