#include "base/pictures/image_io.hpp"
#include "run_lobelia.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

float brightest(const std::filesystem::path& picture) {
  const Image image = read_image(picture);
  return *std::max_element(image.values().begin(), image.values().end());
}

TEST(VerifyStability, WritesARecordWithPictures) {
  const TemporaryDirectory directory;
  const auto result = run_lobelia(
      {"verify", "stability", "--lobe", "cs12", "-q", "--json", "s.json", "--pictures", "pictures"},
      directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr(" within their bounds, 0 outside,"));
  const Json record = read_json(directory.path() / "s.json");
  EXPECT_EQ(record["outside"], 0);
  EXPECT_LT(record["notCompared"], 100);
  EXPECT_GT(record["cases"], 2500);
  ASSERT_EQ(record["byLobe"].size(), 7u);
  for (const auto& group : record["byLobe"]) EXPECT_EQ(group["lobe"], "cs12");
  ASSERT_EQ(record["pictures"].size(), 3u);
  for (const auto& picture : record["pictures"]) {
    for (const char* who : {"naive", "ours"})
      for (const char* file : {"exr", "png", "error"})
        EXPECT_GT(brightest(directory.path() / std::string(picture[who][file])), 0);
    EXPECT_LT(picture["ours"]["largestErrorOfPeak"], 1e-5);
    EXPECT_GT(picture["naive"]["largestErrorOfPeak"],
              1000 * double(picture["ours"]["largestErrorOfPeak"]));
  }
  // At n = 1e6 the brightest pixel of the naive one is no highlight's any more.
  EXPECT_GT(record["pictures"][2]["naive"]["largestErrorOfPeak"], 1);
  EXPECT_EQ(files_in(directory.path() / "pictures"), 19u);
  EXPECT_EQ(files_in(directory.path()), 2u);
}

TEST(VerifyReferences, EndsWith5WhereAnEngineFails) {
  const TemporaryDirectory directory;
  const auto povray = directory.path() / "povray";
  write_file(povray,
             "#!/bin/sh\n"
             "echo 'POV-Ray 3.7.0.10' >&2\n"
             "case \"$*\" in *version*) exit 0;; esac\n"
             "exit 3\n");
  std::filesystem::permissions(povray, std::filesystem::perms::owner_all);
  const auto result = run_lobelia({"verify", "references", "--small", "--size", "16", "--engine",
                                   "povray", "--povray", povray.string(), "-q", "-o", "table"},
                                  directory.path());
  EXPECT_EQ(result.exit_code, 5) << result.output_tail;
  EXPECT_GT(read_json(directory.path() / "table" / "agreement.json")["verdicts"]["failed"], 100);
  EXPECT_THAT(result.output_tail, HasSubstr(" comparisons, none misses its target, "));
}

}  // namespace
}  // namespace lobelia
