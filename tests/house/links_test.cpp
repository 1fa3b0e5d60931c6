// The pages lead somewhere: every link and anchor, the index of docs/, and the beginning of README.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <regex>
#include <set>
#include <sstream>

#include "tests/house/tree.hpp"

namespace house {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Problems = std::vector<std::string>;

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

/// The anchor that GitHub gives a heading.
std::string anchor(const std::string& heading) {
  static const std::regex link(R"re(\[([^\]]*)\]\([^)]*\))re");
  std::string result;
  for (const char c : std::regex_replace(heading, link, "$1")) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (c == ' ')
      result += '-';
    else if (byte >= 0x80 || std::isalnum(byte) || c == '-' || c == '_')
      result += static_cast<char>(std::tolower(byte));
  }
  return result;
}

std::set<std::string> anchors(const std::string& page) {
  static const std::regex heading("#{1,6} +(.*[^ ]) *"), named(R"re(<a (?:id|name)="([^"]+)")re");
  std::set<std::string> result;
  const std::string text = prose(page);
  std::smatch match;
  for (const std::string& line : lines(text)) {
    if (!std::regex_match(line, match, heading)) continue;
    const std::string name = anchor(match[1]);
    // A heading that is there already gets a number.
    std::string unique = name;
    for (int i = 1; !result.insert(unique).second; ++i) unique = name + "-" + std::to_string(i);
  }
  for (std::sregex_iterator it(text.begin(), text.end(), named), end; it != end; ++it)
    result.insert((*it)[1]);
  return result;
}

struct Link {
  std::string file, anchor;
};

/// To files of the project; `file` is empty for the page itself.
std::vector<Link> links(const std::string& page) {
  static const std::regex link(R"re(\]\(([^)#\s]*)(?:#([^)\s]*))?\))re"), span("`[^`\n]*`");
  const std::string text = std::regex_replace(prose(page), span, "`");
  std::vector<Link> result;
  for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
    const std::string file = (*it)[1];
    if (file.find("://") == file.npos && !file.starts_with("mailto:"))
      result.push_back({file, (*it)[2]});
  }
  return result;
}

Problems dead_links(const fs::path& root, const fs::path& page) {
  Problems problems;
  for (const Link& link : links(read(root / page))) {
    const fs::path target = link.file.empty() ? root / page : root / page.parent_path() / link.file;
    if (!fs::exists(target))
      problems.push_back(page.string() + ": " + link.file);
    else if (!link.anchor.empty() && target.extension() == ".md" &&
             !anchors(read(target)).contains(link.anchor))
      problems.push_back(page.string() + ": " + link.file + "#" + link.anchor);
  }
  return problems;
}

/// Pages of docs/ that docs/README.md does not link. The pages of docs/reference have an index of their own.
Problems pages_out_of_the_index(const fs::path& root) {
  std::set<fs::path> linked;
  for (const char* index : {"docs/README.md", "docs/reference/README.md"})
    if (fs::exists(root / index))
      for (const Link& link : links(read(root / index)))
        linked.insert((fs::path(index).parent_path() / link.file).lexically_normal());
  Problems problems;
  for (const fs::path& file : project_files(root))
    if (file.extension() == ".md" && *file.begin() == "docs" && file != "docs/README.md" &&
        !linked.contains(file))
      problems.push_back(file.string());
  return problems;
}

TEST(Links, to_files_and_anchors_lead_somewhere) {
  int pages = 0;
  for (const fs::path& file : project_files(kRoot)) {
    if (file.extension() != ".md") continue;
    ++pages;
    EXPECT_THAT(dead_links(kRoot, file), IsEmpty());
  }
  EXPECT_GT(pages, 50);
}

TEST(Links, that_are_dead_are_found) {
  Scratch tree;
  write(tree / "docs/a.md",
        "# A\n[b](b.md#x-y) [c](../c.md) [d](https://example.org/d.md) [e](b.md#z) [a](#a) "
        "[f](#f) `[g](g.md)`\n```\n[h](h.md)\n# F\n```\n");
  write(tree / "docs/b.md", "## `X`, [y](c.md)\n");
  EXPECT_THAT(dead_links(tree.path(), "docs/a.md"),
              ElementsAre("docs/a.md: ../c.md", "docs/a.md: b.md#z", "docs/a.md: #f"));
}

TEST(Index, links_every_page) { EXPECT_THAT(pages_out_of_the_index(kRoot), IsEmpty()); }

TEST(Index, that_lacks_a_page_is_found) {
  Scratch tree;
  write(tree / "docs/README.md", "[a](a.md) [b](sub/b.md#x)");
  for (const char* page : {"docs/a.md", "docs/sub/b.md", "docs/sub/c.md"}) write(tree / page, "");
  EXPECT_THAT(pages_out_of_the_index(tree.path()), ElementsAre("docs/sub/c.md"));
}

TEST(Readme, is_short_and_has_a_command_early) {
  const std::string page = read(kRoot / "README.md");
  EXPECT_LE(lines(page).size(), 151u) << "150 lines, each of which ends";
  std::istringstream before(page.substr(0, page.find("```")));
  std::size_t words = 0;
  for (std::string word; before >> word;) ++words;
  EXPECT_LE(words, 120u) << "before the first command";
}

TEST(Pages, of_tutorials_and_how_to_say_for_whom_they_are) {
  for (const char* folder : {"docs/tutorials", "docs/howto"})
    for (const auto& entry : fs::directory_iterator(kRoot / folder)) {
      const auto text = lines(read(entry.path()));
      ASSERT_GT(text.size(), 2u) << entry.path();
      EXPECT_TRUE(text[2].starts_with("For ")) << entry.path();
    }
}

}  // namespace
}  // namespace house
