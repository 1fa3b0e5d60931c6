// Chunks that no farm of ours has planned.
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/sha256.hpp"
#include "farm/chunk.hpp"
#include "farm/job_graph.hpp"
#include "lobelia_paths.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

class HostileChunk : public testing::Test {
 protected:
  HostileChunk() {
    records::FarmChunk chunk;
    own_identity().put_into(chunk);
    chunk.cache = (directory_.path() / "cache").string();
    chunk.limits = {60, 60, 1, 0, 0, 5};
    chunk.failed = (directory_.path() / "failed").string();
    chunk.cells = {
        {"a",
         {},
         {},
         read_file(LOBELIA_SOURCE_DIR "/reference_scenes/scenes/oblique_45.xml", 1 << 20),
         {"a/render"}}};
    good_ = as_json(chunk);
  }
  ChunkSummary exec(const std::string& text, const Leave& leave = Leave::of_user(true)) const {
    write_file(directory_.path() / "chunk.json", text);
    return exec_chunk(directory_.path() / "chunk.json", 1, leave);
  }
  const TemporaryDirectory directory_;
  Json good_;
};

TEST_F(HostileChunk, StartsNothingAndWritesNothingWithoutLeave) {
  Json chunk = good_;
  chunk["engines"] = Json::array(
      {{{"name", "povray"}, {"version", "3.7"}, {"content", ""}, {"program", "/evil/povray"}},
       {{"name", "mine"},
        {"version", "1"},
        {"content", ""},
        {"outside",
         {{"name", "mine"},
          {"title", "Mine"},
          {"directory", directory_.path().string()},
          {"command", {"sh", "evil.sh", "{out}"}},
          {"versionCommand", {"sh", "-c", ": > started"}},
          {"ofValue", 0},
          {"ofPeak", 0}}}}});
  EXPECT_THAT(error_words(ExitCode::kUsage, [&] { exec(chunk.dump(), {}); }),
              testing::AllOf(testing::HasSubstr("start '/evil/povray' as povray"),
                             testing::HasSubstr("start 'sh evil.sh '{out}'' by engine mine"),
                             testing::HasSubstr("write into the cache"),
                             testing::HasSubstr("--allow-commands")));
  EXPECT_FALSE(std::filesystem::exists(directory_.path() / "cache"));
  EXPECT_FALSE(std::filesystem::exists(directory_.path() / "started"));
}

TEST_F(HostileChunk, IsNotDoneInPlaceOfTheOneThatWasPlanned) {
  const fs::path file = directory_.path() / "chunk.json", cache = directory_.path() / "cache";
  const Sha256Digest planned = sha256(good_.dump());
  for (const std::string& other : {good_.dump() + " ", good_.dump(1), std::string()}) {
    write_file(file, other);
    EXPECT_THAT(
        error_words(ExitCode::kInput, [&] { exec_chunk(file, 1, Leave::of_user(true), planned); }),
        testing::AllOf(testing::HasSubstr("not the chunk that was submitted"),
                       testing::HasSubstr(hex(sha256(other)) + ", not " + hex(planned))));
    EXPECT_FALSE(fs::exists(cache));
  }
  write_file(file, good_.dump());
  EXPECT_EQ(exec_chunk(file, 1, Leave::of_user(true), planned).done, 1u);
}

TEST_F(HostileChunk, IsRefusedWithOneSentenceWhateverIsWrongInIt) {
  std::vector<std::string> texts{"", "{}", "[]", "null", std::string(100000, '[')};
  const Json others[] = {nullptr,
                         -1,
                         "",
                         "x",
                         Json::array(),
                         Json::array({1}),
                         Json::object(),
                         Json::array({Json::object()})};
  for (const auto& [key, value] : good_.items()) {
    // A chunk that only names another machine is handed back (chunk_test).
    if (key == "madeBy" || key == "program" || key == "libraries") continue;
    Json without = good_;
    without.erase(key);
    if (key != "failed") texts.push_back(without.dump());  // without it nothing is kept
    for (const Json& other : others) {
      // Without cells, or engines, there is nothing to be done, and a cache may have any name.
      if (other.type() == value.type() && (other.empty() || key == "cache")) continue;
      Json chunk = good_;
      chunk[key] = other;
      texts.push_back(chunk.dump());
    }
  }
  for (const std::string key :
       {"timeLimit", "noProgressLimit", "attempts", "giveUpAfter", "memory", "disk"})
    for (const Json& other : {Json(nullptr), Json("x"), Json(-5), Json(1e300), Json(1e12)}) {
      // So many bytes are not too many.
      if (other == Json(1e12) && (key == "memory" || key == "disk")) continue;
      Json chunk = good_;
      chunk["limits"][key] = other;
      texts.push_back(chunk.dump());
    }
  Json of_no_scene = good_;
  of_no_scene["cells"][0]["scene"] = "<scene/>";
  texts.push_back(of_no_scene.dump());
  EXPECT_EQ(exec(good_.dump()).done, 1u) << "what is not altered is done";
  for (const auto& text : texts) {
    try {
      exec(text);
      ADD_FAILURE() << "taken for a chunk: " << text.substr(0, 2000);
    } catch (const Error& error) {
      EXPECT_THAT(int(error.code()), testing::AnyOf(2, 3, 4)) << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << " of " << text.substr(0, 2000);
    }
  }
}

}  // namespace
}  // namespace lobelia
