#include "base/system/leave.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>

#include <atomic>
#include <thread>

#include "base/system/error.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class LeaveTest : public testing::Test {
 protected:
  LeaveTest() {
    for (const char* folder : {"own/inside", "secret", "trusted/deep", "trusted too"})
      fs::create_directories(path(folder));
    ::setenv("LOBELIA_ALLOW_COMMANDS_IN", ("relative:/nowhere:" + path("trusted").string()).c_str(),
             1);
    for (const char* file : {"own/inside/x", "secret/x"}) write_file(path(file), file);
    fs::create_symlink("../secret/x", path("own/link"));
    fs::create_symlink("inside/x", path("own/stays"));
    fs::create_directory_symlink("..", path("own/up"));
  }
  ~LeaveTest() override { ::unsetenv("LOBELIA_ALLOW_COMMANDS_IN"); }
  fs::path path(const std::string& name) const { return fs::canonical(directory_.path()) / name; }
  /// The text of a file that a file in own/ names, or the exit code and the words of why not.
  std::pair<ExitCode, std::string> opened(const fs::path& name, const Leave& leave = {}) const {
    try {
      return {ExitCode::kSuccess,
              read_file(open_named(name, path("own"), leave, "engine studio"), 100)};
    } catch (const Error& error) {
      return {error.code(), error.what()};
    }
  }

 private:
  TemporaryDirectory directory_;
};

TEST_F(LeaveTest, NeedsTheUserOrTrustInEveryFile) {
  EXPECT_FALSE(Leave());
  EXPECT_FALSE(Leave::of_user(false));
  EXPECT_TRUE(Leave::of_user(true).said_by(path("secret")));
  EXPECT_TRUE(Leave().said_by(path("trusted")));
  EXPECT_TRUE(Leave().said_by(path("trusted/deep/x.xml")).said_by(path("trusted")));
  EXPECT_FALSE(Leave().said_by(path("trusted too")));
  EXPECT_FALSE(Leave().said_by(path("secret")).said_by(path("trusted")));
  EXPECT_FALSE(Leave().said_by(path("trusted")).said_by(path("secret")));
}

TEST_F(LeaveTest, SaysWhichFoldersAreDoubtful) {
  EXPECT_THAT(doubts_of_trusted_folders(),
              AllOf(HasSubstr("$LOBELIA_ALLOW_COMMANDS_IN: 'relative' is not absolute"),
                    HasSubstr("; '/nowhere' gives no leave: No such file or directory"),
                    testing::Not(HasSubstr("trusted"))));
  const auto doubts = [](const fs::path& folder) {
    ::setenv("LOBELIA_ALLOW_COMMANDS_IN", folder.c_str(), 1);
    return doubts_of_trusted_folders();
  };
  EXPECT_EQ(doubts(""), "");
  EXPECT_EQ(doubts(path("trusted/deep")), "");
  const auto any_user = HasSubstr("any user may write into '" + path("trusted/deep").string());
  const auto set = [&](const char* folder, unsigned mode) {
    fs::permissions(path(folder), fs::perms(mode));
  };
  set("trusted/deep", 0777);
  EXPECT_THAT(doubts(path("trusted/deep")), any_user);
  set("trusted/deep", 01777);
  EXPECT_THAT(doubts(path("trusted/deep")), any_user) << "others can still add files";
  set("trusted/deep", 0775);
  EXPECT_EQ(doubts(path("trusted/deep")), "");
  // Whoever may write into the folder above can put another in its place, unless that is sticky.
  set("trusted", 0777);
  EXPECT_THAT(doubts(path("trusted/deep")), any_user);
  set("trusted", 01777);
  EXPECT_EQ(doubts(path("trusted/deep")), "");
}

TEST_F(LeaveTest, IsNotNeededBelowTheNamingDirectory) {
  for (const char* name : {"inside/x", "stays", "inside/../inside/x", "up/own/inside/x"})
    EXPECT_EQ(opened(name), std::pair(ExitCode::kSuccess, std::string("own/inside/x"))) << name;
}

TEST_F(LeaveTest, IsNeededForAnyOtherFileWhateverPathLeadsThere) {
  for (const fs::path& name : {fs::path("../secret/x"), path("secret/x"), fs::path("link"),
                               fs::path("up/secret/x"), fs::path("inside/../../secret/x")}) {
    const auto [code, words] = opened(name);
    EXPECT_EQ(code, ExitCode::kUsage) << name;
    EXPECT_THAT(words, AllOf(HasSubstr("read '" + name.string() + "' for engine studio"),
                             HasSubstr("--allow-commands")));
    EXPECT_EQ(opened(name, Leave::of_user(true)).second, "secret/x") << name;
  }
}

TEST_F(LeaveTest, IsNeededForAnotherFileThoughFoldersAreExchangedMeanwhile) {
  fs::create_directory_symlink("../secret", path("own/evil"));
  const std::string inside = path("own/inside").string(), evil = path("own/evil").string();
  std::atomic<bool> done = false;
  std::thread exchange([&] {
    while (!done) ::renameat2(AT_FDCWD, inside.c_str(), AT_FDCWD, evil.c_str(), RENAME_EXCHANGE);
  });
  for (int i = 0; i < 5000; ++i)
    if (const auto [code, text] = opened("inside/x"); code == ExitCode::kSuccess) {
      EXPECT_EQ(text, "own/inside/x");
    }
  done = true;
  exchange.join();
}

TEST_F(LeaveTest, OpensNoPipeAndWaitsForNone) {
  ASSERT_EQ(::mkfifo(path("own/pipe").c_str(), 0600), 0);
  for (const char* name : {"pipe", "none", "inside"})
    EXPECT_EQ(opened(name, Leave::of_user(true)).first, ExitCode::kInput) << name;
}

TEST_F(LeaveTest, RefusesAValueThatAProgramCouldTakeForAnOption) {
  for (const char* value : {"", "a", "a-b", "_-x", "16"})
    EXPECT_NO_THROW(require_no_option(value, "light")) << value;
  for (const char* value : {"-", "-x", "--exec=evil.xml"})
    EXPECT_THROW(require_no_option(value, "light"), Error) << value;
}

}  // namespace
}  // namespace lobelia
