// SECURITY.md has one table of what may start, read and write what, with the files of the source that do it. A new way to
// start a program, or to open or change a file, is a row there before it is merged.
#include <regex>

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"
#include "tests/test.hpp"

namespace house {
namespace {

using Problems = std::vector<std::string>;

/// "base/system/files.cpp: rename"
using Places = std::set<std::string>;

using Kinds = std::vector<std::pair<std::string, std::regex>>;

const Kinds& kinds() {
  static const Kinds all{
      {"remove", std::regex(R"re(\b(remove_all|unlink|unlinkat|rmdir|rmtree)\s*\(|)re"
                            R"re((fs|filesystem)::remove\s*\(|std::remove\s*\([^,)]*\))re")},
      {"rename", std::regex(R"re((::|fs\.|os\.)(rename|renameat2?|link|linkat|symlink|symlinkat|)re"
                            R"re(create_symlink|create_hard_link)\s*\()re")},
      {"write",
       std::regex(
           R"re(\bO_(WRONLY|RDWR|CREAT)\b|std::(ofstream|fstream)\b|\bfopen\s*\([^"]*"[^"]*[wa+]|)re"
           R"re(\b(mkdtemp|mkstemp|copy_file|truncate|ftruncate|zip_open)\s*\()re")},
      {"open", std::regex(R"re((^|[^\w>])::open(at)?\s*\(|\bSYS_openat2?\b|std::ifstream\b|)re"
                          R"re(\b(fopen|zip_source_file|ImageInput::open)\s*\()re")},
      // The declarations of run_process() and spawn() begin their parameters with "const".
      {"start",
       std::regex(R"re(::(execve?|execvp|fexecve|posix_spawn|fork|system|popen)\s*\(|)re"
                  R"re(\bSYS_execve\b|plain_clone\s*\(|subprocess|)re"
                  R"re(\brun_process\s*\((?!const\b|\))|\bspawn\s*\((?!const\b|d1::))re")}};
  return all;
}

/// Quick, and true of every line that a pattern matches.
bool may_match(const std::string& line) {
  static const std::vector<std::string> words{"remove",     "link",    "rmdir",  "rmtree", "rename",
                                              "O_",         "stream",  "open",   "temp",   "copy_",
                                              "trunc",      "exec",    "spawn",  "fork",   "clone",
                                              "subprocess", "process", "system", "zip_"};
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return line.find(word) != line.npos; });
}

/// The kinds of what a line of code does. One that opens a file for writing alone does not read it.
std::set<std::string> kinds_in(const std::string& code, bool is_python) {
  static const std::regex python_open(R"re((^|[^\w.])open\()re"),
      writing_alone(R"re(\bO_(WRONLY|CREAT|TMPFILE)\b)re");
  std::set<std::string> found;
  for (const auto& [kind, pattern] : kinds())
    if (std::regex_search(code, pattern)) found.insert(kind);
  if (is_python && std::regex_search(code, python_open)) found.insert("open");
  if (std::regex_search(code, writing_alone)) found.erase("open");
  return found;
}

/// Without comments.
std::vector<std::string> code_of(const fs::path& file) {
  static const std::regex comment(R"re(//.*$|^\s*#.*$)re");
  std::vector<std::string> code;
  for (const std::string& line : lines(read(file)))
    code.push_back(may_match(line) ? std::regex_replace(line, comment, "") : line);
  return code;
}

/// In what is installed and what engines are given.
Places places_in_source(const fs::path& root) {
  static const std::set<std::string> outside{"tests", "docs"};
  Places found;
  for (const fs::path& file : project_files(root)) {
    const bool is_python = file.extension() == ".py";
    if (outside.contains(file.begin()->string()) || (!is_cpp(file) && !is_python)) continue;
    for (const std::string& code : code_of(root / file))
      if (may_match(code))
        for (const std::string& kind : kinds_in(code, is_python))
          found.insert(file.generic_string() + ": " + kind);
  }
  return found;
}

constexpr char kHeader[] = "| who | starts | reads | writes | in the source |";
constexpr char kNothing[] = "nothing";

/// A row of the table.
struct Row {
  std::string who;
  std::map<std::string, std::string> cells;  ///< of "starts", "reads" and "writes"
  std::vector<std::string> files;
};

std::string column_of(const std::string& kind) {
  return kind == "start" ? "starts" : kind == "open" ? "reads" : "writes";
}

std::vector<Row> rows_of(const std::string& page, std::size_t& length, Problems& problems) {
  static const std::regex row(R"re(^\| ([^|]+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \|$)re"),
      name("`([^`]+)`");
  const std::vector<std::string> all = lines(page);
  auto line = std::find(all.begin(), all.end(), kHeader);
  const auto first = line;
  std::vector<Row> rows;
  for (; line != all.end() && line->starts_with("|"); ++line) {
    if (line - first < 2) continue;
    std::smatch match;
    if (!std::regex_match(*line, match, row)) {
      problems.push_back("no row of five cells: " + *line);
      continue;
    }
    Row& one = rows.emplace_back(
        Row{match[1].str(),
            {{"starts", match[2].str()}, {"reads", match[3].str()}, {"writes", match[4].str()}},
            {}});
    const std::string files = match[5];
    for (std::sregex_iterator it(files.begin(), files.end(), name), end; it != end; ++it)
      one.files.push_back((*it)[1]);
  }
  length = std::size_t(line - first);
  return rows;
}

/// Columns that a file fills by calls of functions that do it.
std::set<std::string> columns_of_calls(const fs::path& file) {
  static const std::vector<std::pair<std::string, std::regex>> calls{
      {"starts", std::regex(R"re(\b(run_engine|refuse_without_leave)\s*\((?!const\b))re")},
      {"reads", std::regex(R"re(\b(read_file|read_picture|read_record|read_scene|open_named|)re"
                           R"re(InputFile|PictureFile)\b)re")},
      {"writes", std::regex(R"re(\b(write_file|write_record|PartFile|make_directories)\b)re")}};
  std::set<std::string> found;
  for (const std::string& line : lines(read(file)))
    for (const auto& [column, pattern] : calls)
      if (line.find("//") == line.npos && std::regex_search(line, pattern)) found.insert(column);
  return found;
}

/// Where the table and the source do not say the same.
Problems differences(const fs::path& root, const std::string& page) {
  Problems problems;
  std::size_t length = 0;
  const std::vector<Row> rows = rows_of(page, length, problems);
  if (rows.empty() || length > 40)
    problems.push_back("the table has " + std::to_string(length) + " lines");
  std::map<std::string, const Row*> row_of;
  std::map<const Row*, std::set<std::string>> filled;
  for (const Row& row : rows) {
    if (row.files.empty()) problems.push_back(row.who + ": no file");
    for (const std::string& file : row.files) {
      if (!row_of.emplace(file, &row).second) problems.push_back(file + ": in two rows");
      if (fs::exists(root / file))
        filled[&row].merge(columns_of_calls(root / file));
      else
        problems.push_back(file + ": not there");
    }
  }
  for (const std::string& one : places_in_source(root)) {
    const std::string file = one.substr(0, one.find(": ")),
                      column = column_of(one.substr(one.find(": ") + 2));
    const auto found = row_of.find(file);
    if (found == row_of.end()) {
      problems.push_back(one + ", in no row");
      continue;
    }
    const Row& row = *found->second;
    filled[&row].insert(column);
    if (row.cells.at(column) == kNothing)
      problems.push_back(one + ", and " + row.who + " " + column + " nothing");
  }
  for (const Row& row : rows)
    for (const auto& [column, cell] : row.cells)
      if (cell != kNothing && !filled[&row].contains(column))
        problems.push_back(row.who + ": " + column + " " + cell + ", by no file of its row");
  return problems;
}

/// A pattern that finds nothing more leaves a cell over that no file of its row fills.
TEST(SecurityPage, ListsAllPermissionsInOneTable) {
  EXPECT_THAT(differences(kRoot, read(kRoot / "SECURITY.md")), IsEmpty());
  for (const std::string& one : places_in_source(kRoot))
    if (one.ends_with(": remove")) {
      EXPECT_EQ(one, "base/system/removal.cpp: remove");
    }
}

TEST(SecurityPage, FindsEveryWayToRemove) {
  Scratch tree;
  write(tree / "base/a.cpp", "removal.remove(name);\nstd::remove(a, b, c);\nbe_unlink(x);\n");
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
