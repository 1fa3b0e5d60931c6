// Shaders as people write them, and the words of `lobelia check-shader` about each. corpus/corpus.txt lists them.
#include <fmt/format.h>

#include <iostream>

#include "base/words/text.hpp"
#include "tests/json.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/shaders/shader_runner.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

const fs::path kCorpus = fs::path(LOBELIA_SOURCE_DIR) / "tests/shaders/corpus";
/// Only a hang takes so long.
constexpr char kHang[] = "--time-limit=3600";

struct Row {
  std::string file, kind;
  std::vector<std::string> mistakes;  ///< each by its names: "tone-mapped/exposure"
  std::vector<std::string> options;
  std::string words;
};

std::vector<Row> corpus() {
  std::vector<Row> rows;
  for (const std::string& line : split(read_file(kCorpus / "corpus.txt", 1 << 20), "\n")) {
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string> cells = split(line, "|");
    if (cells.size() != 5) throw std::runtime_error("corpus.txt: not 5 cells: " + line);
    const auto words = [&](std::size_t i) {
      return cells[i] == "-" ? std::vector<std::string>() : split(cells[i], i == 2 ? " +" : " ");
    };
    rows.push_back({cells[0], cells[1], words(2), words(3), cells[4]});
  }
  return rows;
}

struct Finding {
  bool expected = false;               ///< it says what the row has
  std::vector<std::string> not_there;  ///< causes that it names and that are not planted
  std::string said;
  double seconds = 0;
  bool ran = true;
};

/// Each planted mistake under one of its names, and no other cause.
bool are_named(const Row& row, const std::vector<std::string>& named,
               std::vector<std::string>& not_there) {
  std::vector<std::vector<std::string>> planted;
  for (const std::string& one : row.mistakes) planted.push_back(split(one, "/"));
  const auto is_one_of = [&](const std::string& name) {
    return [&](const auto& names) { return std::ranges::count(names, name) > 0; };
  };
  for (const std::string& name : named)
    if (std::ranges::none_of(planted, is_one_of(name))) not_there.push_back(name);
  return not_there.empty() && named.size() == planted.size() &&
         std::ranges::all_of(planted, [&](const auto& names) {
           return std::ranges::any_of(
               named, [&](const std::string& name) { return std::ranges::count(names, name) > 0; });
         });
}

Finding check(const Row& row, const fs::path& record) {
  std::vector<std::string> command{"check-shader", row.file, "--no-costs", kHang, "--json", record};
  command.insert(command.end(), row.options.begin(), row.options.end());
  const ProcessResult result = run_lobelia(command, kCorpus);
  Finding finding;
  finding.seconds = result.cpu_seconds;
  finding.ran = result.exit_code != 5;
  if (result.exit_code > 1) {
    finding.said = result.output_tail;
    return finding;
  }
  const Json json = read_json(record);
  std::vector<std::string> named;
  finding.said = json.at("verdict");
  if (json.contains("explanation")) {
    const Json& explanation = json.at("explanation");
    finding.said += ": " + explanation.at("sentence").get<std::string>();
    if (explanation.at("complete")) explanation.at("mistakes").get_to(named);
  }
  if (row.kind == "right") {
    finding.expected = result.exit_code == 0;
    finding.not_there = named;
  } else {
    const bool all = are_named(row, named, finding.not_there);
    finding.expected =
        result.exit_code == 1 && (row.kind == "unknown" ? finding.not_there.empty() : all);
  }
  return finding;
}

struct Count {
  int expected = 0, all = 0;
};

class ShaderCorpus : public NeedsShaderRunner {};

TEST_F(ShaderCorpus, IsJudgedAsPlanted) {
  const TemporaryDirectory directory;
  std::map<std::string, Count> counts;
  std::vector<std::pair<double, std::string>> times;
  int not_there = 0;
  for (const Row& row : corpus()) {
    const Finding finding = check(row, directory.path() / "record.json");
    if (!finding.ran) continue;  // without Chromium, say
    times.emplace_back(finding.seconds, row.file);
    ++counts[row.kind].all;
    counts[row.kind].expected += finding.expected;
    not_there += finding.not_there.empty() ? 0 : 1;
    if (!finding.expected)
      std::cout << fmt::format("{} ({}: {}): {}\n", row.file, row.kind, row.words, finding.said);
    for (const std::string& name : finding.not_there)
      std::cout << fmt::format("{}: {} is not planted\n", row.file, name);
  }
  std::cout << "\n| shaders | number | as expected |\n|---|---|---|\n";
  for (const auto& [kind, count] : counts)
    std::cout << fmt::format("| {} | {} | {} |\n", kind, count.all, count.expected);
  std::cout << fmt::format("| causes named that were not planted | | {} |\n\n", not_there);
  std::ranges::sort(times, std::greater());
  times.resize(std::min<std::size_t>(times.size(), 10));
  for (const auto& [seconds, file] : times)
    std::cout << fmt::format("{:5.2f} s of processor time: {}\n", seconds, file);

  const auto missed = [&](const char* kind) { return counts[kind].all - counts[kind].expected; };
  const auto share = [&](const char* kind) {
    return double(counts[kind].expected) / std::max(counts[kind].all, 1);
  };
  EXPECT_EQ(missed("right"), 0);
  EXPECT_EQ(not_there, 0);
  EXPECT_GE(share("single"), 0.95);
  EXPECT_GE(share("pair"), 0.95);
  EXPECT_EQ(share("unknown"), 1);
}

TEST(ShaderCorpusTable, ListsEachFileOnce) {
  std::set<std::string> listed, there;
  std::map<std::string, int> counts;
  int all = 0;
  for (const Row& row : corpus()) {
    ++all;
    ++counts[row.kind];
    listed.insert(row.file);
    EXPECT_TRUE(row.kind == "right" || row.kind == "single" || row.kind == "pair" ||
                row.kind == "unknown")
        << row.file;
    EXPECT_EQ(row.mistakes.size(), row.kind == "single" ? 1u
                                   : row.kind == "pair" ? 2u
                                                        : 0u)
        << row.file;
  }
  for (const auto& entry : fs::directory_iterator(kCorpus))
    there.insert(entry.path().filename().string());
  there.erase("corpus.txt");
  EXPECT_EQ(listed, there);
  EXPECT_EQ(std::size_t(all), listed.size());
  EXPECT_GE(all, 120);
  const std::string page =
      read_file(fs::path(LOBELIA_SOURCE_DIR) / "docs/check_shader.md", 1 << 20);
  for (const auto& [kind, count] : counts)
    EXPECT_THAT(page, HasSubstr(fmt::format("\n| {} | {} |", kind, count)));
}

}  // namespace
}  // namespace lobelia
