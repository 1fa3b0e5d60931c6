// `cmake --install`, `make install` and `make uninstall`.
#include "tests/packages/installed_tree.hpp"
#include "tests/test.hpp"

namespace packages {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::string kScene = "\"$PREFIX/share/lobelia/scenes/oblique_45.xml\"";

TEST(Installed, ProgramRendersComparesAndProfilesWhereItWasMoved) {
  const InstalledTree& tree = installed_tree();
  const Ran rendered = tree.shell("lobelia render " + kScene + " -o ours.exr --png ours.png");
  ASSERT_EQ(rendered.exit_code, 0) << rendered.output;
  const Ran analytic = tree.shell("lobelia reference " + kScene + " --engine analytic -o b.exr");
  ASSERT_EQ(analytic.exit_code, 0) << analytic.output;
  const Ran compared = tree.shell("lobelia compare ours.exr b.exr");
  EXPECT_EQ(compared.exit_code, 0) << compared.output;
  EXPECT_THAT(compared.output, HasSubstr("verdict: pass"));
  // PNG by the plug-in, in the picture reader's process.
  EXPECT_EQ(tree.shell("lobelia compare ours.png ours.png").exit_code, 0);
  const Ran profiled = tree.shell("lobelia profile ours.exr b.exr --scene " + kScene);
  EXPECT_EQ(profiled.exit_code, 0) << profiled.output;
  EXPECT_THAT(profiled.output, HasSubstr("analytic"));
}

TEST(Installed, FarmRendersAnInstalledGrid) {
  const InstalledTree& tree = installed_tree();
  const Ran planned =
      tree.shell("lobelia farm \"$PREFIX/share/lobelia/grids/sphere_grid.xml\" --dry-run -o farm");
  EXPECT_EQ(planned.exit_code, 0) << planned.output;
}

TEST(Installed, DataAndPagesAreThoseOfTheSource) {
  const fs::path share = installed_tree().prefix() / "share", source = LOBELIA_SOURCE_DIR;
  const auto expect_same = [&](const fs::path& installed, const fs::path& from) {
    std::size_t count = 0;
    for (const fs::path& file : house::project_files(source / from)) {
      ++count;
      EXPECT_EQ(read(share / installed / file), read(source / from / file));
    }
    EXPECT_GT(count, 0u) << from;
  };
  expect_same("lobelia/scenes", "reference_scenes/scenes");
  expect_same("lobelia/grids", "reference_scenes/grids");
  expect_same("lobelia/schemas", "docs/reference");
  expect_same("doc/lobelia/docs", "docs");
  // Files that the program wrote.
  for (const char* file :
       {"lobelia/schemas/render.schema.json", "doc/lobelia/docs/reference/README.md",
        "doc/lobelia/docs/reference/render.md"})
    EXPECT_TRUE(fs::exists(share / file)) << file;
}

TEST(Installed, FilesNameNeitherSourceNorBuild) {
  for (const auto& entry : fs::recursive_directory_iterator(installed_tree().prefix()))
    if (entry.is_regular_file()) {
      EXPECT_THAT(read(entry.path()), Not(HasSubstr(LOBELIA_SOURCE_DIR))) << entry.path();
    }
}

// ---- make install and make uninstall

class Uninstall : public testing::Test {
 protected:
  void SetUp() override {
    ::unsetenv("DESTDIR");
    write(prefix / "bin/other", "foreign");
    write(prefix / "share/lobelia/scenes/mine.xml", "foreign");
    const Ran ran = install();
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
    ASSERT_TRUE(fs::exists(prefix / "bin/lobelia"));
  }
  Ran install() { return run(script + house::quoted(kBuild) + " " + house::quoted(prefix)); }
  Ran uninstall() { return run(script + "--remove " + house::quoted(prefix)); }

  Scratch scratch;
  const fs::path prefix = scratch / "it's a $PREFIX ü";
  const std::string script = house::quoted(LOBELIA_SOURCE_DIR "/tools/install") + " ";
};

TEST_F(Uninstall, LeavesForeignFiles) {
  const Ran ran = uninstall();
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_THAT(files_below(prefix),
              testing::ElementsAre("bin/other", "share/lobelia/scenes/mine.xml"));
  EXPECT_FALSE(fs::exists(prefix / "lib/lobelia"));
  EXPECT_EQ(uninstall().exit_code, 3) << "there is nothing left";
}

TEST_F(Uninstall, KeepsAChangedFileAndSaysSo) {
  write(prefix / "share/lobelia/scenes/oblique_45.xml", "changed");
  const Ran ran = uninstall();
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_THAT(ran.output, HasSubstr("scenes/oblique_45.xml"));
  EXPECT_EQ(read(prefix / "share/lobelia/scenes/oblique_45.xml"), "changed");
  EXPECT_FALSE(fs::exists(prefix / "bin/lobelia"));
}

TEST_F(Uninstall, FollowsNoLink) {
  // The same files elsewhere, and a link to them in the place of ours.
  const fs::path elsewhere = scratch / "elsewhere";
  fs::rename(prefix / "share/lobelia/grids", elsewhere);
  fs::create_directory_symlink(elsewhere, prefix / "share/lobelia/grids");
  fs::rename(prefix / "bin/lobelia", elsewhere / "lobelia");
  fs::create_symlink(elsewhere / "lobelia", prefix / "bin/lobelia");
  EXPECT_EQ(uninstall().exit_code, 4);
  EXPECT_TRUE(fs::exists(elsewhere / "sphere_grid.xml"));
  EXPECT_TRUE(fs::exists(elsewhere / "lobelia"));
  EXPECT_TRUE(fs::is_symlink(prefix / "bin/lobelia"));
}

TEST_F(Uninstall, RemovesFilesOfTheOldVersion) {
  // A file of an older version, as its list has it.
  write(prefix / "share/lobelia/scenes/old.xml", "old");
  const std::string sum = run("printf old | sha256sum | cut -c -64").output;
  const fs::path list = prefix / "share/lobelia/installed.txt";
  write(list, read(list) + sum.substr(0, 64) + " share/lobelia/scenes/old.xml\n");
  ASSERT_EQ(install().exit_code, 0);
  EXPECT_FALSE(fs::exists(prefix / "share/lobelia/scenes/old.xml"));
  EXPECT_EQ(uninstall().exit_code, 0);
}

}  // namespace
}  // namespace packages
