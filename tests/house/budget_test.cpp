// The house has a budget of lines and words: what is added is paid for by what goes. Data, generated files and bundles do not
// count. The figures only fall; they rose twice: by what checks shaders and functions of BSDFs, and by the
// materials of other programs and of measurements, spots, and GGX by roughness.
#include "tests/house/tree.hpp"

namespace house {
namespace {

constexpr std::int64_t kLinesOfProgram = 124'200, kLinesOfTests = 51'000, kWordsOfDocs = 35'550;

bool is_source(const fs::path& file, const std::set<std::string>& endings) {
  static const std::set<std::string> generated{"gallery/web/src/records.ts",
                                               "program/library/lobelia/flip_highlight.hpp",
                                               "program/library/lobelia/highlight.hpp"};
  static const std::set<fs::path> not_written{"dist", "test", "corpus"};
  return endings.contains(file.extension().string()) &&
         !generated.contains(file.generic_string()) &&
         std::ranges::none_of(file.parent_path(),
                              [](const fs::path& part) { return not_written.contains(part); });
}

std::int64_t lines_of(const fs::path& file) {
  const std::string text = read(file);
  return std::ranges::count(text, '\n');
}

std::int64_t lines_of_program(const fs::path& root) {
  std::int64_t sum = 0;
  for (const fs::path& file : project_files(root))
    if (*file.begin() != "tests" &&
        is_source(file, {".cpp", ".hpp", ".h", ".inc", ".py", ".ts", ".css"}))
      sum += lines_of(root / file);
  return sum;
}

std::int64_t lines_of_tests(const fs::path& root) {
  std::int64_t sum = 0;
  for (const fs::path& file : project_files(root))
    if (*file.begin() == "tests" && is_source(file, {".cpp", ".hpp", ".h", ".py"}))
      sum += lines_of(root / file);
  return sum;
}

/// Words of the pages that people write: the program and the tools write the others.
std::int64_t words_of_docs(const fs::path& root) {
  static const std::set<fs::path> generated{
      "agreement.md", "command_line.md", "environment.md",       "errata.md",         "metrics.md",
      "models.md",    "mutants.md",      "security_evidence.md", "shader_mistakes.md"};
  std::int64_t sum = 0;
  for (const fs::path& file : project_files(root)) {
    const bool is_page = file == "README.md" || file == "CONTRIBUTING.md" ||
                         (*file.begin() == "docs" && file.extension() == ".md");
    if (!is_page || generated.contains(file.filename()) || file.parent_path() == "docs/reference")
      continue;
    std::istringstream in(read(root / file));
    sum += std::distance(std::istream_iterator<std::string>(in), {});
  }
  return sum;
}

TEST(Budget, HoldsTheLinesOfTheProgram) { EXPECT_LE(lines_of_program(kRoot), kLinesOfProgram); }

TEST(Budget, HoldsTheLinesOfTheTests) { EXPECT_LE(lines_of_tests(kRoot), kLinesOfTests); }

TEST(Budget, HoldsTheWordsOfTheDocs) { EXPECT_LE(words_of_docs(kRoot), kWordsOfDocs); }

}  // namespace
}  // namespace house
