// Templates for machines that the tests do not have: the script inside, and the shape of the files around it.
#include <regex>

#include "tests/packages/installed_tree.hpp"
#include "tests/test.hpp"

namespace packages {
namespace {

using ::testing::HasSubstr;

const fs::path kRoot = LOBELIA_SOURCE_DIR;

class CiScript : public testing::Test {
 protected:
  void SetUp() override {
    const InstalledTree& tree = installed_tree();
    const std::string scene =
        "\"$PREFIX/share/lobelia/scenes/oblique_45.xml\" --width 64 --height 64";
    const Ran made = tree.shell("rm -rf a b r && mkdir a b && lobelia render " + scene +
                                " -o b/x.exr && lobelia render " + scene + " -o a/x.exr");
    ASSERT_EQ(made.exit_code, 0) << made.output;
  }
  Ran compare(const std::string& arguments, const std::string& before = "") {
    return installed_tree().shell(before + house::quoted(kRoot / "tools/packaging/ci/compare") +
                                  " " + arguments);
  }
};

TEST_F(CiScript, PassesAndFailsAsLobeliaCompare) {
  const Ran same = compare("a b 'the report'");
  EXPECT_EQ(same.exit_code, 0) << same.output;
  for (const char* file : {"the report/report.xml", "the report/index.html"})
    EXPECT_TRUE(fs::exists(installed_tree().work() / file)) << file;
  ASSERT_EQ(installed_tree()
                .shell("lobelia render \"$PREFIX/share/lobelia/scenes/oblique_45.xml\" --width 64 "
                       "--height 64 --model modified_phong -o a/x.exr")
                .exit_code,
            0);
  EXPECT_EQ(compare("a b r", "GITHUB_STEP_SUMMARY=summary ").exit_code, 1);
  EXPECT_EQ(read(installed_tree().work() / "summary"), "Lobelia: differs\n");
  EXPECT_EQ(compare("a b r --fail max_rel_peak=1 --no-default-limits").exit_code, 0);
  ASSERT_EQ(installed_tree().shell("cp b/x.exr a/x.exr && cp b/x.exr a/new.exr").exit_code, 0);
  EXPECT_EQ(compare("a b r").exit_code, 1) << "nothing judged new.exr";
  EXPECT_EQ(compare("a b r --missing-reference notice").exit_code, 0);
}

TEST_F(CiScript, SaysHowItIsUsed) {
  const Ran ran = compare("a b");
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.output, HasSubstr("RENDERS REFERENCES REPORT"));
  EXPECT_EQ(compare("missing b r").exit_code, 3);
}

TEST(Scripts, HaveNoMistakeThatBashOrShellcheckFinds) {
  // The commands of the Dockerfile, as a script.
  std::string docker = "#!/bin/sh\n";
  for (const std::string& line : house::lines(read(kRoot / "Dockerfile")))
    if (line.starts_with("RUN ")) docker += line.substr(4) + "\n";
  const fs::path commands = installed_tree().work() / "docker.sh";
  write(commands, docker);
  for (const fs::path& script :
       {kRoot / "tools/packaging/ci/compare", kRoot / "tools/packaging/python/postinst",
        kRoot / "tools/packaging/python/prerm", kRoot / "tools/install",
        kRoot / "tests/packages/first_steps.sh", kRoot / "tests/packages/fresh_root.sh",
        commands}) {
    const std::string file = house::quoted(script);
    const Ran parsed = run("bash -n " + file);
    EXPECT_EQ(parsed.exit_code, 0) << parsed.output;
    if (!has_program("shellcheck")) GTEST_SKIP() << "shellcheck is not installed";
    const Ran checked = run("shellcheck " + file);
    EXPECT_EQ(checked.exit_code, 0) << checked.output;
  }
}

TEST(Scripts, NamePackagesThatAreMade) {
  const std::string docker = read(kRoot / "Dockerfile");
  static const std::regex package("/tmp/([a-z0-9]+)_\\*\\.deb");
  const std::string made = read(kBuild / "CPackConfig.cmake");
  int count = 0;
  for (std::sregex_iterator it(docker.begin(), docker.end(), package), end; it != end; ++it) {
    ++count;
    EXPECT_THAT(made, HasSubstr("PACKAGE_NAME \"" + (*it)[1].str() + "\""));
  }
  EXPECT_EQ(count, 2);
}

}  // namespace
}  // namespace packages
