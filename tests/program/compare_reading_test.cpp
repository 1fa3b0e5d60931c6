// `lobelia compare` says how the files' values became light.
#include "tests/program/compare_pictures_fixture.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

class HowPicturesAreRead : public ComparePictures {
 protected:
  /// The pages of all pairs of a report.
  std::string pages(std::vector<std::string> arguments, int exit_code) {
    arguments.insert(arguments.end(), {"--html", "report"});
    const ProcessResult result = compare(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.output_tail;
    std::string all;
    for (const auto& entry : std::filesystem::directory_iterator(path("report/cells")))
      all += read_file(entry.path() / "index.html", 1 << 20);
    return all;
  }
};

TEST_F(HowPicturesAreRead, IsReportedForCurvesOrGainMaps) {
  file("pq.png", png_file({.width = 8,
                           .height = 8,
                           .bits = 16,
                           .samples = std::string(8 * 8 * 6, '\x70'),
                           .chunks = png_chunk("cICP", std::string("\x9\x10\0\1", 4))}));
  file("gain.jpg", with_segments(block_jpeg(1, 1, 3, {200, 150, 90}), gain_map_segment()));
  const std::vector<std::string> pair{"gain.jpg", "pq.png"};
  EXPECT_THAT(compare(pair).output_tail,
              AllOf(HasSubstr("a: Gain map: not applied; "), HasSubstr("b: Curve: PQ, 1 is 203"),
                    HasSubstr("b: Primaries: 0.708 0.292 ")));
  const Record made = record(pair, 1);
  EXPECT_EQ(made["pictures"]["a"]["gainMap"], "not applied");
  EXPECT_EQ(made["pictures"]["a"]["transfer"], "sRGB");
  EXPECT_EQ(made["pictures"]["b"]["transfer"], "PQ");
  EXPECT_EQ(made["pictures"]["b"]["chromaticities"][0], 0.708);
  EXPECT_THAT(pages(pair, 1), AllOf(HasSubstr("<dt>Gain map</dt>\n<dd>not applied; "),
                                    HasSubstr("<dt>Curve</dt>\n<dd>PQ, 1 is 203"),
                                    HasSubstr("<dt>Primaries</dt>\n<dd>0.708 0.292 ")));
}

TEST_F(HowPicturesAreRead, IsSaidOfLayersAndTheirNoise) {
  for (const char* name : {"a.exr", "b.exr"})
    flat(name, 1,
         {channel("spec.R", 2), channel("spec.G", 2), channel("spec.B", 2),
          channel("spec.StandardError.R", 0.1f), channel("spec.StandardError.G", 0.1f),
          channel("spec.StandardError.B", 0.1f)});
  const std::vector<std::string> pair{
      "a.exr", "b.exr", "--layer", "specular", "--noise-from-layers", "b"};
  EXPECT_THAT(compare(pair).output_tail,
              AllOf(HasSubstr("a: Layer: spec\n"), HasSubstr("b: Layer: spec\n"),
                    HasSubstr("b: Noise: layer spec.StandardError\n")));
  EXPECT_THAT(pages(pair, 6),
              AllOf(HasSubstr("<dt>Layer</dt>\n<dd>spec</dd>"),
                    HasSubstr("<dt>Noise</dt>\n<dd>layer spec.StandardError</dd>")));
}

}  // namespace
}  // namespace lobelia
