// `lobelia compare` on picture files made for it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/image_io.hpp"
#include "tests/cli/run_lobelia.hpp"
#include "tests/core/picture_files.hpp"

namespace lobelia::fixtures {

using Record = nlohmann::json;

class ComparePictures : public ::testing::Test {
 protected:
  void file(const std::string& name, const std::string& bytes) {
    write_file(directory_.path() / name, bytes);
  }
  void exr(const std::string& name, int width, int height,
           const std::vector<ExrChannel>& channels) {
    write_exr_channels(directory_.path() / name, width, height, channels);
  }
  /// R, G and B of one value each, and whatever else.
  void flat(const std::string& name, float value, std::vector<ExrChannel> more = {},
            Imf::PixelType type = Imf::FLOAT) {
    const std::vector<float> values(32 * 32, value);
    for (const char* channel : {"R", "G", "B"}) more.push_back({channel, values, type});
    exr(name, 32, 32, more);
  }
  ExrChannel channel(const char* name, float value) {
    return {name, std::vector<float>(32 * 32, value)};
  }
  ProcessResult compare(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    return run_lobelia(arguments, directory_.path());
  }
  /// Exit code and record.
  Record record(std::vector<std::string> arguments, int exit_code) {
    arguments.insert(arguments.end(), {"--json", "record.json"});
    const ProcessResult result = compare(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.output_tail;
    return Record::parse(read_file(directory_.path() / "record.json", 1 << 20), nullptr, false);
  }
  void expect_refused(const std::string& name, const std::string& why) {
    for (const bool first : {true, false}) {
      const ProcessResult result = compare({first ? name : "good.exr", first ? "good.exr" : name});
      EXPECT_EQ(result.exit_code, 3) << name << ": " << result.output_tail;
      EXPECT_THAT(result.output_tail, ::testing::HasSubstr(name));
      EXPECT_THAT(result.output_tail, ::testing::HasSubstr(why));
      // libpng says on stderr what it tells us as well.
      const std::string& output = result.output_tail;
      const std::size_t ours = output.starts_with("libpng error: ") ? output.find('\n') + 1 : 0;
      EXPECT_TRUE(output.substr(ours).starts_with("lobelia: ")) << output;
      EXPECT_EQ(std::count(output.begin() + std::ptrdiff_t(ours), output.end(), '\n'), 1) << output;
      EXPECT_FALSE(result.timed_out) << name;
    }
  }
  std::string good_exr() {
    flat("good.exr", 0.5f);
    return read_file(directory_.path() / "good.exr", 1 << 20);
  }
  TemporaryDirectory directory_;
};

}  // namespace lobelia::fixtures
