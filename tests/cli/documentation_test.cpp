// The pages of docs/ that `lobelia manual --docs` writes.
#include "tests/cli/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

std::string text_of(const fs::path& file) { return read_file(file, std::size_t{1} << 20); }

TEST(GeneratedPages, AreAsTheProgramWritesThem) {
  const TemporaryDirectory directory;
  const ProcessResult result = run_lobelia({"manual", "--docs", "."}, directory.path());
  ASSERT_EQ(result.exit_code, 0) << result.output_tail;
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(directory.path())) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const fs::path name = fs::relative(entry.path(), directory.path());
    EXPECT_EQ(text_of(fs::path(LOBELIA_SOURCE_DIR) / "docs" / name), text_of(entry.path()))
        << name << "; run: lobelia manual --docs docs";
  }
  EXPECT_GT(files, 10);
}

TEST(GeneratedPages, HaveFormulasThatAreTypeset) {
  const std::string page = text_of(fs::path(LOBELIA_SOURCE_DIR) / "docs/models.md");
  for (
      const char* formula :
      {R"(C = \frac{1}{2 \pi \left(M_0 - M_1\right)}, \quad S = 1)",
       R"(M_j = \left(\frac{k}{n}\right)^{j + 1} \mathrm{B}\left(\min\left(1, \frac{n S}{k}\right); j + 1, k + 1\right))",
       R"(\ell(s) = e^{-\frac{n \arccos\left(1 - s\right)^{2}}{2}})",
       R"(\ell(s) = \frac{1}{\left(1 + \frac{n s \left(2 - s\right)}{2}\right)^{2}})",
       R"(\frac{\left(n + 2\right) \left(n + 4\right)}{8 \pi \left(2^{-n / 2} + n\right)})"})
    EXPECT_THAT(page, HasSubstr(formula));
}

}  // namespace
}  // namespace lobelia
