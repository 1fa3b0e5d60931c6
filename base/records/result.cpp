#include "base/records/result.hpp"

#include <algorithm>

#include "base/system/sha256.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kJobs[] = {"render", "reference", "compare", "profile"};

}  // namespace

std::string Result::hash_of(const std::string& file) const {
  const auto found = std::ranges::find(files, file, &ResultFile::name);
  return found == files.end() ? "" : found->sha256;
}

std::uint64_t Result::bytes() const {
  std::uint64_t sum = 0;
  for (const ResultFile& file : files) sum += file.bytes;
  return sum;
}

void define_result_tables(Tables& tables) {
  tables.define<Arithmetic>("How a machine calculates.", [](auto& t) {
    t.key("libm", "SHA-256 of what its functions return");
    t.key("kernels", "instruction set of the inner loops");
    t.key("processor", "instruction sets that libm may choose by");
  });
  tables.define<ResultInputs>("What decides a result.", [](auto& t) {
    t.key("program", "to the build");
    t.key("libraries", "SHA-256");
    t.key("scene", "SHA-256");
    t.key("engineVersion").if_any();
    t.key("engineContent", "SHA-256").if_any();
    t.rest("pictures", "keys of the results that it is made from, by engine");
  });
  tables.define<ResultSeconds>("Time that a result took, in seconds.", [](auto& t) {
    t.key("wall", "of an engine's picture from when its turn came");
  });
  tables.define<ResultFile>("A file of a result.", [](auto& t) {
    t.key("name").plain_name();
    t.key("modified", "time of change").unit("nanoseconds");
  });
  tables.define<Difference>("The scale of a difference picture, |a - b| / whiteAt, clipped at 1.",
                            [](auto& t) {
                              t.key("whiteAt", "radiance").may_be_nonfinite();
                              t.key("relativeToPeak", "of the reference's brightest value");
                            });
  tables.define<CellComparison>("Where a cell has a comparison.", [](auto& t) {
    t.keys({"a", "b", "record", "png"}).plain_name();
  });
  tables.define<Result>(
      "A result in the cache: results/ab/KEY/result.json beside its files.", [](auto& t) {
        t.kind("result", Seal::kYes);
        t.key("job").one_of(kJobs);
        t.keys({"engine", "verdict"}).if_any();
        t.key("shading").renamed("witness").if_any();
        t.key("firstMadeFor", "a cell");
        t.key("command", "makes it again").if_any();
        t.key("exposureStops").unit("stops");
        t.key("entry", "as the cell's record has it");
        t.key("notComparable", "why there is no comparison").if_any();
        t.key("from", "SHA-256 of each picture that it is of, by engine");
        t.key("peakMemoryBytes", "of what ran in this process, that of the process so far")
            .unit("bytes");
      });
  tables.define<Failure>("Why there is no result: failures/ab/KEY.json in the cache.", [](auto& t) {
    t.kind("failure");
    t.key("failure", "a class of docs/farm.md");
  });
  tables.define<ContentFile>("A file that a program runs, loads or reads.");
  tables.define<Content>("What libraries or an engine of one hash consist of.", [](auto& t) {
    t.kind("content");
    t.key("files", "the first 10000");
  });
  tables.define<KnownHashes>("Hashes of files that seldom change, of one user on one machine.",
                             [](auto& t) {
                               t.kind("file-hashes", Seal::kYes);
                               t.key("files", "path, identity, SHA-256").items(0, 50000);
                             });
}

}  // namespace lobelia::records
