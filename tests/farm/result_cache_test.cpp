#include "farm/result_cache.hpp"

#include <latch>
#include <thread>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
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

}  // namespace
}  // namespace lobelia
