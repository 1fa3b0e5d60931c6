// Damage that other programs and disks do to a cache.
#include <sys/stat.h>

#include "failing_farm.hpp"

namespace lobelia {
namespace {

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

TEST_F(DamagedCache, IsMadeAgainAsFarAsAnyFileIsDamaged) {
  const std::pair<const char*, std::size_t> jobs[] = {
      {"render", 1}, {"reference-povray", 1}, {"compare-povray", 0}, {"profile", 0}};
  for (const auto& [job, pictures_lost] : jobs) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(result_of("n16", job)))
      names.push_back(entry.path().filename().string());
    for (const auto& name : names) {
      SCOPED_TRACE(std::string(job) + " " + name);
      flip_a_bit(result_of("n16", job) / name);
      const fs::path truncated = result_of("n64", job) / name;
      fs::permissions(truncated, fs::perms::owner_write, fs::perm_options::add);
      fs::resize_file(truncated, fs::file_size(truncated) / 2);
      expect_mended(run(), 2 * pictures_lost);
    }
  }
}

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
