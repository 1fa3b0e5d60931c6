// A cache that is lost, wholly or partly, at rest or at work; links in place of its parts; and who may take what away.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "failing_farm.hpp"

namespace lobelia {
namespace {

using testing::AnyOf;

class LostCache : public FailingFarm {
 protected:
  LostCache() {
    undisturbed();
    fake_povray();
    EXPECT_EQ(run().exit_code, 0);
  }
  /// A shelf or another directory that is there; the first one.
  fs::path first_of(const fs::path& directory) const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(directory)) all.push_back(entry.path());
    std::ranges::sort(all);
    return all.at(0);
  }
  static std::vector<std::string> all_paths(const fs::path& top) {
    std::vector<std::string> paths;
    for (const auto& entry : fs::recursive_directory_iterator(top))
      paths.push_back(entry.path().string());
    std::ranges::sort(paths);
    return paths;
  }
};

TEST_F(LostCache, IsMadeAgainWhateverOfItIsLostAtRest) {
  const auto without = [&](const std::vector<std::string>& parts) {
    SCOPED_TRACE(testing::PrintToString(parts));
    for (const auto& part : parts) fs::remove_all(cache() / part);
    expect_mended(run());
    EXPECT_TRUE(fs::exists(cache() / "lobelia-cache"));
    EXPECT_EQ(cached_pictures(), pictures());
  };
  without({"results"});
  without({"failures"});
  without({"making"});
  without({"locks"});
  without({"lobelia-cache"});
  without({"lobelia-cache", "results"});
  without({"results", "failures", "making"});
  without({"lobelia-cache", "failures", "making", "locks"});
  without({"lobelia-cache", "results", "failures", "making"});
  without({"results/" + first_of(cache() / "results").filename().string()});
  without({""});
}

TEST_F(LostCache, IsToldByStatusVerifyAndGcInOneLineEach) {
  fs::remove_all(cache());
  const FarmRun verify = run_command({"farm", "verify", "out", "-q"});
  EXPECT_EQ(verify.exit_code, 1) << verify.output;
  EXPECT_THAT(verify.output, HasSubstr("cache is not there"));
  EXPECT_THAT(verify.output, HasSubstr("16 missing"));
  EXPECT_THAT(verify.output, testing::Not(HasSubstr("whole")));
  const FarmRun status = run_command({"farm", "status", "out"});
  EXPECT_EQ(status.exit_code, 0) << status.output;
  EXPECT_THAT(status.output, HasSubstr("4 cells: 4 pass\nits cache "));
  EXPECT_EQ(std::ranges::count(status.output, '\n'), 2) << status.output;
  const FarmRun gc = run_command({"farm", "gc", "out"});
  EXPECT_EQ(gc.exit_code, 0) << gc.output;
  EXPECT_EQ(std::ranges::count(gc.output, '\n'), 1) << gc.output;
  EXPECT_FALSE(fs::exists(cache())) << "whoever looks makes none";
  expect_mended(run(), pictures());
}

TEST_F(LostCache, VerifyReadsTheFilesUnderCellsToo) {
  EXPECT_EQ(run_command({"farm", "verify", "out", "-q"}).exit_code, 0);
  // A copy, as where the cache is on another file system, whose time and size do not tell.
  const fs::path copy = out() / "cells" / "n16" / "povray.exr";
  const auto time = fs::last_write_time(copy);
  std::string text = read_file(copy, 1 << 26);
  text[text.size() / 2] = char(text[text.size() / 2] ^ 1);
  fs::remove(copy);
  write_file(copy, text);
  fs::last_write_time(copy, time);
  fs::remove(out() / "cells" / "n8" / "lobelia.png");
  std::ofstream(out() / "cells" / "n32" / "cell.json") << "{}";
  const FarmRun verify = run_command({"farm", "verify", "out", "-q"});
  EXPECT_EQ(verify.exit_code, 1) << verify.output;
  for (const char* line : {"damaged: cells/n16/povray.exr has another content",
                           "damaged: cells/n8/lobelia.png is missing",
                           "damaged: cells/n32/cell.json is damaged: not a record of kind 'cell'"})
    EXPECT_THAT(verify.output, HasSubstr(line));
  EXPECT_EQ(run_command({"farm", "verify", "out", "-q", "--remove"}).exit_code, 0);
  expect_mended(run(), 0);
  EXPECT_EQ(run_command({"farm", "verify", "out", "-q"}).exit_code, 0);
}

TEST_F(LostCache, GivesWayToACellsFileWhereADirectoryIsEmpty) {
  const Results before = results_of(out());
  for (const char* name : {"scene.xml", "lobelia.exr", "cell.json"}) {
    const fs::path file = out() / "cells" / "n16" / name;
    fs::remove(file);
    fs::create_directory(file);
    write_file(file / "a user's", "x");
    const FarmRun refused = run_command(command());
    EXPECT_EQ(refused.exit_code, 4) << refused.output;
    EXPECT_THAT(refused.output, HasSubstr(name));
    EXPECT_TRUE(fs::exists(file / "a user's"));
    fs::remove(file / "a user's");
    const FarmRun made = run_command(command());
    EXPECT_EQ(made.exit_code, 0) << made.output;
    EXPECT_THAT(differences(before, results_of(out())), IsEmpty()) << name;
  }
}

TEST_F(LostCache, IsRefusedWithALinkForAnyPart) {
  const fs::path outside = root() / "outside";
  fs::create_directories(outside / "0123456789abcdef");
  fs::create_directories(outside / "n16");
  write_file(outside / "0123456789abcdef" / "precious", "x");
  write_file(outside / "n16" / "lobelia.exr", "x");
  write_file(outside / "precious", "x");
  const auto before = all_paths(outside);
  const std::vector<fs::path> parts{cache() / "making",   cache() / "results",
                                    cache() / "failures", first_of(cache() / "results"),
                                    out() / "cells",      out() / "cells" / "n16"};
  for (const fs::path& part : parts) {
    SCOPED_TRACE(part);
    fs::rename(part, root() / "away");
    fs::create_directory_symlink(outside, part);
    for (const auto& arguments : {command(),
                                  command({"--again"}),
                                  {"farm", "clean", "out"},
                                  {"farm", "clean", "out", "--all"},
                                  {"farm", "gc", "cache", "--max-size", "0"},
                                  {"farm", "verify", "out", "-q", "--remove"}}) {
      const fs::path record = out() / "farm.json";
      const std::string kept = fs::exists(record) ? read_file(record, 1 << 20) : "";
      const FarmRun refused = run_command(arguments);
      EXPECT_THAT(refused.exit_code, AnyOf(0, 1, 3, 4))
          << testing::PrintToString(arguments) << refused.output;
      EXPECT_EQ(all_paths(outside), before) << testing::PrintToString(arguments);
      if (!fs::exists(record)) write_file(record, kept);
    }
    const FarmRun farm = run();
    EXPECT_EQ(farm.exit_code, 4) << farm.output;
    EXPECT_EQ(std::ranges::count(farm.output, '\n'), 1) << farm.output;
    EXPECT_THAT(farm.output, HasSubstr("a symbolic link"));
    EXPECT_EQ(all_paths(outside), before);
    fs::remove(part);
    fs::rename(root() / "away", part);
    expect_mended(run());
  }
}

TEST_F(LostCache, IsOnlyListedInADryRun) {
  grid({"8", "16"});
  ASSERT_EQ(run().exit_code, 0);  // n32 and n64 are foreign now
  const auto dead = fs::path("making") / "0123456789abcdef";
  fs::create_directories(cache() / dead / "deep");
  write_file(cache() / dead / "deep" / "x", "x");
  write_file(out() / "cells" / "n32" / "notes.txt", "the user's");
  write_file(out() / "cells" / "n64" / ".lobelia.exr.2147483646-1.part", "x");
  const auto compare = [&](std::vector<std::string> arguments) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const auto before = all_paths(root());
    arguments.push_back("--dry-run");
    const FarmRun dry = run_command(arguments);
    EXPECT_EQ(dry.exit_code, 0) << dry.output;
    auto unchanged = all_paths(root());
    std::erase_if(unchanged, [&](const auto& path) {
      return fs::path(path).filename().native().starts_with("output-");
    });
    auto expected = before;
    std::erase_if(expected, [&](const auto& path) {
      return fs::path(path).filename().native().starts_with("output-");
    });
    EXPECT_EQ(unchanged, expected) << "a dry run takes and writes nothing";
    arguments.pop_back();
    EXPECT_EQ(run_command(arguments).exit_code, 0);
    std::vector<std::string> gone, listed;
    const auto after = all_paths(root());
    std::ranges::set_difference(before, after, std::back_inserter(gone));
    std::istringstream lines(dry.output);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("out/") || line.starts_with(root().string()) ||
          line.starts_with("cache/"))
        listed.push_back(fs::path(line).is_absolute() ? line : (root() / line).string());
    std::ranges::sort(listed);
    EXPECT_EQ(listed, gone);
    EXPECT_FALSE(gone.empty());
  };
  compare({"farm", "gc", "cache"});
  compare({"farm", "clean", "out"});
  EXPECT_EQ(read_file(out() / "cells" / "n32" / "notes.txt", 100), "the user's");
  EXPECT_FALSE(fs::exists(out() / "cells" / "n64"));
  EXPECT_TRUE(fs::exists(out() / "cells" / "n16" / "cell.json"));
  compare({"farm", "gc", "cache", "--max-size", "40K"});
  compare({"farm", "clean", "out", "--all"});
  EXPECT_TRUE(fs::exists(out() / "cells" / "n32" / "notes.txt"));
}

TEST_F(LostCache, CleanAndAFarmKeepOutOfEachOthersWay) {
  fs::remove_all(out());
  fs::remove_all(cache());
  fake_povray(waits());
  RunningFarm farm(command(), root());
  while (cached_pictures() < 1 && !farm.has_ended()) ::usleep(5000);
  const FarmRun clean = run_command({"farm", "clean", "out", "--all"});
  EXPECT_EQ(clean.exit_code, 4) << clean.output;
  EXPECT_EQ(std::ranges::count(clean.output, '\n'), 1) << clean.output;
  EXPECT_THAT(clean.output, HasSubstr("a farm is at work in this directory"));
  let_go_on();
  EXPECT_EQ(farm.wait(), 0) << farm.output();
  fake_povray();
  expect_mended(run(), 0);
  // And the other way round: the lock that clean holds.
  const int lock = ::open((out() / "farm.lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(lock, 0);
  struct flock whole {};
  whole.l_type = F_WRLCK;
  ASSERT_EQ(::fcntl(lock, F_OFD_SETLK, &whole), 0);
  const FarmRun refused = run();
  EXPECT_EQ(refused.exit_code, 4) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("'lobelia farm clean'"));
  ::close(lock);
  expect_mended(run(), 0);
}

TEST_F(LostCache, LosesTheTemporariesOfAKilledFarmToTheNextOneOrTheDoctor) {
  fs::create_directory(root() / "tmp" / "lobelia-temporary-AbCd01");
  expect_mended(run(), 0);
  EXPECT_TRUE(fs::is_empty(root() / "tmp"));
  fs::create_directory(root() / "tmp" / "lobelia-temporary-AbCd01");
  write_file(root() / "tmp" / "lobelia-temporary-of-mine", "x");
  const FarmRun doctor = run_command({"farm", "doctor", "--clean"});
  EXPECT_EQ(doctor.exit_code, 0) << doctor.output;
  EXPECT_THAT(doctor.output, HasSubstr("lobelia-temporary-AbCd01\n1 temporary directories"));
  EXPECT_TRUE(fs::exists(root() / "tmp" / "lobelia-temporary-of-mine"));
  EXPECT_FALSE(fs::exists(root() / "tmp" / "lobelia-temporary-AbCd01"));
}

// Damage that other programs and disks do to a cache.

class DamagedCache : public FailingFarm {
 protected:
  DamagedCache() {
    undisturbed();
    fake_povray();
    EXPECT_EQ(run().exit_code, 0);
  }
  /// In place, so that the farm's directory shows it too.
  static void flip_a_bit(const fs::path& file) {
    fs::permissions(file, fs::perms::owner_write, fs::perm_options::add);
    const auto middle = std::streamoff(fs::file_size(file) / 2);
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(middle);
    const int byte = stream.get();
    stream.seekp(middle);
    stream.put(char(byte ^ 1));
  }
};

TEST_F(DamagedCache, IsFoundByVerifyIfNobodyNoticesAndMadeAgain) {
  const fs::path file = result_of("n16", "reference-povray") / "povray.exr";
  const auto time = fs::last_write_time(file);
  flip_a_bit(file);
  fs::last_write_time(file, time);
  EXPECT_EQ(run().rendered, 0u) << "its age and size are as they were";
  // Only the last one takes it away.
  for (const char* option : {"-q", "-q", "--remove"}) {
    const FarmRun verify = run_command({"farm", "verify", "out", option});
    EXPECT_THAT(verify.output, HasSubstr("damaged: "));
    EXPECT_THAT(verify.output, HasSubstr("povray.exr has another content"));
  }
  expect_mended(run(), 1);
}

TEST_F(DamagedCache, TakesNothingElseForAResult) {
  const fs::path outside = root() / "outside";
  const auto with = [&](const char* what, const auto& put) {
    SCOPED_TRACE(what);
    const fs::path result = result_of("n16", "reference-povray");
    fs::remove_all(result);
    put(result);
    expect_mended(run(), 1);
    EXPECT_TRUE(fs::is_directory(fs::symlink_status(result)));
  };
  with("a file", [](const fs::path& result) { std::ofstream(result) << "x"; });
  with("a pipe", [](const fs::path& result) { ::mkfifo(result.c_str(), 0600); });
  with("a link to nothing",
       [](const fs::path& result) { fs::create_symlink("/nonexistent", result); });
  with("an empty directory", [](const fs::path& result) { fs::create_directory(result); });
  with("a directory of other things", [](const fs::path& result) {
    fs::create_directories(result / "a" / "b");
    std::ofstream(result / "a" / "c") << "x";
  });
  with("a link to a directory of the user's", [&](const fs::path& result) {
    fs::create_directories(outside);
    std::ofstream(outside / "precious") << "x";
    fs::create_symlink(outside, result);
  });
  EXPECT_TRUE(fs::exists(outside / "precious"));
  with("a record that is a pipe", [](const fs::path& result) {
    fs::create_directory(result);
    ::mkfifo((result / "result.json").c_str(), 0600);
  });
  with("a record that is endless", [](const fs::path& result) {
    fs::create_directory(result);
    fs::create_symlink("/dev/zero", result / "result.json");
  });
}

TEST_F(DamagedCache, IsNotUsedIfItIsNoneOrHasAnotherLayout) {
  const auto refused = [&](const std::string& path, int code) {
    const FarmRun farm = run_command({"farm", "grid.xml", "-o", "other", "--cache", path});
    EXPECT_EQ(farm.exit_code, code) << path << ": " << farm.output;
    EXPECT_EQ(std::ranges::count(farm.output, '\n'), 1) << farm.output;
  };
  std::ofstream(root() / "file") << "x";
  refused("file", 4);
  refused("grid.xml/cache", 4);
  fs::create_directories(root() / "full" / "of");
  refused("full", 3);
  EXPECT_FALSE(fs::exists(root() / "full" / "results"));
  fs::create_directory(root() / "later");
  write_file(root() / "later" / "lobelia-cache", "2\n");
  refused("later", 3);
}

TEST_F(DamagedCache, IsNotPutWhereItWouldBeTakenForAPartOfAFarm) {
  for (const auto& [directory, cache_path] :
       {std::pair("other", "other/cells/cache"), std::pair("other", "other/cells"),
        std::pair("cache/making/other", "cache"), std::pair("cache/results", "cache")}) {
    const FarmRun farm = run_command({"farm", "grid.xml", "-o", directory, "--cache", cache_path});
    EXPECT_EQ(farm.exit_code, 2) << directory << " " << cache_path << ": " << farm.output;
  }
  expect_mended(run(), 0);
}

TEST_F(DamagedCache, IsOnlyCleanedIfItBelongsToAFarm) {
  fs::create_directories(root() / "home" / "cells" / "precious");
  for (const char* command : {"clean", "gc", "verify", "status"}) {
    const FarmRun refused = run_command({"farm", command, "home"});
    EXPECT_EQ(refused.exit_code, 3) << command << ": " << refused.output;
    EXPECT_EQ(std::ranges::count(refused.output, '\n'), 1) << refused.output;
  }
  EXPECT_TRUE(fs::exists(root() / "home" / "cells" / "precious"));
  for (
      const char* record :
      {"{\"schemaVersion\": 1, \"kind\": \"farm\"}",
       "{\"schemaVersion\": 1, \"kind\": \"farm\", \"cells\": 7, \"cache\": 8, \"title\": []}",
       "{\"schemaVersion\": 1, \"kind\": \"farm\", \"cells\": [{\"id\": 3}], \"cache\": \"../cache\"}",
       "{\"schemaVersion\": 1, \"kind\": \"farm\", \"cells\": [{\"id\": \"../../x\", \"status\": []}]}"}) {
    std::ofstream(root() / "home" / "farm.json") << record;
    for (const char* command : {"clean", "status"}) {
      const FarmRun refused = run_command({"farm", command, "home"});
      EXPECT_EQ(refused.exit_code, 3) << command << " " << record << ": " << refused.output;
    }
    EXPECT_TRUE(fs::exists(root() / "home" / "cells" / "precious")) << record;
  }
}

}  // namespace
}  // namespace lobelia
