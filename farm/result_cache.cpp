#include "farm/result_cache.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <random>

#include "base/records/record.hpp"
#include "base/system/files.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kUseLock = ~std::uint64_t{0};
constexpr std::uint64_t kMaxLogBytes = 64 << 20;
constexpr std::time_t kTouchAfterSeconds = 24 * 60 * 60;

/// The number of a result's or a draft's lock.
std::uint64_t lock_number(const ResultKey& key) {
  std::uint64_t value = 0;
  std::memcpy(&value, key.digest.data(), sizeof value);
  return value;
}
std::uint64_t lock_number(const std::string& name) { return lock_number(result_key({name})); }

std::int64_t modified(const struct stat& status) {
  return std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
}

[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
  throw Error(ExitCode::kOutput, "{}: cannot {}: {}", path.string(), what, std::strerror(error));
}

/// Files are written in a draft first: a killed process leaves half-written files nowhere else.
void move(const fs::path& from, const HeldDirectory& to, const std::string& name) {
  if (::renameat(AT_FDCWD, from.c_str(), to.fd(), name.c_str()) != 0)
    fail(to.path() / name, "write", errno);
}

/// Names and hashes of a result's pictures, without times and hosts.
std::vector<std::pair<std::string, std::string>> pictures(const records::Result& record) {
  std::vector<std::pair<std::string, std::string>> found;
  for (const auto& file : record.files)
    if (file.name.ends_with(".exr") || file.name.ends_with(".png"))
      found.emplace_back(file.name, file.sha256);
  return found;
}

/// Why a file is not what its record says; empty if it is.
std::string damage_of(const fs::path& path, const records::ResultFile& file,
                      ResultCache::Look look) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return "is missing";
  if (std::uint64_t(status.st_size) != file.bytes) return "has another size";
  // Not compared for order: a clock may have been set back since.
  if (look == ResultCache::Look::kQuick && file.modified == modified(status)) return "";
  return hex(sha256_of_file(path)) == file.sha256 ? "" : "has another content";
}

fs::path on_shelf(const char* part, const ResultKey& key, const char* ending = "") {
  const std::string text = key.text();
  return fs::path(part) / text.substr(0, 2) / (text + ending);
}

/// Throws Error(kOutput) if the draft was removed. What is made is kept, though the run is interrupted.
std::string hash_of_output(const fs::path& file) {
  const Uninterrupted to_the_end;
  try {
    return hex(sha256_of_file(file));
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    throw Error(ExitCode::kOutput, error.what());
  }
}

}  // namespace

ResultDraft::~ResultDraft() {
  if (directory_.empty()) return;
  try {
    Removal(directory_.parent_path().parent_path(), cache_ownership())
        .remove(directory_.parent_path().filename() / directory_.filename());
  } catch (const Error&) {  // the next farm removes it
  }
}

std::vector<fs::path> ResultDraft::files() const {
  std::vector<fs::path> paths;
  for (const std::string& name : files_) paths.push_back(directory_ / name);
  return paths;
}

bool ResultDraft::is_there() const {
  struct stat status {};
  return directory_.empty() ||  // it is published
         (::lstat(directory_.c_str(), &status) == 0 && S_ISDIR(status.st_mode));
}

ResultCache::ResultCache(fs::path directory, Opening opening)
    : directory_(fs::absolute(directory)),
      locks_(open_cache(directory_, opening), kCacheLocksFile, opening),
      self_(this_process()) {
  std::error_code ignored;
  if (opening == Opening::kMake && !fs::exists(directory_ / kCacheMarkerFile, ignored)) draft();
}

/// The cache's directory; makes it again if it was lost.
HeldDirectory ResultCache::root() const {
  HeldDirectory held(directory_);
  if (!held) {
    make_directories(directory_);
    held = HeldDirectory(directory_);
  }
  if (!held) fail(directory_, "open the directory", ENOENT);
  return held;
}

HeldDirectory ResultCache::shelf(const char* part, const ResultKey& key) const {
  return root().make_below(part).make_below(key.text().substr(0, 2));
}

fs::path ResultCache::result_directory(const ResultKey& key) const {
  return directory_ / on_shelf("results", key);
}

fs::path ResultCache::failure_file(const ResultKey& key, const char* ending) const {
  return directory_ / on_shelf("failures", key, ending);
}

std::vector<ResultKey> ResultCache::list() const {
  std::vector<ResultKey> keys;
  const HeldDirectory results = HeldDirectory(directory_).below("results");
  for (const std::string& shelf : results.names()) {
    if (!is_cache_shelf(shelf)) continue;
    for (const std::string& name : results.below(shelf).names())
      if (ResultKey key; from_hex(name, key.digest)) keys.push_back(key);
  }
  return keys;
}

bool ResultCache::has(const ResultKey& key) const {
  struct stat status {};
  return ::lstat(result_directory(key).c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
         ::access(file(key, kManifestFile).c_str(), F_OK) == 0;
}

std::optional<records::Result> ResultCache::find(const ResultKey& key, Look look,
                                                 std::string* why_not) const {
  const auto no_result = [&](const std::string& why) {
    if (why_not) *why_not = why;
    return std::nullopt;
  };
  if (!has(key))
    return no_result(::access(result_directory(key).c_str(), F_OK) == 0
                         ? "damaged: it has no record"
                         : "missing");
  if (look == Look::kName) return records::Result();
  try {
    auto record = records::read_record<records::Result>(file(key, kManifestFile));
    if (record.key != key.text()) return no_result("damaged: its record is of another result");
    for (const auto& one : record.files)
      if (const std::string damage = damage_of(file(key, one.name), one, look); !damage.empty())
        return no_result(fmt::format("damaged: {} {}", one.name, damage));
    return record;
  } catch (const Error& error) {
    // Too little memory or too many open files: the result may well be whole.
    if (error.code() != ExitCode::kInput) throw;
    return no_result(fmt::format("damaged: {}", error.what()));
  }
}

std::string ResultCache::new_draft_name() const {
  static thread_local std::random_device device;
  return DraftName{self_, locks_.inode(), (std::uint64_t{device()} << 32) | device()}.text();
}

ResultDraft ResultCache::draft() const {
  const std::string name = new_draft_name();
  auto alive = locks_.try_claim(lock_number(name));
  const fs::path directory = directory_ / "making" / name;
  if (!alive) fail(directory, "make the directory", EBUSY);
  const HeldDirectory held = root();
  require_cache(held);
  for (int attempt = 0;; ++attempt) {
    if (::mkdirat(held.make_below("making").fd(), name.c_str(), 0777) == 0) break;
    // ENOENT: making/ was removed at the same moment.
    if (errno != ENOENT || attempt == 3) fail(directory, "make the directory", errno);
  }
  ResultDraft made{directory, std::move(*alive)};
  if (::faccessat(held.fd(), kCacheMarkerFile, F_OK, AT_SYMLINK_NOFOLLOW) != 0) {
    write_file(directory / kCacheMarkerFile, kCacheLayout);
    move(directory / kCacheMarkerFile, held, kCacheMarkerFile);
  }
  return made;
}

void ResultCache::seal(ResultDraft& draft, const ResultKey& key, records::Result& record) const {
  record.key = key.text();
  record.files.clear();
  for (const std::string& name : draft.files_) {
    const fs::path path = draft.directory() / name;
    struct stat status {};
    // Read-only, because the files under cells/ are links to it: nobody edits a result by accident.
    if (::chmod(path.c_str(), 0444) != 0 || ::stat(path.c_str(), &status) != 0)
      fail(path, "write", errno);
    record.files.push_back(
        {name, std::uint64_t(status.st_size), hash_of_output(path), modified(status)});
  }
  records::write_record(draft.file(kManifestFile), record);
}

Publication ResultCache::publish(ResultDraft& draft, const ResultKey& key,
                                 records::Result record) const {
  seal(draft, key, record);
  return place(draft, key, record);
}

Publication ResultCache::place(ResultDraft& draft, const ResultKey& key,
                               const records::Result& record) const {
  const fs::path target = result_directory(key);
  const HeldDirectory to = shelf("results", key);
  for (int attempt = 0;; ++attempt) {
    // rename() replaces only an empty directory: the first result stays.
    if (::renameat(AT_FDCWD, draft.directory().c_str(), to.fd(), key.text().c_str()) == 0) break;
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

Removal ResultCache::removal(Removal::Mode mode) const {
  return Removal(directory_, cache_ownership(), mode);
}

void ResultCache::discard(const ResultKey& key) const {
  Removal removing = removal();
  discard(key, removing);
  if (const auto& kept = removing.kept(); !kept.empty())
    throw Error(ExitCode::kOutput, "{}: cannot take it away: {}", kept.front().path.string(),
                kept.front().why);
}

bool ResultCache::discard(const ResultKey& key, Removal& removal) const {
  const std::string name = new_draft_name();
  const auto alive = locks_.try_claim(lock_number(name));
  return removal.remove_at_once(on_shelf("results", key), fs::path("making") / name);
}

std::optional<ByteLocks::Claim> ResultCache::try_claim(const ResultKey& key) const {
  return locks_.try_claim(lock_number(key));
}

bool ResultCache::is_in_use() const { return locks_.is_claimed(kUseLock); }

std::optional<ByteLocks::Claim> ResultCache::try_use(bool shared) const {
  return locks_.try_claim(kUseLock, shared);
}

ByteLocks::Claim ResultCache::use() const {
  auto claim = try_use(true);
  if (!claim)
    throw Error(ExitCode::kOutput,
                "{}: 'lobelia farm gc' is at work in this cache; try again when it has ended",
                directory_.string());
  return std::move(*claim);
}

void ResultCache::keep_failure(const ResultKey& key, const records::Failure& record,
                               const std::string& log) const {
  ResultDraft made = draft();
  const HeldDirectory to = shelf("failures", key);
  records::write_record(made.file("json"), record);
  if (!log.empty() && log.size() <= kMaxLogBytes) {
    write_file(made.file("log"), log);
    move(made.file("log"), to, key.text() + ".log");
  } else {
    forget_failure(key);
  }
  move(made.file("json"), to, key.text() + ".json");
}

fs::path ResultCache::failure_log(const ResultKey& key) const {
  const fs::path log = failure_file(key, ".log");
  return ::access(log.c_str(), F_OK) == 0 ? log : fs::path();
}

std::optional<records::Failure> ResultCache::failure(const ResultKey& key) const {
  if (::access(failure_file(key, ".json").c_str(), F_OK) != 0) return std::nullopt;
  try {
    return records::read_record<records::Failure>(failure_file(key, ".json"));
  } catch (const Error&) {
    return std::nullopt;
  }
}

void ResultCache::forget_failure(const ResultKey& key) const {
  for (const char* ending : {".json", ".log"}) {
    if (::access(failure_file(key, ending).c_str(), F_OK) != 0) continue;
    Removal removing = removal();
    forget_failure(key, removing);
    return;
  }
}

void ResultCache::keep_content(const Content& content) const {
  const std::string name = content.sha256 + ".json";
  if (content.sha256.empty() || ::access((directory_ / "contents" / name).c_str(), F_OK) == 0)
    return;
  try {
    ResultDraft made = draft();
    records::write_record(made.file("json"), content);
    move(made.file("json"), root().make_below("contents"), name);
  } catch (const Error&) {  // a read-only cache
  }
}

std::optional<Content> ResultCache::content(const std::string& sha256) const {
  if (Sha256Digest digest; !from_hex(sha256, digest)) return std::nullopt;
  try {
    return records::read_record<Content>(directory_ / "contents" / (sha256 + ".json"));
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void ResultCache::forget_failure(const ResultKey& key, Removal& removal) const {
  for (const char* ending : {".json", ".log"}) removal.remove(on_shelf("failures", key, ending));
}

/// `claim` gets the draft's lock if that could be taken, to be held while the draft is removed.
Life ResultCache::life_of_draft(const std::string& name,
                                std::optional<ByteLocks::Claim>& claim) const {
  const auto take_claim = [&] {
    if (auto taken = locks_.try_claim(lock_number(name))) claim.emplace(std::move(*taken));
    return claim ? Life::kDead : Life::kAlive;
  };
  const auto draft = DraftName::parse(name);
  if (!draft) return locks_.works() ? take_claim() : Life::kUnknown;
  if (draft->maker == self_) return Life::kAlive;
  // A lock that is held proves that its holder lives.
  const bool has_our_locks = locks_.works() && draft->locks_inode == locks_.inode();
  if (has_our_locks && take_claim() == Life::kAlive) return Life::kAlive;
  if (const Life life = life_of(draft->maker, self_); life != Life::kUnknown) return life;
  // Locks are always shared between processes of one kernel.
  return has_our_locks && (draft->maker.boot == self_.boot || lock_sharing().shared)
             ? Life::kDead
             : Life::kUnknown;
}

AbandonedDrafts ResultCache::remove_abandoned(Removal& removal) const {
  AbandonedDrafts found;
  for (const std::string& name : removal.directory("making").names()) {
    const fs::path relative = fs::path("making") / name;
    if (owned_in_cache(relative) == Owned::kNo) continue;
    std::optional<ByteLocks::Claim> claim;
    const Life life = life_of_draft(name, claim);
    if (life == Life::kUnknown) ++found.others;
    if (life == Life::kDead && removal.remove(relative)) ++found.removed;
  }
  return found;
}

void ResultCache::touch(const ResultKey& key) const {
  const fs::path directory = result_directory(key);
  struct stat status {};
  if (::stat(directory.c_str(), &status) != 0) return;
  const std::time_t age = std::time(nullptr) - status.st_mtim.tv_sec;
  if (age >= 0 && age < kTouchAfterSeconds) return;
  ::utimensat(AT_FDCWD, directory.c_str(), nullptr, 0);  // fails in a read-only cache
}

}  // namespace lobelia
