// The pages in a real browser, opened as a double-click opens them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

#include "core/process.hpp"
#include "gallery/gallery.hpp"
#include "tests/gallery/fake_farm.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class GalleryInBrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    browser_ = find_program("chromium");
    if (!browser_.empty()) return;
    const char* required = std::getenv("LOBELIA_REQUIRE_ENGINES");
    if (required && std::string_view(required) == "1") FAIL() << "no program 'chromium'";
    GTEST_SKIP() << "no program 'chromium': sudo apt-get install chromium";
  }

  /// What the browser wrote: its messages, and for --dump-dom the page as scripts have left it.
  std::string open(const fs::path& page, const std::string& action) {
    ProcessOptions options;
    options.log = scratch_.path() / "browser.log";
    options.timeout = std::chrono::seconds(60);
    for (const char* name : {"HOME=", "XDG_CONFIG_HOME=", "XDG_CACHE_HOME="})
      options.environment.push_back(name + scratch_.path().string());
    const ProcessResult result = run_process(
        {browser_.string(), "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
         "--disable-background-networking", "--disable-dev-shm-usage", "--enable-logging=stderr",
         "--virtual-time-budget=3000", "--window-size=1200,900",
         "--user-data-dir=" + (scratch_.path() / "profile").string(), action,
         "file://" + page.string()},
        options);
    EXPECT_EQ(result.exit_code, 0) << result.output_tail;
    return read_file(options.log, std::uint64_t{1} << 24);
  }

  fs::path browser_;
  TemporaryDirectory scratch_;
};

TEST_F(GalleryInBrowser, index_and_cell_page_open_without_a_complaint) {
  const FakeFarm farm;
  const fs::path index = write_gallery(farm.directory());
  const std::string dom = open(index, "--dump-dom");
  EXPECT_THAT(dom, HasSubstr("A small farm"));
  EXPECT_THAT(dom, HasSubstr("showing 4 of 4")) << "the filter's script did not run";
  EXPECT_THAT(dom, Not(HasSubstr("CONSOLE")));

  const fs::path cell = farm.cell_directory(FakeFarm::kPass) / "index.html";
  const std::string cell_dom = open(cell, "--dump-dom");
  EXPECT_THAT(cell_dom, HasSubstr("The highlight as a curve"));
  EXPECT_THAT(cell_dom, HasSubstr(">Copy</button>"));
  EXPECT_THAT(cell_dom, Not(HasSubstr("CONSOLE")));
}

TEST_F(GalleryInBrowser, a_screenshot_can_be_taken) {
  const FakeFarm farm;
  const fs::path picture = scratch_.path() / "index.png";
  open(write_gallery(farm.directory()), "--screenshot=" + picture.string());
  EXPECT_GT(fs::file_size(picture), 20'000u) << "an empty page compresses to less";
}

TEST_F(GalleryInBrowser, a_complaint_would_be_seen) {
  const FakeFarm farm;
  const fs::path index = write_gallery(farm.directory());
  write_file(farm.directory() / "gallery.js", std::string_view("throw new Error('on purpose');"));
  EXPECT_THAT(open(index, "--dump-dom"), HasSubstr("CONSOLE"));
}

}  // namespace
}  // namespace lobelia::gallery
