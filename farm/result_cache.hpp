// Results by what decides them: a directory that farms share, also at the same time and from several machines.
//
//   CACHE/lobelia-cache             says that it is one, and of which layout
//   CACHE/results/ab/KEY/           one result: its files and result.json, renamed into place as a whole
//   CACHE/failures/ab/KEY.json      why there is none, and KEY.log beside it
//   CACHE/contents/SHA256.json      what programs are made of that results were made by
//   CACHE/making/                   results in the making (draft_name.hpp)
//   CACHE/locks                     who is at work on what (byte_locks.hpp)
//
// docs/decisions/0014 says why a directory for each result, 0019 how what is lost comes back. Symbolic links among
// these are refused.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/removal.hpp"
#include "core/byte_locks.hpp"
#include "farm/draft_name.hpp"
#include "farm/result_key.hpp"
#include "reference_scenes/content.hpp"

namespace lobelia {

inline constexpr char kManifestFile[] = "result.json";
inline constexpr char kCacheMarkerFile[] = "lobelia-cache";  ///< by which a cache is known

/// Whether there is a cache: by its marker, or because it holds nothing but what caches do and has lost that.
bool is_cache(const std::filesystem::path& directory);

/// A result in the making: a directory to put files into. Taken away with all of them unless it is published.
class ResultDraft {
 public:
  ResultDraft(ResultDraft&& other) noexcept
      : directory_(std::exchange(other.directory_, {})),
        files_(std::move(other.files_)),
        alive_(std::move(other.alive_)) {}
  ResultDraft& operator=(ResultDraft&&) = delete;
  ~ResultDraft();
  const std::filesystem::path& directory() const { return directory_; }
  /// Where a file of the result belongs. It is not published without any that was asked for.
  std::filesystem::path file(const std::string& name) {
    files_.insert(name);
    return directory_ / name;
  }
  /// False if somebody took it away, with the cache or without.
  bool is_there() const;

 private:
  friend class ResultCache;
  ResultDraft(std::filesystem::path directory, ByteLocks::Claim alive)
      : directory_(std::move(directory)), alive_(std::move(alive)) {}
  std::filesystem::path directory_;
  std::set<std::string> files_;
  ByteLocks::Claim alive_;
};

enum class Publication {
  kNew,        ///< it is there now
  kThere,      ///< another one was there first, with the same pictures; that one stays
  kDifferent,  ///< likewise, but its pictures differ: what made them is not deterministic
};

struct AbandonedDrafts {
  std::size_t removed = 0;
  std::size_t others =
      0;  ///< of which this machine cannot tell whether their makers live; they stay
};

class ResultCache {
 public:
  using Opening = ByteLocks::Opening;
  /// Makes the directory and what is missing in it, unless it is only to be looked at. Throws Error(kOutput) if that
  /// fails or a part of it is a symbolic link, Error(kInput) if something else is there, or a cache of another layout.
  /// One that may only be read is not an error.
  explicit ResultCache(std::filesystem::path directory, Opening opening = Opening::kMake);

  const std::filesystem::path& directory() const { return directory_; }
  std::filesystem::path result_directory(const ResultKey& key) const;
  std::filesystem::path file(const ResultKey& key, const std::string& name) const {
    return result_directory(key) / name;
  }

  /// Every result that is there by its name, in no order. Does not look inside.
  std::vector<ResultKey> list() const;
  bool has(const ResultKey& key) const;

  enum class Look {
    kName,  ///< it is believed by its name; its record has nothing in it
    kQuick,  ///< a file of the size and with the time of change that its record tells is taken for whole
    kThorough,  ///< every byte is read again
  };
  /// The record of the result if it is whole, in every file; empty if it is missing or damaged.
  std::optional<records::Result> find(const ResultKey& key, Look look = Look::kQuick) const;
  /// The same, and why not, as a few words.
  std::optional<records::Result> find(const ResultKey& key, Look look, std::string& why_not) const;

  /// Throws Error(kOutput).
  ResultDraft draft() const;
  /// Adds to `record` the list of files, each with its size and hash, writes it as result.json and renames all into
  /// place. Throws Error(kOutput), also if somebody took one of the files away.
  Publication publish(ResultDraft& draft, const ResultKey& key, records::Result record) const;

  /// Of drafts, results and kept failures; of nothing while the marker is missing.
  Removal removal(Removal::Mode mode = Removal::Mode::kForReal) const;
  /// Takes a result away, at once for everyone. Throws Error(kOutput) if it stays.
  void discard(const ResultKey& key) const;
  bool discard(const ResultKey& key, Removal& removal) const;

  /// To be held while a result is being made; none while someone else makes it.
  std::optional<ByteLocks::Claim> try_claim(const ResultKey& key) const;
  /// Whether a farm uses it, without keeping anybody from it.
  bool is_in_use() const;
  /// To be held by whoever uses the cache (shared) or takes results away that others may need (not shared).
  std::optional<ByteLocks::Claim> try_use(bool shared) const;
  /// Shared; Error(kOutput) while somebody takes results away.
  ByteLocks::Claim use() const;

  /// With the log of whoever failed, unless that is empty.
  void keep_failure(const ResultKey& key, const records::Failure& record,
                    const std::string& log = {}) const;
  /// Where that log is, if there is one; otherwise empty.
  std::filesystem::path failure_log(const ResultKey& key) const;
  std::optional<records::Failure> failure(const ResultKey& key) const;
  std::vector<ResultKey> failures() const;  ///< that are kept, in no order
  void forget_failure(const ResultKey& key) const;
  void forget_failure(const ResultKey& key, Removal& removal) const;

  /// Keeps the list of files that a program consists of (reference_scenes/content.hpp) under its hash, which results name.
  /// Only explanations need it, so a read-only cache is not an error.
  void keep_content(const Content& content) const;
  std::optional<Content> content(const std::string& sha256) const;

  /// Drafts that nobody works on any more; to be called before this object has any.
  AbandonedDrafts remove_abandoned() const;
  AbandonedDrafts remove_abandoned(Removal& removal) const;
  /// Whether other machines see this one's locks.
  LockSharing lock_sharing() const { return locks_.sharing(); }

  /// For gc: when it was last used (a whole day is as exact as it gets), and that it was used now.
  void touch(const ResultKey& key) const;

 private:
  std::filesystem::path failure_file(const ResultKey& key, const char* ending) const;
  HeldDirectory root() const;
  HeldDirectory shelf(const char* part, const ResultKey& key) const;
  std::string new_draft_name() const;
  Life life_of_draft(const std::string& name, std::optional<ByteLocks::Claim>& claim) const;
  std::filesystem::path directory_;
  ByteLocks locks_;
  ProcessIdentity self_;
};

}  // namespace lobelia
