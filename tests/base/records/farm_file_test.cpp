#include "base/records/farm_file.hpp"

#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "tests/test.hpp"

namespace lobelia::records {
namespace {

FarmCell some_cell(std::size_t i) {
  FarmCell cell{"n" + std::to_string(i), i % 2 ? "pass" : "missing", {}};
  if (i % 3) cell.axes = {{"exponent", std::to_string(i)}, {"a \"name\"\n", "\xff"}};
  return cell;
}

Farm some_farm() {
  Farm farm;
  farm.title = "A title";
  farm.axes.push_back({"exponent", {{"1", "one"}}});
  farm.engines.emplace_back().name = "analytic";
  farm.engines.back().state = "ready";
  return farm;
}

Farm with_cells(std::size_t count) {
  Farm farm = some_farm();
  for (std::size_t i = 0; i < count; ++i) farm.cells.push_back(some_cell(i));
  return farm;
}

/// The record that was read, or why it was not.
std::string outcome(const std::function<Farm()>& read) {
  try {
    return record_text(read());
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(FarmFile, IsTheVeryRecordForAnyNumberOfCells) {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / "farm.json";
  for (const std::size_t count : {0u, 1u, 2u, 20'000u}) {  // the last in several pieces
    const std::string text = record_text(with_cells(count));
    write_farm(path, with_cells(3), count, some_cell);
    EXPECT_TRUE(read_file(path, kMaxRecordBytes) == text) << count;
    EXPECT_TRUE(outcome([&] { return read_farm(path); }) == text) << count;
    EXPECT_TRUE(outcome([&] { return read_record<Farm>(path); }) == text) << count;
  }
}

TEST(FarmFile, IsReadAsARecordIsWhateverIsWrongWithIt) {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / "farm.json";
  const std::string text = record_text(with_cells(3));
  std::mt19937 random(1);
  std::size_t refused = 0;
  constexpr int kTries = 200;
  for (int i = 0; i < kTries; ++i) {
    std::string changed = text;
    const std::size_t at = random() % text.size();
    if (i % 2)
      changed[at] = "x7\"{}[],"[random() % 8];
    else
      changed.erase(at, 1 + random() % 30);
    write_file(path, changed);
    const std::string is = outcome([&] { return read_farm(path); });
    EXPECT_EQ(is, outcome([&] { return read_record<Farm>(path); })) << changed;
    refused += is.starts_with(path.string()) ? 1 : 0;
  }
  EXPECT_GT(refused, std::size_t(kTries / 2));
}

}  // namespace
}  // namespace lobelia::records
