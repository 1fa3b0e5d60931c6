// Writes a site; a second time it changes only what is different.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "base/system/files.hpp"
#include "gallery/site/published_texts.hpp"

namespace lobelia::gallery {

/// The list of a site's files, in it.
inline constexpr char kSiteList[] = "gallery.json";

enum class SiteKind { kGallery, kReport };
/// The kind of site in a folder, by its list of files. Nothing if Lobelia did not write it, or if it is a link.
std::optional<SiteKind> kind_of_site(const std::filesystem::path& directory);

/// Names are paths below the site's directory: plain names, joined with '/'. Several threads may write, each
/// its own files; then one calls finish().
///
/// Whatever ends a publication, the next one knows the site again: its list is written before anything else is changed.
class Publisher {
 public:
  /// Creates the directory and reads the list of files that an earlier publication wrote. An unreadable list counts as
  /// none. `own` are the files by which kind_of_site() knows the site; they are in the list from the beginning.
  explicit Publisher(std::filesystem::path site, std::set<std::string> own = {"index.html"});

  /// How the texts of the run's files are published; null: as they are. Before the first copy().
  void set_texts(std::shared_ptr<const PublishedTexts> texts) { texts_ = std::move(texts); }

  const std::filesystem::path& site() const { return site_; }

  /// Does not touch a file that has this content already. Throws Error(kOutput), also if a directory below the
  /// site is a symbolic link.
  void write(const std::string& name, std::string_view content);
  /// Copies the run's file of that name with its time, by which the next publication sees that it is unchanged. Does
  /// nothing if the site is the run. Throws Error(kInput) if the file cannot be read, or if a link leads out of the run: a
  /// record must not publish files from elsewhere. Throws Error(kOutput).
  void copy(const std::filesystem::path& run, const std::string& name);
  /// Writes a file that takes time to make, unless it was made from the same `key`, which names all inputs.
  /// Returns false, and writes no file, if `make` returns "".
  bool derive(const std::string& name, const std::string& key,
              const std::function<std::string()>& make);
  /// Lets the next publication make this derived file again, whatever its key: something was missing when it was made.
  void derive_again(const std::string& name);

  /// Removes files that the earlier publication wrote and this one did not, with directories that become empty,
  /// and writes the new list. A file that is now behind a link out of the site is left alone.
  /// Throws Error(kOutput) where the system cannot remove one.
  void finish();

 private:
  void place(const std::string& name, const std::function<void(PartFile&)>& fill);
  void write_list(const std::set<std::string>& files,
                  const std::map<std::string, std::string>& keys) const;
  void remove_stale();
  void add_to_list(const std::string& name);
  void clean(const std::filesystem::path& directory);

  std::filesystem::path site_;
  const std::set<std::string> own_;
  std::shared_ptr<const PublishedTexts> texts_;
  std::set<std::string> earlier_;
  std::map<std::string, std::string> earlier_keys_;  ///< by name of a derived file
  std::once_flag begun_;                             ///< once the first file is changed
  std::mutex mutex_;                                 ///< for the members below
  std::set<std::string> files_;
  std::map<std::string, std::string> keys_;
  std::set<std::filesystem::path> cleaned_;  ///< directories without what killed publications left
};

}  // namespace lobelia::gallery
