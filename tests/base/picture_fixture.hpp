// Picture files in a directory of their own, read or refused.
#pragma once

#include "base/pictures/image_io.hpp"
#include "base/system/error.hpp"
#include "tests/base/picture_files.hpp"
#include "tests/test.hpp"

namespace lobelia::fixtures {

class PictureFiles : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& bytes) {
    write_file(directory_.path() / name, bytes);
    return directory_.path() / name;
  }
  std::filesystem::path exr(const std::string& name, const std::vector<ExrPart>& parts) {
    write_exr_parts(directory_.path() / name, parts);
    return directory_.path() / name;
  }
  std::filesystem::path exr(const std::string& name, int width, int height,
                            const std::vector<ExrChannel>& channels) {
    write_exr_channels(directory_.path() / name, width, height, channels);
    return directory_.path() / name;
  }
  TemporaryDirectory directory_;
};

inline std::vector<float> values(const Image& image) {
  return {image.values().begin(), image.values().end()};
}

/// The message of the one line that a file is refused with.
inline std::string refusal(const std::filesystem::path& path, const std::string& layer = "") {
  try {
    read_picture(path, layer);
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), ExitCode::kInput) << message;
    EXPECT_THAT(message, ::testing::HasSubstr(path.string()));
    EXPECT_EQ(message.find('\n'), message.npos) << message;
    return message;
  }
  ADD_FAILURE() << path << " was read";
  return "";
}

}  // namespace lobelia::fixtures
