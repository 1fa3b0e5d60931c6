// The pages of docs/ that `lobelia manual --docs` writes.
#include "tests/program/run_lobelia.hpp"
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

}  // namespace
}  // namespace lobelia
