#include "reference_scenes/content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "core/sha256.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {
constexpr int kDeepest = 12;
constexpr std::size_t kMostListedFiles = 10000;
constexpr char kUnreadable[] = "unreadable";
}  // namespace

void ContentReader::add(std::string_view part, std::string_view name, const fs::path& file) {
  records::ContentFile hashed{file.string(), 0, kUnreadable};
  try {
    hashed = hashes_.hash(file);
  } catch (const Error&) {  // one that may be executed and not read, say
  }
  parts_.push_back(fmt::format("{}:{}:{}:{}\n", part, name.size(), name, hashed.sha256));
  files_.push_back(std::move(hashed));
}

void ContentReader::add_directory(const fs::path& directory) {
  std::error_code error;
  auto entry = fs::recursive_directory_iterator(
      directory, fs::directory_options::skip_permission_denied, error);
  for (const fs::recursive_directory_iterator end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().filename() == "__pycache__" || entry.depth() > kDeepest)
      entry.disable_recursion_pending();
    else if (entry->is_regular_file(ignored) && parts_.size() < kMostListedFiles)
      add("data", entry->path().lexically_relative(directory).native(), entry->path());
  }
}

Content ContentReader::content() {
  const auto unique = [](auto& values, const auto& before, const auto& same) {
    std::sort(values.begin(), values.end(), before);
    values.erase(std::unique(values.begin(), values.end(), same), values.end());
  };
  unique(parts_, std::less<>(), std::equal_to<>());
  unique(
      files_, [](const auto& a, const auto& b) { return a.path < b.path; },
      [](const auto& a, const auto& b) { return a.path == b.path; });
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
