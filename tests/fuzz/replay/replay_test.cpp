// The corpora of `make fuzz` through the fuzzers' own checks, and small changes to each seed.
#include "base/pictures/image_io.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "farm/grid.hpp"
#include "gallery/cells/checked_cell.hpp"
#include "lobelia_paths.hpp"
#include "reference_scenes/formats/mitsuba.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/fuzz/bundle.hpp"
#include "tests/fuzz/checks.hpp"
#include "tests/test.hpp"

namespace lobelia::fuzz {
namespace {

std::vector<fs::path> seeds(const std::string& corpus) {
  std::vector<fs::path> found;
  for (const auto& entry :
       fs::directory_iterator(std::string(LOBELIA_SOURCE_DIR) + "/tests/fuzz/corpus/" + corpus))
    found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// How many seeds are read to their end, and how many are refused. A corpus that is refused as a whole reaches little.
struct Counts {
  int read = 0, refused = 0;
};

template <class Read>
void replay(const std::string& corpus, void (*check)(std::string_view), Counts least, Read read) {
  Counts counts;
  for (const fs::path& seed : seeds(corpus)) {
    const std::string bytes = read_file(seed, 1 << 20);
    EXPECT_NO_THROW(check(bytes)) << seed;
    try {
      read(bytes);
      ++counts.read;
    } catch (const std::exception&) {
      ++counts.refused;
    }
  }
  EXPECT_GE(counts.read, least.read);
  EXPECT_GE(counts.refused, least.refused);
}

/// Bytes at random, the same ones each time.
void expect_survives_changed_bytes(const std::string& corpus, void (*check)(std::string_view),
                                   int changes) {
  std::mt19937 random(8);
  for (const fs::path& seed : seeds(corpus)) {
    const std::string bytes = read_file(seed, 1 << 20);
    for (int i = 0; i < changes; ++i) {
      std::string changed = bytes;
      const std::size_t at = random() % bytes.size();
      const auto how = random() % 3;
      if (how == 0) changed.erase(at, 1 + random() % 8);
      if (how == 1) changed[at] = char(random());
      if (how == 2) changed.resize(at);
      ASSERT_NO_THROW(check(changed)) << seed << ", change " << i;
    }
  }
}

TEST(SceneCorpus, BreaksNothing) {
  replay("scene", check_scene_reader, {8, 3},
         [](const std::string& text) { parse_scene(text, "s.xml"); });
}

TEST(MitsubaCorpus, BreaksNothing) {
  replay("mitsuba", check_mitsuba_reader, {2, 1},
         [](const std::string& text) { parse_mitsuba(text, "s.xml"); });
}

TEST(ShaderCorpus, BreaksNothing) {
  replay("shader", check_shader_reader, {3, 0}, [](const std::string&) {});
}

TEST(ShaderCorpus, BreaksNothingWithBytesChanged) {
  expect_survives_changed_bytes("shader", check_shader_reader, 4000);
}

/// The files of a bundle, and the directory of all.
void unpack(const TemporaryDirectory& directory, const std::string& bundle) {
  for (const auto& [name, text] : files_of_bundle(bundle))
    write_plainly(directory.path() / name, text);
}

TEST(GridCorpus, BreaksNothing) {
  replay("grid", check_grid_reader, {4, 2}, [](const std::string& bundle) {
    const TemporaryDirectory directory;
    unpack(directory, bundle);
    read_grid(directory.path() / "grid.xml");
  });
}

TEST(RecordCorpus, BreaksNothing) {
  replay("record", check_record_readers, {2, 2}, [](const std::string& bundle) {
    const TemporaryDirectory directory;
    unpack(directory, bundle);
    gallery::read_farm(directory.path());
  });
}

TEST(PictureCorpus, BreaksNothing) {
  replay("picture", check_picture_door, {6, 6}, [](const std::string& bytes) {
    const TemporaryDirectory directory;
    write_plainly(directory.path() / "picture.tga", bytes);
    read_image(directory.path() / "picture.tga");
  });
}

TEST(SceneCorpus, BreaksNothingWithBytesChanged) {
  expect_survives_changed_bytes("scene", check_scene_reader, 4000);
}

TEST(GridCorpus, BreaksNothingWithBytesChanged) {
  expect_survives_changed_bytes("grid", check_grid_reader, 100);
}

TEST(RecordCorpus, BreaksNothingWithBytesChanged) {
  expect_survives_changed_bytes("record", check_record_readers, 100);
}

TEST(PictureCorpus, BreaksNothingWithBytesChanged) {
  expect_survives_changed_bytes("picture", check_picture_door, 100);
}

TEST(PictureCorpus, IsAPictureOrARefusalInTheProcessThatDecodes) {
  const TemporaryDirectory directory;
  const auto decode = [&](std::string_view bytes) {
    const fs::path path = directory.path() / "picture.tga";
    write_plainly(path, bytes);
    try {
      read_image(path);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kInput) throw;
    }
  };
  std::mt19937 random(9);
  for (const fs::path& seed : seeds("picture")) {
    std::string bytes = read_file(seed, 1 << 20);
    for (int i = 0; i < 4; ++i) {
      ASSERT_NO_THROW(decode(bytes)) << seed << ", change " << i;
      bytes[random() % bytes.size()] = char(random());
    }
  }
}

}  // namespace
}  // namespace lobelia::fuzz
