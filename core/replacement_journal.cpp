#include "core/replacement_journal.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/replacement.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// An entry is words and, at its end, a name. A NUL ends it, which no name has.
constexpr std::string_view kMadeWord = "made", kInWord = "in", kNoFileWord = "-";
/// The last entry, which says that none is lost.
constexpr std::string_view kEndWord = "end";

/// The text up to the first blank, which is taken off `text`. Nothing if there is no blank.
std::optional<std::string_view> take_word(std::string_view& text) {
  const std::size_t blank = text.find(' ');
  if (blank == text.npos) return std::nullopt;
  const std::string_view word = text.substr(0, blank);
  text.remove_prefix(blank + 1);
  return word;
}

/// False if it is damaged.
bool read_entry(std::string_view text, ReplacementJournal& journal) {
  const std::optional<std::string_view> first = take_word(text);
  if (first == kMadeWord) {
    journal.made.emplace_back(text);
    return is_inner_path(journal.made.back());
  }
  if (first == kInWord) {
    long long inode = 0;
    const bool is_number = parse_integer(text, inode);
    journal.directory = std::uint64_t(inode);
    return is_number;
  }
  ReplacementJournal::Entry entry;
  const std::optional<std::string_view> before = take_word(text);
  if (!first || !before || !from_hex(*first, entry.bytes)) return false;
  if (*before != kNoFileWord && !from_hex(*before, entry.before.emplace())) return false;
  entry.name = text;
  const bool is_inside = is_inner_path(entry.name);
  journal.entries.push_back(std::move(entry));
  return is_inside;
}

}  // namespace

std::string ReplacementJournal::text() const {
  std::string text;
  const auto add = [&](const std::string& entry) { (text += entry) += '\0'; };
  add(fmt::format("{} {}", kInWord, directory));
  for (const fs::path& one : made) add(fmt::format("{} {}", kMadeWord, one.native()));
  for (const Entry& entry : entries)
    add(fmt::format("{} {} {}", hex(entry.bytes),
                    entry.before ? hex(*entry.before) : std::string(kNoFileWord),
                    entry.name.native()));
  add(std::string(kEndWord));
  return text;
}

std::optional<ReplacementJournal> ReplacementJournal::read(std::string_view text) {
  ReplacementJournal journal;
  for (;;) {
    const std::size_t end = text.find('\0');
    if (end == text.npos) return std::nullopt;
    const std::string_view entry = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (entry == kEndWord) break;
    if (!read_entry(entry, journal)) return std::nullopt;
  }
  if (!text.empty()) return std::nullopt;
  return journal;
}

std::string new_file_name(std::size_t i) { return fmt::format("new-{}", i); }
std::string old_file_name(std::size_t i) { return fmt::format("old-{}", i); }

bool is_inner_path(const fs::path& path) {
  if (path.empty() || path.is_absolute()) return false;
  for (const fs::path& part : path)
    if (part.empty() || part == "." || part == ".." || part == kReplacedName) return false;
  return true;
}

}  // namespace lobelia
