#include "reference_scenes/file_hashes.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/host.hpp"
#include "core/sha256.hpp"
#include "core/text.hpp"
#include "records/record.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostEntries = 50000;  // as the record's table has it
constexpr std::time_t kSettledAfterSeconds = 2;

std::string identity_of(const struct stat& status) {
  return fmt::format("{} {} {} {}.{:09} {}.{:09}", std::uint64_t(status.st_dev),
                     std::uint64_t(status.st_ino), std::uint64_t(status.st_size),
                     status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_ctim.tv_sec,
                     status.st_ctim.tv_nsec);
}

struct stat status_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    throw Error(ExitCode::kInput,
                fmt::format("{}: cannot read: {}", path.string(), std::strerror(errno)));
  if (!S_ISREG(status.st_mode))
    throw Error(ExitCode::kInput, fmt::format("{}: not a regular file", path.string()));
  return status;
}

/// Nobody else could have written it.
bool is_ours_alone(const fs::path& file) {
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
  // Machines that share a home have files of their own under the same paths.
  std::string host = host_name();
  for (char& c : host)
    if (c == '/') c = '_';
  return directory / "lobelia" / fmt::format("file-hashes-{}.json", host);
}

}  // namespace

FileHashes& FileHashes::of_user() {
  static FileHashes hashes(file_of_user());
  return hashes;
}

FileHashes::FileHashes(fs::path file) : file_(std::move(file)) {
  if (file_.empty() || !is_ours_alone(file_)) return;
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

records::ContentFile FileHashes::hash(const fs::path& path) {
  const struct stat before = status_of(path);
  const std::string identity = identity_of(before);
  {
    const std::scoped_lock lock(mutex_);
    const auto known = entries_.find(path.native());
    if (known != entries_.end() && known->second.identity == identity)
      return {path.string(), std::uint64_t(before.st_size), known->second.sha256};
  }
  records::ContentFile hashed{path.string(), std::uint64_t(before.st_size),
                              hex(sha256_of_file(path))};
  const struct stat after = status_of(path);
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
      if (escape_invalid_utf8(path) == path)  // any other name would not come back as it was
        record.files.push_back({path, entry.identity, entry.sha256});
    make_directories(file_.parent_path());
    records::write_record(file_, record);
    changed_ = false;
  } catch (const std::exception&) {  // a home that may only be read, a full disk
  }
}

}  // namespace lobelia
