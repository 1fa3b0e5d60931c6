// Results by the hash of what decides them: a directory that farms share, also at once and from several machines.
//
//   CACHE/lobelia-cache             marks a cache, and names its layout
//   CACHE/results/ab/KEY/           one result: its files and result.json, renamed into place as a whole
//   CACHE/failures/ab/KEY.json      why there is no result, and KEY.log beside it
//   CACHE/contents/SHA256.json      the files of a program that made results
//   CACHE/making/                   results in the making (DraftName)
//   CACHE/locks                     claims (base/system/byte_locks.hpp)
//
// Symbolic links among these are not followed. docs/decisions/0005: why directories; 0006: how lost results come back.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "farm/cache_layout.hpp"
#include "farm/job.hpp"
#include "reference_scenes/content.hpp"

namespace lobelia {

inline constexpr char kManifestFile[] = "result.json";

/// A result in the making: a directory for its files, which is removed unless it is published.
class ResultDraft {
 public:
  ResultDraft(ResultDraft&& other) noexcept
      : directory_(std::exchange(other.directory_, {})),
        files_(std::move(other.files_)),
        alive_(std::move(other.alive_)) {}
  ResultDraft& operator=(ResultDraft&&) = delete;
  ~ResultDraft();
  const std::filesystem::path& directory() const { return directory_; }
  /// The path for a file of the result. Publishing needs every file that was asked for.
  std::filesystem::path file(const std::string& name) {
    files_.insert(name);
    return directory_ / name;
  }
  /// All of these, and after ResultCache::seal() its record too.
  std::vector<std::filesystem::path> files() const;
  /// False if it was removed.
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
  kThere,      ///< an earlier result with the same pictures stays
  kDifferent,  ///< an earlier result with other pictures stays: its maker is not deterministic
};

struct AbandonedDrafts {
  std::size_t removed = 0;
  std::size_t others = 0;  ///< kept: this machine cannot tell whether their makers live
};

class ResultCache {
 public:
  using Opening = ByteLocks::Opening;
  /// Makes missing parts, except with kLook. Throws Error(kOutput) if that fails or a part is a symbolic link, Error(kInput)
  /// if the directory is no cache, or has another layout. A cache may be read-only.
  explicit ResultCache(std::filesystem::path directory, Opening opening = Opening::kMake);

  const std::filesystem::path& directory() const { return directory_; }
  std::filesystem::path result_directory(const ResultKey& key) const;
  std::filesystem::path file(const ResultKey& key, const std::string& name) const {
    return result_directory(key) / name;
  }

  /// Every result by its name, in no order, without a look inside.
  std::vector<ResultKey> list() const;
  bool has(const ResultKey& key) const;

  enum class Look {
    kName,      ///< its name is enough; the record is empty
    kQuick,     ///< files must have the recorded size and time of change
    kThorough,  ///< reads every byte
  };
  /// The record of the result; empty if it is missing or one of its files is damaged: `why_not` gets the reason.
  std::optional<records::Result> find(const ResultKey& key, Look look = Look::kQuick,
                                      std::string* why_not = nullptr) const;

  /// Throws Error(kOutput).
  ResultDraft draft() const;
  /// Writes `record` with the list of files. Throws Error(kOutput), also for a lost file.
  void seal(ResultDraft& draft, const ResultKey& key, records::Result& record) const;
  /// Renames a sealed draft into place; its files must be on the disk. Throws Error(kOutput).
  Publication place(ResultDraft& draft, const ResultKey& key, const records::Result& record) const;
  /// Both.
  Publication publish(ResultDraft& draft, const ResultKey& key, records::Result record) const;

  /// Removes drafts, results and failures; nothing while the marker is missing.
  Removal removal(Removal::Mode mode = Removal::Mode::kForReal) const;
  /// Removes a result, at once for everyone. Throws Error(kOutput) if it stays.
  void discard(const ResultKey& key) const;
  bool discard(const ResultKey& key, Removal& removal) const;

  /// To be held while a result is made; empty while another process makes it.
  std::optional<ByteLocks::Claim> try_claim(const ResultKey& key) const;
  /// Whether a farm uses the cache; takes no lock.
  bool is_in_use() const;
  /// To be held by users of the cache (shared), or to remove results that others may need (not shared).
  std::optional<ByteLocks::Claim> try_use(bool shared) const;
  /// Shared; throws Error(kOutput) while results are being removed.
  ByteLocks::Claim use() const;

  void keep_failure(const ResultKey& key, const records::Failure& record,
                    const std::string& log = {}) const;
  /// Empty if there is none.
  std::filesystem::path failure_log(const ResultKey& key) const;
  std::optional<records::Failure> failure(const ResultKey& key) const;
  void forget_failure(const ResultKey& key) const;
  void forget_failure(const ResultKey& key, Removal& removal) const;

  /// Keeps the list of a program's files under its hash, for explanations. The cache may be read-only.
  void keep_content(const Content& content) const;
  std::optional<Content> content(const std::string& sha256) const;

  /// Removes the drafts of dead processes. To be called before this object has drafts.
  AbandonedDrafts remove_abandoned() const {
    Removal removing = removal();
    return remove_abandoned(removing);
  }
  AbandonedDrafts remove_abandoned(Removal& removal) const;
  /// Whether other machines see this one's locks.
  LockSharing lock_sharing() const { return locks_.sharing(); }

  /// Marks the result as used today, for gc.
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
