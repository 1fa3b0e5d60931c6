// Removal: what it takes away, and what it refuses.
#include "base/system/removal.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

class RemovalTest : public testing::Test {
 protected:
  RemovalTest() {
    fs::create_directories(root());
    write_file(root() / "marker", "ours");
    fs::create_directories(outside() / "deep");
    write_file(outside() / "precious", "x");
    write_file(outside() / "deep" / "precious", "x");
  }
  fs::path root() const { return directory_.path() / "root"; }
  fs::path outside() const { return directory_.path() / "outside"; }
  static bool has_marker(const HeldDirectory& held) { return held.read("marker", 10) == "ours"; }
  /// Trees "tree*", files "file*", directories "directory*", each also below those.
  static Owned by_name(const fs::path& relative) {
    const std::string name = relative.filename();
    return name.starts_with("tree")        ? Owned::kTree
           : name.starts_with("file")      ? Owned::kFile
           : name.starts_with("directory") ? Owned::kDirectory
                                           : Owned::kNo;
  }
  Removal removal(Removal::Mode mode = Removal::Mode::kForReal) const {
    return Removal(root(), {has_marker, by_name}, mode);
  }
  bool outside_is_whole() const {
    return fs::exists(outside() / "precious") && fs::exists(outside() / "deep" / "precious");
  }
  static std::vector<std::string> all_paths(const fs::path& top) {
    std::vector<std::string> paths;
    for (const auto& entry : fs::recursive_directory_iterator(top))
      paths.push_back(entry.path().string());
    std::ranges::sort(paths);
    return paths;
  }
  const TemporaryDirectory directory_;
};

TEST_F(RemovalTest, TakesATreeWithAllInItAndOfLinksInItTheLinks) {
  fs::create_directories(root() / "tree" / "a" / "b");
  write_file(root() / "tree" / "a" / "c", "x");
  fs::create_directory_symlink(outside(), root() / "tree" / "link");
  fs::create_directory_symlink(outside(), root() / "tree" / "a" / "b" / "link");
  ASSERT_EQ(::mkfifo((root() / "tree" / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(removal().remove("tree"));
  EXPECT_FALSE(fs::exists(root() / "tree"));
  EXPECT_TRUE(outside_is_whole());
}

TEST_F(RemovalTest, GoesThroughNoLinkOnTheWayOrAtTheEnd) {
  fs::create_directory_symlink(outside(), root() / "tree");
  fs::create_directory_symlink(outside(), root() / "parent");
  Removal removing = removal();
  EXPECT_TRUE(removing.remove("tree")) << "the link";
  EXPECT_FALSE(fs::is_symlink(root() / "tree"));
  for (const char* path : {"parent/file", "parent/tree", "parent/deep/file"})
    EXPECT_FALSE(removing.remove(path)) << path;
  EXPECT_FALSE(removing.remove("../outside/file"));
  EXPECT_FALSE(removing.remove("../outside"));
  EXPECT_TRUE(outside_is_whole());
  ASSERT_FALSE(removing.kept().empty());
  EXPECT_EQ(removing.kept()[0].why, "a symbolic link, which is not followed");
}

TEST_F(RemovalTest, TakesNothingFromARootWithoutItsMarker) {
  write_file(root() / "file", "x");
  for (const char* marker : {"theirs", ""}) {
    write_file(root() / "marker", marker);
    EXPECT_FALSE(removal().remove("file"));
  }
  fs::remove(root() / "marker");
  EXPECT_FALSE(removal().remove("file"));
  write_file(outside() / "marker", "ours");
  fs::create_symlink(outside() / "marker", root() / "marker");
  EXPECT_FALSE(removal().remove("file")) << "a marker that is a link is none";
  EXPECT_TRUE(fs::exists(root() / "file"));
}

TEST_F(RemovalTest, TakesNothingOfANameThatIsNotOurs) {
  write_file(root() / "notes", "x");
  fs::create_directory(root() / "file1");
  fs::create_directory(root() / "directory");
  write_file(root() / "directory" / "notes", "x");
  write_file(root() / "directory2", "x");
  Removal removing = removal();
  for (const char* path : {"notes", "file1", "directory", "directory2", "directory/notes"})
    EXPECT_FALSE(removing.remove(path)) << path;
  EXPECT_EQ(removing.kept().size(), 5u);
  EXPECT_FALSE(removing.remove("file-that-is-not-there"));
  EXPECT_EQ(removing.kept().size(), 5u) << "nothing to be told";
}

TEST_F(RemovalTest, GoesDownADirectoryAtATimeAndNotForEver) {
  fs::path deep = root() / "tree";
  for (int i = 0; i < 200; ++i) deep /= "d";
  fs::create_directories(deep);
  Removal removing = removal();
  EXPECT_FALSE(removing.remove("tree"));
  ASSERT_FALSE(removing.kept().empty());
  EXPECT_THAT(removing.kept()[0].why, HasSubstr("directories in one another"));
}

TEST_F(RemovalTest, EntersNoOtherFileSystemNotEvenAMountOfThisOne) {
  for (const char* name : {"tree", "bound"}) fs::create_directories(root() / name / "mounted");
  write_file(root() / "tree" / "mounted" / "below", "x");
  // In a process of its own: its mounts are nobody else's.
  const pid_t child = ::fork();
  if (child == 0) {
    const fs::path at = root() / "tree" / "mounted";
    if (::unshare(CLONE_NEWNS) != 0 ||
        ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("tmpfs", at.c_str(), "tmpfs", 0, nullptr) != 0)
      ::_exit(77);
    std::ofstream(at / "precious") << "x";
    int wrong = removal().remove("tree") || !fs::exists(at / "precious") ? 1 : 0;
    ::umount(at.c_str());
    if (::mount(outside().c_str(), at.c_str(), nullptr, MS_BIND, nullptr) != 0) ::_exit(77);
    if (removal().remove("tree") || !outside_is_whole()) wrong |= 2;
    ::_exit(wrong);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "nothing may be mounted here";
  EXPECT_EQ(WEXITSTATUS(status), 0) << "1: another file system; 2: a mount of the same one";
  EXPECT_TRUE(outside_is_whole());
}

/// A random tree of ours and of others' things.
void fill(const fs::path& top, std::mt19937& random, int depth, const fs::path& outside) {
  const char* const kNames[] = {"tree", "file", "directory", "notes"};
  const int count = int(random() % 5) + (depth == 0 ? 3 : 0);
  for (int i = 0; i < count; ++i) {
    const fs::path path = top / (kNames[random() % 4] + std::to_string(random() % 6));
    if (fs::exists(fs::symlink_status(path))) continue;
    switch (random() % 4) {
      case 0:
        fs::create_symlink(outside, path);
        break;
      case 1:
        write_file(path, "x");
        break;
      default:
        fs::create_directory(path);
        if (depth < 4) fill(path, random, depth + 1, outside);
    }
  }
}

TEST_F(RemovalTest, ListsTheSameEntriesInADryRun) {
  std::mt19937 random(19);
  std::size_t told = 0;
  for (int round = 0; round < 40; ++round) {
    fs::remove_all(root());
    fs::create_directory(root());
    write_file(root() / "marker", "ours");
    fill(root(), random, 0, outside());
    std::vector<fs::path> wanted;
    for (const auto& entry : fs::recursive_directory_iterator(root()))
      wanted.push_back(entry.path().lexically_relative(root()));
    // Entries before their directory, in one order for both.
    std::ranges::sort(wanted, std::greater());
    const auto before = all_paths(root());
    std::vector<std::string> would_go, went;
    const auto listen = [&](Removal::Mode mode, std::vector<std::string>& list) {
      Removal removing = removal(mode);
      removing.on_removed([&](const fs::path& path) { list.push_back(path.string()); });
      for (const auto& path : wanted) removing.remove(path);
    };
    listen(Removal::Mode::kDryRun, would_go);
    ASSERT_EQ(all_paths(root()), before) << "a dry run takes nothing";
    listen(Removal::Mode::kForReal, went);
    ASSERT_EQ(would_go, went);
    std::vector<std::string> gone;
    const auto after = all_paths(root());
    std::ranges::set_difference(before, after, std::back_inserter(gone));
    std::ranges::sort(went);
    ASSERT_EQ(went, gone);
    told += went.size();
    ASSERT_TRUE(outside_is_whole());
  }
  EXPECT_GT(told, 400u);
}

TEST_F(RemovalTest, TellsWhereAResultWasThatItTookAtOnce) {
  fs::create_directories(root() / "tree" / "a");
  fs::create_directory(root() / "directory");
  std::vector<std::string> told;
  Removal removing = removal();
  removing.on_removed(
      [&](const fs::path& path) { told.push_back(path.lexically_relative(root()).string()); });
  EXPECT_TRUE(removing.remove_at_once("tree", "directory/tree7"));
  EXPECT_THAT(told, ElementsAre("tree/a", "tree"));
  EXPECT_TRUE(fs::is_empty(root() / "directory"));
}

/// While it lives, no file can be opened.
class NoOpenFiles {
 public:
  NoOpenFiles() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const rlimit none{1, before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &none);
  }
  ~NoOpenFiles() { ::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(RemovalTest, ReportsTooManyOpenFiles) {
  fs::create_directories(root() / "tree" / "inner");
  const HeldDirectory held(root());
  Removal all = removal();
  const std::function<void()> looks[] = {[&] { HeldDirectory here(root()); },
                                         [&] { held.below("tree"); },
                                         [&] { held.below("tree", HeldDirectory::Border::kCross); },
                                         [&] { held.names(); },
                                         [&] { held.read("marker", 10); },
                                         [&] { held.copy(); },
                                         [&] { all.remove("tree"); }};
  for (const auto& look : looks) {
    const NoOpenFiles limit;
    EXPECT_THAT(error_words(ExitCode::kNoResources, look),
                HasSubstr("too many open files (ulimit -n)"))
        << &look - looks;
  }
  EXPECT_TRUE(fs::exists(root() / "tree" / "inner"));
}

TEST_F(RemovalTest, LeavesPartsToTheNextFarmWhereTooManyFilesAreOpen) {
  const std::string part = fmt::format(".a.exr.{}-1.part", ::getpid());
  write_file(root() / part, "x");
  {
    const NoOpenFiles limit;
    remove_part(root() / part);
    EXPECT_FALSE(remove_temporary(root() / "lobelia-temporary-abcdef"));
  }
  EXPECT_TRUE(fs::exists(root() / part));
  remove_part(root() / part);
  EXPECT_FALSE(fs::exists(root() / part));
}

TEST(PartNames, AreReadStrictly) {
  EXPECT_TRUE(is_part_name(".a.exr.123-4294967295.part"));
  for (const char* name : {"", ".part", ".a.part", ".a.exr.-1-2.part", ".a.exr.1-x.part",
                           "a.1-2.part", ".a.exr.0-2.part", ".1-2.part", ".a.1-2.part~"})
    EXPECT_FALSE(is_part_name(name)) << name;
}

class DeadTemporaries : public testing::Test {
 protected:
  const TemporaryDirectory place_;
};

TEST_F(DeadTemporaries, GoIfTheyAreOursWithoutAHolder) {
  const fs::path place = place_.path();
  const TemporaryDirectory outside;
  write_file(outside.path() / "precious", "x");
  for (const char* name :
       {"lobelia-temporary-AAAAAA", "lobelia-temporary-BBBBBB", "lobelia-temporary-held00",
        "lobelia-temporary-toolong", "lobelia-temporary-a.b.cd", "another-temporary-AAAAAA"})
    fs::create_directory(place / name);
  write_file(place / "lobelia-temporary-BBBBBB" / "x", "x");
  write_file(place / "lobelia-temporary-a_file", "x");
  fs::create_directory_symlink(outside.path(), place / "lobelia-temporary-linked");
  const HeldDirectory held(place / "lobelia-temporary-held00");
  ASSERT_EQ(::flock(held.fd(), LOCK_EX), 0);
  const auto removed = remove_dead_temporaries(place);
  EXPECT_THAT(removed,
              ElementsAre(place / "lobelia-temporary-AAAAAA", place / "lobelia-temporary-BBBBBB"));
  EXPECT_TRUE(fs::exists(outside.path() / "precious"));
  EXPECT_EQ(std::distance(fs::directory_iterator(place), {}), 6);
}

TEST_F(DeadTemporaries, AreToldFromThoseThatAreJustBeingMade) {
  const char* const before = std::getenv("TMPDIR");
  const std::string system = before ? before : "";
  ::setenv("TMPDIR", place_.path().c_str(), 1);
  std::atomic<bool> stop{false};
  std::thread remover([&] {
    while (!stop) remove_dead_temporaries(place_.path());
  });
  int lost = 0;
  for (int i = 0; i < 2000; ++i) {
    const TemporaryDirectory made;
    std::ofstream file(made.path() / "x");
    lost += file.good() ? 0 : 1;
  }
  stop = true;
  remover.join();
  before ? ::setenv("TMPDIR", system.c_str(), 1) : ::unsetenv("TMPDIR");
  EXPECT_EQ(lost, 0);
  EXPECT_TRUE(fs::is_empty(place_.path()));
}

}  // namespace
}  // namespace lobelia
