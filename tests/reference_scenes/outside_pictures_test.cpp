// Pictures that are there already, as an engine: which are hashed for their keys, and which are not read at all.
#include "base/pictures/image_io.hpp"
#include "base/system/files.hpp"
#include "base/system/sha256.hpp"
#include "reference_scenes/content.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/engines/outside/outside.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr char kExr[] = "\x76\x2f\x31\x01";
constexpr auto kLong = std::chrono::minutes(10);

class OutsidePictures : public testing::Test {
 protected:
  OutsidePictures() {
    described_.name = described_.title = "studio";
    described_.directory = fs::canonical(directory_.path()).string();
    described_.files = "x.exr";
    scene_.film.width = scene_.film.height = 8;
  }
  fs::path file() const { return directory_.path() / "x.exr"; }
  /// A sparse file that begins as an EXR does, or not.
  void sparse(std::uint64_t bytes, const std::string& begin = kExr) const {
    write_file(file(), begin);
    fs::resize_file(file(), bytes);
  }
  /// The key's part, and why the picture then has failed.
  std::pair<std::string, std::string> key(std::chrono::duration<double> limit = kLong) const {
    const auto engine = make_outside_engine(described_, {});
    const std::string part = engine->key_part(scene_.film, {}, limit);
    write_picture();  // what comes later does not count
    return {part, Session(*engine, {}).render(scene_).error};
  }
  void write_picture() const { write_exr(file(), Image(8, 8), {}); }

  const TemporaryDirectory directory_;
  OutsideEngine described_;
  Scene scene_;
};

TEST_F(OutsidePictures, HaveTheirHashesAsKeys) {
  write_picture();
  EXPECT_EQ(key(), std::pair(hex(sha256_of_file(file())), std::string()));
}

TEST_F(OutsidePictures, AreHashedOnceForAllCells) {
  write_picture();
  // Changed just now, and in the future: hashes of such files are not remembered otherwise.
  fs::last_write_time(file(), fs::file_time_type::clock::now() + std::chrono::hours(1000));
  const auto engine = make_outside_engine(described_, {});
  const std::size_t before = FileHashes::of_user().read_count();
  const std::string part = engine->key_part(scene_.film, {}, kLong);
  EXPECT_EQ(FileHashes::of_user().read_count(), before + 1);
  for (int cell = 0; cell < 5; ++cell)
    EXPECT_EQ(engine->key_part(scene_.film, {{"exponent", std::to_string(cell)}}, kLong), part);
  EXPECT_EQ(FileHashes::of_user().read_count(), before + 1);
}

TEST_F(OutsidePictures, AreNotHashedIfTheyAreNone) {
  sparse(std::uint64_t{7} << 30, "no picture");
  const auto [part, why] = key();
  EXPECT_EQ(part, "unreadable");
  EXPECT_THAT(why, HasSubstr("its first bytes are not those of"));
}

TEST_F(OutsidePictures, AreNotHashedIfTheyAreLargerThanTheirFilmJustifies) {
  const std::uint64_t most = most_picture_bytes(scene_.film);
  EXPECT_LT(most, 32u << 20);
  sparse(most + 1);
  auto [part, why] = key();
  EXPECT_EQ(part, "unreadable");
  EXPECT_THAT(why, HasSubstr(fmt::format("the file has {} bytes; a picture of 8 x 8 pixels may "
                                         "have {}",
                                         most + 1, most)));
  sparse(std::uint64_t{1} << 40);
  std::tie(part, why) = key();
  EXPECT_EQ(part, "unreadable");
  EXPECT_THAT(why, HasSubstr("at most 8589934592 are read"));
  sparse(most);
  EXPECT_EQ(key().first.size(), 64u);
  // Any picture of the film fits, with 64 layers of four floats.
  scene_.film.width = 4096;
  scene_.film.height = 2160;
  EXPECT_GT(most_picture_bytes(scene_.film), 4096u * 2160u * 64u * 4u * 4u);
}

TEST_F(OutsidePictures, FailIfTheirHashTakesLongerThanAPictureMay) {
  write_picture();
  const auto [part, why] = key(std::chrono::seconds(0));
  EXPECT_EQ(part, "unreadable");
  EXPECT_THAT(why, HasSubstr("bytes, which were not read within 0 s"));
}

}  // namespace
}  // namespace lobelia
