#include "reference_scenes/content.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/sha256.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/engines/outside/outside.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

class FileHashesTest : public testing::Test {
 protected:
  /// A file that has long been there: what has just changed is not remembered, and ctime cannot be set. Files of the
  /// system are old enough.
  const fs::path old_ = fs::canonical("/bin/sh");
  fs::path memory() const { return directory_.path() / "memory" / "hashes.json"; }
  /// How many files were read for the old one's hash.
  std::size_t reads() const {
    FileHashes hashes(memory());
    EXPECT_EQ(hashes.hash(old_).sha256, hex(sha256_of_file(old_)));
    hashes.save();
    return hashes.read_count();
  }
  const TemporaryDirectory directory_;
};

TEST_F(FileHashesTest, ReadsAFileOnceForAllRuns) {
  EXPECT_EQ(reads(), 1u);
  EXPECT_EQ(reads(), 0u);
  // Damaged, cut off, of another writer, or a link: as if it were not there.
  const std::string whole = read_file(memory(), 1 << 20);
  for (std::string text : {std::string(), whole.substr(0, whole.size() / 2), whole}) {
    if (text == whole) text[text.find("\"files\"") + 400 % (text.size() / 2)] ^= 1;
    write_file(memory(), text);
    EXPECT_EQ(reads(), 1u) << text;
    EXPECT_EQ(reads(), 0u);
  }
  fs::permissions(memory(), fs::perms::others_write, fs::perm_options::add);
  EXPECT_EQ(reads(), 1u);
  fs::rename(memory(), directory_.path() / "elsewhere");
  fs::create_symlink(directory_.path() / "elsewhere", memory());
  EXPECT_EQ(reads(), 1u);
}

TEST_F(FileHashesTest, SeesEveryChange) {
  FileHashes hashes(memory());
  const fs::path file = directory_.path() / "file";
  for (const char* text : {"one", "two", "six", "three", "one"}) {
    write_file(file, std::string_view(text));
    EXPECT_EQ(hashes.hash(file).sha256, hex(sha256(text)));
    EXPECT_EQ(hashes.hash(file).bytes, std::string_view(text).size());
  }
  // In place, with the time of change set back.
  struct stat before {};
  ::stat(file.c_str(), &before);
  const int fd = ::open(file.c_str(), O_WRONLY);
  ASSERT_EQ(::pwrite(fd, "two", 3, 0), 3);
  const timespec times[2] = {before.st_atim, before.st_mtim};
  ::futimens(fd, times);
  ::close(fd);
  EXPECT_EQ(hashes.hash(file).sha256, hex(sha256("two")));
}

TEST_F(FileHashesTest, WorksWithoutAMemory) {
  FileHashes hashes("/proc/no/such/place/hashes.json");
  EXPECT_THROW(hashes.hash(directory_.path()), Error);
  EXPECT_THROW(hashes.hash("/no/such/file"), Error);
  EXPECT_THROW(hashes.hash("/dev/zero"), Error);
  EXPECT_EQ(hashes.hash(old_).sha256, hex(sha256_of_file(old_)));
  hashes.save();
}

TEST_F(FileHashesTest, GivesUpAFileThatTakesTooLong) {
  FileHashes hashes{fs::path()};
  EXPECT_THROW(hashes.hash(InputFile(old_), std::chrono::seconds(0)), Error);
  EXPECT_EQ(hashes.hash(InputFile(old_), std::chrono::hours(1)).sha256, hex(sha256_of_file(old_)));
}

class ContentTest : public FileHashesTest {
 protected:
  fs::path file(const std::string& name, const std::string& text) const {
    const fs::path path = directory_.path() / name;
    fs::create_directories(path.parent_path());
    write_file(path, text);
    return path;
  }
};

TEST_F(ContentTest, IsIndependentOfPathsOrTheirOrder) {
  FileHashes hashes{fs::path()};
  const auto content = [&](const std::vector<std::pair<std::string, fs::path>>& libraries) {
    ContentReader reader(hashes);
    for (const auto& [name, path] : libraries) reader.add("library", name, path);
    return reader.content().sha256;
  };
  const fs::path a = file("a/liba", "A"), b = file("b/libb", "B"), moved = file("c/liba", "A");
  const std::string both = content({{"liba", a}, {"libb", b}});
  EXPECT_EQ(content({{"libb", b}, {"liba", moved}, {"libb", b}}), both);
  EXPECT_NE(content({{"liba", b}, {"libb", a}}), both);
  EXPECT_NE(content({{"liba", a}}), both);
  EXPECT_NE(content({{"liba", a}, {"libb", directory_.path() / "gone"}}), both);
  EXPECT_EQ(content({}), "");
}

TEST_F(ContentTest, IsNotMadeOfAFileThatAFaultHides) {
  FileHashes hashes{fs::path()};
  ContentReader reader(hashes);
  // Anyone may open it, and the first bytes of memory give EIO.
  EXPECT_THROW(reader.add("library", "memory", "/proc/self/mem"), Error);
  EXPECT_NO_THROW(reader.add("library", "gone", directory_.path() / "gone"));
  EXPECT_NO_THROW(reader.add("library", "no file", directory_.path()));
  EXPECT_EQ(reader.content().files.size(), 2u);
}

TEST_F(ContentTest, ExplainsTheRefusalOfAHugeFile) {
  FileHashes hashes{fs::path()};
  ContentReader reader(hashes);
  const fs::path huge = file("huge.bin", "");
  fs::resize_file(huge, kMostHashedBytes + 1);
  EXPECT_EQ(error_words(ExitCode::kInput, [&] { reader.add("program", "", huge); }),
            huge.string() +
                ": 8589934593 bytes; a file that an engine gets as an argument, or that it loads, "
                "is hashed, and may have 8589934592");
}

TEST_F(ContentTest, CoversAllFilesOfADirectoryButPythonsCaches) {
  FileHashes hashes{fs::path()};
  const auto content = [&] {
    ContentReader reader(hashes);
    reader.add_directory(directory_.path() / "d");
    return reader.content();
  };
  EXPECT_EQ(content().sha256, "");
  file("d/x.py", "x");
  file("d/deep/er/y", "y");
  const Content before = content();
  EXPECT_EQ(before.files.size(), 2u);
  file("d/__pycache__/x.pyc", "compiled");
  fs::create_directory_symlink("/", directory_.path() / "d" / "root");
  EXPECT_EQ(content().sha256, before.sha256);
  file("d/deep/er/y", "z");
  file("d/new", "n");
  const Content after = content();
  EXPECT_NE(after.sha256, before.sha256);
  const std::string d = (directory_.path() / "d").string();
  EXPECT_THAT(file_changes(before, after, 5),
              testing::ElementsAre(d + "/deep/er/y changed", d + "/new is new"));
  EXPECT_THAT(file_changes(after, before, 1),
              testing::ElementsAre(d + "/deep/er/y changed", "and 1 files more"));
  const Content read = records::parse_record<Content>(records::record_text(after), "after");
  EXPECT_EQ(read.sha256, after.sha256);
  EXPECT_THAT(file_changes(read, after, 5), testing::IsEmpty());
}

// Pictures that are there already, as an engine: which are hashed for their keys, and which are not read at all.

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
