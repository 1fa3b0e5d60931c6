// The Debian packages: made by CPack, looked at by lintian, and installed, run and purged below a directory of the test.
#include <unistd.h>

#include "tests/packages/installed_tree.hpp"
#include "tests/test.hpp"

namespace packages {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const fs::path kTests = fs::path(LOBELIA_SOURCE_DIR) / "tests/packages";

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
  static bool has_python() { return fs::exists(kBuild / "python"); }
  static std::string all() { return house::quoted(made->path()) + "/*.deb"; }

  /// By programs and module below `prefix` alone: renders, compares, makes a gallery, runs the tutorial.
  static void take_first_steps(const fs::path& prefix, const fs::path& place) {
    if (run("/usr/bin/python3 -c 'import matplotlib, pandas'").exit_code != 0) return;
    fs::create_directory(place);
    const Ran ran = run("cd " + house::quoted(place) + " && env -i HOME=" + house::quoted(place) +
                        " PATH=/usr/bin:/bin sh " + house::quoted(kTests / "first_steps.sh") + " " +
                        house::quoted(prefix));
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
  }

  static Scratch* made;
};
Scratch* Debian::made = nullptr;

TEST_F(Debian, DeclaresItsDependencies) {
  for (const char* needed : {"libopenimageio", "libopencolorio", "libembree", "libglpk"})
    EXPECT_THAT(field(library(), "Depends"), HasSubstr(needed)) << "for its modules";
  EXPECT_THAT(field("lobelia", "Depends"), HasSubstr(library() + " (= "));
  EXPECT_THAT(field("lobelia", "Depends"), HasSubstr("libisal"));
  EXPECT_THAT(field("lobelia", "Depends"), Not(HasSubstr("povray")));
  for (const char* engine : {"povray", "blender"})
    EXPECT_THAT(field("lobelia", "Recommends"), HasSubstr(engine));
  EXPECT_THAT(field("liblobelia-dev", "Depends"), HasSubstr(library() + " (= "));
  EXPECT_THAT(field("lobelia-doc", "Architecture"), HasSubstr("all"));
  if (!has_python()) return;
  for (const char* needed : {"python3 (>= 3.", "python3 (<< 3.", "python3-numpy", "libisal"})
    EXPECT_THAT(field("python3-lobelia", "Depends"), HasSubstr(needed));
  for (const char* optional : {"lobelia (= ", "python3-matplotlib", "python3-pytest"})
    EXPECT_THAT(field("python3-lobelia", "Recommends"), HasSubstr(optional));
  EXPECT_THAT(field("python3-lobelia", "Suggests"), HasSubstr("python3-pandas"));
}

TEST_F(Debian, PackagesHaveNoErrorThatLintianFinds) {
  if (!has_program("lintian")) GTEST_SKIP() << "lintian is not installed";
  const Ran ran =
      run("LC_ALL=C.UTF-8 lintian --allow-root --fail-on error --tag-display-limit 0 " + all());
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
}

/// dpkg with a root and a database of its own: nothing of the machine is touched. The maintainer scripts run without
/// chroot, and find an ldconfig that does nothing.
TEST_F(Debian, PackagesAreInstalledRunAndPurged) {
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
       {"usr/share/man/man1/lobelia-render.1.gz", "usr/share/bash-completion/completions/lobelia",
        "usr/include/lobelia/lobelia.hpp", "usr/include/lobelia/highlight.hpp",
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

  if (has_python()) take_first_steps(root / "usr", scratch / "first");
  const Ran purged = run(dpkg + "--purge lobelia lobelia-doc liblobelia-dev " + library() +
                         (has_python() ? " python3-lobelia" : ""));
  EXPECT_EQ(purged.exit_code, 0) << purged.output;
  EXPECT_THAT(files_below(root / "usr"),
              testing::ElementsAre("bin/other", "share/lobelia/scenes/mine.xml"));
}

/// In a root of its own, of which nothing is the machine's. It takes minutes and a network.
TEST_F(Debian, PackagesAreAllThatAFreshDebianNeeds) {
  if (!std::getenv("LOBELIA_FRESH_ROOT")) GTEST_SKIP() << "LOBELIA_FRESH_ROOT is not set";
  Scratch scratch;
  const Ran ran = run("sh " + house::quoted(kTests / "fresh_root.sh") + " " +
                      house::quoted(made->path()) + " " + house::quoted(scratch.path()));
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
}

}  // namespace
}  // namespace packages
