// Writing a site so that a second time changes only what is different.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

namespace lobelia::gallery {

/// Names are paths below the site's directory, with '/', of plain names. Several threads may write, each
/// its own files; finish() comes after them.
class Publisher {
 public:
  /// Creates the directory. Reads which files an earlier publication wrote; a list that cannot be read is
  /// taken for none.
  explicit Publisher(std::filesystem::path site);

  const std::filesystem::path& site() const { return site_; }

  /// A file that has this content already is not touched. Throws Error(kOutput), also where a directory below the
  /// site is a symbolic link.
  void write(const std::string& name, std::string_view content);
  /// The run's file of that name as it is, with its time, by which an unchanged one is known the next time; nothing
  /// if the site is in the run. Throws Error(kInput) if a link leads out of the run: what lies elsewhere is not
  /// to be published because a record names it. Throws Error(kOutput).
  void copy(const std::filesystem::path& run, const std::string& name);
  /// What takes time to make: left as it is if it was made of the same `key`, which says all that decides it.
  /// False, and no file, if `make` gives nothing.
  bool derive(const std::string& name, const std::string& key,
              const std::function<std::string()>& make);

  /// Removes what the earlier publication wrote and this one did not, with directories that are empty then,
  /// and writes the new list. A file that is no longer where it was written, but behind a link out of the
  /// site, is left alone.
  void finish();

  int written() const { return written_; }  ///< files that were new or different
  int removed() const { return removed_; }

 private:
  void remove_stale();
  void publishes(const std::string& name);
  void count_written();

  std::filesystem::path site_;
  std::mutex mutex_;  ///< of what follows
  std::set<std::string> files_, earlier_;
  std::map<std::string, std::string> keys_, earlier_keys_;  ///< of what was derived, by name
  int written_ = 0, removed_ = 0;
};

}  // namespace lobelia::gallery
