// Hostile pictures: what they do to their decoder, they do to nobody else.
#include "base/pictures/contained_reader.hpp"

#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <thread>

#include "base/pictures/picture_file.hpp"
#include "base/pictures/picture_message.hpp"
#include "base/pictures/reading_limits.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/spawn.hpp"
#include "lobelia_paths.hpp"
#include "tests/base/format_samples.hpp"
#include "tests/base/picture_fixture.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

using ContainedReader = PictureFiles;

/// Each ends OpenImageIO 2.4.7 by a signal.
std::vector<Sample> crashers(const fs::path& scratch) {
  Imf::Header header(4, 4);
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  header.insert("tiff:RowsPerStrip", Imf::IntAttribute(0));
  const fs::path exr = scratch / "zero_rows.exr";
  {
    const std::vector<float> values(16, 0.5f);
    Imf::OutputFile output(exr.c_str(), header);
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow(), 4, 16));
    output.setFrameBuffer(buffer);
    output.writePixels(4);
  }
  std::string dpx = dpx_file(8, 8, std::string(192, 'x'));
  dpx.replace(36, 100, std::string(100, '\xff'));
  return {
      {"palette.tga", from_hex("000101000001002000000000010001002000000000ffffffff3f")},
      {"bits.bmp", from_hex("424d1c0700000000000036040000280000007f000000400000000100200001000000"
                            "e6020100000f00000000006701000000000000d6d6000001000200ff000006b9ff")},
      {"zero_rows.exr", read_file(exr, 1 << 20)},
      {"endless_name.dpx", dpx}};
}

TEST_F(ContainedReader, ReadsEveryFormatAsThisProcessWould) {
  for (const Sample& sample : format_samples()) {
    SCOPED_TRACE(sample.name);
    const auto path = file(sample.name, sample.bytes);
    const Image contained = read_image(path), direct = read_trusted_image(path);
    ASSERT_EQ(contained.width(), direct.width());
    ASSERT_EQ(contained.height(), direct.height());
    EXPECT_TRUE(std::ranges::equal(contained.values(), direct.values()));
    EXPECT_GT(contained.width(), 0);
  }
}

TEST_F(ContainedReader, ReadsALargeExrInBandsAsThisProcessWouldAtOnce) {
  // Three bands, the last of which is short.
  constexpr int kWidth = 2100, kHeight = 2060;
  constexpr std::size_t kPixels = std::size_t(kWidth) * kHeight;
  const auto ramp = [](double start) {
    std::vector<float> values(kPixels);
    for (std::size_t i = 0; i < kPixels; ++i)
      values[i] = float(std::fmod(start + 0.37 * double(i), 60000));
    return values;
  };
  const auto path = directory_.path() / "large.exr";
  const auto at = [&](int x, int y) { return window(x, y, kWidth, kHeight); };
  const std::vector<ExrChannel> colours{{"R", ramp(1), Imf::HALF},
                                        {"G", ramp(2)},
                                        {"B", ramp(3)},
                                        {"Z", ramp(4)},
                                        {"id", ramp(5), Imf::UINT}};
  for (const ExrPart& part :
       {ExrPart{.data = at(0, 0), .display = at(0, 0), .channels = colours},
        ExrPart{.data = at(-7, 11), .display = at(-7, 11), .channels = colours},
        ExrPart{.data = at(0, 0), .display = at(5, 3), .channels = colours}}) {
    write_exr_parts(path, {part});
    const Image contained = read_image(path), direct = read_trusted_image(path);
    EXPECT_EQ(contained.width(), kWidth);
    EXPECT_TRUE(std::ranges::equal(contained.values(), direct.values()));
    const Image depth = read_picture(path, "Z").image, ids = read_picture(path, "id").image;
    const PixelWindow data = read_picture(path, "Z").source.data;
    EXPECT_EQ(data.x, part.data.min.x);
    if (part.data != part.display) continue;
    for (std::size_t i = 0; i < kPixels; i += 4999) {
      ASSERT_EQ(depth.values()[3 * i], colours[3].values[i]);
      ASSERT_EQ(ids.values()[3 * i], std::floor(colours[4].values[i]));
    }
  }
}

TEST_F(ContainedReader, TellsTheFormatByTheFirstBytes) {
  for (const Sample& sample : format_samples()) {
    if (sample.name == "plain.tga") continue;  // a TGA without a footer has its name only
    SCOPED_TRACE(sample.name);
    const Image named = read_image(file(sample.name, sample.bytes));
    for (const char* other : {"renamed.exr", "renamed.png", "renamed.tga", "renamed"})
      EXPECT_TRUE(
          std::ranges::equal(read_image(file(other, sample.bytes)).values(), named.values()))
          << other;
  }
}

TEST_F(ContainedReader, OutlivesPicturesThatEndTheirDecoder) {
  const auto good = file("good.png", png_file({.samples = "abc"}));
  int crashed = 0;
  for (const Sample& crasher : crashers(directory_.path())) {
    std::string message = "read";
    try {
      read_image(file(crasher.name, crasher.bytes));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kInput);
      message = error.what();
    }
    crashed += message.find("the decoder crashed (signal") != message.npos;
    EXPECT_EQ(read_image(good).width(), 1) << "after " << crasher.name;
  }
#ifndef __SANITIZE_ADDRESS__  // with its memory, what crashes is read, and differs
  EXPECT_GE(crashed, 1) << "none of them crashes this version's decoders: the test proves nothing";
#endif
}

TEST_F(ContainedReader, RefusesOtherFormatsByTheirFirstBytesUnderAnyName) {
  const Sample others[] = {{"softimage", from_hex("5380f634") + std::string(104, '\0')},
                           {"icon", from_hex("00000100010010100000010020000000000016000000")},
                           {"photoshop", "8BPS" + std::string(1000, '\0')},
                           {"gif", gif_file({"abc"})},
                           {"iff", "FOR4" + std::string(100, 'x')},
                           {"sgi", from_hex("01da0101") + std::string(600, '\0')},
                           {"fits", "SIMPLE  =                    T" + std::string(2850, ' ')},
                           {"text", "I am not a picture"},
                           {"zeros", std::string(100000, '\0')}};
  for (const Sample& other : others)
    for (const char* ending : {".exr", ".tga", ".pic", ".ico", ".psd", ".null", ""})
      EXPECT_THAT(refusal(file(other.name + ending, other.bytes)),
                  HasSubstr("its first bytes are not those of OpenEXR, PNG"));
}

TEST_F(ContainedReader, OpensOtherFormatsWhereAnyIsAskedFor) {
  const auto gif = file("a.gif", gif_file({"\xff\xff\xff", std::string(3, '\0')}));
  refusal(gif);
  read_any_picture_format(true);
  EXPECT_EQ(read_image(gif).pixel(0, 0)[1], 1);
  EXPECT_EQ(read_picture(gif, "part2").image.pixel(0, 0)[1], 0) << "the second frame";
  EXPECT_EQ(read_image(file("renamed.exr", gif_file({"\xff\xff\xff"}))).pixel(0, 0)[1], 1);
  for (const Sample& sample : format_samples())
    if (sample.name.starts_with("rgb")) {
      EXPECT_GT(read_image(file(sample.name, sample.bytes)).width(), 0) << sample.name;
    }
  refusal(file("a.null", "this is text"));
  refusal(file("a.txt", "this is text"));
  read_any_picture_format(false);
  refusal(gif);
}

TEST_F(ContainedReader, RefusesTooLargeFilesUnread) {
  const auto pipe = directory_.path() / "pipe.exr";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(refusal(pipe), HasSubstr("not a regular file"));
  EXPECT_THAT(refusal(directory_.path()), HasSubstr("not a regular file"));
  EXPECT_THAT(refusal(directory_.path() / "none.exr"), HasSubstr("no such file"));
  EXPECT_THAT(refusal(file("empty.exr", "")), HasSubstr("the file is empty"));
  const auto sparse = file("sparse.exr", "\x76\x2f\x31\x01");
  fs::resize_file(sparse, std::uintmax_t{20} << 30);
  EXPECT_THAT(refusal(sparse), HasSubstr("at most 8589934592 are read"));
  fs::resize_file(sparse, std::uintmax_t{1} << 30);
  refusal(sparse);
  const auto zeros = file("zeros.exr", "");
  fs::resize_file(zeros, std::uintmax_t{1} << 30);
  EXPECT_THAT(refusal(zeros), HasSubstr("its first bytes"));
}

TEST_F(ContainedReader, RefusesPicturesThatNoFileOfTheirSizeHolds) {
  // 57 bytes that claim 11000 x 11000 pixels of 64 bits.
  const std::string png =
      "\x89PNG\r\n\x1a\n" +
      png_chunk("IHDR", big_endian(11000) + big_endian(11000) + "\x10\x06" + std::string(3, '\0')) +
      png_chunk("IDAT", "") + png_chunk("IEND", "");
  ASSERT_EQ(png.size(), 57u);
  EXPECT_THAT(refusal(file("a.png", png)),
              HasSubstr("claims 121000000 pixels in a file of 57 bytes; allowed here: 16777216"));
  EXPECT_THAT(refusal(file("a.dpx", dpx_file(30000, 4000, "abc"))),
              HasSubstr("claims 120000000 pixels in a file of 2051 bytes"));
}

TEST_F(ContainedReader, HoldsAPictureToTheLimitOfWhoeverAsksBeforeItIsUnpacked) {
  // No pixel has a value, so that a decoder that unpacks it finds it damaged.
  const std::string png =
      "\x89PNG\r\n\x1a\n" +
      png_chunk("IHDR", big_endian(1100) + big_endian(1000) + "\x08\x02" + std::string(3, '\0')) +
      png_chunk("IDAT", "") + png_chunk("IEND", "");
  const fs::path path = file("a.png", png);
  const auto why = [&](const PictureLimit& limit) {
    return error_words(ExitCode::kInput, [&] { read_picture(path, "", limit); });
  };
  EXPECT_THAT(why({1'099'999, 0}),
              HasSubstr("claims 1100000 pixels in a file of 57 bytes; allowed here: 1099999"));
  EXPECT_THAT(why({1'099'000, 17}), HasSubstr("1099000, and 17 more for each byte of the file"));
  for (const PictureLimit limit : {PictureLimit{1'100'000, 0}, PictureLimit{1'099'000, 18}})
    EXPECT_THAT(why(limit), AllOf(HasSubstr("a.png"), ::testing::Not(HasSubstr("claims"))));
}

TEST(Claims, GrowWithTheFile) {
  const PictureLimit limit;
  const std::uint64_t of_any = limit.pixels_of_any_file;
  EXPECT_EQ(claim_problem({2 * of_any, 8 * of_any}, 1, limit), "");
  EXPECT_NE(claim_problem({2 * of_any + 3 * limit.pixels_per_byte, 0}, 1, limit), "");
  // A picture of the largest size that is read, compressed as far as deflate goes.
  const std::uint64_t largest = 2 * std::uint64_t(kMaxImagePixels);
  EXPECT_EQ(claim_problem({largest, 0}, kMaxImagePixels * 3 / 1032, limit), "");
  for (std::uint64_t bytes = 1; bytes < kMaxImagePixels; bytes *= 3) {
    EXPECT_LE(memory_to_read({100, 300}, bytes), memory_to_read({200, 300}, bytes));
    EXPECT_LE(seconds_to_read({}, bytes), seconds_to_read({largest, 0}, bytes));
    EXPECT_LT(seconds_to_read({largest, 0}, bytes), seconds_to_wait(bytes, limit) + 1000);
  }
}

// The allocator of the sanitizers fills memory in its own way, so that both reads find the same there.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(ContainedReader, RefusesAPictureOfWhichPixelsAreNotInTheFile) {
  std::string pixels;
  for (int i = 0; i < 3 * 64 * 64; ++i) pixels += char(i % 251);
  const std::string whole = tga_file({.width = 64, .height = 64, .data = pixels});
  EXPECT_EQ(read_image(file("whole.tga", whole)).width(), 64);
  // OpenImageIO reads it, and shows what lay in its memory before.
  for (const std::size_t length : {18 + 3 * 64 * 63, 18 + 3 * 64 * 32 + 5, 40})
    refusal(file("cut.tga", whole.substr(0, length)));
}
#endif

TEST_F(ContainedReader, ServesManyThreadsAndLeavesNoDescriptorOpen) {
  const auto good = file("good.png", png_file({.samples = "abc"}));
  const auto bad = file("bad.png", png_file({.samples = "abc"}).substr(0, 40));
  const auto descriptors = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  const auto round = [&] {
    std::atomic<int> right{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&] {
        for (int i = 0; i < 5; ++i) {
          right += read_image(good).width() == 1;
          try {
            read_image(bad);
          } catch (const Error&) {
            ++right;
          }
        }
      });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(right, 40);
  };
  round();
  const auto before = descriptors();
  round();
  // A reader more may have been needed, which has one socket.
  EXPECT_LE(descriptors(), before + 3);
  for (int i = 0; i < 20; ++i) refusal(bad);
  EXPECT_LE(descriptors(), before + 3);
}

TEST_F(ContainedReader, StopsAtOnceWhenItIsInterrupted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto good = file("good.png", png_file({.samples = "abc"}));
  const auto exit_code = [&] {
    read_image(good);
    catch_interrupts();
    ::raise(SIGTERM);
    try {
      read_image(good);
    } catch (const Error& error) {
      return int(error.code());
    }
    return 0;
  };
  EXPECT_EXIT(std::_Exit(exit_code()), ::testing::ExitedWithCode(int(ExitCode::kInterrupted)), "");
}

/// The readers that any thread of a process has started.
std::vector<pid_t> readers_of(pid_t process) {
  std::vector<pid_t> found;
  std::error_code gone;
  for (const auto& task :
       fs::directory_iterator("/proc/" + std::to_string(process) + "/task", gone)) {
    std::ifstream list(task.path() / "children");
    for (pid_t child = 0; list >> child;) found.push_back(child);
  }
  return found;
}

bool is_running(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/stat");
  std::string pid, name, state;
  return status >> pid >> name >> state && name == "(lobelia_picture)" && state != "Z";
}

TEST_F(ContainedReader, LeavesNoReaderBehindWhenItsProgramIsKilled) {
  if (!fs::exists(LOBELIA_PROGRAM)) GTEST_SKIP() << "make sanitize-short builds no program";
  const auto folder = directory_.path() / "many";
  fs::create_directory(folder);
  const std::string picture =
      png_file({.width = 64, .height = 64, .samples = std::string(3 * 64 * 64, 'x')});
  for (int i = 0; i < 300; ++i) write_file(folder / (std::to_string(i) + ".png"), picture);
  const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  const pid_t program =
      spawn({.arguments = {LOBELIA_PROGRAM, "compare", folder.string(), folder.string()},
             .environment = {},
             .working_directory = {},
             .output = null})
          .pid;
  ::close(null);
  const auto wait = std::chrono::milliseconds(5);
  constexpr int kHang = 120'000;  // of these waits: ten minutes
  std::vector<pid_t> readers;
  for (int i = 0; i < kHang && (readers = readers_of(program)).empty(); ++i)
    std::this_thread::sleep_for(wait);
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  ASSERT_FALSE(readers.empty());
  for (const pid_t reader : readers) {
    for (int i = 0; i < kHang && is_running(reader); ++i) std::this_thread::sleep_for(wait);
    EXPECT_FALSE(is_running(reader));
  }
}

/// The things that a process can do after lock_down(), as bits; tried in a process of its own.
enum Deed { kOpen, kCreate, kConnect, kFork, kExecute, kKill, kTrace, kRename };

int deeds_after_lock_down(bool may_open_files, const fs::path& victim) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (!lock_down(may_open_files)) ::_exit(0xff);
    int done = 0;
    const auto note = [&](Deed deed, bool possible) { done |= int(possible) << deed; };
    note(kOpen, ::open(victim.c_str(), O_RDONLY) >= 0);
    note(kCreate, ::open((victim.string() + ".new").c_str(), O_WRONLY | O_CREAT, 0600) >= 0 ||
                      ::open(victim.c_str(), O_RDWR) >= 0);
    note(kConnect,
         ::socket(AF_INET, SOCK_STREAM, 0) >= 0 || ::socket(AF_UNIX, SOCK_STREAM, 0) >= 0);
    const pid_t other = ::fork();
    if (other == 0) ::_exit(0);
    note(kFork, other >= 0);
    note(kKill, ::kill(::getppid(), 0) == 0);
    note(kTrace, ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0);
    note(kRename, ::rename(victim.c_str(), (victim.string() + ".moved").c_str()) == 0);
    char* const arguments[] = {const_cast<char*>("/bin/true"), nullptr};
    ::execv(arguments[0], arguments);
    ::_exit(done);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(ContainedReader, CanDoNothingButDecode) {
  const auto victim = file("victim", "untouched");
  const int deeds = deeds_after_lock_down(false, victim);
  if (deeds == 0xff) GTEST_SKIP() << "this kernel takes no system calls away";
  EXPECT_EQ(deeds, 0);
  EXPECT_EQ(deeds_after_lock_down(true, victim), 0) << "Landlock leaves it no file";
  EXPECT_EQ(read_file(victim, 100), "untouched");
  EXPECT_FALSE(fs::exists(victim.string() + ".new"));
}

TEST(Answers, AreRefusedOrHarmlessFromAHijackedReader) {
  ReadingAnswer answer;
  answer.kind = ReadingAnswer::Kind::kPicture;
  answer.source.format = "openexr";
  answer.source.channels = {"R", "G", "B"};
  answer.source.chromaticities = {0.5, 0.25};
  answer.source.data = answer.source.display = {0, 0, 3, 2};
  answer.width = 3;
  answer.height = 2;
  const std::string whole = pack(answer);
  EXPECT_EQ(unpack_answer(whole).source.channels, answer.source.channels);
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(unpack_answer(whole.substr(0, length)), std::runtime_error) << length;
  EXPECT_THROW(unpack_answer(whole + "x"), std::runtime_error);
  for (const int orientation : {-1, 0, 9}) {
    ReadingAnswer odd = answer;
    odd.source.orientation = orientation;
    EXPECT_THROW(unpack_answer(pack(odd)), std::runtime_error);
  }
  std::mt19937 random(18);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string changed = whole;
    for (int flips = 0; flips <= i % 4; ++flips)
      changed[random() % changed.size()] = char(random());
    try {
      const ReadingAnswer read = unpack_answer(changed);
      if (read.kind != ReadingAnswer::Kind::kPicture) continue;
      EXPECT_GE(read.source.orientation, 1);
      EXPECT_LE(read.source.orientation, 8);
      EXPECT_GE(read.width, 1u);
      EXPECT_LE(read.width * read.height, std::uint64_t(kMaxImagePixels));
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace lobelia
