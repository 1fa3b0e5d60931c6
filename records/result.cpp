#include "records/result.hpp"

#include <algorithm>

#include "core/sha256.hpp"

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

const Struct& Arithmetic::type() {
  return define<Arithmetic>("Arithmetic", "How a machine calculates.", [](Struct& t) {
    t.key<&Arithmetic::libm>("libm", "SHA-256 of what its functions return");
    t.key<&Arithmetic::kernels>("kernels", "instruction set of the inner loops");
    t.key<&Arithmetic::processor>("processor", "instruction sets that libm may choose by");
  });
}

const Struct& ResultInputs::type() {
  return define<ResultInputs>("ResultInputs", "What decides a result.", [](Struct& t) {
    t.key<&ResultInputs::program>("program", "to the build");
    t.key<&ResultInputs::libraries>("libraries", "SHA-256");
    t.key<&ResultInputs::arithmetic>("arithmetic");
    t.key<&ResultInputs::scene>("scene", "SHA-256");
    t.key<&ResultInputs::engine_version>("engineVersion").if_any();
    t.key<&ResultInputs::engine_content>("engineContent", "SHA-256").if_any();
    t.rest<&ResultInputs::pictures>("keys of the results that it is made from, by engine");
  });
}

const Struct& ResultSeconds::type() {
  return define<ResultSeconds>(
      "ResultSeconds", "Time that a result took, in seconds.", [](Struct& t) {
        t.key<&ResultSeconds::wall>("wall", "of an engine's picture from when its turn came");
        t.key<&ResultSeconds::cpu>("cpu");
      });
}

const Struct& ResultFile::type() {
  return define<ResultFile>("ResultFile", "A file of a result.", [](Struct& t) {
    t.key<&ResultFile::name>("name").plain_name();
    t.key<&ResultFile::bytes>("bytes");
    t.key<&ResultFile::sha256>("sha256");
    t.key<&ResultFile::modified>("modified", "time of change").unit("nanoseconds");
  });
}

const Struct& Difference::type() {
  return define<Difference>(
      "Difference", "The scale of a difference picture, |a - b| / whiteAt, clipped at 1.",
      [](Struct& t) {
        t.key<&Difference::white_at>("whiteAt", "radiance").may_be_nonfinite();
        t.key<&Difference::relative_to_peak>("relativeToPeak",
                                             "of the reference's brightest value");
      });
}

const Struct& CellComparison::type() {
  return define<CellComparison>("CellComparison", "Where a cell has a comparison.", [](Struct& t) {
    t.key<&CellComparison::a>("a").plain_name();
    t.key<&CellComparison::b>("b").plain_name();
    t.key<&CellComparison::record>("record").plain_name();
    t.key<&CellComparison::png>("png").plain_name();
    t.key<&CellComparison::difference>("difference");
  });
}

const Struct& Result::type() {
  return define<Result>(
      "Result", "A result in the cache: results/ab/KEY/result.json beside its files.",
      [](Struct& t) {
        t.kind("result", Seal::kYes);
        t.key<&Result::job>("job").one_of(kJobs);
        t.key<&Result::engine>("engine").if_any();
        t.key<&Result::first_made_for>("firstMadeFor", "a cell");
        t.key<&Result::inputs>("inputs");
        t.key<&Result::host>("host");
        t.key<&Result::attempts>("attempts");
        t.key<&Result::command>("command", "makes it again").if_any();
        t.key<&Result::exposure_stops>("exposureStops").unit("stops");
        t.key<&Result::highlight>("highlight");
        t.key<&Result::warnings>("warnings");
        t.key<&Result::engine_commands>("engineCommands");
        t.key<&Result::witness>("witness").if_any();
        t.key<&Result::verdict>("verdict").if_any();
        t.key<&Result::entry>("entry", "as the cell's record has it");
        t.key<&Result::not_comparable>("notComparable", "why there is no comparison").if_any();
        t.key<&Result::from>("from", "SHA-256 of each picture that it is of, by engine");
        t.key<&Result::threads>("threads");
        t.key<&Result::seconds>("seconds");
        t.key<&Result::peak_memory_bytes>("peakMemoryBytes",
                                          "of what ran in this process, that of the process so far")
            .unit("bytes");
        t.key<&Result::key>("key");
        t.key<&Result::files>("files");
      });
}

const Struct& Failure::type() {
  return define<Failure>("Failure", "Why there is no result: failures/ab/KEY.json in the cache.",
                         [](Struct& t) {
                           t.kind("failure");
                           t.key<&Failure::job>("job");
                           t.key<&Failure::key>("key");
                           t.key<&Failure::failure>("failure", "a class of docs/farm.md");
                           t.key<&Failure::message>("message");
                           t.key<&Failure::attempts>("attempts");
                           t.key<&Failure::host>("host");
                         });
}

const Struct& ContentFile::type() {
  return define<ContentFile>("ContentFile", "A file that a program runs, loads or reads.",
                             [](Struct& t) {
                               t.key<&ContentFile::path>("path");
                               t.key<&ContentFile::bytes>("bytes");
                               t.key<&ContentFile::sha256>("sha256");
                             });
}

const Struct& Content::type() {
  return define<Content>("Content", "What libraries or an engine of one hash consist of.",
                         [](Struct& t) {
                           t.kind("content");
                           t.key<&Content::sha256>("sha256");
                           t.key<&Content::file_count>("fileCount");
                           t.key<&Content::files>("files", "the first 10000");
                         });
}

const Struct& KnownHashes::type() {
  return define<KnownHashes>(
      "KnownHashes", "Hashes of files that seldom change, of one user on one machine.",
      [](Struct& t) {
        t.kind("file-hashes", Seal::kYes);
        t.key<&KnownHashes::files>("files", "path, identity, SHA-256").items(0, 50000);
      });
}

}  // namespace lobelia::records
