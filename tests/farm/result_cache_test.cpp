#include "farm/result_cache.hpp"

#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <latch>
#include <thread>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "farm/cache_layout.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

records::Result a_result() {
  records::Result result;
  result.job = "render";
  return result;
}

class ResultCacheTest : public testing::Test {
 protected:
  fs::path path() const { return directory_.path() / "cache"; }
  static Publication publish(const ResultCache& cache, const ResultKey& key,
                             const std::string& picture) {
    ResultDraft draft = cache.draft();
    write_file(draft.file("a.exr"), picture);
    write_file(draft.file("a.json"), "{}");
    return cache.publish(draft, key, a_result());
  }
  std::size_t drafts() const {
    return std::size_t(std::distance(fs::directory_iterator(path() / "making"), {}));
  }
  TemporaryDirectory directory_;
  const ResultKey key_ = result_key({"a", "result"}), other_ = result_key({"another"});
};

TEST_F(ResultCacheTest, GivesBackPublishedResultsOnly) {
  const ResultCache cache(path());
  EXPECT_FALSE(cache.find(key_));
  EXPECT_EQ(publish(cache, key_, "pixels"), Publication::kNew);
  const auto record = cache.find(key_);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->key, key_.text());
  EXPECT_EQ(record->files.size(), 2u);
  EXPECT_EQ(read_file(cache.file(key_, "a.exr"), 100), "pixels");
  EXPECT_FALSE(cache.find(other_));
  EXPECT_EQ(cache.list(), std::vector<ResultKey>{key_});
  EXPECT_EQ(drafts(), 0u);
}

TEST_F(ResultCacheTest, TheFirstResultStaysAndASecondOneIsToldFromIt) {
  const ResultCache cache(path());
  publish(cache, key_, "pixels");
  EXPECT_EQ(publish(cache, key_, "pixels"), Publication::kThere);
  EXPECT_EQ(publish(cache, key_, "others"), Publication::kDifferent);
  EXPECT_EQ(read_file(cache.file(key_, "a.exr"), 100), "pixels");
  EXPECT_EQ(drafts(), 0u);
}

TEST_F(ResultCacheTest, ADamagedResultIsNoResultAndIsReplaced) {
  const ResultCache cache(path());
  publish(cache, key_, "pixels");
  const fs::path picture = cache.file(key_, "a.exr");
  fs::permissions(picture, fs::perms::owner_all);
  for (const char* text : {"", "pixel", "PIXELS"}) {
    std::ofstream(picture) << text;
    std::string why;
    EXPECT_FALSE(cache.find(key_, ResultCache::Look::kQuick, &why)) << text;
    EXPECT_TRUE(why.starts_with("damaged: a.exr has another")) << why;
    EXPECT_EQ(publish(cache, key_, "pixels"), Publication::kNew) << text;
    EXPECT_TRUE(cache.find(key_));
    fs::permissions(picture, fs::perms::owner_all);
  }
  for (const char* file : {"a.exr", kManifestFile}) {
    fs::remove(cache.file(key_, file));
    EXPECT_FALSE(cache.find(key_)) << file;
    EXPECT_EQ(publish(cache, key_, "pixels"), Publication::kNew) << file;
  }
}

TEST_F(ResultCacheTest, AFileOfAnotherAgeIsReadAndNotDoubted) {
  const ResultCache cache(path());
  publish(cache, key_, "pixels");
  const fs::path picture = cache.file(key_, "a.exr");
  for (const int hours : {-1000, 1000}) {
    fs::last_write_time(picture, fs::last_write_time(picture) + std::chrono::hours(hours));
    EXPECT_TRUE(cache.find(key_)) << hours;
  }
}

TEST_F(ResultCacheTest, BelievesNoRecordThatPointsElsewhere) {
  const ResultCache cache(path());
  publish(cache, key_, "pixels");
  const Json good = as_json(*cache.find(key_));
  write_file(directory_.path() / "secret", "pixels");
  for (const char* name : {"../../../../secret", "/etc/passwd", "", ".", ".."}) {
    Json bad = good;
    bad["files"][0]["name"] = name;
    fs::permissions(cache.file(key_, kManifestFile), fs::perms::owner_all);
    write_json(cache.file(key_, kManifestFile), sealed(bad));
    EXPECT_FALSE(cache.find(key_)) << name;
  }
  Json swapped = good;
  swapped["key"] = other_.text();
  write_json(cache.file(key_, kManifestFile), sealed(swapped));
  EXPECT_FALSE(cache.find(key_));
  Json altered = good;
  altered["files"][0]["modified"] = 7;
  write_json(cache.file(key_, kManifestFile), altered);
  EXPECT_FALSE(cache.find(key_)) << "not as it was sealed";
  write_json(cache.file(key_, kManifestFile), sealed(altered));
  EXPECT_TRUE(cache.find(key_));
  for (const std::string& text : std::vector<std::string>{
           "", "{", "[]", "{\"schemaVersion\":1,\"kind\":\"result\"}", std::string(100000, '[')}) {
    write_file(cache.file(key_, kManifestFile), text);
    EXPECT_FALSE(cache.find(key_)) << text.substr(0, 100);
  }
}

TEST_F(ResultCacheTest, PublishesNothingThatHasLostAFile) {
  const ResultCache cache(path());
  for (const char* lost : {"a.exr", "b.json"}) {
    ResultDraft draft = cache.draft();
    write_file(draft.file("a.exr"), "x");
    write_file(draft.file("b.json"), "{}");
    fs::remove(draft.directory() / lost);
    EXPECT_THROW(cache.publish(draft, key_, a_result()), Error) << lost;
    EXPECT_FALSE(cache.has(key_)) << lost;
  }
}

TEST_F(ResultCacheTest, AClaimHoldsOthersOffUntilItEnds) {
  const ResultCache one(path()), two(path());
  {
    const auto claim = one.try_claim(key_);
    ASSERT_TRUE(claim);
    EXPECT_FALSE(two.try_claim(key_));
    EXPECT_TRUE(two.try_claim(other_));
  }
  EXPECT_TRUE(two.try_claim(key_));
}

TEST_F(ResultCacheTest, ManyMayUseItAtOnceAndWhoeverClearsItIsAlone) {
  const ResultCache one(path()), two(path()), three(path());
  {
    const auto a = one.try_use(true), b = two.try_use(true);
    EXPECT_TRUE(a && b);
    EXPECT_FALSE(three.try_use(false));
  }
  const auto alone = three.try_use(false);
  EXPECT_TRUE(alone);
  EXPECT_FALSE(one.try_use(true));
}

TEST_F(ResultCacheTest, IsOneForAllWhoMakeItAtTheSameMoment) {
  for (int run = 0; run < 30; ++run) {
    const fs::path place = directory_.path() / std::to_string(run);
    std::latch begun(3);
    const auto make = [&] {
      begun.arrive_and_wait();
      EXPECT_NO_THROW(ResultCache{place});
    };
    const std::jthread first(make), second(make);
    make();
  }
}

TEST_F(ResultCacheTest, KeepsAFailureUntilItIsForgotten) {
  const ResultCache cache(path());
  EXPECT_FALSE(cache.failure(key_));
  cache.keep_failure(key_, {});
  EXPECT_TRUE(cache.failure(key_));
  cache.forget_failure(key_);
  EXPECT_FALSE(cache.failure(key_));
  cache.forget_failure(other_);
}

TEST(ResultKey, ChangesWithEveryPartAndWithTheirBorders) {
  const std::vector<ResultKey> keys{
      result_key({}),         result_key({""}),         result_key({"ab"}),
      result_key({"a", "b"}), result_key({"b", "a"}),   result_key({"ab", ""}),
      result_key({"", "ab"}), result_key({"1:a", "b"}), result_key({"a", "b", ""})};
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(keys[i], keys[j]) << i << " " << j;
  EXPECT_EQ(result_key({"a", "b"}), result_key({"a", "b"}));
}

// Makers of drafts and shared locks, as far as one machine can decide.

DraftName of(const ProcessIdentity& maker, std::uint64_t inode = 7) { return {maker, inode, 42}; }

/// The PID of a child that has ended.
std::uint64_t dead_pid() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return std::uint64_t(child);
}

TEST(DraftName, SaysItsMakerAndIsReadStrictly) {
  const DraftName name = of(this_process());
  const std::string text = name.text();
  EXPECT_LT(text.size(), 200u);
  const auto read = DraftName::parse(text);
  ASSERT_TRUE(read) << text;
  EXPECT_EQ(read->maker, name.maker);
  EXPECT_EQ(read->locks_inode, 7u);
  EXPECT_EQ(read->random, 42u);
  EXPECT_EQ(read->maker.pid, std::uint64_t(::getpid()));
  EXPECT_GT(read->maker.start, 0u);
  const std::string good = "draft.a-0.0123456789abcdef0123456789abcdef.1.2.3.4.0123456789abcdef";
  EXPECT_TRUE(DraftName::parse(good));
  for (const char* bad :
       {"", "draft", "draft.......", "draft.a-0.0123456789abcdef0123456789abcdef.1.2.3.4",
        "raft.a-0.0123456789abcdef0123456789abcdef.1.2.3.4.0123456789abcdef",
        "draft.a/0.0123456789abcdef0123456789abcdef.1.2.3.4.0123456789abcdef",
        "draft..0123456789abcdef0123456789abcdef.1.2.3.4.0123456789abcdef",
        "draft.a-0.0123456789ABCDEF0123456789abcdef.1.2.3.4.0123456789abcdef",
        "draft.a-0.0123456789abcdef0123456789abcdef.1.-2.3.4.0123456789abcdef",
        "draft.a-0.0123456789abcdef0123456789abcdef.1.02.3.4.0123456789abcdef",
        "draft.a-0.0123456789abcdef0123456789abcdef.1.0.3.4.0123456789abcdef",
        "draft.a-0.0123456789abcdef0123456789abcdef.1.99999999999.3.4.0123456789abcdef",
        "draft.a-0.0123456789abcdef0123456789abcdef.1.2.3.4.0123456789abcdef.5",
        "draft.a-0.0123456789abcdef0123456789abcdef.1.2.3..0123456789abcdef"})
    EXPECT_FALSE(DraftName::parse(bad)) << bad;
  EXPECT_FALSE(DraftName::parse(good + std::string(300, '0')));
}

TEST(DraftName, TellsLivingOwnersFromDeadOnes) {
  const ProcessIdentity self = this_process();
  EXPECT_EQ(life_of(self, self), Life::kAlive);
  const auto with = [&](const auto& change) {
    ProcessIdentity other = self;
    change(other);
    return life_of(other, self);
  };
  EXPECT_EQ(with([](auto& p) { p.pid = dead_pid(); }), Life::kDead);
  EXPECT_EQ(with([](auto& p) { ++p.start; }), Life::kDead) << "another one had this number";
  EXPECT_EQ(with([](auto& p) { p.boot[0] = p.boot[0] == '1' ? '2' : '1'; }), Life::kDead)
      << "before this machine was started again";
  EXPECT_EQ(with([](auto& p) {
              p.boot[0] = p.boot[0] == '1' ? '2' : '1';
              p.host = "elsewhere-0";
            }),
            Life::kUnknown);
  EXPECT_EQ(with([](auto& p) { ++p.pid_namespace; }), Life::kUnknown);
  EXPECT_EQ(with([](auto& p) { p.boot = std::string(32, '0'); }), Life::kUnknown);
}

TEST(Drafts, GoOnceTheirMakerIsDeadOrTheirSharedLockIsFree) {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / "cache";
  const ResultCache cache(path);
  struct stat locks {};
  ASSERT_EQ(::stat((path / "locks").c_str(), &locks), 0);
  const ProcessIdentity self = this_process();
  const auto put = [&](ProcessIdentity maker, std::uint64_t inode) {
    const fs::path draft = path / "making" / of(maker, inode).text();
    fs::create_directory(draft);
    write_file(draft / "x", "x");
    return draft;
  };
  ProcessIdentity dead = self, elsewhere = self;
  dead.pid = dead_pid();
  elsewhere.host = "elsewhere-0";
  elsewhere.boot[0] = elsewhere.boot[0] == '1' ? '2' : '1';
  const fs::path of_dead = put(dead, 999), of_other_locks = put(elsewhere, 999),
                 of_shared_locks = put(elsewhere, locks.st_ino),
                 of_living = put(self, locks.st_ino), old = path / "making" / "0123456789abcdef";
  fs::create_directory(old);
  const fs::path foreign = path / "making" / "notes";
  fs::create_directory(foreign);
  const ResultCache other(path);
  const AbandonedDrafts found = other.remove_abandoned();
  EXPECT_FALSE(fs::exists(of_dead));
  EXPECT_FALSE(fs::exists(old)) << "as earlier versions named them";
  EXPECT_TRUE(fs::exists(of_living));
  EXPECT_TRUE(fs::exists(of_other_locks)) << "its maker may hold a lock that is not seen here";
  EXPECT_EQ(fs::exists(of_shared_locks), !other.lock_sharing().shared);
  EXPECT_TRUE(fs::exists(foreign)) << "no draft's name";
  EXPECT_EQ(found.removed + found.others, 4u);
}

TEST(Drafts, StayIfTheFileOfLocksWasRemoved) {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / "cache";
  const ResultCache first(path);
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();  // another process, which holds a draft until it is killed
  if (child == 0) {
    const ResultCache theirs(path);
    const ResultDraft draft = theirs.draft();
    const std::string name = draft.directory().string();
    if (::write(ends[1], name.data(), name.size()) > 0) ::pause();
    ::_exit(1);
  }
  char name[4096] = {};
  ASSERT_GT(::read(ends[0], name, sizeof name - 1), 0);
  for (const int end : ends) ::close(end);
  fs::remove(path / "locks");
  EXPECT_FALSE(first.lock_sharing().shared) << "the file it holds is not the cache's any more";
  const ResultCache second(path);
  EXPECT_EQ(second.remove_abandoned().removed, 0u);
  EXPECT_TRUE(fs::exists(name));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(second.remove_abandoned().removed, 1u);
  EXPECT_FALSE(fs::exists(name));
}

TEST(LockSharing, IsReadFromTheMounts) {
  // As machines of several clusters show them.
  const std::string mounts =
      "22 1 8:1 / / rw,relatime shared:1 - ext4 /dev/sda1 rw,errors=remount-ro\n"
      "40 22 0:48 / /users rw,relatime shared:9 - nfs4 fs1:/users "
      "rw,vers=4.2,rsize=1048576,hard,proto=tcp,timeo=600,sec=sys,clientaddr=10.0.0.7,local_lock=none,addr=10.0.0.1\n"
      "41 22 0:49 / /scratch rw,nosuid - nfs fs2:/scratch "
      "rw,vers=3,nolock,proto=tcp,mountproto=udp,local_lock=all,addr=10.0.0.2\n"
      "42 22 0:50 / /proj rw - nfs fs2:/proj rw,vers=3,hard,local_lock=posix,addr=10.0.0.2\n"
      "43 22 0:51 / /flock rw - nfs fs2:/flock rw,vers=3,hard,local_lock=flock,addr=10.0.0.2\n"
      "44 22 0:52 / /lustre rw,relatime - lustre 10.0.0.3@o2ib:/work rw,flock,lazystatfs\n"
      "45 22 0:53 / /lustre2 rw - lustre 10.0.0.3@o2ib:/w2 rw,localflock,user_xattr\n"
      "46 22 0:54 / /lustre3 rw - lustre 10.0.0.3@o2ib:/w3 rw,noflock,user_xattr\n"
      "47 22 0:55 / /lustre4 rw - lustre 10.0.0.3@o2ib:/w4 rw,user_xattr\n"
      "48 22 0:56 / /gpfs rw - gpfs gpfs rw,relatime\n"
      "49 22 0:57 / /ssh rw - fuse.sshfs host: rw,user_id=0\n"
      "50 22 0:58 / /cifs rw - cifs //s/x rw,vers=3.1.1,nobrl\n"
      "51 22 0:59 /sub /data\\040disk rw - btrfs /dev/sdb rw,subvol=/sub\n"
      "52 22 0:60 / /tmp rw - tmpfs tmpfs rw\n"
      "53 22 0:61 / /host rw - 9p hostshare rw,trans=virtio\n";
  const auto shared = [&](const char* device, const char* path) {
    return lock_sharing_of(mounts, device, path).shared;
  };
  EXPECT_TRUE(shared("8:1", "/var/cache/locks"));
  EXPECT_TRUE(shared("0:48", "/users/u/cache/locks"));
  EXPECT_FALSE(shared("0:49", "/scratch/locks"));
  EXPECT_FALSE(shared("0:50", "/proj/locks"));
  EXPECT_TRUE(shared("0:51", "/flock/locks")) << "ours are no flock(2) locks";
  EXPECT_TRUE(shared("0:52", "/lustre/locks"));
  EXPECT_FALSE(shared("0:53", "/lustre2/locks"));
  EXPECT_FALSE(shared("0:54", "/lustre3/locks"));
  EXPECT_FALSE(shared("0:55", "/lustre4/locks"));
  EXPECT_TRUE(shared("0:56", "/gpfs/locks"));
  EXPECT_FALSE(shared("0:57", "/ssh/locks"));
  EXPECT_FALSE(shared("0:58", "/cifs/locks"));
  EXPECT_FALSE(shared("0:61", "/host/locks"));
  EXPECT_EQ(lock_sharing_of(mounts, "0:99", "/data disk/cache/locks").why,
            "btrfs, a file system of this machine")
      << "files there have another device than the mount";
  EXPECT_EQ(lock_sharing_of(mounts, "0:49", "/scratch/locks").why,
            "nfs with nolock: its locks are this machine's");
  for (const char* text : {"", "x", "- - - - - -", "1 2 8:1 / / rw -", "1 2 8:1 / / rw - ext4"})
    EXPECT_FALSE(lock_sharing_of(text, "8:1", "/a").shared) << text;
}

}  // namespace
}  // namespace lobelia
