#include "run_lobelia.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

std::string bytes(const std::filesystem::path& path) { return read_file(path, 1 << 28); }

TEST(RenderCommand, WarnsOutsideThePapersExponents) {
  const TemporaryDirectory directory;
  const auto render = [&](const char* exponent, const char* normalisation) {
    return run_lobelia({"render", kScenes + "head_on.xml", "--width", "8", "--height", "8",
                        "--exponent", exponent, "--normalisation", normalisation, "-o", "out.exr"},
                       directory.path());
  };
  for (const char* exponent : {"15.9", "1025"}) {
    const auto result = render(exponent, "paper");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output_tail, HasSubstr(std::string("warning: exponent ") + exponent));
    EXPECT_THAT(result.output_tail, HasSubstr("for 16 to 1024"));
    const Json record = read_json(directory.path() / "out.json");
    EXPECT_TRUE(record.at("highlights").at(0).contains("warning"));
    EXPECT_THAT(render(exponent, "exact").output_tail, testing::Not(HasSubstr("warning")));
  }
  for (const char* exponent : {"16", "1024"})
    EXPECT_THAT(render(exponent, "paper").output_tail, testing::Not(HasSubstr("warning")));
}

TEST(RenderCommand, KeepsTheOldPictureAndNothingElseOnAFullDisk) {
  const TemporaryDirectory directory;
  write_file(directory.path() / "x.exr", "old");
  // A limit of 8 blocks of 512 bytes stands in for the disk.
  const auto result = run_shell(
      "ulimit -f 8; \"$LOBELIA\" render \"$SCENES\"two_lights.xml -q -o x.exr", directory.path());
  EXPECT_EQ(result.exit_code, 4) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr("x.exr: cannot write: File too large"));
  EXPECT_EQ(bytes(directory.path() / "x.exr"), "old");
  EXPECT_EQ(files_in(directory.path()), 1u);
}

TEST(RenderCommand, Renders16384x16384PixelsWithin1GiBOfMemory) {
  const TemporaryDirectory directory;
  const auto result = run_lobelia({"render", kScenes + "head_on.xml", "--width", "16384",
                                   "--height", "16384", "-q", "-o", "x.exr", "--png", "x.png"},
                                  directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_EQ(files_in(directory.path()), 3u);
  EXPECT_LT(result.peak_memory_bytes, std::uint64_t{1} << 30);
}

TEST(RenderCommand, RefusesOptionsThatNeedTooMuchMemory) {
  const TemporaryDirectory directory;
  const auto render = [&](std::vector<std::string> more, const char* side = "16384") {
    std::vector<std::string> arguments{
        "render", kScenes + "oblique_45.xml", "--width", side, "--height", side, "-q", "-o",
        "x.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = run_lobelia(arguments, directory.path());
    EXPECT_EQ(files_in(directory.path()), 0u);
    return std::pair(result.exit_code, result.output_tail);
  };
  using testing::Pair;
  const auto says = HasSubstr(
      "a picture of 16384 x 16384 is too large to be held in memory; allowed: 134217728 pixels");
  EXPECT_THAT(render({"--standard-error", "e.exr"}), Pair(2, says));
  EXPECT_THAT(render({"--accuracy", "1e-3"}), Pair(2, says));
  EXPECT_THAT(render({"--time-limit", "9", "--samples", "4"}), Pair(3, says));
  EXPECT_THAT(render({}, "16385"), Pair(2, HasSubstr("are too many; allowed: 268435456 in all")));
}

/// Writes the number that /proc has for this shell into the file `process`; in a PID namespace $$ is another.
const std::string kTellProcess = "read process rest < /proc/self/stat; echo $process > process; ";
/// Waits until that process catches signals: the bit of SIGINT in its mask.
const std::string kWhenItListens =
    "when_it_listens() {\n"
    "  until [ -s process ]; do sleep 0.05; done\n"
    "  until grep -q '^SigCgt:.*[2367abef]$' /proc/$(cat process)/status; do\n"
    "    [ -d /proc/$(cat process) ] || exit 99\n"
    "    sleep 0.05\n"
    "  done\n"
    "  rm process\n"
    "}\n";
const std::string kLongRender =
    "\"$LOBELIA\" render \"$SCENES\"oblique_45.xml --width 4096 --height 4096 --samples 4096 -q -o x.exr --png x.png";

TEST(RenderCommand, TakesTwoSignalsInOneBreathForOneWish) {
  const TemporaryDirectory directory;
  const auto result =
      run_shell(kWhenItListens + "{ " + kTellProcess + "exec " + kLongRender +
                    "; } & job=$!\nwhen_it_listens; "
                    // Both wait for a stopped process, however slow this shell is.
                    "for signal in STOP TERM INT CONT; do kill -$signal $job; done; wait $job",
                directory.path());
  // Either may come first.
  EXPECT_THAT(result.exit_code, testing::AnyOf(143, 130)) << result.output_tail;
  EXPECT_EQ(result.output_tail, "lobelia: interrupted\n");
}

TEST(RenderCommand, NamesTheMissingModuleAndRendersWithoutIt) {
  // They are loaded only when they are needed: help, plans and EXRs need none.
  const TemporaryDirectory directory;
  const auto result = run_shell(
      "scene=\"$SCENES\"head_on.xml; cp \"$LOBELIA\" ./lobelia && ./lobelia plan \"$scene\" && "
      "./lobelia render \"$scene\" -q -o x.exr && ./lobelia render \"$scene\" -q -o y.exr --png y.png",
      directory.path());
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.output_tail, HasSubstr("camera rays        65536"));
  EXPECT_THAT(result.output_tail,
              HasSubstr("lobelia_png.so is neither beside " +
                        std::filesystem::canonical(directory.path() / "lobelia").string()));
  EXPECT_TRUE(std::filesystem::exists(directory.path() / "x.exr"));
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "y.png"));
}

}  // namespace
}  // namespace lobelia
