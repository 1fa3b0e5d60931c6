#include "gallery/site/published_texts.hpp"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <regex>
#include <set>

#include "base/system/error.hpp"
#include "base/system/host.hpp"
#include "base/system/sha256.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

/// Keys whose texts are paths, which may have spaces in them.
constexpr std::string_view kPaths[] = {"cache",  "program", "path", "grid", "scene", "file",
                                       "config", "exr",     "png",  "a",    "b",     "c"};
/// Keys of commands and of their arguments.
constexpr std::string_view kCommands[] = {"command", "engineCommands", "engineOptions"};
/// Keys of sentences that a system or an engine may have written. Elsewhere a word that is also a host's name means
/// something else.
constexpr std::string_view kSentences[] = {"message",  "why",     "because", "remarks",
                                           "warnings", "warning", "stopped", "reason",
                                           "method",   "error",   "problem", "finding"};
/// Keys that are left out.
constexpr std::string_view kOfMachine[] = {"pid", "user", "node"};
constexpr std::string_view kTextFiles[] = {".log", ".csv", ".glsl", ".hlsl", ".wgsl",
                                           ".osl", ".txt", ".md",   ".h",    ".text"};
/// Words of logs that a user may be called, too.
constexpr std::string_view kCommonWords[] = {"root", "lobelia", "user", "localhost", ""};

template <class List>
bool contains(const List& list, std::string_view text) {
  return std::ranges::find(list, text) != std::end(list);
}

bool in_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || (c & 0x80) != 0;
}

bool has_word(std::string_view text, std::string_view word) {
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !in_name(text[at - 1])) && (end == text.size() || !in_name(text[end])))
      return true;
  }
  return false;
}

/// "pid 123", "process 123", "pid=123" and "povray[123]:".
bool tells_process(const std::string& text) {
  static const std::regex kId(
      R"(\b(p?pids?|process)[ :=#]+[0-9]+(?![.0-9]| of )|\b[a-z][-a-z0-9_]*\[[0-9]+\]:)",
      std::regex::icase);
  return std::regex_search(text, kId);
}

/// The file's name if it is one that a person's home cannot have.
std::string name_in(std::string_view path) {
  while (path.size() > 1 && path.ends_with('/')) path.remove_suffix(1);
  const std::size_t slash = path.rfind('/');
  if (slash == 0) return std::string(path);  // "/dev" or "/" tells nothing of a machine
  return path.find('/', 1) == slash ? "…" : std::string(path.substr(slash + 1));
}

/// Whether a path may begin after this: at the start, after a gap or a quote, or after an option's letters, as in
/// -I/usr/include and POV-Ray's +I/usr.
bool opens_path(std::string_view before) {
  constexpr std::string_view kGaps = " \t\n'\"=(),;";
  std::size_t letters = before.size();
  while (letters > 0 && std::isalpha(static_cast<unsigned char>(before[letters - 1]))) --letters;
  if (letters > 0 && letters < before.size() &&
      (before[letters - 1] == '-' || before[letters - 1] == '+'))
    before = before.substr(0, letters - 1);
  return before.empty() || kGaps.find(before.back()) != kGaps.npos;
}

/// Each path in a scene is the whole of an attribute.
std::string scene(const std::string& text) {
  static const std::regex kPath(R"re("/[^"]*/([^"/]*)")re");
  return std::regex_replace(text, kPath, "\"$1\"");
}

}  // namespace

std::string without_paths(std::string_view text) {
  constexpr std::string_view kEnds = " \t\n'\"=(),;";
  std::string shown;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '/' || !opens_path(text.substr(0, i))) {
      shown += text[i++];
      continue;
    }
    const bool is_quoted = i > 0 && (text[i - 1] == '\'' || text[i - 1] == '"');
    const std::size_t end =
        std::min(is_quoted ? text.find(text[i - 1], i) : text.find_first_of(kEnds, i), text.size());
    shown += name_in(text.substr(i, end - i));
    i = end;
  }
  return shown;
}

bool tells_path(const std::string& text) {
  if (text.find_first_of("/~@") == text.npos) return false;
  static const std::regex kWeb(R"(\bhttps?://[^\s'"`<>@]*)");
  // After a name, a number, a bracket or a dot it is a fraction or a relative path; not after an option, as in
  // -I/usr/include and POV-Ray's +I/usr, nor after an escaped character or the colour of a terminal.
  static const std::regex kAbsolute(
      R"((^|[^A-Za-z0-9)\].%_|</]|\\[nt]|\[[0-9;]*m)/+[A-Za-z0-9._~@$\x80-\xff]|(^|[\s'"])[-+][A-Za-z]{1,20}/+[A-Za-z._~])");
  static const std::regex kHome(R"((^|[\s'"`=(:,;])~[/A-Za-z])");
  static const std::regex kAddress(R"(\b[a-z+.-]+://|[A-Za-z0-9]@[A-Za-z0-9])");
  const std::string rest = std::regex_replace(text, kWeb, "");
  return std::regex_search(rest, kAbsolute) || std::regex_search(rest, kHome) ||
         std::regex_search(rest, kAddress);
}

PublishedTexts::PublishedTexts(std::vector<std::string> hosts, std::vector<std::string> users)
    : names_(std::move(hosts)) {
  names_.push_back(host_name());
  for (std::size_t i = names_.size(); i-- > 0;)  // "node7.example.org" is node7, too
    if (const auto dot = names_[i].find('.'); dot != std::string::npos)
      names_.push_back(names_[i].substr(0, dot));
  names_.insert(names_.end(), users.begin(), users.end());
  if (const passwd* user = ::getpwuid(::geteuid())) names_.emplace_back(user->pw_name);
  for (const char* variable : {"USER", "LOGNAME"})
    if (const char* const name = std::getenv(variable)) names_.emplace_back(name);
  std::erase_if(names_, [](const std::string& name) { return contains(kCommonWords, name); });
}

void PublishedTexts::keep_apart(const std::vector<records::Axis>& axes) {
  const auto shown = [](const std::string& value) {
    const std::string name = value.starts_with('/') ? name_in(value) : without_paths(value);
    return tells_path(name) ? std::string(kLeftOut) : name;
  };
  std::set<std::string> used;
  for (const records::Axis& axis : axes)
    for (const records::AxisValue& value : axis.values)
      if (shown(value.value) == value.value) used.insert(value.value);
  for (const records::Axis& axis : axes)
    for (const records::AxisValue& value : axis.values) {
      const std::string name = shown(value.value);
      if (name == value.value || values_.contains(value.value)) continue;
      std::string apart = name;
      for (int i = 2; !used.insert(apart).second; ++i) apart = name + " " + std::to_string(i);
      values_.emplace(value.value, apart);
    }
}

bool PublishedTexts::tells_name(const std::string& text) const {
  return tells_process(text) ||
         std::ranges::any_of(names_, [&](const std::string& name) { return has_word(text, name); });
}

std::string PublishedTexts::lines(std::string_view text, bool of_log) const {
  std::string shown;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string line(text.substr(0, end));
    if (tells_path(line) || (of_log && tells_name(line)))
      shown += kLeftOut + std::string(line.ends_with('\n') ? "\n" : "");
    else
      shown += line;
    text.remove_prefix(end);
  }
  return shown;
}

std::optional<std::string> PublishedTexts::text_of_record(std::span<const std::string> keys,
                                                          const std::string& text) const {
  const std::string key = keys.empty() ? "" : keys.back();
  if (contains(kOfMachine, key) ||
      (key == "name" && keys.size() > 1 && keys[keys.size() - 2] == "host"))
    return std::nullopt;
  if (const auto value = values_.find(text); value != values_.end()) return value->second;
  if (text.starts_with('/') && contains(kPaths, key)) return name_in(text);
  // An argument may be a path with spaces; the whole of a command begins with a program's name.
  const bool is_command = contains(kCommands, key);
  const std::string shown = !is_command                                 ? text
                            : text.starts_with('/') && key == "command" ? name_in(text)
                                                                        : without_paths(text);
  const bool is_sentence = contains(kSentences, key);
  return tells_path(shown) || (is_sentence && tells_name(shown)) ? std::string(kLeftOut) : shown;
}

std::string PublishedTexts::record(std::string_view text) const {
  const auto changed =
      records::with_texts(text, [&](std::span<const std::string> keys, const std::string& value) {
        return text_of_record(keys, value);
      });
  return changed ? *changed : lines(text);
}

std::string PublishedTexts::cell(std::string text, const fs::path& directory) const try {
  records::Origin origin;
  auto cell = records::parse_record<records::Cell>(text, "", &origin);
  if (origin.seal != records::Origin::Seal::kFits) return text;
  bool has_changed = false;
  for (records::CellFile& file : cell.files) try {
      const auto published = this->file(directory / file.name);
      // A file that is not the one that the farm wrote keeps that flaw.
      if (!published || hex(sha256_of_file(directory / file.name)) != file.sha256) continue;
      const std::string now = hex(sha256(*published));
      has_changed = has_changed || now != file.sha256;
      file.sha256 = now;
    } catch (const Error&) {
      continue;
    }
  return has_changed ? records::record_text(cell) : text;
} catch (const Error& error) {
  if (error.code() != ExitCode::kInput) throw;
  return text;
}

std::optional<std::string> PublishedTexts::file(const fs::path& path) const {
  const std::string extension = path.extension().string();
  const bool is_record = extension == ".json", is_scene = extension == ".xml";
  if (!is_record && !is_scene && !contains(kTextFiles, extension)) return std::nullopt;
  const std::string text = read_file(path, records::kMaxRecordBytes);
  if (is_scene) return scene(text);
  if (!is_record) return lines(text, extension == ".log");
  std::string shown = record(text);
  return path.filename() == "cell.json" ? cell(std::move(shown), path.parent_path()) : shown;
}

}  // namespace lobelia::gallery
