#include "farm/cell_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>

#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "farm/make_result.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr auto kCross = HeldDirectory::Border::kCross;  // a larger disk may be mounted there

/// The files that a farm of any version may have put into a cell for an engine alone.
std::set<std::string> names_of(const std::string& engine) {
  return {engine + ".exr", engine + "-error.exr", engine + ".json", engine + ".png",
          engine + ".log"};
}

/// Likewise for all engines together, the catalogue's and `outside` ones, and for us.
std::set<std::string> names_of_all(const std::set<std::string>& outside) {
  std::set<std::string> engines = outside, all{"profile.json", "scene.xml"};
  engines.insert(kOurs);
  for (const auto& engine : engine_infos()) engines.emplace(engine.name);
  for (const std::string& a : engines) {
    all.merge(names_of(a));
    for (const std::string& b : engines)
      if (a != b)
        for (const char* ending : {".json", ".png"}) all.insert(comparison_name(a, b) + ending);
  }
  return all;
}

/// Whether `there` is the file in the cache, or an untouched copy of it.
bool is_same_file(const fs::path& cached, const fs::path& there) {
  struct stat a {
  }, b{};
  if (::lstat(cached.c_str(), &a) != 0 || ::lstat(there.c_str(), &b) != 0) return false;
  if (a.st_dev == b.st_dev && a.st_ino == b.st_ino) return true;
  return a.st_size == b.st_size && a.st_mtim.tv_sec == b.st_mtim.tv_sec &&
         a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

[[noreturn]] void fail(const fs::path& path, int error) {
  throw Error(ExitCode::kOutput, "{}: cannot write: {}", path.string(), std::strerror(error));
}

/// Makes `part` a link to `cached`, or a copy of the same age if the cache is on another file system.
void link_or_copy(const fs::path& cached, const HeldDirectory& directory, const std::string& part,
                  const fs::path& target) {
  if (::linkat(AT_FDCWD, cached.c_str(), directory.fd(), part.c_str(), 0) == 0) return;
  if (errno == ENOENT || errno == ENOSPC || errno == EROFS || errno == EACCES) fail(target, errno);
  const fs::path path = directory.path() / part;
  write_file(path, read_file(cached, kMostHashedBytes));
  struct stat status {};
  if (::stat(cached.c_str(), &status) != 0) {
    const int number = errno;
    remove_part(path);
    fail(target, number);
  }
  const timespec times[2] = {status.st_atim, status.st_mtim};
  ::utimensat(directory.fd(), part.c_str(), times, AT_SYMLINK_NOFOLLOW);
}

void place_file(const fs::path& cached, const HeldDirectory& directory, const std::string& name) {
  const fs::path target = directory.path() / name;
  for (int attempt = 0; !is_same_file(cached, target); ++attempt) {
    if (::linkat(AT_FDCWD, cached.c_str(), directory.fd(), name.c_str(), 0) == 0) return;
    const std::string part = part_path(name).string();
    link_or_copy(cached, directory, part, target);
    const int error =
        ::renameat(directory.fd(), part.c_str(), directory.fd(), name.c_str()) == 0 ? 0 : errno;
    // rename() between two links of one file leaves both.
    remove_part(directory.path() / part);
    // ENOENT: a farm of another machine removed the part as abandoned.
    if (error != 0 && (error != ENOENT || attempt == 3)) fail(target, error);
  }
}

/// May remove a cell's files, and empty directories of such names.
Removal removal_from(const HeldDirectory& directory, const std::set<std::string>& names) {
  return Removal(directory.path(),
                 {[&](const HeldDirectory& root) { return root.is_same_as(directory); },
                  [&directory, names](const fs::path& name) {
                    return name != kCellRecordFile && !names.contains(name.string()) ? Owned::kNo
                           : directory.below(name.string()) ? Owned::kDirectory
                                                            : Owned::kFile;
                  }});
}

std::optional<records::Cell> read_cell_record(const fs::path& directory) {
  if (::access((directory / kCellRecordFile).c_str(), F_OK) != 0) return std::nullopt;
  try {
    return records::read_record<records::Cell>(directory / kCellRecordFile);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    return std::nullopt;
  }
}

/// The files of all results with their hashes, for the gallery.
std::vector<records::CellFile> files_of(const CellRecords& records) {
  std::vector<records::CellFile> files;
  for (const auto& record : records) {
    if (!record) continue;
    for (const auto& file : record->files) files.push_back({file.name, file.sha256});
  }
  return files;
}

HeldDirectory existing(const fs::path& directory) {
  HeldDirectory held(directory);
  if (!held) throw Error(ExitCode::kOutput, "{}: {}", directory.string(), held.why_not());
  return held;
}

}  // namespace

bool is_cell_file(const std::string& name, const std::set<std::string>& outside) {
  return name == kCellRecordFile || names_of_all(outside).contains(name);
}

FarmDirectoryLock::FarmDirectoryLock(const fs::path& directory, Use use, ByteLocks::Opening opening)
    : locks_(existing(directory), "farm.lock", opening) {
  if (auto claim = locks_.try_claim(0, use == Use::kFarm))
    claim_.emplace(std::move(*claim));
  else
    throw Error(ExitCode::kOutput,
                "{}: {} is at work in this directory; try again when it has ended",
                directory.string(),
                use == Use::kFarm ? "'lobelia farm clean' or 'verify --remove'" : "a farm");
}

CellDirectory::CellDirectory(const fs::path& farm_directory, const JobGraph& graph,
                             std::size_t cell)
    : graph_(&graph),
      cell_(cell),
      farm_directory_(farm_directory),
      directory_(farm_directory / "cells" / graph.cells().cells[cell].id) {}

/// Holds none if it is missing or a link.
HeldDirectory CellDirectory::held() const {
  return HeldDirectory(farm_directory_)
      .below("cells", kCross)
      .below(directory_.filename().string(), kCross);
}

/// Those of now, and those of which the cell has files from earlier.
std::set<std::string> CellDirectory::outside_engines() const {
  std::set<std::string> names;
  for (const auto& engine : graph_->engines())
    if (engine.engine->outside()) names.insert(engine.name);
  if (const auto record = read_cell_record(directory_))
    for (const auto& [name, version] : record->made_from.engines)
      if (is_plain_name(name)) names.insert(name);
  return names;
}

records::Named<std::string> CellDirectory::results(const CellRecords& records) const {
  records::Named<std::string> found;
  for (const JobIndex job : graph_->jobs(cell_))
    if (const auto& result = records[graph_->place(job)])
      found.emplace_back(graph_->name_in_cell(job), result->key);
  return found;
}

records::MadeFrom CellDirectory::made_from() const {
  records::MadeFrom made_from;
  own_identity().put_into(made_from);
  made_from.scene = graph_->scene_hash(cell_);
  for (const auto& here : graph_->engines()) {
    if (!here.is_known()) continue;
    made_from.engines.emplace_back(here.name, here.version);
    if (!here.content.empty()) made_from.contents.emplace_back(here.name, here.content);
  }
  return made_from;
}

std::string CellDirectory::current_status(const ResultCache& cache,
                                          const CellRecords& records) const {
  const auto record = held() ? read_cell_record(directory_) : std::nullopt;
  if (!record || !record->problems.empty() || record->results != results(records) ||
      record->made_from != made_from() || record->files != files_of(records))
    return "";
  for (const JobIndex job : graph_->jobs(cell_)) {
    const auto& result = records[graph_->place(job)];
    if (!result) continue;
    for (const auto& file : result->files)
      if (!is_same_file(cache.file((*graph_)[job].key, file.name), directory_ / file.name))
        return "";
  }
  return record->status;
}

void CellDirectory::remove_abandoned() const {
  if (const HeldDirectory directory = held()) remove_abandoned_parts(directory);
}

void CellDirectory::write(const ResultCache& cache, const CellRecords& records,
                          const std::vector<CellProblem>& problems, GroupFlush& flush,
                          std::function<void(const std::string& status)> on_status) const {
  make_directories(farm_directory_);
  const HeldDirectory directory = HeldDirectory(farm_directory_)
                                      .make_below("cells", kCross)
                                      .make_below(directory_.filename().string(), kCross);
  remove_abandoned_parts(directory);
  std::set<std::string> foreign;
  if (const std::vector<std::string> there = directory.names(); !there.empty())
    std::ranges::set_intersection(there, names_of_all(outside_engines()),
                                  std::inserter(foreign, foreign.end()));
  Removal removal = removal_from(directory, foreign);
  // The old record is about files that change now.
  removal.remove(kCellRecordFile);

  bool complete = true;
  for (const JobIndex job : graph_->jobs(cell_)) {
    const auto& result = records[graph_->place(job)];
    complete = complete && result;
    if (!result) continue;
    for (const auto& [name, bytes, sha256, modified] : result->files) {
      if (foreign.contains(name) && removal.directory(name)) removal.remove(name);  // only if empty
      place_file(cache.file((*graph_)[job].key, name), directory, name);
      foreign.erase(name);
    }
  }
  for (const auto& problem : problems) {
    if (problem.log.empty()) continue;
    const std::string log = problem.record.engine + ".log";
    place_file(problem.log, directory, log);
    foreign.erase(log);
  }
  // Pictures of an absent engine stay: they could not be made again.
  for (const auto& engine : graph_->engines())
    if (!engine.is_here())
      std::erase_if(foreign, [&](const std::string& name) {
        return names_of(engine.name).contains(name) ||
               name.find("-" + engine.name + ".") != name.npos ||
               name.starts_with(engine.name + "-");
      });
  for (const auto& name : foreign) removal.remove(name);

  records::Cell record = cell_record(records);
  for (const auto& problem : problems) record.problems.push_back(problem.record);
  if (!problems.empty())
    record.status = "failed";
  else if (!complete)
    record.status = "missing";
  const auto part = std::make_shared<PartFile>(directory_ / kCellRecordFile, AtLink::kReplace);
  part->append(records::record_text(record));
  flush.add({part->part()},
            [part, &flush, status = record.status, on_status = std::move(on_status)] {
              const auto is_flushed = flush.later();
              part->finish();
              on_status(status);
            });
}

records::Cell CellDirectory::cell_record(const CellRecords& records) const {
  const Cell& cell = graph_->cells().cells[cell_];
  records::Cell record;
  record.id = cell.id;
  for (const auto& [name, value] : cell.axes) record.axes.emplace_back(name, value);
  const auto add_image = [&](const std::string& engine, const records::Result& result) {
    const std::string file = picture_file(engine);
    record.images.push_back(
        {engine, file, engine + ".png", engine + ".json", result.hash_of(file)});
  };
  if (const auto& ours = records[0]) {
    record.highlight = ours->highlight;
    record.exposure_stops = ours->exposure_stops;
    if (graph_->cells().ours) add_image(kOurs, *ours);
  }
  bool judged = false;
  std::string worst = "pass";
  for (std::size_t e = 0; e < graph_->engines().size(); ++e) {
    const std::string& engine = graph_->engines()[e].name;
    if (std::string why = graph_->refusal(cell_, e); !why.empty())
      record.not_comparable.push_back({engine, std::move(why)});
    const auto& reference = records[graph_->place(graph_->reference(cell_, e))];
    const auto& compared = records[graph_->place(graph_->compare(cell_, e))];
    if (!reference || !compared) continue;
    add_image(engine, *reference);
    // It was compared with ours only for its PNG.
    if (!graph_->cells().ours && compared->entry && compared->entry->a == kOurs) continue;
    if (!compared->entry) {
      record.not_comparable.push_back({engine, compared->not_comparable});
      continue;
    }
    record.comparisons.push_back(*compared->entry);
    judged = true;
    const std::string& verdict = compared->verdict;
    if (verdict == "undecided" && worst == "pass") worst = "undecided";
    if (verdict != "undecided" && verdict != "pass" && verdict != "same") worst = "differs";
  }
  record.status = judged ? worst : "unchecked";
  if (records.back()) record.profile = "profile.json";
  for (const std::size_t e : graph_->missing_engines(cell_))
    record.missing_engines.push_back(graph_->engines()[e].name);
  record.made_from = made_from();
  record.results = results(records);
  record.files = files_of(records);
  return record;
}

void CellDirectory::forget() const {
  if (const HeldDirectory directory = held()) removal_from(directory, {}).remove(kCellRecordFile);
}

std::string CellDirectory::reason(JobIndex job) const {
  if (!before_) before_ = read_cell_record(directory_);
  const auto& record = *before_;
  const Job& wanted = (*graph_)[job];
  if (!record) return "missing";
  const records::MadeFrom& before = record->made_from;
  if (before.scene != graph_->scene_hash(cell_)) return "scene changed";
  const auto engine_reason = [&](std::size_t e) -> std::string {
    const FarmEngine& here = graph_->engines()[e];
    const std::string* was = records::find(before.engines, here.name);
    if (!was) return "";
    if (*was != here.version)
      return fmt::format("engine version changed: {}, was {}", here.version, *was);
    const std::string* content = records::find(before.contents, here.name);
    if ((content ? *content : "") == here.content) return "";
    return fmt::format("engine changed under the same version {}", *was);
  };
  for (std::size_t e = 0; e < graph_->engines().size(); ++e)
    if (wanted.engine == e || wanted.kind == JobKind::kProfile)
      if (std::string changed = engine_reason(e); !changed.empty()) return changed;
  const OwnIdentity& own = own_identity();
  if (before.program != own.program) return "program changed";
  if (before.libraries != own.libraries) return "libraries changed";
  if (before.arithmetic != own.arithmetic) return "arithmetic differs";
  const std::string* key = records::find(record->results, graph_->name_in_cell(job));
  return key && *key == wanted.key.text() ? "lost from the cache" : "missing";
}

}  // namespace lobelia
