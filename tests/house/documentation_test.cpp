// The pages: what they say of the source, where every link leads, the index of docs/, the beginning of README,
// and the site that `make docs` makes of them.
#include <regex>

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"
#include "tests/test.hpp"

namespace house {
namespace {

using ::testing::IsSupersetOf;
using Problems = std::vector<std::string>;

std::set<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    found.insert((*it)[1]);
  return found;
}

/// Variables that the source reads by name or in a list of names, and those of ours that it mentions.
std::set<std::string> variables(const fs::path& root) {
  static const std::regex read_one(R"re((?:getenv|set)\("([A-Z_]+)"\))re");
  static const std::regex list(R"re((\{\s*(?:"[A-Z_]+",\s*)+"[A-Z_]+"\s*\}))re"),
      name(R"re("([A-Z_]+)")re"), ours(R"re("[^"\n]*\$(LOBELIA_[A-Z_]+))re");
  std::set<std::string> found;
  for (const fs::path& file : project_files(root)) {
    if (!is_cpp(file) || *file.begin() == "tests") continue;
    const std::string text = read(root / file);
    found.merge(matches(text, ours));
    if (text.find("getenv(") == text.npos) continue;
    found.merge(matches(text, read_one));
    for (const std::string& names : matches(text, list)) found.merge(matches(names, name));
  }
  return found;
}

TEST(Environment, ThePageNamesEveryVariableThatTheProgramReads) {
  const std::string page = read(kRoot / "docs/environment.md");
  const auto found = variables(kRoot);
  EXPECT_THAT(found, IsSupersetOf({"LOBELIA_CACHE", "OCIO", "CI", "XDG_CACHE_HOME", "TMPDIR"}));
  for (const std::string& variable : found)
    EXPECT_NE(page.find("`" + variable + "`"), page.npos) << variable;
}

TEST(Environment, ThePageNamesEveryExitCode) {
  const std::string page = read(kRoot / "docs/environment.md");
  const auto codes =
      matches(read(kRoot / "base/system/error.hpp"), std::regex(R"re(\n  k\w+ = (\d+))re"));
  EXPECT_GT(codes.size(), 10u);
  for (const std::string& code : codes) EXPECT_THAT(page, HasSubstr("| `" + code + "` |"));
}

TEST(Paper, ThePageLinksEveryErratum) {
  const std::string page = read(kRoot / "docs/paper.md");
  const auto errata =
      matches(read(kRoot / "docs/errata.md"),
              std::regex(R"re(\n\| \[[^\]]*\]\((#[^)]*)\).*\| not reproduced \|)re"));
  EXPECT_GT(errata.size(), 5u);
  for (const std::string& erratum : errata)
    EXPECT_THAT(page, HasSubstr("(errata.md" + erratum + ")"));
}

/// Without fenced code, whose # and [] mean other things.
std::string prose(const std::string& page) {
  std::string result;
  bool code = false;
  for (const std::string& line : lines(page)) {
    if (line.starts_with("```")) code = !code;
    if (!code) result += line + "\n";
  }
  return result;
}

/// To files of the project. `make docs` looks at anchors.
std::vector<std::string> links(const std::string& page) {
  static const std::regex link(R"re(\]\(([^)#\s]+)(?:#[^)\s]*)?\))re"), span("`[^`\n]*`");
  const std::string text = std::regex_replace(prose(page), span, "`");
  std::vector<std::string> result;
  for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
    const std::string file = (*it)[1];
    if (file.find("://") == file.npos && !file.starts_with("mailto:")) result.push_back(file);
  }
  return result;
}

Problems dead_links(const fs::path& root, const fs::path& page) {
  Problems problems;
  for (const std::string& file : links(read(root / page)))
    if (!fs::exists(root / page.parent_path() / file))
      problems.push_back(page.string() + ": " + file);
  return problems;
}

/// Pages of docs/ that docs/README.md does not link.
Problems pages_out_of_the_index(const fs::path& root) {
  std::set<fs::path> linked;
  for (const std::string& file : links(read(root / "docs/README.md")))
    linked.insert((fs::path("docs") / file).lexically_normal());
  Problems problems;
  for (const fs::path& file : project_files(root))
    if (file.extension() == ".md" && *file.begin() == "docs" && file != "docs/README.md" &&
        !linked.contains(file))
      problems.push_back(file.string());
  return problems;
}

TEST(Links, LeadToFilesThatExist) {
  int pages = 0;
  for (const fs::path& file : project_files(kRoot)) {
    if (file.extension() != ".md") continue;
    ++pages;
    EXPECT_THAT(dead_links(kRoot, file), IsEmpty());
  }
  EXPECT_GT(pages, 40);
}

TEST(Index, LinksEveryPage) { EXPECT_THAT(pages_out_of_the_index(kRoot), IsEmpty()); }

TEST(Readme, IsShortAndHasACommandEarly) {
  const std::string page = read(kRoot / "README.md");
  EXPECT_LE(lines(page).size(), 151u) << "150 lines, each of which ends";
  std::istringstream before(page.substr(0, page.find("```")));
  std::size_t words = 0;
  for (std::string word; before >> word;) ++words;
  EXPECT_LE(words, 120u) << "before the first command";
}

Ran make_site(const fs::path& root, const fs::path& site) {
  return run("LOBELIA_PROGRAM=" + quoted(LOBELIA_PROGRAM) + " " + quoted(root / "tools/docs") +
             " " + quoted(site));
}

class Site : public testing::Test {
 protected:
  void SetUp() override {
    if (run("/usr/bin/python3 -c 'import sphinx, myst_parser, furo' && "
            "test -e /usr/share/fonts/truetype/dejavu/DejaVuMathTeXGyre.ttf")
            .exit_code != 0)
      GTEST_SKIP() << "the packages of the purpose 'docs' are not installed";
  }
  Scratch scratch_;
};

TEST_F(Site, IsMadeWithoutAWarningAndFindsWords) {
  const Ran made = make_site(kRoot, scratch_ / "site");
  ASSERT_EQ(made.exit_code, 0) << made.output;
  EXPECT_EQ(made.output, (scratch_ / "site/index.html").string() + "\n");
  EXPECT_THAT(read(scratch_ / "site/index.html"), HasSubstr("docs/models.html"));
  EXPECT_THAT(read(scratch_ / "site/docs/models.html"), HasSubstr("<math "));
  EXPECT_THAT(read(scratch_ / "site/docs/reference/README.html"), HasSubstr("comparison-set.html"));
  EXPECT_TRUE(fs::exists(scratch_ / "site/docs/reference/render.html"));
  const std::string index = read(scratch_ / "site/searchindex.js");
  for (const char* word : {"\"energi\"", "\"docs/glossary\""})
    EXPECT_NE(index.find(word), index.npos) << word;
}

TEST_F(Site, TakesNoOtherFoldersPlace) {
  write(scratch_ / "mine/letter.txt", "Dear");
  EXPECT_EQ(make_site(kRoot, scratch_ / "mine").exit_code, 4);
  EXPECT_EQ(read(scratch_ / "mine/letter.txt"), "Dear");
}

TEST_F(Site, IsRefusedWithADeadLinkOrAForeignFile) {
  for (const char* part : {"tools/docs", "tools/site"}) {
    fs::create_directories((scratch_ / part).parent_path());
    fs::copy(kRoot / part, scratch_ / part, fs::copy_options::recursive);
  }
  write(scratch_ / "README.md", "# A\n");
  write(scratch_ / "docs/README.md",
        "# B\n## Tutorials: learn\n[C](c.md)\n## Reference: look it up\n[F](records.md)\n"
        "### D\n[E](e.md)\n");
  write(scratch_ / "docs/e.md", "# E\n");
  write(scratch_ / "docs/records.md", "# F\n");
  const auto refused = [&](const std::string& page) {
    write(scratch_ / "docs/c.md", "# C\n\n" + page + "\n");
    const Ran made = make_site(scratch_.path(), scratch_ / "site");
    return made.exit_code == 0 ? "made" : made.output;
  };
  EXPECT_EQ(refused("[E](e.md#e) [F](../tools/docs)"), "made");
  EXPECT_THAT(refused("[F](f.md)"), HasSubstr("f.md"));
  EXPECT_THAT(refused("[E](e.md#f)"), HasSubstr("e.md#f"));
  EXPECT_THAT(refused("<a href=\"x.html\">X</a>"), HasSubstr("x.html leads nowhere"));
  EXPECT_THAT(refused("![G](https://example.org/g.png)"),
              HasSubstr("loads https://example.org/g.png"));
  EXPECT_THAT(refused("<p style=\"background: url(//example.org/g.png)\">"),
              HasSubstr("loads //example.org/g.png"));
}

}  // namespace
}  // namespace house
