// tests/suites.txt and tools/change: which tests are long, and which of them a change calls for.
#include <fnmatch.h>

#include <regex>

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"
#include "tests/test.hpp"

namespace house {
namespace {

struct LongTests {
  std::string program, tests, group, why;
};

std::vector<LongTests> long_tests(const std::string& text) {
  static const std::regex entry(R"(^([A-Za-z_]+) +(\S+) +([a-z]+) +(.+)$)");
  std::vector<LongTests> found;
  for (const std::string& line : lines(text)) {
    std::smatch match;
    if (std::regex_match(line, match, entry))
      found.push_back({match[1], match[2], match[3], match[4]});
  }
  return found;
}

/// SUITE.NAME of every test in these sources; the files of the browser's and Python's tests stand for their own.
std::set<std::string> tests_in(const fs::path& root) {
  static const std::regex test(R"(\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\))");
  std::set<std::string> names;
  for (const fs::path& file : project_files(root)) {
    const std::string name = file.generic_string();
    if (name.starts_with("gallery/web/test/") && name.ends_with(".test.mjs"))
      names.insert(name.substr(17, name.size() - 17 - 9));
    if (name.starts_with("tests/program/python/")) names.insert(file.filename());
    if (!name.starts_with("tests/") || !is_cpp(file)) continue;
    const std::string text = read(root / file);
    for (std::sregex_iterator it(text.begin(), text.end(), test), end; it != end; ++it)
      names.insert((*it)[1].str() + "." + (*it)[2].str());
  }
  return names;
}

/// Parts of a filter that stand for no test.
std::vector<std::string> of_no_test(const std::vector<LongTests>& entries,
                                    const std::set<std::string>& names) {
  static const std::regex parameters(R"(^(?:[\w*]+/)?([^/]+)(?:/.*)?$)");
  std::vector<std::string> lost;
  for (const LongTests& entry : entries) {
    std::istringstream parts(entry.tests);
    for (std::string part; std::getline(parts, part, ':');) {
      const std::string pattern = std::regex_replace(part, parameters, "$1");
      if (std::ranges::none_of(names, [&](const std::string& name) {
            return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
          }))
        lost.push_back(entry.program + " " + part);
    }
  }
  return lost;
}

TEST(Suites, NameTestsThatExist) {
  const auto entries = long_tests(read(kRoot / "tests/suites.txt"));
  EXPECT_GT(entries.size(), 10u);
  EXPECT_THAT(of_no_test(entries, tests_in(kRoot)), IsEmpty());
}

/// The groups of long tests that tools/change prints for these files.
std::string groups_of(const std::string& files) {
  const Ran ran = run(quoted(kRoot / "tools/change") + " --groups " + files + " 2>/dev/null");
  EXPECT_EQ(ran.exit_code, 0);
  return ran.output;
}

TEST(Suites, HaveEveryGroupCalledForBySomeChange) {
  const std::string table = read(kRoot / "tools/change");
  for (const LongTests& entry : long_tests(read(kRoot / "tests/suites.txt")))
    EXPECT_TRUE(entry.group == "short" ||
                std::regex_search(table, std::regex("echo .*\\b" + entry.group + "\\b")))
        << entry.group;
}

TEST(Suites, CallForTheGroupsThatAChangeCanBreak) {
  EXPECT_EQ(groups_of("docs/faq.md"), "cli docs python\n");
  EXPECT_EQ(groups_of("docs/mutants.md"), "docs\n");
  EXPECT_EQ(groups_of("tests/faults/inject"), "all_faults\n");
  EXPECT_EQ(groups_of("tests/farm/failures/failing_farm.hpp"), "all_farm\n");
  EXPECT_THAT(groups_of("gallery/pages.cpp"), HasSubstr("pages"));
  EXPECT_EQ(groups_of("tests/gallery/pages_test.cpp"), "all_gallery\n");
  EXPECT_EQ(groups_of("tests/program/library/library_test.cpp"), "\n");
  EXPECT_THAT(groups_of("docs/faq.md farm/farm.cpp"),
              HasSubstr("cluster docs faults python readers"));
  EXPECT_THAT(groups_of("'a new room/x.cpp'"), HasSubstr("whole"));
}

TEST(Suites, HaveAGroupForEveryRoom) {
  std::set<std::string> rooms;
  for (const fs::path& file : project_files(kRoot))
    if (is_cpp(file) && *file.begin() != "tests") rooms.insert(file.begin()->string());
  for (const std::string& room : rooms)
    EXPECT_THAT(groups_of(room + "/new/x.cpp"), testing::Not(HasSubstr("whole"))) << room;
}

}  // namespace
}  // namespace house
