#include "gallery/site/publisher.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <ranges>

#include "base/records/farm.hpp"
#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/removal.hpp"
#include "base/words/text.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

bool is_path_of_plain_names(const std::string& name) {
  return !name.empty() && std::ranges::all_of(std::views::split(name, '/'), [](const auto& part) {
    return is_plain_name({part.begin(), part.end()});
  });
}

/// Whether `path` is in `directory` after following all links.
bool is_within(const fs::path& directory, const fs::path& path) {
  std::error_code error, other;
  const fs::path root = fs::canonical(directory, error), real = fs::canonical(path, other);
  return !error && !other && is_below(real, root);
}

bool is_same_text(const fs::path& path, std::string_view content) {
  std::error_code error;
  if (fs::is_symlink(path, error) || fs::file_size(path, error) != content.size() || error)
    return false;
  return read_file(path, content.size()) == content;
}

/// Every report of `lobelia compare` has one of these records. A gallery has neither.
constexpr const char* kReportRecords[] = {"comparison.json", "comparison-set.json"};

}  // namespace

std::optional<SiteKind> kind_of_site(const fs::path& directory) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(directory, error)) ||
      !fs::is_regular_file(fs::symlink_status(directory / kSiteList, error)))
    return std::nullopt;
  try {
    const auto list = records::read_record<records::GalleryList>(directory / kSiteList);
    const auto has = [&](const char* name) {
      return std::ranges::find(list.files, name) != list.files.end();
    };
    if (!has("index.html")) return std::nullopt;
    return std::ranges::any_of(kReportRecords, has) ? SiteKind::kReport : SiteKind::kGallery;
  } catch (const Error&) {
    return std::nullopt;
  }
}

Publisher::Publisher(fs::path site, std::set<std::string> own)
    : site_(std::move(site)), own_(std::move(own)) {
  make_directories(site_);
  if (file_type_at(site_ / kSiteList, ExitCode::kOutput) == fs::file_type::not_found) return;
  try {
    const auto list = records::read_record<records::GalleryList>(site_ / kSiteList);
    for (const std::string& name : list.files)
      if (is_path_of_plain_names(name)) earlier_.insert(name);
    earlier_keys_.insert(list.made_of.begin(), list.made_of.end());
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput || error.is_fault()) throw;
    earlier_.clear();  // nothing is removed, which does no harm
  }
}

/// Lets `fill` write a file, which then gets its name. It is not flushed to the disk as records are: there are tens of
/// thousands, and a site that a crash has damaged can be published again.
void Publisher::place(const std::string& name, const std::function<void(PartFile&)>& fill) {
  std::call_once(begun_, [&] {
    std::set<std::string> files = earlier_;
    files.insert(own_.begin(), own_.end());
    // Without keys: a derived file that this publication changes is no longer what its key says.
    write_list(files, {});
  });
  // Links are refused: a link below the site may lead out of it.
  HeldDirectory held(site_);
  for (const fs::path& folder : fs::path(name).parent_path())
    held = held.make_below(folder.string(), HeldDirectory::Border::kCross);
  const FlushLater later;
  PartFile file(site_ / name, AtLink::kReplace);
  fill(file);
  file.finish();
}

void Publisher::write_list(const std::set<std::string>& files,
                           const std::map<std::string, std::string>& keys) const {
  const std::string text = records::record_text(
      records::GalleryList{{files.begin(), files.end()}, {keys.begin(), keys.end()}});
  if (!is_same_text(site_ / kSiteList, text)) write_file(site_ / kSiteList, text, AtLink::kReplace);
}

void Publisher::add_to_list(const std::string& name) {
  const std::scoped_lock lock(mutex_);
  files_.insert(name);
  clean(fs::path(name).parent_path());
}

/// Removes from a directory of the site what killed publications left there.
void Publisher::clean(const fs::path& directory) {
  if (!cleaned_.insert(directory).second) return;
  HeldDirectory held(site_);
  for (const fs::path& folder : directory)
    held = held.below(folder.string(), HeldDirectory::Border::kCross);
  remove_abandoned_parts(held);
}

void Publisher::write(const std::string& name, std::string_view content) {
  // After an interruption, the content may be incomplete.
  throw_if_interrupted();
  add_to_list(name);
  if (is_same_text(site_ / name, content)) return;
  place(name, [&](PartFile& file) { file.append(content); });
}

void Publisher::copy(const fs::path& run, const std::string& name) {
  const fs::path from = run / name, to = site_ / name;
  std::error_code error;
  if (fs::equivalent(from, to, error)) return;
  if (!is_within(run, from))
    throw Error(ExitCode::kInput,
                from.string() + ": a link that leads out of the run is not published");
  if (texts_)
    if (const auto published = texts_->file(from)) return write(name, *published);
  add_to_list(name);
  const auto time = fs::last_write_time(from, error);
  if (error) throw failure_of(from.string() + ": cannot read", error.value(), ExitCode::kInput);
  if (fs::file_size(from, error) == fs::file_size(to, error) && !error &&
      fs::last_write_time(to, error) == time && !error)
    return;
  place(name, [&](PartFile& file) {
    file.append_file(from);
    std::error_code failed;
    fs::last_write_time(file.part(), time, failed);
    if (failed) throw failure_of(to.string() + ": cannot write", failed.value(), ExitCode::kOutput);
  });
}

bool Publisher::derive(const std::string& name, const std::string& key,
                       const std::function<std::string()>& make) {
  const auto earlier = earlier_keys_.find(name);
  std::error_code ignored;
  if (earlier != earlier_keys_.end() && earlier->second == key &&
      fs::is_regular_file(site_ / name, ignored)) {
    add_to_list(name);
  } else {
    const std::string content = make();
    if (content.empty()) return false;
    write(name, content);
  }
  const std::scoped_lock lock(mutex_);
  keys_[name] = key;
  return true;
}

void Publisher::derive_again(const std::string& name) {
  const std::scoped_lock lock(mutex_);
  keys_.erase(name);
}

void Publisher::remove_stale() {
  std::set<fs::path> directories;
  for (const std::string& name : earlier_)
    for (fs::path up = fs::path(name).parent_path(); !up.empty(); up = up.parent_path())
      directories.insert(up);
  for (const fs::path& directory : directories) clean(directory);
  Removal removal(site_, {[](const HeldDirectory& site) {
                            struct stat status {};
                            return ::fstatat(site.fd(), kSiteList, &status, AT_SYMLINK_NOFOLLOW) ==
                                       0 &&
                                   S_ISREG(status.st_mode);
                          },
                          [&](const fs::path& relative) {
                            return earlier_.contains(relative.string()) ? Owned::kFile
                                   : directories.contains(relative)     ? Owned::kDirectory
                                                                        : Owned::kNo;
                          }});
  for (const std::string& name : earlier_) {
    if (files_.contains(name)) continue;
    const std::size_t kept = removal.kept().size();
    if (!removal.remove(name) && removal.kept().size() > kept) continue;
    // Only an empty directory is removed.
    for (fs::path up = fs::path(name).parent_path(); !up.empty() && removal.remove(up);)
      up = up.parent_path();
  }
  // The list that stays names it still, so that the next publication tries again.
  for (const Removal::Kept& kept : removal.kept())
    if (kept.is_fault)
      throw Error(ExitCode::kOutput, "{}: cannot remove: {}", kept.path.string(), kept.why);
}

void Publisher::finish() {
  remove_stale();
  write_list(files_, keys_);
}

}  // namespace lobelia::gallery
