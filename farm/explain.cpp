#include "farm/explain.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <optional>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/sha256.hpp"
#include "core/text.hpp"
#include "farm/cell_directory.hpp"
#include "farm/farm_engines.hpp"
#include "farm/own_identity.hpp"
#include "farm/result_cache.hpp"
#include "farm/upkeep.hpp"
#include "records/record.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostFilesNamed = 5;
constexpr std::uint64_t kMostSceneBytes = 64 << 20;

/// `type` is that of the thing itself: a link is not followed.
bool is_there(const fs::path& path, mode_t type) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && (status.st_mode & S_IFMT) == type;
}

/// The directory of a cell whose name somebody typed.
fs::path directory_of_cell(const fs::path& farm_directory, const std::string& cell) {
  const fs::path cells = farm_directory / "cells";
  if (!is_plain_name(cell) || !is_there(cells, S_IFDIR) || !is_there(cells / cell, S_IFDIR) ||
      !is_there(cells / cell / kCellRecordFile, S_IFREG))
    throw Error(ExitCode::kInput, fmt::format("{}: no cell '{}' with a cell.json",
                                              farm_directory.string(), printable(cell, 200)));
  return cells / cell;
}

/// The engines on this machine, each looked for once.
class Now {
 public:
  explicit Now(const std::map<std::string, fs::path>& programs) : programs_(programs) {}
  const FarmEngine& engine(const std::string& name) {
    const auto found = engines_.find(name);
    if (found != engines_.end()) return found->second;
    const auto program = programs_.find(name);
    const fs::path given = program == programs_.end() ? fs::path() : program->second;
    return engines_.emplace(name, look_for_engine(name, given, FileHashes::of_user()))
        .first->second;
  }

 private:
  const std::map<std::string, fs::path>& programs_;
  std::map<std::string, FarmEngine> engines_;
};

/// The parts of a job's key, then and now.
class Parts {
 public:
  Parts(const std::optional<ResultCache>& cache, Now& now) : cache_(cache), now_(now) {}

  void own(const OwnIdentity& was) {
    const OwnIdentity& is = own_identity();
    add("program", was.program, is.program);
    add("libraries", was.libraries, is.libraries, files(was.libraries, own_libraries()));
    add("arithmetic: libm", was.arithmetic.libm, is.arithmetic.libm);
    add("arithmetic: kernels", was.arithmetic.kernels, is.arithmetic.kernels);
    add("arithmetic: processor", was.arithmetic.processor, is.arithmetic.processor);
  }

  void scene(const std::string& was, const fs::path& file) {
    std::string is = "not there";
    try {
      is = hex(sha256(read_file(file, kMostSceneBytes)));
    } catch (const Error&) {
    }
    add("scene", was, is);
  }

  void engine(const std::string& name, const std::string& version, const std::string& content) {
    const FarmEngine& here = now_.engine(name);
    const std::string title(here.engine->info().title);
    if (!here.is_here()) {
      add(title, version,
          fmt::format("{}: {}", state_name(here.engine->status().state),
                      here.engine->status().why));
      return;
    }
    add(title + ": version", version, here.version);
    if (!content.empty() || !here.content.empty())
      add(title + ": content", content, here.content, files(content, here.files));
  }

  void input(const std::string& whose, const std::string& key,
             const records::Named<std::string>& results) {
    const std::string job = whose == "lobelia" ? "render" : "reference-" + whose;
    const std::string* now = records::find(results, job);
    add("input " + job, key, now ? *now : "not there");
  }

  std::vector<records::ExplainedPart> list() && { return std::move(list_); }

 private:
  void add(const std::string& part, const std::string& was, const std::string& is,
           std::vector<std::string> changed_files = {}) {
    if (was == is) changed_files.clear();
    list_.push_back({part, was, is, was == is, std::move(changed_files)});
  }
  std::vector<std::string> files(const std::string& was, const Content& is) const {
    if (was == is.sha256 || !cache_) return {};
    const auto before = cache_->content(was);
    return before ? file_changes(*before, is, kMostFilesNamed) : std::vector<std::string>();
  }

  const std::optional<ResultCache>& cache_;
  Now& now_;
  std::vector<records::ExplainedPart> list_;
};

/// No farm has written this record.
struct NotOurs {};

/// Empty for a job of ours.
std::string engine_of_job(const std::string& job) {
  for (const std::string_view kind : {"reference-", "compare-"}) {
    if (!job.starts_with(kind)) continue;
    std::string engine = job.substr(kind.size());
    if (std::ranges::find(engine_infos(), engine, &EngineInfo::name) == engine_infos().end())
      throw NotOurs();
    return engine;
  }
  return "";
}

std::string value_of(const records::Named<std::string>& values, const std::string& name) {
  const std::string* value = records::find(values, name);
  return value ? *value : "";
}

records::ExplainedJob explain_job(const std::string& job, const std::string& key_text,
                                  const records::Cell& cell, const fs::path& cell_directory,
                                  const std::optional<ResultCache>& cache, Now& now) {
  ResultKey key;
  if (!from_hex(key_text, key.digest)) throw NotOurs();
  std::string why_not = "the cache is not there";
  std::optional<records::Result> result;
  if (cache) result = cache->find(key, ResultCache::Look::kQuick, why_not);

  // A lost result had the parts that the cell had.
  const records::MadeFrom& made_from = cell.made_from;
  Parts parts(cache, now);
  parts.own(result ? OwnIdentity::of_record(result->inputs) : OwnIdentity::of_record(made_from));
  parts.scene(result ? result->inputs.scene : made_from.scene, cell_directory / "scene.xml");
  if (const std::string engine = engine_of_job(job); !engine.empty()) {
    if (result)
      parts.engine(engine, result->inputs.engine_version, result->inputs.engine_content);
    else if (records::find(made_from.engines, engine))
      parts.engine(engine, value_of(made_from.engines, engine),
                   value_of(made_from.contents, engine));
    else
      throw NotOurs();
  }
  if (result)
    for (const auto& [whose, input] : result->inputs.pictures)
      if (whose == "lobelia" || records::find(made_from.engines, whose))
        parts.input(whose, input, cell.results);
  return {job, key_text, result.has_value(), result ? "" : why_not, std::move(parts).list()};
}

}  // namespace

records::FarmExplanation explain_cell(const fs::path& directory, const std::string& cell,
                                      const std::string& job,
                                      const std::map<std::string, fs::path>& programs) {
  const fs::path cell_directory = directory_of_cell(directory, cell);
  std::optional<ResultCache> cache;
  try {
    if (const CachePlace place = cache_of(directory); place.is_there)
      cache.emplace(place.cache, ResultCache::Opening::kLook);
  } catch (const Error&) {  // then nothing is in it
  }
  const auto record = records::read_record<records::Cell>(cell_directory / kCellRecordFile);
  records::FarmExplanation explanation;
  explanation.cell = cell;
  explanation.status = record.status;
  Now now(programs);
  std::string names;
  try {
    for (const auto& [name, key] : record.results) {
      names += (names.empty() ? "" : ", ") + name;
      if (job.empty() || job == name)
        explanation.jobs.push_back(explain_job(name, key, record, cell_directory, cache, now));
    }
  } catch (const NotOurs&) {
    throw Error(ExitCode::kInput, fmt::format("{}: its cell.json is none that this version wrote",
                                              cell_directory.string()));
  }
  if (!job.empty() && explanation.jobs.empty())
    throw Error(ExitCode::kInput,
                fmt::format("{}: cell {} has no result of a job '{}'; it has {}",
                            directory.string(), printable(cell, 200), printable(job, 200),
                            names.empty() ? "none" : printable(names, 400)));
  for (const auto& problem : record.problems)
    explanation.without.push_back(fmt::format("{}: {}", problem.engine, problem.message));
  for (const auto& engine : record.missing_engines)
    explanation.without.push_back(fmt::format("{}: it was absent", engine));
  return explanation;
}

}  // namespace lobelia
