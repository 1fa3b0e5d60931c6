// Every command under small limits of memory, threads, files and their size: it does its work, or says what to raise.
#include "run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kTakesTerabytes = true;  // of address space
#else
constexpr bool kTakesTerabytes = false;
#endif

/// The dynamic linker's exit code, which comes before any of ours.
constexpr int kNotLoaded = 127;

class ResourceLimits : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_grid(directory_.path());
    const auto made = run_shell(
        "\"$LOBELIA\" render -q \"$SCENES\"head_on.xml --width 64 --height 64 -o a.exr &&\n"
        "\"$LOBELIA\" render -q \"$SCENES\"oblique_45.xml --width 64 --height 64 -o b.exr &&\n"
        "\"$LOBELIA\" farm grid.xml -q -o run",
        directory_.path());
    ASSERT_EQ(made.exit_code, 0) << made.output_tail;
  }
  fs::path path(const std::string& name) const { return directory_.path() / name; }

  /// The environment that limits a program to so many threads, as a shell writes it before the command.
  std::string with_threads(int threads) const {
    const fs::path library = path("few_threads.so");  // LD_PRELOAD takes paths apart at blanks
    if (!fs::exists(library)) fs::create_symlink(LOBELIA_FEW_THREADS, library);
    return "THREADS_ALLOWED=" + std::to_string(threads) +
           " ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" + library.string();
  }

  /// Each command after `limit`, a line of shell. Counts those that did their work.
  void expect_work_or_a_sentence(const std::string& limit) {
    struct Command {
      const char* arguments;
      int exit_code;
    };
    for (
        const auto& [arguments, exit_code] : {
            Command{"render \"$SCENES\"oblique_45.xml --width 64 --height 64 -q -o out.exr", 0},
            {"render \"$SCENES\"oblique_45.xml --png out.png -q -o out.exr", 0},
            {"render \"$SCENES\"two_lights.xml --samples 4 -q -o out.exr", 0},
            {"render \"$SCENES\"head_on.xml --width 64 --height 64 --accuracy de2000=1 -q -o out.exr",
             0},
            {"compare a.exr b.exr", 1},
            {"farm grid.xml -q -o out", 0},
            {"farm verify run", 0},
            {"gallery run -o out", 0},
        }) {
      const auto result =
          run_shell("(" + limit + "; exec \"$LOBELIA\" " + arguments +
                        ") > /dev/null; code=$?; rm -rf out out.exr out.png out.json; exit $code",
                    directory_.path());
      const std::string& errors = result.output_tail;
      const std::string what = limit + "; " + arguments + "\n" + errors;
      if (result.exit_code == exit_code) {
        ++done_;
        continue;
      }
      ++refused_;
      if (result.exit_code == kNotLoaded) {
        // The loader's own words, in one of two of its places.
        EXPECT_TRUE(errors.find("error while loading shared libraries") != errors.npos ||
                    errors == "out of memory\n")
            << what;
        continue;
      }
      EXPECT_TRUE(result.exit_code == 71 || result.exit_code == 3 || result.exit_code == 4)
          << result.exit_code << " " << what;
      EXPECT_TRUE(errors.starts_with("lobelia: ")) << what;
      if (result.exit_code == 71) {
        EXPECT_THAT(errors, HasSubstr("ulimit -")) << what;
      }
    }
  }

  TemporaryDirectory directory_;
  int done_ = 0, refused_ = 0;
};

TEST_F(ResourceLimits, OnMemoryEndInWorkOrASentence) {
  if (kTakesTerabytes) GTEST_SKIP() << "a sanitizer takes more address space than any limit";
  for (const int megabytes :
       {50, 75, 100, 125, 150, 200, 250, 300, 400, 500, 600, 800, 1000, 1500, 2000})
    expect_work_or_a_sentence("ulimit -v " + std::to_string(megabytes * 1000));
  for (const int megabytes : {1, 5, 20, 80, 300})
    expect_work_or_a_sentence("ulimit -d " + std::to_string(megabytes * 1000));
  EXPECT_GT(done_, 5);
  EXPECT_GT(refused_, 5);
}

TEST_F(ResourceLimits, OnThreadsEndInWorkOrASentence) {
  for (const int threads : {0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 24})
    expect_work_or_a_sentence("export " + with_threads(threads));
  EXPECT_GT(done_, 30) << "only pictures and thumbnails need more than the first";
  EXPECT_GT(refused_, 0) << "the limit holds";
}

TEST_F(ResourceLimits, OnThreadsLetASmallPictureBeRendered) {
  for (const std::string more : {"", "--png c.png", "--accuracy de2000=1", "--accuracy 1e-3"}) {
    const auto small = run_shell(
        with_threads(1) +
            " \"$LOBELIA\" render \"$SCENES\"oblique_45.xml --width 64 --height 64 -q -o c.exr " +
            more,
        directory_.path());
    EXPECT_EQ(small.exit_code, 0) << more << "\n" << small.output_tail;
    if (more.empty()) {
      EXPECT_EQ(read_file(path("c.exr"), 1 << 20), read_file(path("b.exr"), 1 << 20));
    }
  }
}

TEST_F(ResourceLimits, OnOpenFilesEndInWorkOrASentence) {
  for (const int files : {4, 5, 6, 7, 8, 10, 12, 16, 24, 32, 64})
    expect_work_or_a_sentence("ulimit -n " + std::to_string(files));
  EXPECT_GT(done_, 10);
  EXPECT_GT(refused_, 3);
}

TEST_F(ResourceLimits, OnFileSizeAreAnErrorOfWriting) {
  for (const int blocks : {0, 1, 4})
    expect_work_or_a_sentence("ulimit -f " + std::to_string(blocks));
  EXPECT_GT(refused_, 3);
}

}  // namespace
}  // namespace lobelia
