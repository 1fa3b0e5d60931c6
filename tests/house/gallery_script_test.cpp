// tools/gallery with a program that only writes down how it was called.
#include <sys/wait.h>

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"
#include "tests/test.hpp"

namespace house {
namespace {

using ::testing::EndsWith;

class GalleryScript : public ::testing::Test {
 protected:
  /// Runs the script with commands that exit with `gallery_status` and `cost_status`, all others with `farm_status`;
  /// returns the script's exit code.
  int run(int farm_status, int gallery_status = 0, int cost_status = 0) {
    const fs::path program = scratch_ / "lobelia";
    write(
        program,
        "#!/bin/sh\necho \"$1|$2|$3\" >> \"$(dirname \"$0\")/calls\"\nif [ $1 = gallery ]; then echo \"$2/index.html\"; exit " +
            std::to_string(gallery_status) + "; fi\n[ $1 != cost ] || exit " +
            std::to_string(cost_status) +
            "\n"
            "echo \"$1|$2|$3|$4\"\n[ $1 != farm ] || mkdir -p \"$4\"\nexit " +
            std::to_string(farm_status) + "\n");
    fs::permissions(program, fs::perms::owner_all);
    const std::string command = quoted(LOBELIA_SOURCE_DIR "/tools/gallery") + " " +
                                quoted(program) + " grid.xml " + quoted(scratch_ / "a place") +
                                " > " + quoted(scratch_ / "said") + " 2> " +
                                quoted(scratch_ / "told");
    const int status = std::system(command.c_str());
    said = read(scratch_ / "said");
    calls = read(scratch_ / "calls");
    told = read(scratch_ / "told");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  Scratch scratch_;
  std::string said, calls, told;
};

TEST_F(GalleryScript, ExitsWithTheWorstFailure) {
  struct Case {
    const char* what;
    int farm, gallery, cost, exit_code;
  };
  for (const auto& [what, farm, gallery, cost, exit_code] :
       {Case{"nothing fails", 0, 0, 0, 0}, Case{"cells differ", 1, 0, 0, 1},
        Case{"cells are not what the farm wrote", 0, 1, 0, 1},
        Case{"a job failed, and cells are not what the farm wrote", 4, 1, 0, 4},
        Case{"cells differ, and the gallery cannot be written", 1, 4, 0, 4},
        Case{"a view cannot be measured", 0, 0, 1, 4},
        Case{"cells differ, and a view cannot be measured", 1, 0, 1, 1}}) {
    EXPECT_EQ(run(farm, gallery, cost), exit_code) << what;
    EXPECT_THAT(said, HasSubstr("farm|grid.xml|-o|")) << what;
    EXPECT_THAT(said, EndsWith("/a place/index.html\n")) << what;
  }
}

TEST_F(GalleryScript, RefreshesTheGalleryAfterMeasurements) {
  EXPECT_EQ(run(0), 0);
  const std::size_t first = calls.find("gallery|"), last = calls.rfind("gallery|");
  EXPECT_LT(calls.find("farm|"), first);
  for (const char* measured :
       {"models|", "search|", "verify|stability|", "verify|paper|", "cost|"}) {
    EXPECT_LT(first, calls.find(measured)) << measured;
    EXPECT_GT(last, calls.find(measured)) << measured;
  }
  for (const char* measured : {"search", "stability", "paper", "cost"})
    EXPECT_THAT(told, HasSubstr("gallery: measuring " + std::string(measured) + "; about "));
}

TEST_F(GalleryScript, MakesNoGalleryOfAnInterruptedFarm) {
  EXPECT_EQ(run(130), 130);
  EXPECT_THAT(said, Not(HasSubstr("index.html")));
}

TEST_F(GalleryScript, LeavesTheGalleryOfTheFarmIfAViewIsInterrupted) {
  EXPECT_EQ(run(0, 0, 130), 130);
  EXPECT_EQ(calls.find("gallery|"), calls.rfind("gallery|"));
  EXPECT_THAT(said, EndsWith("/a place/index.html\n"));
}

TEST_F(GalleryScript, MeasuresOnlyTheMissingFilesOfViews) {
  write(scratch_ / "a place/paper/paper.json", "{}");
  EXPECT_EQ(run(0), 0);
  EXPECT_THAT(calls, HasSubstr("models|--tables|"));
  EXPECT_THAT(calls, HasSubstr("verify|stability|"));
  EXPECT_THAT(calls, Not(HasSubstr("verify|paper|")));
}

}  // namespace
}  // namespace house
