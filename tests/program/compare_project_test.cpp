// `lobelia compare` with a project, several references and known differences; Markdown, GitHub's lines, colours.
#include <fmt/chrono.h>

#include <ctime>

#include "tests/program/compare_pictures_fixture.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

class CompareProject : public ComparePictures {
 protected:
  void project(const std::string& content, const std::string& name = "lobelia.toml") {
    file(name, content);
  }
  void expect_refused(const std::string& content, const std::string& why) {
    SCOPED_TRACE(content);
    project(content);
    const ProcessResult result = compare({});
    expect_one_line(result, 3, why);
    EXPECT_THAT(result.output_tail, HasSubstr("lobelia.toml: "));
  }
};

constexpr char kTwoFolders[] = "judged = [\"mine\"]\nreferences = [\"truth\"]\n";

TEST_F(CompareProject, NeedsNoOptionInItsDirectory) {
  flat("mine/x.exr", 0.5f), flat("truth/x.exr", 0.5f);
  EXPECT_EQ(compare({}).exit_code, 2);
  project(kTwoFolders);
  EXPECT_EQ(compare({}).exit_code, 0);
  flat("mine/x.exr", 0.6f);
  EXPECT_EQ(compare({}).exit_code, 1);
}

TEST_F(CompareProject, HasPathsFromItsOwnDirectoryAndMayBeJson) {
  flat("tests/mine/x.exr", 0.5f), flat("tests/truth/x.exr", 0.5f);
  project(kTwoFolders, "tests/p.toml");
  project(R"({"judged": ["mine"], "references": ["truth"]})", "tests/p.json");
  for (const char* file : {"tests/p.toml", "tests/p.json"})
    EXPECT_EQ(compare({"--project", file}).exit_code, 0) << file;
}

TEST_F(CompareProject, GivesWayToTheCommandLine) {
  flat("mine/x.exr", 0.5f), flat("truth/x.exr", 0.55f), flat("other/x.exr", 0.55f);
  project(std::string(kTwoFolders) + "fail = [\"max_abs=0.01\"]\ndefaultLimits = false\n");
  EXPECT_EQ(compare({}).exit_code, 1);
  EXPECT_EQ(compare({"--project", "lobelia.toml", "--fail", "max_abs=0.1"}).exit_code, 0);
  EXPECT_EQ(compare({"other", "--project", "lobelia.toml"}).exit_code, 0);
  EXPECT_EQ(compare({"mine", "mine", "--project", "lobelia.toml"}).exit_code, 0);
}

TEST_F(CompareProject, AppliesTheLastMatchingRule) {
  for (const char* name : {"glossy/a.exr", "glossy/b.exr", "matt.exr"})
    flat(std::string("mine/") + name, 0.55f), flat(std::string("truth/") + name, 0.5f);
  project(std::string(kTwoFolders) + "fail = [\"max_abs=0.01\"]\ndefaultLimits = false\n" +
          "[[rules]]\nmatch = \"glossy/*\"\nfail = [\"max_abs=0.1\"]\n" +
          "[[rules]]\nmatch = \"*/b.exr\"\nfail = [\"max_abs=0.02\"]\n");
  const std::string output = compare({}).output_tail;
  EXPECT_THAT(output, HasSubstr("3 pairs: 1 pass, 2 differ"));
  EXPECT_THAT(output, HasSubstr("matt.exr: max_abs is 0.05, limit 0.01"));
  EXPECT_THAT(output, HasSubstr("glossy/b.exr: max_abs is 0.05, limit 0.02"));
}

TEST_F(CompareProject, HasMasksAndIgnoredPartsByName) {
  for (const char* name : {"x.exr", "y.exr"})
    flat(std::string("mine/") + name, 0.6f), flat(std::string("truth/") + name, 0.5f);
  project(std::string(kTwoFolders) + "defaultLimits = false\nfail = [\"max_abs=0.01\"]\n" +
          "[[rules]]\nmatch = \"x.*\"\nignore = [\"rect:0,0,32,31\", \"rect:0,31,31,1\"]\n" +
          "fail = [\"share_over.abs=0.05=1%\"]\ndefaultLimits = false\n");
  const std::string output = compare({}).output_tail;
  EXPECT_THAT(output, HasSubstr("x.exr: max_abs is 0.1, limit 0.01"));  // of the pixel that is left
  EXPECT_THAT(output, Not(HasSubstr("x.exr: max_abs is 0.1, limit 0.01; share")));
  project(std::string(kTwoFolders) + "[[rules]]\nmatch = \"x.exr\"\nmask = [\"gone.png\"]\n");
  const auto without_mask = compare({});
  EXPECT_EQ(without_mask.exit_code, 3);
  EXPECT_THAT(without_mask.output_tail, HasSubstr("gone.png"));
}

TEST_F(CompareProject, MayAcceptSeveralReferencesOfWhichTheBestCounts) {
  flat("mine/x.exr", 0.5f), flat("truth/x.exr", 0.6f), flat("mac/x.exr", 0.5f);
  flat("mine/y.exr", 0.5f), flat("mac/y.exr", 0.7f), flat("truth/y.exr", 0.9f);
  project("judged = [\"mine\"]\nreferences = [\"truth\", \"mac\"]\n");
  const auto result = compare({"--project", "lobelia.toml", "--json", "set.json"});
  EXPECT_EQ(result.exit_code, 1);
  const Record set = json("set.json");
  EXPECT_EQ(set["summary"]["pass"], 1);
  for (const Record& pair : set["pairs"]) {
    EXPECT_EQ(pair["references"], 2);
    EXPECT_THAT(pair["comparison"]["b"].get<std::string>(), HasSubstr("mac/")) << pair["name"];
  }
  const auto pair = compare({"mine/x.exr", "truth/x.exr", "--also-accept", "mac/x.exr"});
  EXPECT_EQ(pair.exit_code, 0) << pair.output_tail;
  EXPECT_THAT(pair.output_tail, HasSubstr("of 2 acceptable references"));
}

TEST_F(CompareProject, ExcusesAKnownDifferenceUntilItExpires) {
  flat("mine/x.exr", 0.5f), flat("truth/x.exr", 0.6f);
  const auto known = [](const std::string& day) {
    return std::string(kTwoFolders) +
           "[[known]]\nmatch = \"x.*\"\nreason = \"the <b>new</b> lamp\"\nexpires = " + day + "\n";
  };
  project(known("9999-12-31"));
  auto result = compare({"--project", "lobelia.toml", "--junit", "j.xml", "--csv", "c.csv"});
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr("known       x.exr: "));
  EXPECT_THAT(result.output_tail, HasSubstr("1 known to differ"));
  const std::string junit = text("j.xml");
  EXPECT_THAT(junit, HasSubstr("<skipped"));
  EXPECT_THAT(junit, HasSubstr("failures=\"0\""));
  EXPECT_THAT(junit, HasSubstr("&lt;b"));
  EXPECT_THAT(text("c.csv"), HasSubstr("known until 9999-12-31"));
  const auto today = [] { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))); };
  for (std::string day; day != today();) {  // again where a day ended meanwhile
    day = today();
    project(known(day));
    result = compare({});
  }
  EXPECT_EQ(result.exit_code, 0) << "on its last day: " << result.output_tail;
  project(known("\"2001-01-01\""));
  result = compare({});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output_tail, HasSubstr("known, but expired on 2001-01-01"));
  flat("mine/x.exr", 0.6f);
  result = compare({});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output_tail, HasSubstr("no longer   x.exr: it passes"));
}

TEST_F(CompareProject, IsRefusedWithThePlaceOfItsMistake) {
  flat("mine/x.exr", 0.5f), flat("truth/x.exr", 0.5f);
  const std::string two = kTwoFolders;
  expect_refused("judged = [", "line 1, column ");
  expect_refused(two + "fial = [\"rmse=1\"]\n", "fial: there is no such key; did you mean 'fail'?");
  expect_refused(two + "fail = [\"rmse\"]\n", "fail rmse: expected METRIC=LIMIT");
  for (const char* before : {"", "[[rules]]\nmatch = \"*\"\n"})
    expect_refused(two + before + "fail = [\"share_over.abs=0.004=10\"]\n", "for 10 % write 0.1");
  expect_refused(two + "[[rules]]\nmatch = \"*\"\nfail = [\"nonsense=1\"]\n", "rules[0]: ");
  expect_refused(two + "[[rules]]\nfail = [\"rmse=1\"]\n", "rules[0].match: missing");
  expect_refused(two + "tolerance = \"1\"\n", "tolerance 1: expected");
  expect_refused(two + "[[known]]\nmatch = \"*\"\nreason = \"?\"\nexpires = 2027-02-30\n",
                 "line 6");
  expect_refused(two + "[[known]]\nmatch = \"*\"\nreason = \"?\"\nexpires = \"soon\"\n",
                 "expires: expected a day");
  expect_refused(two + "[[known]]\nmatch = \"*\"\nreason = \"?\"\nexpires = \"+099-02-03\"\n",
                 "expires: expected a day");
  expect_refused(two + "[[known]]\nmatch = \"*\"\nexpires = 2027-02-01\n",
                 "known[0].reason: missing");
  expect_refused(two + "judged = [\"twice\"]\n", "line 3");
  expect_refused("title = 3\n" + two, "title: ");
  expect_refused(std::string(100'000, '['), "line 1");
  std::string deep = "a";
  for (int i = 0; i < 30'000; ++i) deep += ".a";
  for (const std::string& text : {deep + " = 1", "[" + deep + "]", "x = {" + deep + " = 1}",
                                  "x = \"a.b\"\ny = 'c\"'\n" + deep + " = 1"})
    expect_refused(text, "a key has over 32 parts");
  expect_refused(two + "title = \"a\\u0000b\"\n", "a text has a NUL");
  expect_refused("a" + std::string("\xff\xfe") + "=1", "line 1");
  EXPECT_EQ(compare({"--project", "gone.toml"}).exit_code, 3);
}

TEST_F(CompareProject, IsRefusedAsJsonWithAKeyTwiceOrTooDeep) {
  for (const auto& [text, why] :
       {std::pair(std::string(R"({"judged": ["a"], "references": ["b"], "judged": ["c"]})"),
                  "the key judged stands twice"),
        {R"({"rules": [{"match": "*", "fail": [], "match": "?"}]})", "the key match stands twice"},
        {R"({"judged": ["a\u0000b"], "references": ["b"]})", "a text has a NUL"},
        {std::string(100'000, '[') + std::string(100'000, ']'), "not an object"},
        {R"({"title": )" + std::string(100'000, '[') + std::string(100'000, ']') + "}", "title"}}) {
    project(text, "p.json");
    const ProcessResult result = compare({"--project", "p.json"});
    EXPECT_EQ(result.exit_code, 3) << result.output_tail;
    EXPECT_THAT(result.output_tail, HasSubstr(why));
  }
}

TEST_F(CompareProject, EscapesItsTextsInMarkdown) {
  flat("mine/a|b,c%<i>.exr", 0.5f), flat("truth/a|b,c%<i>.exr", 0.6f);
  flat("mine/fine.exr", 0.5f), flat("truth/fine.exr", 0.5f);
  project(kTwoFolders);
  const ProcessResult markdown = compare({"--project", "lobelia.toml", "--markdown", "-"});
  EXPECT_EQ(markdown.exit_code, 1);
  EXPECT_THAT(markdown.output_tail, HasSubstr("2 pairs: 1 pass, 1 differ"));
  EXPECT_THAT(markdown.output_tail, HasSubstr("| differs | a\\|b,c%\\<i\\>.exr |"));
  EXPECT_THAT(markdown.output_tail, Not(HasSubstr("fine.exr")));
  EXPECT_EQ(compare({"--project", "lobelia.toml", "--format", "github", "--json", "-"}).exit_code,
            2);
  const ProcessResult github = compare({"--project", "lobelia.toml", "--format", "github", "-q"});
  EXPECT_EQ(github.exit_code, 1);
  EXPECT_THAT(
      github.output_tail,
      HasSubstr("\n::error file=mine/a|b%2Cc%25<i>.exr,title=a|b%2Cc%25<i>.exr%3A differs::"));
}

TEST_F(CompareProject, IsQuietVerboseAndColouredOnRequest) {
  flat("mine/x.exr", 0.5f), flat("truth/x.exr", 0.6f);
  flat("mine/fine.exr", 0.5f), flat("truth/fine.exr", 0.5f);
  project(kTwoFolders);
  const auto told = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"--project", "lobelia.toml"});
    return compare(more).output_tail;
  };
  EXPECT_EQ(std::ranges::count(told({"-q"}), '\n'), 1);
  EXPECT_EQ(compare({"mine/fine.exr", "truth/fine.exr", "-q"}).output_tail, "");
  EXPECT_THAT(told({}), Not(HasSubstr("pass        fine.exr")));
  EXPECT_THAT(told({"-v"}), HasSubstr("pass        fine.exr"));
  EXPECT_THAT(told({}), Not(HasSubstr("\x1b[")));
  EXPECT_THAT(told({"--color", "always"}), HasSubstr("\x1b[31mdiffers"));
}

TEST_F(CompareProject, RunsAsTheDocumentationShowsIt) {
  const std::string page =
      read_file(std::string(LOBELIA_SOURCE_DIR) + "/docs/comparing.md", 1 << 20);
  const std::size_t start = page.find("```toml\n") + 8;
  project(page.substr(start, page.find("```", start) - start));
  flat("masks/ball.png", 1);  // its bytes tell that it is an EXR
  for (const char* folder : {"renders/", "references/", "references-mac/"})
    flat(std::string(folder) + "cloth_n20000.exr", folder[2] == 'n' ? 0.5f : 0.6f);
  EXPECT_THAT(compare({}).output_tail, HasSubstr("half floats cannot hold this peak"));
}

}  // namespace
}  // namespace lobelia
