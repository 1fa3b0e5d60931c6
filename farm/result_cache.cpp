#include "farm/result_cache.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <random>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/seal.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr char kLayout[] = "1\n";
constexpr std::uint64_t kUseLock = ~std::uint64_t{0};
constexpr std::uint64_t kMaxLogBytes = 64 << 20;
constexpr std::time_t kTouchAfterSeconds = 24 * 60 * 60;
/// Where locks do not tell whether a draft is alive.
constexpr std::time_t kAbandonedAfterSeconds = 7 * 24 * 60 * 60;

std::uint64_t number_of(const ResultKey& key) { return std::hash<ResultKey>()(key); }
std::uint64_t number_of(const std::string& name) { return number_of(result_key({name})); }

std::int64_t modified(const struct stat& status) {
  return std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
}

[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
  throw Error(ExitCode::kOutput,
              fmt::format("{}: cannot {}: {}", path.string(), what, std::strerror(error)));
}

/// Whoever is killed while it writes leaves nothing but a draft: nowhere else are there half-written files, and no
/// other farm has to tell whose they are.
void move(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) fail(to, "write", errno);
}

/// The pictures of a record, which its times and hosts are no part of.
std::vector<std::pair<std::string, std::string>> pictures(const Json& record) {
  std::vector<std::pair<std::string, std::string>> found;
  for (const auto& file : record.at("files"))
    if (const std::string name = file.at("name"); name.ends_with(".exr") || name.ends_with(".png"))
      found.emplace_back(name, file.at("sha256"));
  return found;
}

std::string random_name() {
  static thread_local std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

/// Why a file is not what its record says; empty if it is.
std::string damage_of(const fs::path& path, const Json& file, ResultCache::Look look) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return "is missing";
  if (std::uint64_t(status.st_size) != file.at("bytes").get<std::uint64_t>())
    return "has another size";
  // Compared for equality alone: a clock may have been set back since.
  if (look == ResultCache::Look::kQuick &&
      file.at("modified").get<std::int64_t>() == modified(status))
    return "";
  return hex(sha256_of_file(path)) == file.at("sha256").get<std::string>() ? ""
                                                                           : "has another content";
}

/// Of what is named KEY or KEY.json in the directories under this one.
std::vector<ResultKey> keys_on_shelves(const fs::path& directory) {
  std::vector<ResultKey> keys;
  std::error_code ignored;
  for (const auto& shelf : fs::directory_iterator(directory, ignored))
    for (const auto& entry : fs::directory_iterator(shelf.path(), ignored)) {
      ResultKey key;
      if (entry.path().extension() != ".log" && from_hex(entry.path().stem().native(), key.digest))
        keys.push_back(key);
    }
  return keys;
}

}  // namespace

bool is_plain_file_name(const std::string& name) {
  return !name.empty() && name.find('/') == name.npos && name.front() != '.';
}

ResultDraft::~ResultDraft() {
  std::error_code ignored;
  if (!directory_.empty()) fs::remove_all(directory_, ignored);
}

namespace {
/// Makes what a cache consists of, unless it is there; before the locks' file can be opened.
fs::path prepared(fs::path directory) {
  const fs::path marker = directory / kCacheMarkerFile;
  std::error_code ignored;
  if (fs::exists(marker, ignored)) {
    if (read_file(marker, 64) != kLayout)
      throw Error(ExitCode::kInput,
                  fmt::format("{}: a cache of another layout; this program reads layout {}",
                              directory.string(), std::string_view(kLayout, 1)));
    return directory;
  }
  if (fs::is_directory(directory, ignored) && !fs::is_empty(directory, ignored) &&
      !fs::exists(directory / "results", ignored))
    throw Error(ExitCode::kInput, fmt::format("{}: not empty and not a cache (it has no file '{}')",
                                              directory.string(), kCacheMarkerFile));
  for (const char* part : {"results", "failures", "making"}) make_directories(directory / part);
  return directory;
}
}  // namespace

ResultCache::ResultCache(fs::path directory)
    : directory_(prepared(fs::absolute(directory))), locks_(directory_ / "locks") {
  const fs::path marker = directory_ / kCacheMarkerFile;
  std::error_code ignored;
  if (fs::exists(marker, ignored)) return;
  const ResultDraft made = draft();
  write_file(made.file(kCacheMarkerFile), kLayout);
  move(made.file(kCacheMarkerFile), marker);
}

fs::path ResultCache::result_directory(const ResultKey& key) const {
  const std::string text = key.text();
  return directory_ / "results" / text.substr(0, 2) / text;
}

fs::path ResultCache::failure_file(const ResultKey& key, const char* ending) const {
  const std::string text = key.text();
  return directory_ / "failures" / text.substr(0, 2) / (text + ending);
}

std::vector<ResultKey> ResultCache::list() const { return keys_on_shelves(directory_ / "results"); }

bool ResultCache::has(const ResultKey& key) const {
  return ::access(file(key, kManifestFile).c_str(), F_OK) == 0;
}

std::optional<Json> ResultCache::find(const ResultKey& key, Look look) const {
  std::string ignored;
  return find(key, look, ignored);
}

std::optional<Json> ResultCache::find(const ResultKey& key, Look look, std::string& why_not) const {
  why_not = "missing";
  if (!has(key)) {
    if (::access(result_directory(key).c_str(), F_OK) == 0) why_not = "damaged: it has no record";
    return std::nullopt;
  }
  try {
    Json record = read_record(file(key, kManifestFile), "result");
    if (record.at("key") != key.text()) {
      why_not = "damaged: its record is of another result";
      return std::nullopt;
    }
    if (record.at("seal") != seal_of(record)) {
      why_not = "damaged: its record has another content";
      return std::nullopt;
    }
    for (const auto& one : record.at("files")) {
      const std::string name = one.at("name");
      const std::string damage =
          is_plain_file_name(name) ? damage_of(file(key, name), one, look) : "has no plain name";
      if (damage.empty()) continue;
      why_not = fmt::format("damaged: {} {}", name, damage);
      return std::nullopt;
    }
    why_not.clear();
    return record;
  } catch (const std::exception& error) {  // not a record, or not of ours
    why_not = fmt::format("damaged: {}", error.what());
    return std::nullopt;
  }
}

ResultDraft ResultCache::draft() const {
  const std::string name = random_name();
  auto alive = locks_.try_claim(number_of(name));
  const fs::path directory = directory_ / "making" / name;
  if (!alive) fail(directory, "make the directory", EBUSY);
  if (::mkdir(directory.c_str(), 0777) != 0) {
    const int error = errno;
    if (error != ENOENT) fail(directory, "make the directory", error);
    make_directories(directory);
  }
  return {directory, std::move(*alive)};
}

Publication ResultCache::publish(ResultDraft& draft, const ResultKey& key, Json record) const {
  record["key"] = key.text();
  Json files = Json::array();
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(draft.directory())) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths) {
    struct stat status {};
    // Read-only, because a farm's directories link to it: who edits a picture there means a copy.
    if (::chmod(path.c_str(), 0444) != 0 || ::stat(path.c_str(), &status) != 0)
      fail(path, "write", errno);
    files.push_back({{"name", path.filename().string()},
                     {"bytes", std::uint64_t(status.st_size)},
                     {"sha256", hex(sha256_of_file(path))},
                     {"modified", modified(status)}});
  }
  record["files"] = std::move(files);
  record["seal"] = seal_of(record);
  write_record(draft.file(kManifestFile), record);

  const fs::path target = result_directory(key);
  if (::mkdir(target.parent_path().c_str(), 0777) != 0 && errno != EEXIST)
    fail(target.parent_path(), "make the directory", errno);
  for (int attempt = 0;; ++attempt) {
    // A directory replaces none that has something in it, and nothing that is none: the first one stays,
    // whoever comes later.
    if (::rename(draft.directory().c_str(), target.c_str()) == 0) break;
    const int error = errno;
    if (error != ENOTEMPTY && error != EEXIST && error != ENOTDIR) fail(target, "write", error);
    if (const auto there = find(key))
      return pictures(*there) == pictures(record) ? Publication::kThere : Publication::kDifferent;
    if (attempt == 3) fail(target, "replace a damaged result", error);
    discard(key);
  }
  draft.directory_.clear();
  return Publication::kNew;
}

void ResultCache::discard(const ResultKey& key) const {
  const fs::path target = result_directory(key);
  const std::string name = random_name();
  const auto alive = locks_.try_claim(number_of(name));
  const fs::path away = directory_ / "making" / name;
  if (::rename(target.c_str(), away.c_str()) != 0) {
    if (errno == ENOENT) return;
    fail(target, "take it away", errno);
  }
  std::error_code ignored;
  fs::remove_all(away, ignored);
}

std::optional<ByteLocks::Claim> ResultCache::try_claim(const ResultKey& key) const {
  return locks_.try_claim(number_of(key));
}

bool ResultCache::is_in_use() const { return locks_.is_claimed(kUseLock); }

std::optional<ByteLocks::Claim> ResultCache::try_use(bool shared) const {
  return locks_.try_claim(kUseLock, shared);
}

ByteLocks::Claim ResultCache::use() const {
  auto claim = try_use(true);
  if (!claim)
    throw Error(
        ExitCode::kOutput,
        fmt::format("{}: 'lobelia farm gc' is at work in this cache; try again when it has ended",
                    directory_.string()));
  return std::move(*claim);
}

void ResultCache::keep_failure(const ResultKey& key, const Json& record,
                               const fs::path& log) const {
  make_directories(failure_file(key, "").parent_path());
  const ResultDraft made = draft();
  std::error_code ignored;
  write_record(made.file("json"), record);
  ::unlink(failure_file(key, ".log").c_str());
  if (!log.empty() && fs::file_size(log, ignored) <= kMaxLogBytes && !ignored) {
    write_file(made.file("log"), read_file(log, kMaxLogBytes));
    move(made.file("log"), failure_file(key, ".log"));
  }
  move(made.file("json"), failure_file(key, ".json"));
}

fs::path ResultCache::failure_log(const ResultKey& key) const {
  const fs::path log = failure_file(key, ".log");
  return ::access(log.c_str(), F_OK) == 0 ? log : fs::path();
}

std::optional<Json> ResultCache::failure(const ResultKey& key) const {
  if (::access(failure_file(key, ".json").c_str(), F_OK) != 0) return std::nullopt;
  try {
    return read_record(failure_file(key, ".json"), "failure");
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::vector<ResultKey> ResultCache::failures() const {
  return keys_on_shelves(directory_ / "failures");
}

void ResultCache::forget_failure(const ResultKey& key) const {
  for (const char* ending : {".json", ".log"}) ::unlink(failure_file(key, ending).c_str());
}

std::size_t ResultCache::remove_abandoned() const {
  std::size_t count = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory_ / "making", ignored)) {
    if (locks_.works()) {
      const auto free = locks_.try_claim(number_of(entry.path().filename().string()));
      if (!free) continue;
      fs::remove_all(entry.path(), ignored);
    } else {
      struct stat status {};
      if (::stat(entry.path().c_str(), &status) != 0 ||
          std::time(nullptr) - status.st_mtim.tv_sec < kAbandonedAfterSeconds)
        continue;
      fs::remove_all(entry.path(), ignored);
    }
    ++count;
  }
  return count;
}

void ResultCache::touch(const ResultKey& key) const {
  const fs::path directory = result_directory(key);
  struct stat status {};
  if (::stat(directory.c_str(), &status) != 0) return;
  const std::time_t age = std::time(nullptr) - status.st_mtim.tv_sec;
  if (age >= 0 && age < kTouchAfterSeconds) return;
  ::utimensat(AT_FDCWD, directory.c_str(), nullptr,
              0);  // a cache that may only be read stays as it is
}

}  // namespace lobelia
