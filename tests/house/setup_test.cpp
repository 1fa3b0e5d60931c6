// tools/setup against a made-up system: a $PATH with nothing on it but a few plain tools and
// fakes of dpkg-query, apt-get, sudo and id that only write down how they were called.
#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"
#include "tests/test.hpp"

namespace house {
namespace {

class Setup : public ::testing::Test {
 protected:
  Setup() {
    fs::create_directories(bin());
    for (const char* tool : {"bash", "env", "cat", "grep", "dirname"}) {
      fs::path real = fs::path("/bin") / tool;
      if (!fs::exists(real)) real = fs::path("/usr/bin") / tool;
      fs::create_symlink(real, bin() / tool);
    }
    // In a folder with a space in its name, as a newcomer's may be.
    fs::copy_file(fs::path(LOBELIA_SOURCE_DIR) / "tools/setup", script());
    write(scratch_ / "a clone/scripts/packages.txt",
          "# comment\n\n"
          "compiler build    turns source into programs\n"
          "library  build,test  is linked\n"
          "painter  engines  paints\n"
          "sculptor engines  sculpts\n");
    fake("id", "echo 0");
    fake("dpkg-query",
         "for name in \"$@\"; do if grep -qx \"$name\" '" + (scratch_ / "installed").string() +
             "'; then echo \"$name installed\"; fi; done; "
             "[ -e '" +
             (scratch_ / "quiet").string() + "' ] || { echo \"no packages found\" >&2; exit 1; }");
    fake("apt-get", "echo \"$*\" >> '" + calls_file() +
                        "'; "
                        "case \" $* \" in *' install '*) ;; *) exit 0;; esac; "
                        "for name in \"$@\"; do if grep -qx \"$name\" '" +
                        (scratch_ / "unavailable").string() +
                        "'; then exit 100; fi; done; "
                        "for name in \"$@\"; do echo \"$name\" >> '" +
                        (scratch_ / "installed").string() + "'; done");
    write(scratch_ / "installed", "");
    write(scratch_ / "unavailable", "");
  }

  fs::path bin() const { return scratch_ / "bin"; }
  fs::path script() {
    fs::create_directories(scratch_ / "a clone/scripts");
    return scratch_ / "a clone/scripts/setup";
  }
  std::string calls_file() const { return (scratch_ / "calls").string(); }

  void fake(const std::string& name, const std::string& body) {
    write(bin() / name, "#!" + (bin() / "bash").string() + "\n" + body + "\n");
    fs::permissions(bin() / name, fs::perms::owner_all);
  }
  void installed(const std::string& names) { write(scratch_ / "installed", names); }
  void unavailable(const std::string& names) { write(scratch_ / "unavailable", names); }

  /// Runs the script; its output, both streams together, is in `said`.
  int run(const std::string& purposes) {
    fs::remove(calls_file());
    const Ran ran = house::run("PATH=" + quoted(bin()) + " bash " + quoted(script()) + " " +
                               purposes + " < /dev/null");
    said = ran.output;
    return ran.exit_code;
  }
  /// How apt-get was called since, without the options that do not matter here.
  std::vector<std::string> apt_calls() {
    if (!fs::exists(calls_file())) return {};
    std::vector<std::string> calls;
    for (std::string line : lines(read(calls_file()))) {
      const std::size_t verb = std::min(line.find("update"), line.find("install "));
      if (verb != std::string::npos) calls.push_back(line.substr(verb));
    }
    return calls;
  }

  Scratch scratch_;
  std::string said;
};

TEST_F(Setup, DoesNothingWhenNothingIsMissing) {
  const auto expect_silence = [&](const std::string& purposes) {
    EXPECT_EQ(run(purposes), 0);
    EXPECT_EQ(said, "");
    EXPECT_THAT(apt_calls(), IsEmpty());
  };
  installed("compiler\nlibrary\n");
  expect_silence("build");
  expect_silence("test");
  // Engines that were installed another way.
  for (const char* engine : {"painter", "sculptor"}) fake(engine, "");
  expect_silence("build engines");
  for (const char* engine : {"painter", "sculptor"}) fs::remove(bin() / engine);
  installed("compiler\nlibrary\npainter\nsculptor\n");
  write(scratch_ / "quiet", "");
  expect_silence("build engines");
}

TEST_F(Setup, InstallsOnlyMissingPackages) {
  installed("compiler\npainter\n");
  EXPECT_EQ(run("build engines"), 0);
  EXPECT_THAT(apt_calls(), ElementsAre("update", "install -y --no-install-recommends library",
                                       "install -y --no-install-recommends sculptor"));
  EXPECT_THAT(said, AllOf(HasSubstr("library"), HasSubstr("is linked"), HasSubstr("sculpts")));
  EXPECT_THAT(said, Not(HasSubstr("compiler")));
  EXPECT_EQ(run("build engines"), 0);
  EXPECT_THAT(apt_calls(), IsEmpty());
}

TEST_F(Setup, CountsARemovedPackageAsMissing) {
  installed("library\n");
  fake("dpkg-query", "echo 'compiler config-files'; echo 'library installed'");
  fake("id", "echo 1000");
  EXPECT_EQ(run("build"), 1);
  EXPECT_THAT(said, AllOf(HasSubstr("compiler"), Not(HasSubstr("library"))));
}

TEST_F(Setup, NamesItsCommandIfPermissionIsMissing) {
  installed("compiler\n");
  fake("id", "echo 1000");
  EXPECT_EQ(run("build engines"), 1);
  EXPECT_THAT(said, HasSubstr("there is no sudo"));
  EXPECT_THAT(said, HasSubstr("apt-get install --no-install-recommends library painter sculptor"));
  EXPECT_THAT(apt_calls(), IsEmpty());

  fake("sudo", "exit 1");
  EXPECT_EQ(run("build engines"), 1);
  EXPECT_THAT(said, HasSubstr("sudo did not let you"));
  EXPECT_THAT(apt_calls(), IsEmpty());
}

TEST_F(Setup, InstallsThroughSudo) {
  fake("id", "echo 1000");
  fake("sudo", "while [[ ${1-} == -* ]]; do shift; done; [[ $1 == true ]] || \"$@\"");
  EXPECT_EQ(run("build"), 0);
  EXPECT_THAT(apt_calls(),
              ElementsAre("update", "install -y --no-install-recommends compiler library"));
}

TEST_F(Setup, NamesThePackagesWithoutAptOrDpkg) {
  fs::remove(bin() / "apt-get");
  EXPECT_EQ(run("build"), 1);
  EXPECT_THAT(said, AllOf(HasSubstr("no apt-get"), HasSubstr("compiler"), HasSubstr("SETUP=no")));
  fs::remove(bin() / "dpkg-query");
  EXPECT_EQ(run("build"), 1);
  EXPECT_THAT(said, AllOf(HasSubstr("no dpkg-query"), HasSubstr("library")));
}

TEST_F(Setup, InstallsTheOtherEnginesIfOneIsUnavailable) {
  installed("compiler\nlibrary\n");
  unavailable("painter\n");
  EXPECT_EQ(run("build engines"), 0);
  EXPECT_THAT(said, HasSubstr("going on without painter."));
  EXPECT_THAT(read(scratch_ / "installed"), HasSubstr("sculptor"));

  fake("id", "echo 1000");
  EXPECT_EQ(run("build engines"), 0);
  EXPECT_THAT(said, HasSubstr("going on without painter."));
}

TEST_F(Setup, FailsWithoutAPackageOfTheBuild) {
  unavailable("library\n");
  EXPECT_EQ(run("build engines"), 1);
  EXPECT_THAT(said, HasSubstr("could not install"));
}

TEST_F(Setup, GoesOnAfterAFailingSourceList) {
  fake("apt-get", "echo \"$*\" >> '" + calls_file() +
                      "'; case \"$*\" in *update) exit 100;; esac; "
                      "for name in \"$@\"; do echo \"$name\" >> '" +
                      (scratch_ / "installed").string() + "'; done");
  EXPECT_EQ(run("build"), 0);
  EXPECT_THAT(said, HasSubstr("apt-get update failed"));
}

TEST_F(Setup, RefusesAnUnknownPurpose) {
  EXPECT_EQ(run("biuld"), 2);
  EXPECT_THAT(said, HasSubstr("biuld"));
}

TEST_F(Setup, HasAReasonForEveryPackageOfTheRealList) {
  int packages = 0;
  for (const std::string& line : lines(read(fs::path(LOBELIA_SOURCE_DIR) / "tools/packages.txt"))) {
    if (line.empty() || line.starts_with('#')) continue;
    ++packages;
    std::istringstream in(line);
    std::string package, purpose, why;
    EXPECT_TRUE(in >> package >> purpose >> why) << line;
  }
  EXPECT_GT(packages, 10);
}

}  // namespace
}  // namespace house
