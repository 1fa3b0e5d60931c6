#include "farm/upkeep.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <set>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/finite_image.hpp"
#include "core/image_io.hpp"
#include "core/interrupt.hpp"
#include "core/text.hpp"
#include "farm/result_cache.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// Opens what a result's file should be, whose hash is right; empty if it is.
std::string why_not_readable(const fs::path& file) {
  try {
    const std::string name = file.filename().string();
    if (name.ends_with(".exr") && !is_finite(read_trusted_image(file)))
      return "has values that are not finite";
    if (name.ends_with(".png")) read_trusted_image(file);
    if (name.ends_with(".json") &&
        !Json::accept(read_file(file, std::numeric_limits<std::uint32_t>::max())))
      return "is not JSON";
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

std::string title_of(const ResultKey& key, const std::optional<Json>& record) {
  if (!record) return key.text();
  const auto text = [&](const char* name) {
    const auto found = record->find(name);
    return found != record->end() && found->is_string() ? printable(found->get<std::string>())
                                                        : std::string("?");
  };
  return fmt::format("{} ({}{} of {})", key.text(), text("job"),
                     record->contains("engine") ? " by " + text("engine") : "",
                     text("firstMadeFor"));
}

std::uint64_t bytes_of(const Json& record) {
  std::uint64_t sum = 0;
  for (const auto& file : record.at("files")) sum += file.at("bytes").get<std::uint64_t>();
  return sum;
}

/// Whoever reads it takes cells away by their names.
Json read_farm_record(const fs::path& directory) {
  Json record = read_record(directory / "farm.json", "farm");
  try {
    for (const char* name : {"title", "cache"})
      if (record.contains(name)) record.at(name).get_ref<const std::string&>();
    for (const auto& cell : record.at("cells").get_ref<const Json::array_t&>()) {
      cell.at("status").get_ref<const std::string&>();
      if (const std::string id = cell.at("id"); !is_plain_file_name(id))
        throw Error(ExitCode::kInput,
                    fmt::format("{}: no name of a cell: '{}'", (directory / "farm.json").string(),
                                printable(id)));
    }
  } catch (const Json::exception& error) {
    throw Error(ExitCode::kInput, fmt::format("{}: not a farm's record: {}",
                                              (directory / "farm.json").string(), error.what()));
  }
  return record;
}

/// The number of the file's last change, for an order.
std::pair<std::int64_t, std::int64_t> changed(const fs::path& path) {
  struct stat status {};
  ::stat(path.c_str(), &status);
  return {status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

}  // namespace

fs::path cache_of(const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(path / kCacheMarkerFile, ignored)) return path;
  if (!fs::exists(path / "farm.json", ignored))
    throw Error(
        ExitCode::kInput,
        fmt::format("{}: neither a farm's directory (it has no farm.json) nor a cache (it has "
                    "no lobelia-cache)",
                    path.string()));
  const Json record = read_farm_record(path);
  const fs::path cache = path / record.value("cache", std::string("cache"));
  if (!fs::exists(cache / kCacheMarkerFile, ignored))
    throw Error(ExitCode::kInput, fmt::format("{}: its cache {} is not there", path.string(),
                                              cache.lexically_normal().string()));
  return cache.lexically_normal();
}

VerifyReport verify_cache(
    const fs::path& directory, bool remove,
    const std::function<void(std::size_t done, std::size_t all)>& on_progress) {
  const ResultCache cache(directory);
  std::vector<ResultKey> keys = cache.list();
  std::sort(keys.begin(), keys.end());
  VerifyReport report;
  report.results = keys.size();
  std::mutex mutex;
  std::map<ResultKey, std::string> damaged;
  std::size_t done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t i) {
    throw_if_interrupted();
    std::string why;
    const auto record = cache.find(keys[i], ResultCache::Look::kThorough, why);
    if (record)
      for (const auto& file : record->at("files")) {
        const std::string name = file.at("name");
        if (const std::string bad = why_not_readable(cache.file(keys[i], name)); !bad.empty())
          why = fmt::format("{} {}", name, bad);
      }
    const std::scoped_lock lock(mutex);
    if (record) {
      report.files += record->at("files").size();
      report.bytes += bytes_of(*record);
    }
    if (!why.empty()) damaged[keys[i]] = title_of(keys[i], record) + ": " + why;
    if (on_progress) on_progress(++done, keys.size());
  });
  for (const auto& [key, text] : damaged) {
    report.damaged.push_back(text);
    if (remove) cache.discard(key);
  }
  return report;
}

GcReport collect_garbage(const fs::path& directory, std::optional<std::uint64_t> max_bytes) {
  const ResultCache cache(directory);
  const auto alone = cache.try_use(false);
  if (!alone)
    throw Error(ExitCode::kOutput,
                fmt::format("{}: a farm is using this cache; try again when it has ended",
                            directory.string()));
  GcReport report;
  report.abandoned = cache.remove_abandoned();
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
      cache.discard(key);
      ++report.removed;
      continue;
    }
    cache.forget_failure(key);
    results.push_back({changed(cache.result_directory(key)), key, bytes_of(*record)});
    report.kept_bytes += results.back().bytes;
  }
  std::sort(results.begin(), results.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.used, a.key) < std::tie(b.used, b.key);
  });
  report.kept = results.size();
  for (const Candidate& one : results) {
    if (!max_bytes || report.kept_bytes <= *max_bytes) break;
    throw_if_interrupted();
    cache.discard(one.key);
    ++report.removed;
    --report.kept;
    report.removed_bytes += one.bytes;
    report.kept_bytes -= one.bytes;
  }
  return report;
}

std::uint64_t parse_size(const std::string& text) {
  const auto fail = [&]() -> std::uint64_t {
    throw Error(
        ExitCode::kUsage,
        fmt::format("size '{}'; allowed: a number and B, K, M, G or T (of 1024), such as 10G",
                    printable(text)));
  };
  constexpr std::string_view kUnits = "BKMGT";
  std::string number = text;
  if (number.size() > 1 && (number.back() == 'B' || number.back() == 'b') &&
      !std::isdigit(static_cast<unsigned char>(number[number.size() - 2])))
    number.pop_back();
  double scale = 1;
  if (!number.empty() && std::isalpha(static_cast<unsigned char>(number.back()))) {
    const auto unit = kUnits.find(char(std::toupper(static_cast<unsigned char>(number.back()))));
    if (unit == kUnits.npos) return fail();
    scale = std::pow(1024.0, double(unit));
    number.pop_back();
  }
  while (number.ends_with(' ')) number.pop_back();
  double value = 0;
  if (!parse_number(number, value) || !(value >= 0) || value * scale > 1e18) return fail();
  return std::uint64_t(value * scale);
}

CleanReport clean_farm(const fs::path& directory, bool all) {
  const Json record = read_farm_record(directory);
  std::set<std::string> ids;
  if (!all)
    for (const auto& cell : record.at("cells")) ids.insert(cell.at("id").get<std::string>());
  CleanReport report;
  std::error_code ignored;
  std::vector<fs::path> foreign;
  for (const auto& entry : fs::directory_iterator(directory / "cells", ignored))
    if (!ids.contains(entry.path().filename().string())) foreign.push_back(entry.path());
  for (const auto& cell : foreign) {
    report.files += std::size_t(fs::remove_all(cell, ignored));
    ++report.cells;
  }
  remove_abandoned_files(directory);
  for (const auto& id : ids) remove_abandoned_files(directory / "cells" / id);
  if (all) {
    fs::remove(directory / "cells", ignored);
    report.files += fs::remove(directory / "farm.json", ignored) ? 1 : 0;
  }
  return report;
}

Json farm_status(const fs::path& directory) {
  const Json farm = read_farm_record(directory);
  Json record = make_record("farm-status");
  record["title"] = farm.value("title", "");
  std::map<std::string, std::size_t> counts;
  Json failures = Json::array();
  for (const auto& cell : farm.at("cells")) {
    throw_if_interrupted();
    const std::string id = cell.at("id");
    std::string status = cell.at("status");
    // The farm's record is as old as its last look; a cell's own is not.
    const fs::path file = directory / "cells" / id / "cell.json";
    std::error_code ignored;
    if (fs::exists(file, ignored)) {
      try {
        const Json own = read_record(file, "cell");
        status = own.at("status");
        for (const auto& problem : own.at("problems"))
          failures.push_back({{"cell", id},
                              {"engine", problem.at("engine").get<std::string>()},
                              {"failure", problem.value("failure", "")},
                              {"attempts", problem.value("attempts", 0)},
                              {"message", problem.at("message").get<std::string>()}});
      } catch (const std::exception&) {  // being written, or broken: as the farm's record has it
      }
    }
    ++counts[status];
  }
  record["cells"] = farm.at("cells").size();
  for (const char* status : {"failed", "differs", "undecided", "missing", "unchecked", "pass"})
    record["status"][status] = counts[status];
  bool at_work = false;
  try {
    at_work = ResultCache(cache_of(directory)).is_in_use();
  } catch (const Error&) {  // without its cache nobody is
  }
  record["atWork"] = at_work;
  record["failures"] = std::move(failures);
  return record;
}

}  // namespace lobelia
