#include "farm/upkeep.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>

#include "base/pictures/image_io.hpp"
#include "base/pictures/image_values.hpp"
#include "base/records/farm_file.hpp"
#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "farm/cell_directory.hpp"
#include "farm/failed_jobs.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// Why a file with the right hash cannot be opened as a picture or a record; empty if it can.
std::string why_not_readable(const fs::path& file) {
  try {
    const std::string name = file.filename().string();
    if (name.ends_with(".exr") && !is_finite(read_trusted_image(file)))
      return "has values that are not finite";
    if (name.ends_with(".png")) read_trusted_image(file);
    if (name.ends_with(".json") &&
        !records::is_json(read_file(file, std::numeric_limits<std::uint32_t>::max())))
      return "is not JSON";
    return "";
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    return error.what();
  }
}

std::string title_of(const ResultKey& key, const std::optional<records::Result>& record) {
  if (!record) return key.text();
  return fmt::format("{} ({}{} of {})", key.text(), record->job,
                     record->engine.empty() ? "" : " by " + printable(record->engine),
                     printable(record->first_made_for));
}

records::Farm read_farm_record(const fs::path& directory) {
  return records::read_farm(directory / "farm.json");
}

template <class F>
void in_parallel(std::size_t count, const OnProgress& on_progress, F f) {
  std::mutex mutex;
  std::size_t done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    throw_if_interrupted();
    f(i);
    const std::scoped_lock lock(mutex);
    if (on_progress) on_progress(++done, count);
  });
}

/// The time of the last change, to sort by.
std::pair<std::int64_t, std::int64_t> changed(const fs::path& path) {
  struct stat status {};
  ::stat(path.c_str(), &status);
  return {status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

/// Whether a path below a farm's directory may be removed: the farm or its gallery may have written it.
Owned owned_in_farm(const fs::path& relative, const std::set<std::string>& of_gallery,
                    const std::set<std::string>& engines) {
  const std::vector<std::string> parts(relative.begin(), relative.end());
  const std::string& name = parts.back();
  if (parts.size() == 1 && (name == "farm.json" || is_part_name(name))) return Owned::kFile;
  if (parts[0] == FailedJobs::kName && parts.size() <= 3)
    return parts.size() < 3 ? Owned::kDirectory : Owned::kTree;
  if (parts[0] != "cells" || parts.size() > 3) return Owned::kNo;
  if (parts.size() < 3) return Owned::kDirectory;
  return is_cell_file(name, engines) || is_part_name(name) || of_gallery.contains(relative.string())
             ? Owned::kFile
             : Owned::kNo;
}

/// The files listed in the gallery.json of a gallery in the farm's directory.
std::set<std::string> files_of_gallery(const fs::path& directory) {
  const auto text = HeldDirectory(directory).read("gallery.json", records::kMaxRecordBytes);
  if (!text) return {};
  try {
    const auto files = records::parse_record<records::GalleryList>(*text, "").files;
    return {files.begin(), files.end()};
  } catch (const Error&) {
    return {};
  }
}

/// The names of the engines in farm.json that can be a part of a file's name.
std::set<std::string> engines_of_farm(const fs::path& directory) {
  std::set<std::string> names;
  try {
    for (const auto& engine : read_farm_record(directory).engines)
      if (is_plain_name(engine.name)) names.insert(engine.name);
  } catch (const Error&) {
    return {};
  }
  return names;
}

/// Removes only while farm.json is there.
Removal removal_from_farm(const fs::path& directory, bool dry_run) {
  return Removal(
      directory,
      {[](const HeldDirectory& root) {
         return root.read("farm.json", records::kMaxRecordBytes).has_value();
       },
       [files = files_of_gallery(directory), engines = engines_of_farm(directory)](
           const fs::path& relative) { return owned_in_farm(relative, files, engines); }},
      dry_run ? Removal::Mode::kDryRun : Removal::Mode::kForReal);
}

/// Throws Error(kOutput) for anything but a directory, such as a link.
HeldDirectory there_or_missing(HeldDirectory directory) {
  if (!directory && !directory.is_missing())
    throw Error(ExitCode::kOutput, "{}: {}", directory.path().string(), directory.why_not());
  return directory;
}

std::vector<std::string> sentences(const std::vector<Removal::Kept>& kept) {
  std::vector<std::string> found;
  for (const auto& one : kept) found.push_back(fmt::format("{}: {}", one.path.string(), one.why));
  return found;
}

/// The files of a cell, compared with its record.
struct CellFindings {
  std::vector<std::pair<std::string, std::string>> damaged;  ///< file and why
  std::set<ResultKey> missing;
  std::size_t files = 0;
  std::uint64_t bytes = 0;
};

CellFindings look_at_cell(const HeldDirectory& cell, const ResultCache* cache) {
  CellFindings found;
  const auto text = cell.read(kCellRecordFile, records::kMaxRecordBytes);
  if (!text) {
    found.damaged.emplace_back(kCellRecordFile, "is missing");
    return found;
  }
  try {
    const auto record = records::parse_record<records::Cell>(*text, "");
    for (const auto& [job, key_text] : record.results) {
      ResultKey key;
      if (!from_hex(key_text, key.digest) || !cache || !cache->has(key)) found.missing.insert(key);
    }
    for (const auto& [name, sha256] : record.files) {
      struct stat status {};
      if (::fstatat(cell.fd(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0 ||
          !S_ISREG(status.st_mode)) {
        found.damaged.emplace_back(name, "is missing");
      } else if (hex(sha256_of_file(cell.path() / name)) != sha256) {
        found.damaged.emplace_back(name, "has another content");
      }
      ++found.files;
      found.bytes += std::uint64_t(status.st_size);
    }
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    found.damaged.emplace_back(kCellRecordFile, fmt::format("is damaged: {}", error.what()));
  }
  return found;
}

}  // namespace

records::StatusCounts count_statuses(const std::vector<std::string>& statuses) {
  std::map<std::string, std::size_t> counts;
  for (const std::string& status : statuses) ++counts[status];
  return {counts["failed"],  counts["differs"],   counts["undecided"],
          counts["missing"], counts["unchecked"], counts["pass"]};
}

CachePlace cache_of(const fs::path& path) {
  std::error_code ignored;
  if (is_cache(path)) return {path, true, false};
  if (!fs::exists(path / "farm.json", ignored))
    throw Error(ExitCode::kInput,
                "{}: neither a farm's directory (it has no farm.json) nor a cache (it has "
                "no lobelia-cache)",
                path.string());
  const std::string recorded = read_farm_record(path).cache;
  const fs::path cache = (path / (recorded.empty() ? "cache" : recorded)).lexically_normal();
  return {cache, is_cache(cache), true};
}

VerifyReport verify_cache(const fs::path& directory, bool remove, const OnProgress& on_progress) {
  const ResultCache cache(directory, ResultCache::Opening::kLook);
  const std::vector<ResultKey> keys = cache.list();
  VerifyReport report;
  report.results = keys.size();
  std::mutex mutex;
  std::map<ResultKey, std::string> damaged;
  in_parallel(keys.size(), on_progress, [&](std::size_t i) {
    std::string why;
    const auto record = cache.find(keys[i], ResultCache::Look::kThorough, &why);
    if (record)
      for (const auto& file : record->files)
        if (const std::string bad = why_not_readable(cache.file(keys[i], file.name)); !bad.empty())
          why = fmt::format("{} {}", file.name, bad);
    const std::scoped_lock lock(mutex);
    if (record) {
      report.files += record->files.size();
      report.bytes += record->bytes();
    }
    if (!why.empty()) damaged[keys[i]] = title_of(keys[i], record) + ": " + why;
  });
  for (const auto& [key, text] : damaged) {
    report.damaged.push_back(text);
    if (remove) cache.discard(key);
  }
  return report;
}

VerifyReport verify_farm(const fs::path& directory, bool remove, const OnProgress& on_progress) {
  const records::Farm farm = read_farm_record(directory);
  std::optional<FarmDirectoryLock> alone;
  if (remove) alone.emplace(directory, FarmDirectoryLock::Use::kAlone);
  const CachePlace place = cache_of(directory);
  VerifyReport report;
  std::optional<ResultCache> cache;
  if (place.is_there) {
    report = verify_cache(place.cache, remove, on_progress);
    cache.emplace(place.cache, ResultCache::Opening::kLook);
  }
  const HeldDirectory cells =
      there_or_missing(HeldDirectory(directory).below("cells", HeldDirectory::Border::kCross));
  const auto& all = farm.cells;
  std::vector<CellFindings> findings(all.size());
  in_parallel(all.size(), on_progress, [&](std::size_t i) {
    const HeldDirectory cell = cells.below(all[i].id, HeldDirectory::Border::kCross);
    // A cell that was never finished has no record.
    struct stat ignored {};
    const bool has_record =
        cell && ::fstatat(cell.fd(), kCellRecordFile, &ignored, AT_SYMLINK_NOFOLLOW) == 0;
    if (has_record || all[i].status != "missing")
      findings[i] = look_at_cell(cell, cache ? &*cache : nullptr);
  });
  Removal removal = removal_from_farm(directory, false);
  std::set<ResultKey> missing;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const fs::path cell = fs::path("cells") / all[i].id;
    report.files += findings[i].files;
    report.bytes += findings[i].bytes;
    missing.insert(findings[i].missing.begin(), findings[i].missing.end());
    for (const auto& [name, why] : findings[i].damaged) {
      report.damaged.push_back(fmt::format("{} {}", (cell / name).string(), why));
      if (!remove) continue;
      removal.remove(cell / name);
      removal.remove(cell / kCellRecordFile);
    }
  }
  report.missing = missing.size();
  return report;
}

GcReport collect_garbage(const fs::path& directory, std::optional<std::uint64_t> max_bytes,
                         const RemovalOptions& options) {
  const ResultCache cache(
      directory, options.dry_run ? ResultCache::Opening::kLook : ResultCache::Opening::kMake);
  const auto alone = cache.try_use(false);
  if (!alone)
    throw Error(ExitCode::kOutput, "{}: a farm is using this cache; try again when it has ended",
                directory.string());
  Removal removal =
      cache.removal(options.dry_run ? Removal::Mode::kDryRun : Removal::Mode::kForReal);
  removal.on_removed(options.on_removed);
  GcReport report;
  const AbandonedDrafts abandoned = cache.remove_abandoned(removal);
  report.abandoned = abandoned.removed;
  report.others = abandoned.others;
  struct Candidate {
    std::pair<std::int64_t, std::int64_t> used;
    ResultKey key;
    std::uint64_t bytes;
  };
  std::vector<Candidate> results;
  for (const ResultKey& key : cache.list()) {
    throw_if_interrupted();
    const auto record = cache.find(key);
    if (!record) {
      if (cache.discard(key, removal)) ++report.removed;
      continue;
    }
    cache.forget_failure(key, removal);
    results.push_back({changed(cache.result_directory(key)), key, record->bytes()});
    report.kept_bytes += results.back().bytes;
  }
  std::ranges::sort(results, [](const Candidate& a, const Candidate& b) {
    return std::tie(a.used, a.key) < std::tie(b.used, b.key);
  });
  report.kept = results.size();
  for (const Candidate& one : results) {
    if (!max_bytes || report.kept_bytes <= *max_bytes) break;
    throw_if_interrupted();
    if (!cache.discard(one.key, removal)) continue;
    ++report.removed;
    --report.kept;
    report.removed_bytes += one.bytes;
    report.kept_bytes -= one.bytes;
  }
  report.stays = sentences(removal.kept());
  return report;
}

std::uint64_t parse_size(const std::string& text) {
  const auto fail = [&]() -> std::uint64_t {
    throw Error(ExitCode::kUsage,

                "size '{}'; allowed: 0, or a number with B, K, M, G or T (of 1024), such as 10G",
                printable(text));
  };
  constexpr std::string_view kUnits = "BKMGT";
  std::string number = text;
  if (number.size() > 1 && (number.back() == 'B' || number.back() == 'b') &&
      !std::isdigit(static_cast<unsigned char>(number[number.size() - 2])))
    number.pop_back();
  double scale = 0;  // a number alone would be bytes, which nobody means
  if (const auto last = static_cast<unsigned char>(number.empty() ? '0' : number.back());
      std::isalpha(last)) {
    const auto unit = kUnits.find(char(std::toupper(last)));
    if (unit == kUnits.npos) return fail();
    scale = std::pow(1024.0, double(unit));
    number.pop_back();
  }
  while (number.ends_with(' ')) number.pop_back();
  double value = 0;
  if (!parse_number(number, value) || !(value >= 0) || value * scale > 1e18) return fail();
  if (value > 0 && scale == 0) return fail();
  return std::uint64_t(value * scale);
}

CleanReport clean_farm(const fs::path& directory, bool all, const RemovalOptions& options) {
  const records::Farm record = read_farm_record(directory);
  const FarmDirectoryLock alone(
      directory, FarmDirectoryLock::Use::kAlone,
      options.dry_run ? ByteLocks::Opening::kLook : ByteLocks::Opening::kMake);
  std::set<std::string> staying;  // ids of cells
  if (!all)
    for (const auto& cell : record.cells) staying.insert(cell.id);
  CleanReport report;
  Removal removal = removal_from_farm(directory, options.dry_run);
  std::size_t paths = 0;
  removal.on_removed([&](const fs::path& path) {
    ++paths;
    if (options.on_removed) options.on_removed(path);
  });
  const HeldDirectory cells = there_or_missing(removal.directory("cells"));
  const auto remove_parts = [&](const fs::path& where) {
    const HeldDirectory held = removal.directory(where);
    for (const std::string& name : held.names())
      if (const Descriptor lock = lock_abandoned_part(held, name)) removal.remove(where / name);
  };
  for (const std::string& id : cells.names()) {
    const fs::path cell = fs::path("cells") / id;
    remove_parts(cell);
    if (staying.contains(id)) continue;
    for (const std::string& name : removal.directory(cell).names())
      if (!is_part_name(name)) removal.remove(cell / name);
    if (removal.remove(cell)) ++report.cells;
  }
  std::size_t directories = report.cells;
  remove_parts("");
  if (all && removal.remove("cells")) ++directories;
  if (all) removal.remove("farm.json");
  report.files = paths - directories;
  const fs::path failed = FailedJobs::kName;
  for (const std::string& id : removal.directory(failed).names()) {
    if (staying.contains(id)) continue;
    for (const std::string& job : removal.directory(failed / id).names())
      removal.remove(failed / id / job);
    removal.remove(failed / id);
  }
  if (all && removal.directory(failed)) removal.remove(failed);
  report.stays = sentences(removal.kept());
  return report;
}

records::FarmStatus farm_status(const fs::path& directory) {
  const records::Farm farm = read_farm_record(directory);
  records::FarmStatus record;
  record.title = farm.title;
  record.cells = farm.cells.size();
  std::vector<std::string> statuses;
  for (const auto& [id, status, axes] : farm.cells) {
    throw_if_interrupted();
    std::string& now = statuses.emplace_back(status);
    // The cell's own record is newer than the farm's.
    const fs::path file = directory / "cells" / id / kCellRecordFile;
    std::error_code ignored;
    if (fs::exists(file, ignored)) {
      try {
        const auto own = records::read_record<records::Cell>(file);
        now = own.status;
        for (const auto& problem : own.problems)
          record.failures.push_back(
              {id, problem.engine, problem.failure, problem.attempts, problem.message});
      } catch (const std::exception&) {  // damaged: the farm's record counts
      }
    }
  }
  record.status = count_statuses(statuses);
  const CachePlace place = cache_of(directory);
  try {
    record.at_work =
        place.is_there && ResultCache(place.cache, ResultCache::Opening::kLook).is_in_use();
  } catch (const Error&) {  // it cannot be read
  }
  record.cache = place.cache.string();
  record.cache_is_there = place.is_there;
  return record;
}

}  // namespace lobelia
