// The commands that README, the tutorials and the how-to pages mark as to be run do run.
#include <cctype>

#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "tests/program/page_commands.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using ::testing::IsSupersetOf;

std::vector<std::string> pages_with_commands() {
  std::vector<std::string> pages = {"README.md"};
  for (const char* folder : {"docs/tutorials", "docs/howto"})
    for (const auto& entry : fs::directory_iterator(fs::path(LOBELIA_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".md")
        pages.push_back(std::string(folder) + "/" + entry.path().filename().string());
  std::erase_if(pages, [](const std::string& page) { return page_commands(page).empty(); });
  std::ranges::sort(pages);
  return pages;
}

bool missing(const std::string& engine) {
  if (!find_program(engine).empty()) return false;
  if (std::getenv("LOBELIA_REQUIRE_ENGINES")) ADD_FAILURE() << "no " << engine;
  return true;
}

TEST(PageCommands, AreOnThesePages) {
  EXPECT_THAT(pages_with_commands(),
              IsSupersetOf({"README.md", "docs/tutorials/first_picture.md",
                            "docs/tutorials/first_gallery.md", "docs/tutorials/first_gate.md"}));
}

class PageCommandsOf : public testing::TestWithParam<std::string> {};

TEST_P(PageCommandsOf, ThisPageRun) {
  const std::string commands = page_commands(GetParam());
  if (commands.find("povray") != commands.npos && missing("povray")) GTEST_SKIP() << "no povray";
  const TemporaryDirectory directory;
  const ProcessResult result = run_commands(commands, directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
}

INSTANTIATE_TEST_SUITE_P(Pages, PageCommandsOf, testing::ValuesIn(pages_with_commands()),
                         [](const auto& page) {
                           std::string name = page.param;
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

}  // namespace
}  // namespace lobelia
