#include "reference_scenes/content.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <functional>

#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/host.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr int kDeepestFolder = 12;
constexpr std::size_t kMostListedFiles = 10000;
constexpr char kUnreadable[] = "unreadable";
constexpr std::size_t kMostEntries = 50000;  // also in the table of records::KnownHashes
constexpr std::time_t kSettledAfterSeconds = 2;

std::string identity_of(const struct stat& status) {
  return fmt::format("{} {} {} {}.{:09} {}.{:09}", std::uint64_t(status.st_dev),
                     std::uint64_t(status.st_ino), std::uint64_t(status.st_size),
                     status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_ctim.tv_sec,
                     status.st_ctim.tv_nsec);
}

struct stat status_of(const InputFile& file) {
  struct stat status {};
  if (::fstat(file.descriptor(), &status) != 0)
    throw failure_of(file.path().string() + ": cannot read", errno, ExitCode::kInput);
  return status;
}

/// Whether no other user can write it.
bool only_we_can_write(const fs::path& file) {
  struct stat status {};
  return ::lstat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
         status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

fs::path file_of_user() {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return fs::path(value ? value : "");
  };
  fs::path directory = set("XDG_CACHE_HOME");
  if (!directory.is_absolute()) {
    directory = set("HOME");
    if (!directory.is_absolute()) return {};
    directory /= ".cache";
  }
  // Machines that share a home may have different files at the same paths.
  std::string host = host_name();
  std::ranges::replace(host, '/', '_');
  return directory / "lobelia" / fmt::format("file-hashes-{}.json", host);
}

}  // namespace

bool is_out_of_reach(const fs::path& file, std::uint64_t max_bytes) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return tells_of_file(errno);
  return !S_ISREG(status.st_mode) || std::uint64_t(status.st_size) > max_bytes ||
         (::access(file.c_str(), R_OK) != 0 && tells_of_file(errno));
}

FileHashes& FileHashes::of_user() {
  static FileHashes hashes(file_of_user());
  return hashes;
}

FileHashes::FileHashes(fs::path file) : file_(std::move(file)) {
  if (file_.empty() || !only_we_can_write(file_)) return;
  try {
    for (auto& [path, identity, sha256] : records::read_record<records::KnownHashes>(file_).files) {
      Sha256Digest ignored;
      if (from_hex(sha256, ignored))
        entries_[std::move(path)] = {std::move(identity), std::move(sha256)};
    }
  } catch (const std::exception&) {
    entries_.clear();
  }
}

records::ContentFile FileHashes::hash(const fs::path& path) { return hash(InputFile(path)); }

records::ContentFile FileHashes::hash(const InputFile& file,
                                      std::chrono::duration<double> time_limit) {
  const fs::path& path = file.path();
  const struct stat before = status_of(file);
  const std::string identity = identity_of(before);
  {
    const std::scoped_lock lock(mutex_);
    const auto known = entries_.find(path.native());
    if (known != entries_.end() && known->second.identity == identity)
      return {path.string(), std::uint64_t(before.st_size), known->second.sha256};
  }
  records::ContentFile hashed{path.string(), std::uint64_t(before.st_size),
                              hex(sha256_of_file(file, time_limit))};
  const struct stat after = status_of(file);
  const bool settled = identity_of(after) == identity &&
                       std::time(nullptr) - std::max(after.st_mtim.tv_sec, after.st_ctim.tv_sec) >=
                           kSettledAfterSeconds;
  const std::scoped_lock lock(mutex_);
  ++read_count_;
  if (settled && (entries_.size() < kMostEntries || entries_.contains(path.native()))) {
    entries_[path.native()] = {identity, hashed.sha256};
    changed_ = true;
  }
  return hashed;
}

void FileHashes::save() {
  const std::scoped_lock lock(mutex_);
  if (!changed_ || file_.empty()) return;
  try {
    std::erase_if(entries_,
                  [](const auto& entry) { return ::access(entry.first.c_str(), F_OK) != 0; });
    records::KnownHashes record;
    for (const auto& [path, entry] : entries_)
      if (escape_invalid_utf8(path) == path)  // other names would not be read back unchanged
        record.files.push_back({path, entry.identity, entry.sha256});
    make_directories(file_.parent_path());
    records::write_record(file_, record);
    changed_ = false;
  } catch (const std::exception&) {  // a read-only home, a full disk
  }
}

void ContentReader::add(std::string_view part, std::string_view name, const fs::path& file) {
  records::ContentFile hashed{file.string(), 0, kUnreadable};
  try {
    const InputFile opened(file);
    if (opened.size() > kMostHashedBytes)
      throw Error(ExitCode::kInput,
                  "{}: {} bytes; a file that an engine gets as an argument, or that it "
                  "loads, is hashed, and may have {}",
                  printable_path(file.string()), opened.size(), kMostHashedBytes);
    hashed = hashes_.hash(opened);
  } catch (const Error& error) {
    // A program may be executable but not readable. If a fault counted as that, all keys would change without a word.
    if (error.code() != ExitCode::kInput || !is_out_of_reach(file)) throw;
  }
  parts_.push_back(fmt::format("{}:{}:{}:{}\n", part, name.size(), name, hashed.sha256));
  files_.push_back(std::move(hashed));
}

void ContentReader::add_directory(const fs::path& directory) {
  std::error_code error;
  auto entry = fs::recursive_directory_iterator(
      directory, fs::directory_options::skip_permission_denied, error);
  for (const fs::recursive_directory_iterator end; !error && entry != end; entry.increment(error)) {
    std::error_code unknown;
    if (entry->path().filename() == "__pycache__" || entry.depth() > kDeepestFolder)
      entry.disable_recursion_pending();
    else if (entry->is_regular_file(unknown) && parts_.size() < kMostListedFiles)
      add("data", entry->path().lexically_relative(directory).native(), entry->path());
    if (unknown && !tells_of_file(unknown.value())) {
      error = unknown;
      break;
    }
  }
  if (error && !tells_of_file(error.value()))
    throw failure_of(directory.string() + ": cannot be listed", error.value(), ExitCode::kInput);
}

Content ContentReader::content() {
  const auto keep_each_once = [](auto& values, auto key) {
    std::ranges::sort(values, {}, key);
    // Clang 14 does not compile std::ranges::unique of GCC 12's library.
    const auto same = [&](const auto& a, const auto& b) {
      return std::invoke(key, a) == std::invoke(key, b);
    };
    values.erase(std::unique(values.begin(), values.end(), same), values.end());
  };
  keep_each_once(parts_, std::identity());
  keep_each_once(files_, &records::ContentFile::path);
  Content content;
  if (!parts_.empty()) content.sha256 = hex(sha256(fmt::format("{}", fmt::join(parts_, ""))));
  content.file_count = files_.size();
  content.files = std::move(files_);
  if (content.files.size() > kMostListedFiles) content.files.resize(kMostListedFiles);
  return content;
}

std::vector<std::string> file_changes(const Content& before, const Content& now, std::size_t most) {
  std::map<std::string, std::pair<std::string, std::string>> hashes;
  for (const auto& file : before.files) hashes[file.path].first = file.sha256;
  for (const auto& file : now.files) hashes[file.path].second = file.sha256;
  std::vector<std::string> changes;
  std::size_t more = 0;
  for (const auto& [path, both] : hashes) {
    if (both.first == both.second) continue;
    if (changes.size() == most) {
      ++more;
      continue;
    }
    changes.push_back(fmt::format("{} {}", path,
                                  both.first.empty()    ? "is new"
                                  : both.second.empty() ? "is gone"
                                                        : "changed"));
  }
  if (more > 0) changes.push_back(fmt::format("and {} files more", more));
  return changes;
}

}  // namespace lobelia
