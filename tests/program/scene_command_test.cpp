// lobelia scene, as a user runs it.
#include "tests/program/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class SceneCommand : public testing::Test {
 protected:
  ProcessResult run(const std::string& arguments) {
    return run_shell("\"$LOBELIA\" scene " + arguments, directory_.path());
  }
  std::string text(const std::string& file) { return read_file(directory_.path() / file, 1 << 24); }
  const TemporaryDirectory directory_;
};

TEST_F(SceneCommand, WritesOneFileToStandardOutputOrToAFile) {
  EXPECT_EQ(run("\"$SCENES\"oblique_45.xml --to json > a.json").exit_code, 0);
  EXPECT_EQ(run("\"$SCENES\"oblique_45.xml --to json -o b.json").exit_code, 0);
  EXPECT_EQ(text("a.json"), text("b.json"));
  EXPECT_THAT(text("a.json"), HasSubstr("\"kind\": \"scene\""));
  EXPECT_EQ(run("\"$SCENES\"oblique_45.xml --to json -o folder/").exit_code, 0);
  EXPECT_EQ(text("folder/scene.json"), text("a.json"));
}

TEST_F(SceneCommand, WritesSeveralFilesToADirectoryOnly) {
  const auto refused = run("\"$SCENES\"oblique_45.xml --to povray");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output_tail, HasSubstr("-o DIR"));
  EXPECT_EQ(run("\"$SCENES\"oblique_45.xml --to povray -o new/deep").exit_code, 0);
  EXPECT_THAT(text("new/deep/pass0.pov"), HasSubstr("Lobelia_Sphere"));
  write_file(directory_.path() / "file", "mine");
  EXPECT_EQ(run("\"$SCENES\"oblique_45.xml --to povray -o file").exit_code, 2);
  EXPECT_EQ(text("file"), "mine");
}

TEST_F(SceneCommand, NeverWritesOverTheSceneThatItReads) {
  EXPECT_EQ(run("\"$SCENES\"oblique_45.xml --to lobelia -o scene.xml").exit_code, 0);
  const std::string before = text("scene.xml");
  EXPECT_EQ(run("scene.xml --to json -o scene.xml").exit_code, 2);
  EXPECT_EQ(run("./scene.xml --to mitsuba --model modified_phong -o .").exit_code, 2);
  EXPECT_EQ(text("scene.xml"), before);
  EXPECT_EQ(files_in(directory_.path()), 1u);
}

TEST_F(SceneCommand, WritesNothingIfAFormatCannotHoldTheScene) {
  const auto refused = run("\"$SCENES\"oblique_45.xml --to mitsuba -o out");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_THAT(refused.output_tail,
              HasSubstr("cannot be written for Mitsuba 3, because material 0 is phong_rdf"));
  EXPECT_EQ(run("\"$SCENES\"oblique_45.xml --to mitsuva").exit_code, 2);
  EXPECT_THAT(run("\"$SCENES\"oblique_45.xml").output_tail, HasSubstr("--to FORMAT"));
  EXPECT_EQ(files_in(directory_.path()), 0u);
}

TEST_F(SceneCommand, WarnsOfEachUnreadPartOfAMitsubaScene) {
  ASSERT_EQ(run("\"$SCENES\"oblique_45.xml --to mitsuba --model modified_phong -o mi").exit_code,
            0);
  ASSERT_EQ(
      run("\"$SCENES\"oblique_45.xml --to lobelia --model modified_phong -o direct.xml").exit_code,
      0);
  const auto read = run("mi/scene.xml --from mitsuba -o back.xml");
  EXPECT_EQ(read.exit_code, 0);
  EXPECT_EQ(read.output_tail, "");
  EXPECT_EQ(text("back.xml"), text("direct.xml"));
  std::string changed = text("mi/scene.xml");
  changed.insert(changed.find("</scene>"), "<shape type=\"teapot\"/>\n");
  write_file(directory_.path() / "teapot.xml", changed);
  const auto warned = run("teapot.xml --from mitsuba -o back2.xml");
  EXPECT_EQ(warned.exit_code, 0);
  EXPECT_THAT(warned.output_tail,
              testing::ContainsRegex(
                  "warning: teapot.xml:[0-9]+:[0-9]+: <shape type=\"teapot\"> is not supported"));
  EXPECT_EQ(text("back2.xml"), text("direct.xml"));
  write_file(directory_.path() / "empty.xml", "<scene version=\"3.0.0\"/>");
  EXPECT_EQ(run("empty.xml --from mitsuba -o none.xml").exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(directory_.path() / "none.xml"));
}

TEST_F(SceneCommand, SaysThatAPictureIsNotCopied) {
  const auto warned = run("\"$SCENES\"effects/environment_map.xml --to lobelia -o out.xml");
  EXPECT_EQ(warned.exit_code, 0);
  EXPECT_THAT(warned.output_tail, HasSubstr("sky.exr, which is not copied"));
}

}  // namespace
}  // namespace lobelia
