// The corpus of `make fuzz` through the fuzzer's own entry, and every small change to each seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/files.hpp"
#include "fuzz/scene_reader.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> seeds() {
  std::vector<fs::path> found;
  for (const auto& entry :
       fs::directory_iterator(std::string(LOBELIA_SOURCE_DIR) + "/fuzz/corpus/scene"))
    found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

TEST(SceneCorpus, BreaksNothing) {
  int scenes = 0, refused = 0;
  for (const fs::path& seed : seeds()) {
    const std::string text = read_file(seed, 1 << 20);
    EXPECT_NO_THROW(check_scene_reader(text)) << seed;
    try {
      parse_scene(text, "s.xml");
      ++scenes;
    } catch (const std::exception&) {
      ++refused;
    }
  }
  // A corpus that is refused as a whole reaches little.
  EXPECT_GE(scenes, 8);
  EXPECT_GE(refused, 3);
}

TEST(SceneCorpus, BreaksNothingWithAByteLeftOutOrChanged) {
  int tried = 0;
  for (const fs::path& seed : seeds()) {
    const std::string text = read_file(seed, 1 << 20);
    if (text.size() > 2048) continue;  // bounded: each byte is nine inputs
    for (std::size_t i = 0; i < text.size(); ++i) {
      std::string changed = text;
      changed.erase(i, 1);
      ASSERT_NO_THROW(check_scene_reader(changed)) << seed << " without byte " << i;
      for (int bit = 0; bit < 8; ++bit) {
        changed = text;
        changed[i] = char(changed[i] ^ (1 << bit));
        ASSERT_NO_THROW(check_scene_reader(changed))
            << seed << " with bit " << bit << " of byte " << i << " changed";
      }
      ++tried;
    }
  }
  EXPECT_GT(tried, 2000);
}

}  // namespace
}  // namespace lobelia::fuzz
