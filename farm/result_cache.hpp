// Results by the hash of what decides them: a directory that farms share, also at once and from several machines.
//
//   CACHE/lobelia-cache             says that it is one, and of which layout
//   CACHE/results/ab/KEY/           one result: its files and result.json, renamed into place as a whole
//   CACHE/failures/ab/KEY.json      why there is none, and KEY.log beside it
//   CACHE/contents/SHA256.json      the files of a program that made results
//   CACHE/making/                   results in the making (draft_name.hpp)
//   CACHE/locks                     claims (core/byte_locks.hpp)
//
// docs/decisions/0014 says why each result has a directory, 0019 how lost results come back. No symbolic link among
// these is followed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "farm/cache_layout.hpp"
#include "farm/draft_name.hpp"
#include "farm/result_key.hpp"
#include "reference_scenes/content.hpp"

namespace lobelia {

inline constexpr char kManifestFile[] = "result.json";

/// A result in the making: a directory for its files. Removed with all of them unless it is published.
class ResultDraft {
 public:
  ResultDraft(ResultDraft&& other) noexcept
      : directory_(std::exchange(other.directory_, {})),
        files_(std::move(other.files_)),
        alive_(std::move(other.alive_)) {}
  ResultDraft& operator=(ResultDraft&&) = delete;
  ~ResultDraft();
  const std::filesystem::path& directory() const { return directory_; }
  /// The path for a file of the result. Every file that was asked for must be there to publish it.
  std::filesystem::path file(const std::string& name) {
    files_.insert(name);
    return directory_ / name;
  }
  /// False if somebody took it away.
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
  kNew,
  kThere,      ///< another one was there first, with the same pictures; that one stays
  kDifferent,  ///< likewise, with other pictures: their maker is not deterministic
};

struct AbandonedDrafts {
  std::size_t removed = 0;
  std::size_t others = 0;  ///< this machine cannot tell whether their makers live; they stay
};

class ResultCache {
 public:
  using Opening = ByteLocks::Opening;
  /// Makes what is missing, except with kLook. Throws Error(kOutput) if that fails or a part is a symbolic link,
  /// Error(kInput) if something else is there, or a cache of another layout. It may be read-only.
  explicit ResultCache(std::filesystem::path directory, Opening opening = Opening::kMake);

  const std::filesystem::path& directory() const { return directory_; }
  std::filesystem::path result_directory(const ResultKey& key) const;
  std::filesystem::path file(const ResultKey& key, const std::string& name) const {
    return result_directory(key) / name;
  }

  /// Every result by its name, in no order. Does not look inside.
  std::vector<ResultKey> list() const;
  bool has(const ResultKey& key) const;

  enum class Look {
    kName,      ///< it is believed by its name; its record has nothing in it
    kQuick,     ///< files must have the size and time of change that the record says
    kThorough,  ///< every byte is read again
  };
  /// The record of the result; empty if it is missing or a file of it is damaged.
  std::optional<records::Result> find(const ResultKey& key, Look look = Look::kQuick) const;
  std::optional<records::Result> find(const ResultKey& key, Look look, std::string& why_not) const;

  /// Throws Error(kOutput).
  ResultDraft draft() const;
  /// Adds the list of files to `record`, writes it and renames all into place. Throws Error(kOutput), also if somebody
  /// took one of the files away.
  Publication publish(ResultDraft& draft, const ResultKey& key, records::Result record) const;

  /// Removes drafts, results and kept failures; nothing while the marker is missing.
  Removal removal(Removal::Mode mode = Removal::Mode::kForReal) const;
  /// Takes a result away, at once for everyone. Throws Error(kOutput) if it stays.
  void discard(const ResultKey& key) const;
  bool discard(const ResultKey& key, Removal& removal) const;

  /// For as long as a result is being made; none while someone else makes it.
  std::optional<ByteLocks::Claim> try_claim(const ResultKey& key) const;
  /// Whether a farm uses it, without keeping anybody from it.
  bool is_in_use() const;
  /// For who uses the cache (shared), or takes results away that others may need (not shared).
  std::optional<ByteLocks::Claim> try_use(bool shared) const;
  /// Shared; Error(kOutput) while somebody takes results away.
  ByteLocks::Claim use() const;

  void keep_failure(const ResultKey& key, const records::Failure& record,
                    const std::string& log = {}) const;
  /// Empty if there is none.
  std::filesystem::path failure_log(const ResultKey& key) const;
  std::optional<records::Failure> failure(const ResultKey& key) const;
  std::vector<ResultKey> failures() const;  ///< in no order
  void forget_failure(const ResultKey& key) const;
  void forget_failure(const ResultKey& key, Removal& removal) const;

  /// Keeps the list of a program's files under its hash, for explanations. The cache may be read-only.
  void keep_content(const Content& content) const;
  std::optional<Content> content(const std::string& sha256) const;

  /// Removes drafts that nobody works on any more. To be called before this object has any.
  AbandonedDrafts remove_abandoned() const {
    Removal removing = removal();
    return remove_abandoned(removing);
  }
  AbandonedDrafts remove_abandoned(Removal& removal) const;
  /// Whether other machines see this one's locks.
  LockSharing lock_sharing() const { return locks_.sharing(); }

  /// For gc: the result was used today.
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
