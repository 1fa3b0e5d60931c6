// `lobelia compare` on picture files made for it.
#pragma once

#include <nlohmann/json.hpp>

#include "base/pictures/image_io.hpp"
#include "tests/base/picture_files.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia::fixtures {

using Record = nlohmann::json;

class ComparePictures : public ::testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return directory_.path() / name; }
  std::string text(const std::string& name) const { return read_file(path(name), 1 << 20); }
  Record json(const std::string& name) const { return Record::parse(text(name)); }
  void file(const std::string& name, const std::string& bytes) { write_file(path(name), bytes); }
  void exr(const std::string& name, int width, int height,
           const std::vector<ExrChannel>& channels) {
    std::filesystem::create_directories(path(name).parent_path());
    write_exr_channels(path(name), width, height, channels);
  }
  /// R, G and B of one value each, and whatever else; makes the folder, too.
  void flat(const std::string& name, float value, std::vector<ExrChannel> more = {}) {
    const std::vector<float> values(32 * 32, value);
    for (const char* channel : {"R", "G", "B"}) more.push_back({channel, values});
    exr(name, 32, 32, more);
  }
  ExrChannel channel(const char* name, float value) {
    return {name, std::vector<float>(32 * 32, value)};
  }
  ProcessResult compare(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    return run_lobelia(arguments, directory_.path());
  }
  Record record(std::vector<std::string> arguments, int exit_code) {
    arguments.insert(arguments.end(), {"--json", "record.json"});
    const ProcessResult result = compare(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.output_tail;
    return Record::parse(text("record.json"), nullptr, false);
  }
  std::string good_exr() {
    flat("good.exr", 0.5f);
    return text("good.exr");
  }
  TemporaryDirectory directory_;
};

}  // namespace lobelia::fixtures
