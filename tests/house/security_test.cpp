// SECURITY.md lists every place that removes, renames, opens for writing or starts a program: a new one is a line
// there before it is merged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"

namespace house {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// "core/files.cpp: rename"
using Places = std::set<std::string>;

const std::vector<std::pair<std::string, std::regex>>& kinds() {
  static const std::vector<std::pair<std::string, std::regex>> all{
      {"remove", std::regex(R"re(\b(remove_all|unlink|unlinkat|rmdir|rmtree)\s*\(|)re"
                            R"re((fs|filesystem)::remove\s*\(|std::remove\s*\([^,)]*\))re")},
      {"rename", std::regex(R"re((::|fs\.|os\.)(rename|renameat2?|link|linkat|symlink|symlinkat|)re"
                            R"re(create_symlink|create_hard_link)\s*\()re")},
      {"write",
       std::regex(
           R"re(\bO_(WRONLY|RDWR|CREAT)\b|std::(ofstream|fstream)\b|\bfopen\s*\([^"]*"[^"]*[wa+]|)re"
           R"re(\b(mkdtemp|mkstemp|copy_file|truncate|ftruncate)\s*\()re")},
      {"start", std::regex(R"re(::(execve?|execvp|fexecve|posix_spawn|fork|system|popen)\s*\(|)re"
                           R"re(\bSYS_execve\b|plain_clone\s*\(|subprocess)re")}};
  return all;
}

/// Quick, and true of every line that a pattern matches.
bool may_match(const std::string& line) {
  static const std::vector<std::string> words{
      "remove", "link",  "rmdir", "rmtree", "rename", "O_",     "stream", "fopen", "temp",
      "copy_",  "trunc", "exec",  "spawn",  "fork",   "system", "popen",  "clone", "subprocess"};
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return line.find(word) != line.npos; });
}

/// In what is installed and what engines are given; comments aside.
Places places_in_source(const fs::path& root) {
  static const std::set<std::string> outside{"tests", "bench", "fuzz"};
  Places found;
  for (const fs::path& file : project_files(root)) {
    if (outside.contains(file.begin()->string()) || (!is_cpp(file) && file.extension() != ".py"))
      continue;
    for (const std::string& line : lines(read(root / file))) {
      if (!may_match(line)) continue;
      const std::string code = std::regex_replace(line, std::regex(R"re(//.*$|^\s*#.*$)re"), "");
      for (const auto& [kind, pattern] : kinds())
        if (std::regex_search(code, pattern)) found.insert(file.generic_string() + ": " + kind);
    }
  }
  return found;
}

/// Rows "| `core/files.cpp` | rename, write | ... |" whose last cell says what guards them.
Places places_in_page(const std::string& page) {
  static const std::regex row(R"re(^\| `([^`]+)` \| ([a-z, ]+) \| ([^|]{10,}) \|$)re");
  static const std::regex word("[a-z]+");
  Places found;
  std::smatch match;
  for (const std::string& line : lines(page)) {
    if (!std::regex_match(line, match, row)) continue;
    const std::string words = match[2];
    for (std::sregex_iterator it(words.begin(), words.end(), word), end; it != end; ++it)
      found.insert(match[1].str() + ": " + it->str());
  }
  return found;
}

std::vector<std::string> only_in(const Places& a, const Places& b) {
  std::vector<std::string> result;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

TEST(SecurityPage, lists_every_place_that_changes_files_or_starts_programs_and_no_other) {
  const Places source = places_in_source(LOBELIA_SOURCE_DIR),
               page = places_in_page(read(fs::path(LOBELIA_SOURCE_DIR) / "SECURITY.md"));
  EXPECT_THAT(only_in(source, page), IsEmpty()) << "in the source, not in SECURITY.md";
  EXPECT_THAT(only_in(page, source), IsEmpty()) << "in SECURITY.md, not in the source";
  EXPECT_GT(page.size(), 10u);
  for (const std::string& one : source)
    if (one.ends_with(": remove")) {
      EXPECT_EQ(one, "core/removal.cpp: remove");
    }
}

TEST(SecurityPage, every_kind_of_place_is_found) {
  Scratch tree;
  write(tree / "core/a.cpp",
        "fs::remove(path);  // and fs::rename(a, b)\n"
        "int fd = ::open(path, O_WRONLY | O_CREAT);\n"
        "bool rename_it(); void unlinked();\n");
  write(tree / "farm/b.cpp", "::renameat2(a, b, c, d, 0);\n::posix_spawn(&pid, p);\n");
  write(tree / "reference_scenes/c.py", "# shutil.rmtree(x)\nsubprocess.run(['x'])\n");
  write(tree / "tests/d.cpp", "::unlink(path);\n");
  EXPECT_THAT(places_in_source(tree.path()),
              ElementsAre("core/a.cpp: remove", "core/a.cpp: write", "farm/b.cpp: rename",
                          "farm/b.cpp: start", "reference_scenes/c.py: start"));
  EXPECT_THAT(places_in_page("| file | calls | guard |\n|---|---|---|\n"
                             "| `core/a.cpp` | remove, write | names of ours alone |\n"
                             "| `core/b.cpp` | remove | |\n"),
              ElementsAre("core/a.cpp: remove", "core/a.cpp: write"));
}

TEST(SecurityPage, every_way_to_remove_is_found) {
  Scratch tree;
  write(tree / "core/a.cpp", "removal.remove(name);\nstd::remove(a, b, c);\nbe_unlink(x);\n");
  ASSERT_THAT(places_in_source(tree.path()), IsEmpty());
  int file = 0;
  for (const char* call : {"fs::remove_all(a);", "std::filesystem::remove_all (a);", "::unlink(a);",
                           "::rmdir(a);", "::unlinkat(f, a, 0);", "fs::remove(a, error);",
                           "std::filesystem::remove(a);", "std::remove(a);"})
    write(tree / ("farm/" + std::to_string(file++) + ".cpp"), call);
  EXPECT_EQ(places_in_source(tree.path()).size(), 8u);
}

}  // namespace
}  // namespace house
