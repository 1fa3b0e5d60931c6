#include <fmt/format.h>
#include <sys/stat.h>

#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "farm/cell_directory.hpp"
#include "farm/upkeep.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostFilesNamed = 5;
constexpr std::uint64_t kMostSceneBytes = 64 << 20;

/// Does not follow a link.
bool is_there(const fs::path& path, mode_t type) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && (status.st_mode & S_IFMT) == type;
}

/// The directory of a cell that the user named.
fs::path directory_of_cell(const fs::path& farm_directory, const std::string& cell) {
  const fs::path cells = farm_directory / "cells";
  if (!is_plain_name(cell) || !is_there(cells, S_IFDIR) || !is_there(cells / cell, S_IFDIR) ||
      !is_there(cells / cell / kCellRecordFile, S_IFREG))
    throw Error(ExitCode::kInput, "{}: no cell '{}' with a cell.json", farm_directory.string(),
                printable(cell, 200));
  return cells / cell;
}

/// cell.json is not a record that a farm wrote.
struct ForeignRecord {};

bool is_of_catalogue(const std::string& engine) {
  return std::ranges::find(engine_infos(), engine, &EngineInfo::name) != engine_infos().end();
}

/// Empty for a render or a profile.
std::string engine_of_job(const std::string& job, const records::MadeFrom& made_from) {
  for (const std::string_view kind : {"reference-", "compare-"}) {
    if (!job.starts_with(kind)) continue;
    std::string engine = job.substr(kind.size());
    if (!is_of_catalogue(engine) && !records::find(made_from.engines, engine))
      throw ForeignRecord();
    return engine;
  }
  return "";
}

std::string value_of(const records::Named<std::string>& values, const std::string& name) {
  const std::string* value = records::find(values, name);
  return value ? *value : "";
}

/// Compares the parts of each job's key, as the records have them, with those of now.
class Explainer {
 public:
  Explainer(const fs::path& directory, const records::Cell& cell,
            const std::optional<ResultCache>& cache, const ProgramPaths& programs)
      : directory_(directory), cell_(cell), cache_(cache), programs_(programs) {}

  records::ExplainedJob job(const std::string& name, const std::string& key_text) {
    ResultKey key;
    if (!from_hex(key_text, key.digest)) throw ForeignRecord();
    std::string why_not = "the cache is not there";
    std::optional<records::Result> result;
    if (cache_) result = cache_->find(key, ResultCache::Look::kQuick, &why_not);

    parts_.clear();
    // The cell's record has the parts of a result that is lost.
    const records::MadeFrom& made_from = cell_.made_from;
    add_own(result ? OwnIdentity::of_record(result->inputs) : OwnIdentity::of_record(made_from));
    add_scene(result ? result->inputs.scene : made_from.scene);
    if (const std::string engine = engine_of_job(name, made_from); !engine.empty()) {
      if (result)
        add_engine(engine, result->inputs.engine_version, result->inputs.engine_content);
      else if (records::find(made_from.engines, engine))
        add_engine(engine, value_of(made_from.engines, engine),
                   value_of(made_from.contents, engine));
      else
        throw ForeignRecord();
    }
    if (result)
      for (const auto& [whose, input] : result->inputs.pictures)
        if (whose == kOurs || records::find(made_from.engines, whose)) add_input(whose, input);
    return {name, key_text, result.has_value(), result ? "" : why_not, parts_};
  }

 private:
  void add(const std::string& part, const std::string& was, const std::string& is,
           std::vector<std::string> changed_files = {}) {
    parts_.push_back({part, was, is, was == is, std::move(changed_files)});
  }
  std::vector<std::string> changed_files(const std::string& was, const Content& is) const {
    if (was == is.sha256 || !cache_) return {};
    const auto before = cache_->content(was);
    return before ? file_changes(*before, is, kMostFilesNamed) : std::vector<std::string>();
  }

  void add_own(const OwnIdentity& was) {
    const OwnIdentity& is = own_identity();
    add("program", was.program, is.program);
    add("libraries", was.libraries, is.libraries, changed_files(was.libraries, own_libraries()));
    add("arithmetic: libm", was.arithmetic.libm, is.arithmetic.libm);
    add("arithmetic: kernels", was.arithmetic.kernels, is.arithmetic.kernels);
    add("arithmetic: processor", was.arithmetic.processor, is.arithmetic.processor);
  }

  void add_scene(const std::string& was) {
    std::string is = "not there";
    try {
      is = hex(sha256(read_file(directory_ / "scene.xml", kMostSceneBytes)));
    } catch (const Error&) {
    }
    add("scene", was, is);
  }

  void add_engine(const std::string& name, const std::string& version, const std::string& content) {
    // Only the grid says how to ask it.
    if (!is_of_catalogue(name)) return add(name + ": version", version, version);
    auto found = engines_.find(name);
    if (found == engines_.end())
      found = engines_
                  .emplace(name, look_for_engine(make_engine(name, program_for(programs_, name)),
                                                 FileHashes::of_user()))
                  .first;
    const FarmEngine& here = found->second;
    const EngineStatus& status = here.engine->status();
    const std::string title(here.engine->info().title);
    if (!here.is_here())
      return add(title, version, fmt::format("{}: {}", state_name(status.state), status.why));
    add(title + ": version", version, here.version);
    if (!content.empty() || !here.content.empty())
      add(title + ": content", content, here.content, changed_files(content, here.files));
  }

  void add_input(const std::string& whose, const std::string& key) {
    const std::string job = whose == kOurs ? "render" : "reference-" + whose;
    const std::string* now = records::find(cell_.results, job);
    add("input " + job, key, now ? *now : "not there");
  }

  const fs::path& directory_;
  const records::Cell& cell_;
  const std::optional<ResultCache>& cache_;
  const ProgramPaths& programs_;
  std::map<std::string, FarmEngine> engines_;  ///< of this machine, each looked for once
  std::vector<records::ExplainedPart> parts_;  ///< of the job at hand
};

}  // namespace

records::FarmExplanation explain_cell(const fs::path& directory, const std::string& cell,
                                      const std::string& job, const ProgramPaths& programs) {
  const fs::path cell_directory = directory_of_cell(directory, cell);
  std::optional<ResultCache> cache;
  try {
    if (const CachePlace place = cache_of(directory); place.is_there)
      cache.emplace(place.cache, ResultCache::Opening::kLook);
  } catch (const Error&) {  // as if it were empty
  }
  const auto record = records::read_record<records::Cell>(cell_directory / kCellRecordFile);
  records::FarmExplanation explanation;
  explanation.cell = cell;
  explanation.status = record.status;
  Explainer explainer(cell_directory, record, cache, programs);
  std::string names;
  try {
    for (const auto& [name, key] : record.results) {
      names += (names.empty() ? "" : ", ") + name;
      if (job.empty() || job == name) explanation.jobs.push_back(explainer.job(name, key));
    }
  } catch (const ForeignRecord&) {
    throw Error(ExitCode::kInput, "{}: its cell.json is none that this version wrote",
                cell_directory.string());
  }
  if (!job.empty() && explanation.jobs.empty())
    throw Error(ExitCode::kInput, "{}: cell {} has no result of a job '{}'; it has {}",
                directory.string(), printable(cell, 200), printable(job, 200),
                names.empty() ? "none" : printable(names, 400));
  for (const auto& problem : record.problems)
    explanation.without.push_back(fmt::format("{}: {}", problem.engine, problem.message));
  for (const auto& engine : record.missing_engines)
    explanation.without.push_back(fmt::format("{}: it was absent", engine));
  return explanation;
}

}  // namespace lobelia
