// lobelia compare with folders, second references and its reports, as a user runs it.
#include <regex>

#include "base/pictures/image_io.hpp"
#include "tests/program/compare_pictures_fixture.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

class CompareFolders : public ComparePictures {
 protected:
  void SetUp() override {
    fs::create_directories(path("a/deep"));
    fs::create_directories(path("b/deep"));
  }
  void put(const std::string& name, float value, int width = 20) {
    Image image(width, 20);
    for (int x = 0; x < width; ++x) image.pixel(x, 3)[1] = value * float(x);
    write_exr(path(name), image, {});
  }
  /// All names, links not followed, and each file's bytes.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> result;
    for (const auto& entry : fs::recursive_directory_iterator(directory_.path()))
      result[entry.path().string()] =
          entry.is_regular_file() ? read_file(entry.path(), 1 << 20) : "";
    return result;
  }
  /// The comparison would write over what it reads. It says so and changes nothing.
  void expect_refused(const std::vector<std::string>& arguments,
                      const char* why = "is read or written by this command already") {
    SCOPED_TRACE(::testing::PrintToString(arguments));
    const auto before = contents();
    const auto result = compare(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.output_tail;
    EXPECT_THAT(result.output_tail, HasSubstr(why));
    EXPECT_EQ(contents(), before);
  }
};

TEST_F(CompareFolders, GoOnPastAnIncomparablePair) {
  put("a/small.exr", 0.1f, 10), put("b/small.exr", 0.1f, 20);
  write_file(path("a/text.png"), "text"), write_file(path("b/text.png"), "text");
  put("a/off.exr", 0.1f), put("b/off.exr", 0.2f), put("a/same.exr", 0.1f), put("b/same.exr", 0.1f);
  const auto result =
      compare({"a", "b", "--fail", "rmse=1e-4", "--json", "set.json", "--csv", "set.csv", "--junit",
               "set.xml", "--diff-image", "maps", "--diff-of", "abs"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.output_tail, HasSubstr("error       small.exr: the sizes differ"));
  EXPECT_THAT(result.output_tail, HasSubstr("error       text.png"));
  EXPECT_THAT(result.output_tail, HasSubstr("differs     off.exr: rmse is "));
  const auto record = json("set.json");
  EXPECT_EQ(record["kind"], "comparison-set");
  EXPECT_EQ(record["summary"]["pairs"], 4);
  EXPECT_EQ(record["summary"]["pass"], 1);
  EXPECT_EQ(record["summary"]["errors"], 2);
  EXPECT_THAT(text("set.csv"), HasSubstr("\r\noff.exr,differs,"));
  EXPECT_THAT(text("set.xml"), HasSubstr("tests=\"4\" failures=\"1\" errors=\"2\""));
  EXPECT_TRUE(fs::exists(path("maps/off.exr.png")));
  EXPECT_FALSE(fs::exists(path("maps/text.png.png")));
}

TEST_F(CompareFolders, WritesTheSameReportWithAnyNumberOfThreads) {
  for (int i = 0; i < 12; ++i) {
    put("a/" + std::to_string(i) + ".exr", 0.1f * float(i + 1));
    put("b/" + std::to_string(i) + ".exr", 0.11f * float(i + 1));
  }
  EXPECT_EQ(
      compare({"a", "b", "--threads", "1", "--csv", "one.csv", "--json", "one.json"}).exit_code, 1);
  EXPECT_EQ(
      compare({"a", "b", "--threads", "5", "--csv", "five.csv", "--json", "five.json"}).exit_code,
      1);
  EXPECT_EQ(text("one.csv"), text("five.csv"));
  EXPECT_EQ(text("one.json"), text("five.json"));
}

TEST_F(CompareFolders, WriteNoReportOverAnotherSite) {
  put("a/x.exr", 0.1f), put("b/x.exr", 0.1f);
  fs::create_directory(path("site"));
  write_file(path("site/index.html"), "mine");
  const auto refused = compare({"a", "b", "--html", "site"});
  EXPECT_EQ(refused.exit_code, 4) << refused.output_tail;
  EXPECT_EQ(read_file(path("site/index.html"), 100), "mine");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(compare({"a", "b", "--html", "report"}).exit_code, 0);
}

TEST_F(CompareFolders, ReportAnUnreadablePairToCi) {
  put("b/x.exr", 0.1f);
  const auto result = compare(
      {"a/gone.exr", "b/x.exr", "--junit", "j.xml", "--json", "r.json", "--format", "github"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.output_tail, HasSubstr("::error title=gone.exr%3A error::a/gone.exr: not a"));
  EXPECT_THAT(text("j.xml"), HasSubstr("<error type=\"error\""));
  EXPECT_FALSE(fs::exists(path("r.json")));
}

TEST_F(CompareFolders, HaveOneRangeOfExposuresForTheWholeSet) {
  for (const auto& [name, value] : {std::pair{"dark.exr", 0.01f}, {"bright.exr", 9.0f}}) {
    Image image(16, 16);
    float level = value;
    for (float& v : image.values()) v = level, level += value / 200;
    for (const char* folder : {"a/", "b/"}) write_exr(path(folder + std::string(name)), image, {});
  }
  ASSERT_EQ(compare({"a", "b", "--exposures", "auto", "--json", "set.json"}).exit_code, 0);
  const auto pairs = json("set.json")["pairs"];
  const auto range = [&](std::size_t i) {
    return pairs[i]["comparison"]["viewing"]["hdrExposures"];
  };
  EXPECT_EQ(range(0), range(1));
  ASSERT_EQ(
      compare({"a/dark.exr", "b/dark.exr", "--exposures", "auto", "--json", "one.json"}).exit_code,
      0);
  EXPECT_LT(json("one.json")["viewing"]["hdrExposures"]["count"], range(0)["count"]);
}

TEST_F(CompareFolders, ShowHowFarTwoReferencesAreFromEachOther) {
  put("a/x.exr", 0.10f), put("b/x.exr", 0.11f), put("c.exr", 0.13f);
  const auto result = compare({"a/x.exr", "b/x.exr", "--reference-floor", "c.exr", "--metrics",
                               "rmse", "--json", "one.json"});
  EXPECT_EQ(result.exit_code, 1) << "the second reference has no part in the verdict";
  EXPECT_THAT(result.output_tail, HasSubstr("C and B"));
  const auto record = json("one.json");
  EXPECT_EQ(record["referenceFloor"]["c"], "c.exr");
  EXPECT_NEAR(record["referenceFloor"]["metrics"]["rmse"].get<double>(),
              2 * record["metrics"]["rmse"].get<double>(), 1e-6);
  EXPECT_EQ(compare({"a/x.exr", "b/x.exr", "--reference-floor", "none.exr"}).exit_code, 3);
}

TEST_F(CompareFolders, WarnWithoutFailing) {
  put("a/x.exr", 0.10f), put("b/x.exr", 0.11f);
  const auto result = compare({"a/x.exr", "b/x.exr", "--fail", "rmse=9", "--no-default-limits",
                               "--warn", "mae=1e-9", "--warn", "ssim=0.1", "--json", "one.json"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output_tail, HasSubstr("warning: mae"));
  EXPECT_EQ(json("one.json")["warnings"].size(), 2u);
  EXPECT_EQ(json("one.json")["warnings"][0]["pass"], false);
  EXPECT_EQ(json("one.json")["warnings"][1]["pass"], true);
  EXPECT_EQ(compare({"a/x.exr", "b/x.exr", "--warn", "rsme=1"}).exit_code, 2);
}

TEST_F(CompareFolders, WriteADifferenceAsColoursOrAsValues) {
  put("a/x.exr", 0.10f), put("b/x.exr", 0.11f);
  const auto write = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"a/x.exr", "b/x.exr", "--fail", "rmse=9",
                                         "--no-default-limits", "--diff-image"});
    return compare(arguments).exit_code;
  };
  ASSERT_EQ(write({"d.png", "--diff-of", "abs", "--diff-colours", "viridis"}), 0);
  EXPECT_THAT(text("d.png"), HasSubstr("lobelia:colourMap"));
  EXPECT_THAT(text("d.png"), HasSubstr("viridis"));
  ASSERT_EQ(write({"d.exr", "--diff-of", "signed"}), 0);
  EXPECT_NEAR(read_image(path("d.exr")).pixel(10, 3)[0], -0.1f / 3, 1e-6);
  ASSERT_EQ(write({"channels.png"}), 0);
  EXPECT_THAT(text("channels.png"), HasSubstr("lobelia:scaleTo"));
  EXPECT_EQ(write({"d.jpg", "--diff-of", "abs"}), 2);
  EXPECT_EQ(write({"d.png", "--diff-of", "hue"}), 2);
  EXPECT_EQ(write({"d.png", "--diff-of", "abs", "--diff-colours", "magna"}), 2);
  EXPECT_EQ(write({"d.png", "--diff-colours", "magma"}), 2);
  EXPECT_EQ(write({"no/such/d.png"}), 4);
}

TEST_F(CompareFolders, WriteNoDifferencePictureIntoAFolderThatIsRead) {
  for (const char* folder : {"a/", "b/", "c/", "error/", "half/", "a/deep/", "out/"}) {
    fs::create_directories(path(folder));
    put(folder + std::string("x.exr"), 0.1f);
    // The name that the picture of x.exr would get.
    write_file(path(folder + std::string("x.exr.png")), read_file(path("a/x.exr"), 1 << 20));
  }
  put("b/deep/x.exr", 0.1f);
  fs::create_directory_symlink("b", path("other_b"));
  const auto refused = [&](std::vector<std::string> more, const char* why) {
    more.insert(more.begin(), {"a", "b", "--reference-floor", "c"});
    expect_refused(more, why);
  };
  const char* inside = "which is read by this command; choose a folder outside it";
  for (const char* folder :
       {"a", "b", "c", "./b/../a", "a/deep", "a/new", "other_b", "other_b/new"})
    refused({"--diff-image", folder}, inside);
  refused({"--diff-image", "error", "--a-error", "error"}, inside);
  refused({"--diff-image", "half/new", "--b-replicate", "half"}, inside);
  const char* taken = "is read or written by this command already";
  for (const char* file : {"a/x.exr", "b/x.exr", "c/x.exr", "a/x.exr.png"}) {
    refused({"--json", file}, "is there and is no JSON");
    refused({"--junit", file}, taken);
  }
  refused({"--csv", "half/x.exr", "--a-replicate", "half"}, taken);
  refused({"--junit", "out/x.exr.png", "--diff-image", "out"}, taken);
}

TEST_F(CompareFolders, WriteNoDifferenceOverALinkedPicture) {
  put("a/x.exr", 0.1f), put("b/x.exr", 0.2f), put("a/deep/x.exr", 0.1f), put("b/deep/x.exr", 0.2f);
  put("error.exr", 0.1f);
  fs::create_directories(path("soft")), fs::create_directories(path("hard"));
  fs::create_symlink(path("a/x.exr"), path("soft/x.exr.png"));
  fs::create_hard_link(path("b/x.exr"), path("hard/x.exr.png"));
  expect_refused({"a", "b", "--diff-image", "soft"});
  expect_refused({"a", "b", "--diff-image", "hard"});
  fs::create_directories(path("two"));
  fs::create_directory_symlink(".", path("two/deep"));  // x and deep/x would be one file
  expect_refused({"a", "b", "--diff-image", "two"});
  fs::create_hard_link(path("a/x.exr"), path("a.json"));
  expect_refused({"a", "b", "--diff-image", "out", "--json", "a.json"});

  // The same holds for two files.
  fs::create_hard_link(path("error.exr"), path("map.png"));
  expect_refused({"a/x.exr", "b/x.exr", "--a-error", "error.exr", "--diff-image", "map.png"});
  EXPECT_EQ(compare({"a", "b", "--diff-image", "good"}).exit_code, 1);
  EXPECT_TRUE(fs::exists(path("good/deep/x.exr.png")));
}

TEST_F(CompareFolders, ThePageCountsAsTheSummaryDoes) {
  for (const char* name : {"fine.exr", "off.exr", "nan.exr", "new.exr"})
    put(std::string("a/") + name, 0.1f);
  for (const char* name : {"fine.exr", "off.exr", "nan.exr", "gone.exr"})
    put(std::string("b/") + name, 0.1f);
  put("a/off.exr", 0.5f), put("a/nan.exr", std::nanf(""));
  const std::string text = compare({"a", "b", "--html", "report"}).output_tail;
  const std::string page = read_file(path("report/index.html"), 1 << 22);
  const std::size_t from = page.find("<ul class=\"counts\">"), to = page.find("</ul>", from);
  ASSERT_NE(to, page.npos);
  std::string counts = std::regex_replace(page.substr(from, to - from), std::regex("<[^>]*>"), "");
  std::string printed = "3 pairs 1 pass 1 differ 1 not finite 0 errors 1 missing 1 extra";
  std::erase(counts, '\n'), std::erase(counts, ' '), std::erase(printed, ' ');
  EXPECT_EQ(counts, printed);
  EXPECT_THAT(text,
              HasSubstr("3 pairs: 1 pass, 1 differ, 1 not finite, 0 errors; 1 missing, 1 extra"));
  for (const char* word : {"non-finite", "differs", "missing", "extra", "pass"})
    EXPECT_THAT(page, HasSubstr(std::string(" ") + word + "</span>"));
  EXPECT_THAT(page, Not(HasSubstr("</span> no picture")));
  EXPECT_THAT(page, Not(HasSubstr("differs from a by")));
}

TEST_F(CompareFolders, PrintOneReportToStdoutInPlaceOfTheTable) {
  put("a/x.exr", 0.1f), put("b/x.exr", 0.1f);
  const auto printed = [&](const char* option) {
    const auto result = compare({"a", "b", option, "-"});
    EXPECT_EQ(result.exit_code, 0) << result.output_tail;
    EXPECT_FALSE(fs::exists(path("-")));
    return result.output_tail;
  };
  EXPECT_THAT(printed("--csv"), ::testing::StartsWith("name,verdict,why,"));
  EXPECT_THAT(printed("--csv"), Not(HasSubstr("1 pairs")));
  EXPECT_THAT(printed("--junit"), ::testing::StartsWith("<?xml"));
  EXPECT_THAT(printed("--junit"), ::testing::EndsWith("</testsuites>\n"));
  EXPECT_THAT(printed("--json"), ::testing::EndsWith("\n}\n"));
  EXPECT_THAT(printed("--json"), Not(HasSubstr("1 pairs")));
  for (const auto& [one, other] :
       {std::pair{"--csv", "--junit"}, {"--csv", "--json"}, {"--junit", "--json"}}) {
    const auto two = compare({"a", "b", one, "-", other, "-"});
    EXPECT_EQ(two.exit_code, 2);
    EXPECT_THAT(two.output_tail, HasSubstr("only one of"));
  }
}

TEST_F(CompareFolders, NameTheFilesWhoseSizesDiffer) {
  put("a/x.exr", 0.1f, 10), put("b/x.exr", 0.1f, 20), put("c.exr", 0.1f, 30);
  const auto says = [&](std::vector<std::string> arguments, const char* what) {
    const auto result = compare(arguments);
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.output_tail, HasSubstr(what));
  };
  says({"a/x.exr", "b/x.exr"}, "10 x 20 against 20 x 20 (a/x.exr against b/x.exr)");
  says({"a", "b"}, "10 x 20 against 20 x 20 (a/x.exr against b/x.exr)");
  says({"b/x.exr", "b/x.exr", "--reference-floor", "c.exr"}, "(c.exr against b/x.exr)");
  says({"b/x.exr", "b/x.exr", "--a-replicate", "c.exr"}, "(the picture against c.exr)");
  says({"b/x.exr", "b/x.exr", "--b-error", "c.exr"}, "(the picture against c.exr)");
  says({"a/x.exr", "a/x.exr", "--scene", kScenes + "head_on.xml"}, "a/x.exr has 10 x 20 pixels");
}

}  // namespace
}  // namespace lobelia
