// What the pages of docs/ say of the source, and the site that `make docs` makes of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"

namespace house {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

std::set<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    found.insert((*it)[1]);
  return found;
}

/// That the source reads by name, or in a list of names; and those of ours that it mentions.
std::set<std::string> variables(const fs::path& root) {
  static const std::regex read_one(R"re((?:getenv|set)\("([A-Z_]+)"\))re");
  static const std::regex list(R"re((\{\s*(?:"[A-Z_]+",\s*)+"[A-Z_]+"\s*\}))re"),
      name(R"re("([A-Z_]+)")re"), ours(R"re("[^"\n]*\$(LOBELIA_[A-Z_]+))re");
  std::set<std::string> found;
  for (const fs::path& file : project_files(root)) {
    if (!is_cpp(file) || *file.begin() == "tests" || *file.begin() == "bench") continue;
    const std::string text = read(root / file);
    found.merge(matches(text, ours));
    if (text.find("getenv(") == text.npos) continue;
    found.merge(matches(text, read_one));
    for (const std::string& names : matches(text, list)) found.merge(matches(names, name));
  }
  return found;
}

TEST(Environment, page_names_every_variable_that_the_program_reads) {
  const std::string page = read(kRoot / "docs/environment.md");
  const auto found = variables(kRoot);
  EXPECT_THAT(found, IsSupersetOf({"LOBELIA_CACHE", "OCIO", "CI", "XDG_CACHE_HOME", "TMPDIR"}));
  for (const std::string& variable : found)
    EXPECT_NE(page.find("`" + variable + "`"), page.npos) << variable;
}

TEST(Environment, page_names_every_exit_code) {
  const std::string page = read(kRoot / "docs/environment.md");
  const auto codes = matches(read(kRoot / "core/error.hpp"), std::regex(R"re(\n  k\w+ = (\d+))re"));
  EXPECT_GT(codes.size(), 10u);
  for (const std::string& code : codes) EXPECT_THAT(page, HasSubstr("| `" + code + "` |"));
}

TEST(Paper, page_links_every_erratum) {
  const std::string page = read(kRoot / "docs/paper.md");
  const auto errata =
      matches(read(kRoot / "docs/errata.md"),
              std::regex(R"re(\n\| \[[^\]]*\]\((#[^)]*)\).*\| not reproduced \|)re"));
  EXPECT_GT(errata.size(), 5u);
  for (const std::string& erratum : errata)
    EXPECT_THAT(page, HasSubstr("(errata.md" + erratum + ")"));
}

Ran make_site(const fs::path& root, const fs::path& site) {
  return run(quoted(root / "scripts/docs") + " " + quoted(site));
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

TEST_F(Site, is_made_without_a_warning_and_finds_words) {
  const Ran made = make_site(kRoot, scratch_ / "site");
  ASSERT_EQ(made.exit_code, 0) << made.output;
  EXPECT_EQ(made.output, (scratch_ / "site/index.html").string() + "\n");
  EXPECT_THAT(read(scratch_ / "site/index.html"), HasSubstr("docs/models.html"));
  EXPECT_THAT(read(scratch_ / "site/docs/models.html"), HasSubstr("<math "));
  const std::string index = read(scratch_ / "site/searchindex.js");
  for (const char* word : {"\"energi\"", "\"docs/glossary\""})
    EXPECT_NE(index.find(word), index.npos) << word;
}

TEST_F(Site, takes_no_other_folder_s_place) {
  write(scratch_ / "mine/letter.txt", "Dear");
  EXPECT_EQ(make_site(kRoot, scratch_ / "mine").exit_code, 4);
  EXPECT_EQ(read(scratch_ / "mine/letter.txt"), "Dear");
}

TEST_F(Site, with_a_dead_link_or_something_from_elsewhere_is_refused) {
  for (const char* part : {"scripts/docs", "scripts/site"}) {
    fs::create_directories((scratch_ / part).parent_path());
    fs::copy(kRoot / part, scratch_ / part, fs::copy_options::recursive);
  }
  write(scratch_ / "README.md", "# A\n");
  write(scratch_ / "docs/README.md", "# B\n## Tutorials: learn\n[C](c.md)\n### D\n[E](e.md)\n");
  write(scratch_ / "docs/e.md", "# E\n");
  const auto refused = [&](const std::string& page) {
    write(scratch_ / "docs/c.md", "# C\n\n" + page + "\n");
    const Ran made = make_site(scratch_.path(), scratch_ / "site");
    return made.exit_code == 0 ? "made" : made.output;
  };
  EXPECT_EQ(refused("[E](e.md#e) [F](../scripts/docs)"), "made");
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
