#include "farm/chunk.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using testing::SizeIs;

class ChunkReportFiles : public testing::Test {
 protected:
  ChunkReportFiles() { ::setenv("SLURMD_NODENAME", "n2", 1); }
  ~ChunkReportFiles() override { ::unsetenv("SLURMD_NODENAME"); }
  fs::path run() const { return directory_.path() / "run"; }
  fs::path file(const std::string& name) const { return run() / "reports" / name; }
  void report(std::size_t number, const std::string& engine) const {
    const LeftUndone left{engine, "it failed 5 times in a row"};
    write_chunk_report(run(), number, {&left, 1});
  }
  /// A report but for what is put in.
  static std::string text(const std::string& node, const std::string& left) {
    return fmt::format(
        R"({{"schemaVersion": 1, "kind": "farm-chunk-report", "node": {}, "left": {}}})", node,
        left);
  }
  TemporaryDirectory directory_;
};

TEST_F(ChunkReportFiles, AreReadAsTheyWereWritten) {
  EXPECT_THAT(read_chunk_reports(run()).reports, IsEmpty());
  write_chunk_report(run(), 3, {});
  EXPECT_FALSE(fs::exists(run())) << "there is nothing to tell";
  report(12, "povray");
  report(3, "");
  report(3, "blender");  // a second time over the first
  const ChunkReports found = read_chunk_reports(run());
  EXPECT_THAT(found.problems, IsEmpty());
  ASSERT_THAT(found.reports, SizeIs(2));
  EXPECT_EQ(found.reports[0].number, 3u);
  EXPECT_EQ(found.reports[0].node, "n2");
  ASSERT_THAT(found.reports[0].left, SizeIs(1));
  EXPECT_EQ(found.reports[0].left[0].engine, "blender");
  EXPECT_EQ(found.reports[1].left[0].why, "it failed 5 times in a row");
  EXPECT_THAT(read_chunk_reports(run(), 4, 12).reports, IsEmpty());
  EXPECT_THAT(read_chunk_reports(run(), 4, 13).reports, SizeIs(1));
}

TEST_F(ChunkReportFiles, NameTheHostWhereSlurmNamesNoNode) {
  for (const char* name : {"--wrap=reboot", "n1,n2", "n[1-3]", "", "a/b"}) {
    ::setenv("SLURMD_NODENAME", name, 1);
    EXPECT_NE(own_node_name(), name);
  }
  ::setenv("SLURMD_NODENAME", "rack-7.node_3", 1);
  EXPECT_EQ(own_node_name(), "rack-7.node_3");
}

TEST_F(ChunkReportFiles, AreBoundedForAnyEngine) {
  std::vector<LeftUndone> left(300, {"povray", std::string(10000, 'x') + "\n\x1b[2J"});
  write_chunk_report(run(), 1, left);
  EXPECT_LT(fs::file_size(file("1.json")), 64u << 10);
  EXPECT_THAT(read_chunk_reports(run()).reports, SizeIs(1));
}

TEST_F(ChunkReportFiles, AreNotWrittenThroughALink) {
  const fs::path elsewhere = directory_.path() / "elsewhere";
  fs::create_directories(elsewhere);
  write_file(elsewhere / "1.json", "precious");
  fs::create_directories(run());
  fs::create_directory_symlink(elsewhere, run() / "reports");
  EXPECT_THROW(report(1, "povray"), Error);
  fs::remove(run() / "reports");
  fs::create_directories(run() / "reports");
  fs::create_symlink(elsewhere / "1.json", file("1.json"));
  EXPECT_THROW(report(1, "povray"), Error);
  EXPECT_EQ(read_file(elsewhere / "1.json", 100), "precious");
}

TEST_F(ChunkReportFiles, AreProblemsAndNothingElseIfTheyAreInvalid) {
  const std::string left = R"([{"engine": "povray", "why": "w"}])";
  report(0, "povray");
  fs::rename(file("0.json"), directory_.path() / "good.json");
  const std::pair<const char*, std::string> broken[] = {
      {"no record", ""},
      {"no record", std::string(60000, '[')},
      {"another kind", R"({"schemaVersion": 1, "kind": "farm-chunk"})"},
      {"a node that is an option", text("\"--wrap=reboot\"", left)},
      {"a node that is a list", text("\"n1,n2\"", left)},
      {"a node that is a number", text("7", left)},
      {"a node of many bytes", text("\"" + std::string(1000, 'n') + "\"", left)},
      {"an engine that is none", text("\"n1\"", R"([{"engine": "../x", "why": "w"}])")}};
  for (const auto& [what, content] : broken) {
    write_file(file("0.json"), content);
    const ChunkReports found = read_chunk_reports(run());
    EXPECT_THAT(found.reports, IsEmpty()) << what;
    ASSERT_THAT(found.problems, SizeIs(1)) << what;
    EXPECT_THAT(found.problems[0], HasSubstr("0.json: not taken for a report: ")) << what;
  }
  write_file(file("0.json"), text("\"n1\"", left));
  EXPECT_THAT(read_chunk_reports(run()).reports, SizeIs(1)) << "this one is none of them";

  fs::resize_file(file("0.json"), 20ull << 30);  // a hole
  EXPECT_THAT(read_chunk_reports(run()).problems[0], HasSubstr("over 65536 bytes"));
  fs::remove(file("0.json"));
  fs::create_symlink(directory_.path() / "good.json", file("0.json"));
  EXPECT_THAT(read_chunk_reports(run()).problems[0], HasSubstr("a link"));
  fs::remove(file("0.json"));
  ASSERT_EQ(::mkfifo(file("0.json").c_str(), 0600), 0);
  EXPECT_THAT(read_chunk_reports(run()).problems[0], HasSubstr("not a regular file"));
  fs::remove(file("0.json"));
  fs::create_directory(file("0.json"));
  EXPECT_THAT(read_chunk_reports(run()).problems[0], HasSubstr("not a regular file"));
  for (const char* other : {"00.json", "-1.json", "x.json", "1.json.part", ".1.json.7-1.part",
                            "99999999999999999999999.json"})
    write_file(file(other), text("\"n1\"", left));
  EXPECT_THAT(read_chunk_reports(run(), 1).reports, IsEmpty());
  for (int i = 0; i < 30; ++i) write_file(file(fmt::format("{}.json", i + 1)), "x");
  EXPECT_THAT(read_chunk_reports(run()).problems, SizeIs(10));

  fs::remove_all(run() / "reports");
  fs::create_directory_symlink(directory_.path(), run() / "reports");
  EXPECT_THAT(read_chunk_reports(run()).problems, SizeIs(1));
}

}  // namespace
}  // namespace lobelia
