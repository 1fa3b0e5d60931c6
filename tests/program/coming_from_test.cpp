// The commands in docs/coming_from.md.
#include <regex>

#include "base/words/text.hpp"
#include "tests/program/compare_pictures_fixture.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

TEST_F(ComparePictures, EveryCommandForUsersOfOtherToolsRunsAndJudges) {
  const auto rgb = [](float value) {
    std::vector<float> grey(32 * 32, value);
    grey[40] = 1;
    return std::vector<ExrChannel>{{"R", grey}, {"G", grey}, {"B", grey}};
  };
  std::string samples(32 * 32 * 3, '\x60');
  for (const char* side : {"A", "B"}) {
    std::filesystem::create_directory(path(side));
    const bool is_a = side[0] == 'A';
    exr(is_a ? "a.exr" : "b.exr", 32, 32, rgb(is_a ? 0.21f : 0.2f));
    samples[300] = is_a ? '\xff' : '\x10';
    const std::string png = png_file({.width = 32, .height = 32, .samples = samples});
    for (const std::string& name :
         {std::string(is_a ? "a.png" : "b.png"), std::string(side) + "/x.png"})
      file(name, png);
    if (is_a)
      file("mask.png",
           png_file({.width = 32,
                     .height = 32,
                     .samples = std::string(100, '\x7f') + std::string(32 * 32 * 3 - 100, '\0')}));
  }
  const std::string page =
      read_file(std::string(LOBELIA_SOURCE_DIR) + "/docs/coming_from.md", 1 << 20);
  const std::regex code("`lobelia compare ([^`]*)`");
  int commands = 0, passed = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), code), end; at != end; ++at, ++commands) {
    const ProcessResult result = compare(split((*at)[1].str(), " "));
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 1) << (*at)[1] << "\n"
                                                                << result.output_tail;
    passed += result.exit_code == 0;
  }
  EXPECT_GE(commands, 30);
  EXPECT_GT(passed, 3);
  EXPECT_LT(passed, commands);
}

}  // namespace
}  // namespace lobelia
