// The Debian packages: made by CPack, looked at by lintian, and installed, run and purged below a directory of the test.
#include <gmock/gmock.h>
#include <unistd.h>

#include "tests/packages/installed_tree.hpp"

namespace packages {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Debian : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!has_program("dpkg-shlibdeps") || !fs::exists(kBuild / "CPackConfig.cmake")) return;
    made = new Scratch;
    const Ran ran =
        run("cd " + house::quoted(kBuild) + " && cpack -B " + house::quoted(made->path()));
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
  }
  static void TearDownTestSuite() {
    delete made;
    made = nullptr;
  }
  void SetUp() override {
    if (!made) GTEST_SKIP() << "this is no Debian with dpkg-dev";
  }

  static std::string deb(const std::string& package) {
    std::string found;
    for (const auto& entry : fs::directory_iterator(made->path()))
      if (entry.path().filename().string().starts_with(package + "_")) found = entry.path();
    EXPECT_THAT(found, Not(IsEmpty())) << package;
    return house::quoted(found);
  }
  static std::string field(const std::string& package, const std::string& name) {
    return run("dpkg-deb --field " + deb(package) + " " + name).output;
  }
  static std::string library() {
    for (const auto& entry : fs::directory_iterator(made->path())) {
      const std::string name = entry.path().filename();
      if (name.starts_with("liblobelia") && !name.starts_with("liblobelia-"))
        return name.substr(0, name.find('_'));
    }
    return "";
  }
  static std::string all() { return house::quoted(made->path()) + "/*.deb"; }

  static Scratch* made;
};
Scratch* Debian::made = nullptr;

TEST_F(Debian, packages_depend_on_what_they_need) {
  EXPECT_THAT(field(library(), "Depends"), HasSubstr("libopenimageio"));
  EXPECT_THAT(field("lobelia", "Depends"), HasSubstr(library() + " (= "));
  EXPECT_THAT(field("lobelia", "Depends"), HasSubstr("libembree"));
  EXPECT_THAT(field("lobelia", "Depends"), Not(HasSubstr("povray")));
  for (const char* engine : {"povray", "blender"})
    EXPECT_THAT(field("lobelia", "Recommends"), HasSubstr(engine));
  EXPECT_THAT(field("liblobelia-dev", "Depends"), HasSubstr(library() + " (= "));
  EXPECT_THAT(field("lobelia-doc", "Architecture"), HasSubstr("all"));
}

TEST_F(Debian, lintian_finds_no_error) {
  if (!has_program("lintian")) GTEST_SKIP() << "lintian is not installed";
  const Ran ran =
      run("LC_ALL=C.UTF-8 lintian --allow-root --fail-on error --tag-display-limit 0 " + all());
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
}

/// dpkg with a root and a database of its own: nothing of the machine is touched. The maintainer scripts run without
/// chroot, and find an ldconfig that does nothing.
TEST_F(Debian, packages_are_installed_run_and_purged) {
  if (::geteuid() != 0) GTEST_SKIP() << "dpkg needs root";
  Scratch scratch;
  const fs::path root = scratch / "root";
  write(root / "var/lib/dpkg/status", "");
  fs::create_directories(root / "var/lib/dpkg/updates");
  fs::create_directories(root / "var/lib/dpkg/info");
  write(root / "usr/bin/other", "foreign");
  write(root / "usr/share/lobelia/scenes/mine.xml", "foreign");
  write(scratch / "bin/ldconfig", "#!/bin/sh\n");
  fs::permissions(scratch / "bin/ldconfig", fs::perms::owner_all);
  const std::string dpkg = "PATH=" + house::quoted(scratch / "bin") +
                           ":$PATH dpkg --root=" + house::quoted(root) +
                           " --force-depends --force-script-chrootless --log=/dev/null ";
  const Ran installed = run(dpkg + "--install " + all());
  ASSERT_EQ(installed.exit_code, 0) << installed.output;
  for (const char* file :
       {"usr/share/man/man1/lobelia-render.1.gz", "usr/share/zsh/vendor-completions/_lobelia",
        "usr/share/bash-completion/completions/lobelia", "usr/include/lobelia/lobelia.hpp",
        "usr/share/doc/lobelia-doc/copyright", "usr/share/lobelia/schemas/render.schema.json"})
    EXPECT_TRUE(fs::exists(root / file)) << file;

  // It finds its parts below the test's root. The libraries of others are the machine's.
  const std::string lobelia = "env -i " + house::quoted(root / "usr/bin/lobelia") + " ";
  const std::string scene = house::quoted(root / "usr/share/lobelia/scenes/oblique_45.xml");
  const std::string picture = house::quoted(scratch / "a.exr"),
                    eye = house::quoted(scratch / "a.png");
  const Ran ran = run(lobelia + "render " + scene + " -o " + picture + " --png " + eye + " && " +
                      lobelia + "compare " + eye + " " + eye + " && " + lobelia + "profile " +
                      picture + " --scene " + scene);
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_THAT(ran.output, HasSubstr("verdict: pass"));

  const Ran purged = run(dpkg + "--purge lobelia lobelia-doc liblobelia-dev " + library());
  EXPECT_EQ(purged.exit_code, 0) << purged.output;
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(root / "usr"))
    if (!entry.is_directory()) left.push_back(entry.path().lexically_relative(root).string());
  std::sort(left.begin(), left.end());
  EXPECT_THAT(left, testing::ElementsAre("usr/bin/other", "usr/share/lobelia/scenes/mine.xml"));
}

}  // namespace
}  // namespace packages
