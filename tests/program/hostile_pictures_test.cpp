// Hostile and odd pictures, made here, given to comparisons and profiles.
#include <fmt/format.h>

#include "tests/base/format_samples.hpp"
#include "tests/json.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using namespace fixtures;
using ::testing::AnyOf;

constexpr std::uint64_t kMostMemory = std::uint64_t{1} << 30;

class Corpus {
 public:
  explicit Corpus(std::uint32_t seed) : random_(seed) {
    for (const Sample& sample : format_samples()) {
      add("whole", sample, sample.bytes);
      cut(sample);
      flip(sample);
      claim(sample);
    }
    add_odd_values();
  }
  const std::vector<Sample>& pictures() const { return pictures_; }

 private:
  void add(const std::string& what, const Sample& sample, const std::string& bytes) {
    pictures_.push_back({fmt::format("{:04}-{}-{}", pictures_.size(), what, sample.name), bytes});
  }
  /// Everywhere in a short header, and at places all over the rest.
  void cut(const Sample& sample) {
    const std::size_t size = sample.bytes.size();
    std::set<std::size_t> places{0,  1,  2,  3,  4,        8,        12,
                                 17, 18, 24, 40, size - 1, size - 4, size - 13};
    for (int i = 1; i < 12; ++i) places.insert(size * std::size_t(i) / 12);
    for (const std::size_t place : places)
      if (place < size) add("cut", sample, sample.bytes.substr(0, place));
  }
  /// Some bits near the start, where headers are, and some anywhere.
  void flip(const Sample& sample) {
    for (int i = 0; i < 16; ++i) {
      std::string bytes = sample.bytes;
      const std::size_t reach = i % 2 == 0 ? std::min<std::size_t>(bytes.size(), 96) : bytes.size();
      for (int flips = 0; flips <= i % 5; ++flips)
        bytes[random_() % reach] ^= char(1 << random_() % 8);
      add("flipped", sample, bytes);
    }
  }
  /// Whatever stands for a size, one of these makes it huge, and another nothing.
  void claim(const Sample& sample) {
    // DPX and EXR have their sizes far behind, so those places are drawn.
    for (int i = 0; i < 24; ++i) {
      const std::size_t places = std::min<std::size_t>(sample.bytes.size() - 4, i < 16 ? 64 : 820);
      const std::size_t at = i < 16 ? std::size_t(2 * i + 4) % places : random_() % places;
      for (const char* value : {"\x7f\xff\xff\xff", "\xff\xff\xff\x7f"}) {
        std::string bytes = sample.bytes;
        bytes.replace(at, 4, std::string(value, 4));
        if (i % 2 == 0) add("claims", sample, bytes);
      }
      if (i % 3 == 0) {
        std::string bytes = sample.bytes;
        bytes.replace(at, 4, std::string(4, '\0'));
        add("zeros", sample, bytes);
      }
    }
  }
  void add_odd_values() {
    const float odd[] = {std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity(),
                         std::numeric_limits<float>::quiet_NaN(),
                         std::numeric_limits<float>::max(),
                         -std::numeric_limits<float>::max(),
                         std::numeric_limits<float>::denorm_min(),
                         -0.0f,
                         -1e30f};
    for (const float value : odd) {
      std::vector<float> values(192, 0.25f);
      values[random_() % 192] = value;
      add("odd", {"odd.pfm", ""}, pfm_file(8, 8, values));
      add("odd", {"odd.tif", ""},
          tiff_file({.width = 8,
                     .height = 8,
                     .bits = 32,
                     .is_float = true,
                     .samples = little_endian(values)}));
      std::fill(values.begin(), values.end(), value);
      add("odd", {"all.pfm", ""}, pfm_file(8, 8, values));
    }
  }
  std::mt19937 random_;
  std::vector<Sample> pictures_;
};

TEST(HostilePictures, NeverEndAComparisonOfFolders) {
  const TemporaryDirectory directory;
  const Corpus corpus(18);
  for (const char* folder : {"a", "b"}) {
    fs::create_directory(directory.path() / folder);
    for (const Sample& picture : corpus.pictures())
      write_file(directory.path() / folder / picture.name, picture.bytes);
  }
  const ProcessResult result = run_lobelia(
      {"compare", "a", "b", "--json", "set.json", "--junit", "junit.xml"}, directory.path());
  EXPECT_EQ(result.exit_code, 3) << result.output_tail;
  EXPECT_LT(result.peak_memory_bytes, kMostMemory);
  const Json record = read_json(directory.path() / "set.json");
  int read = 0, refused = 0;
  ASSERT_EQ(record.at("pairs").size(), corpus.pictures().size());
  for (const auto& pair : record.at("pairs")) {
    const std::string name = pair.at("name");
    if (pair.contains("error")) {
      ++refused;
      const std::string error = pair.at("error");
      EXPECT_THAT(error, HasSubstr(name));
      EXPECT_EQ(error.find('\n'), error.npos) << error;
      EXPECT_EQ(name.find("-whole-"), name.npos) << error;
    } else {
      ++read;
      EXPECT_THAT(pair.at("comparison").at("verdict"), AnyOf("pass", "non-finite"))
          << name << " and itself";
    }
  }
  // A corpus that is refused as a whole, or read as a whole, is none.
  EXPECT_GT(read, int(corpus.pictures().size() / 10));
  EXPECT_GT(refused, int(corpus.pictures().size() / 3));
  EXPECT_GT(fs::file_size(directory.path() / "junit.xml"), 1000u);
}

TEST(HostilePictures, EndAProfileWithOneLineOrAreProfiled) {
  const TemporaryDirectory directory;
  const Corpus corpus(19);
  int succeeded = 0;
  for (std::size_t i = 0; i < corpus.pictures().size(); i += 61) {
    const Sample& picture = corpus.pictures()[i];
    SCOPED_TRACE(picture.name);
    write_file(directory.path() / picture.name, picture.bytes);
    const ProcessResult result = run_lobelia({"profile", picture.name}, directory.path());
    if (result.exit_code == 0)
      ++succeeded;
    else
      expect_one_line(result, 3, "");
    EXPECT_LT(result.peak_memory_bytes, kMostMemory);
  }
  EXPECT_GT(succeeded, 0) << "not even a whole picture is read";
}

}  // namespace
}  // namespace lobelia
