#include "gallery/scrub.hpp"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <set>

#include "core/error.hpp"
#include "core/host.hpp"
#include "core/sha256.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

/// Texts for people and for shells. Elsewhere a word that is also a host's name means something else.
constexpr std::string_view kFreeTexts[] = {"message",  "why",     "because", "remarks",
                                           "warnings", "warning", "command", "engineCommands",
                                           "stopped",  "reason",  "method"};
/// Texts that are nothing but a path if they begin with '/', also with spaces in it.
constexpr std::string_view kPaths[] = {"cache", "program", "path", "grid",
                                       "scene", "file",    "a",    "b"};
constexpr std::string_view kTextFiles[] = {".json", ".log",  ".csv",  ".svg", ".xml", ".glsl",
                                           ".hlsl", ".wgsl", ".osl",  ".txt", ".md",  ".h",
                                           ".html", ".js",   ".text", ".tex"};
/// Words of logs that a user may be called, too.
constexpr std::string_view kCommonWords[] = {"root", "lobelia", "user", ""};

template <class List>
bool contains(const List& list, std::string_view text) {
  return std::ranges::find(list, text) != std::end(list);
}

bool in_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || (c & 0x80) != 0;
}

bool is_gap(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Not a word of a language, which a text may have for other reasons.
bool is_telling(std::string_view name) {
  return !std::ranges::all_of(name, [](char c) { return c >= 'a' && c <= 'z'; });
}

/// What may stand before a path.
bool opens_path(std::string_view before) {
  if (before.empty()) return true;
  // Quotes, dots, dashes and arrows (U+2000 to U+2FFF), and a space that does not break.
  const std::string_view last3 =
      before.substr(before.size() - std::min<std::size_t>(3, before.size()));
  if (last3.starts_with('\xE2') || before.ends_with("\u00A0") || before.ends_with("«")) return true;
  if (before.ends_with("\\n") || before.ends_with("\\t")) return true;  // in an escaped text
  if (std::string_view(" \t\r\n'\"`=([{<>,;:|@&!\\]?#*%+").find(before.back()) != before.npos)
    return true;
  // An option, as in -I/usr/include and POV-Ray's +I/usr.
  constexpr std::size_t kLongestOption = 20;
  std::size_t at = before.size();
  while (at > 0 && before.size() - at < kLongestOption &&
         std::isalpha(static_cast<unsigned char>(before[at - 1])))
    --at;
  if (at > 0 && (before[at - 1] == '-' || before[at - 1] == '+'))
    return at == 1 || is_gap(before[at - 2]);
  // A colour of a terminal.
  const std::size_t code = before.find_last_not_of("0123456789;", before.size() - 2);
  return before.ends_with('m') && code != before.npos && before[code] == '[';
}

/// Whether a path after this character is only the end of a longer one. Known directories are not looked for there.
bool goes_on(char before) {
  return in_name(before) || before == '.' || before == '~' || before == '-';
}

bool begins_name(char c) { return in_name(c) || c == '.' || c == '~' || c == '@' || c == '$'; }

constexpr std::string_view kEnds = " \t\r\n'\"`=(),:;<>|[]{}", kEndsOfUrl = " \t\r\n'\"`<>";

std::size_t end_of_path(std::string_view text, std::size_t begin, std::size_t known) {
  const char before = begin > 0 ? text[begin - 1] : '\0';
  if (before == '"' || before == '\'' || before == '`') {
    const std::size_t end = text.find_first_of(std::string{before, '\n'}, begin);
    if (end != text.npos && text[end] == before) return end;
  }
  std::size_t end = std::min(text.find_first_of(kEnds, begin + known), text.size());
  while (end > begin + known && (text[end - 1] == '.' || text[end - 1] == ':')) --end;
  return end;
}

std::string_view last_part(std::string_view path) {
  while (path.size() > 1 && path.ends_with('/')) path.remove_suffix(1);
  return path.substr(path.rfind('/') + 1);
}

void replace_words(std::string& text, std::string_view word, std::string_view with) {
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at)) {
    const std::size_t end = at + word.size();
    if ((at > 0 && in_name(text[at - 1])) || (end < text.size() && in_name(text[end]))) {
      at = end;
      continue;
    }
    text.replace(at, word.size(), with);
    at += with.size();
  }
}

/// "pid 123", "process 123", "pid=123" and "povray[123]:" without the number.
void remove_process_ids(std::string& text) {
  static const std::regex kNamed(R"(\b(p?pids?|process)[ :=#]+[0-9]+(?![.0-9]| of ))",
                                 std::regex::icase);
  static const std::regex kOfLog(R"(\b([A-Za-z][-A-Za-z0-9_]*)\[[0-9]+\]:)");
  text = std::regex_replace(std::regex_replace(text, kNamed, "$1"), kOfLog, "$1:");
}

/// Whether it is a person's own directory, whose last part is the person's name.
bool is_home(const fs::path& path) {
  const fs::path above = path.parent_path();
  return above.parent_path() == "/" && (above.filename() == "home" || above.filename() == "Users");
}

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

Scrub::Scrub(const std::vector<fs::path>& directories, const std::vector<std::string>& hosts,
             const std::vector<std::string>& users)
    : hosts_(hosts), users_(users) {
  std::set<std::string> known;
  const auto add = [&](const fs::path& directory) {
    if (directory.empty()) return;
    std::error_code error;
    for (fs::path path : {fs::absolute(directory, error).lexically_normal(),
                          fs::weakly_canonical(directory, error)})
      for (; path.is_absolute() && path.has_relative_path(); path = path.parent_path())
        if (path.has_filename()) known.insert(path.string());
  };
  for (const fs::path& directory : directories) add(directory);
  std::error_code error;
  add(fs::current_path(error));
  for (const char* variable : {"HOME", "TMPDIR"})
    if (const std::string path = environment(variable); path.starts_with('/')) add(path);
  hosts_.push_back(host_name());
  if (const passwd* user = ::getpwuid(::geteuid())) {
    users_.emplace_back(user->pw_name);
    if (user->pw_dir && user->pw_dir[0] == '/') {
      add(user->pw_dir);
      homes_.emplace_back(user->pw_dir);
    }
  }
  for (const char* variable : {"USER", "LOGNAME"}) users_.push_back(environment(variable));
  directories_.assign(known.begin(), known.end());
  std::ranges::sort(directories_, std::greater(), &std::string::size);
  for (std::size_t i = hosts_.size(); i-- > 0;)  // "node7.example.org" is node7, too
    if (const auto dot = hosts_[i].find('.'); dot != std::string::npos)
      hosts_.push_back(hosts_[i].substr(0, dot));
  std::erase_if(hosts_,
                [](const std::string& name) { return name.empty() || name == "localhost"; });
  std::erase_if(users_, [](const std::string& name) { return contains(kCommonWords, name); });
  std::ranges::sort(hosts_, std::greater(), &std::string::size);
}

void Scrub::keep_apart(const std::vector<records::Axis>& axes) {
  const auto shown = [&](const std::string& value) {
    return value.starts_with('/') ? std::string(last_part(value)) : without_paths(value);
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

std::size_t Scrub::known_directory(std::string_view text) const {
  for (const std::string& directory : directories_)
    if (text.starts_with(directory) &&
        (text.size() == directory.size() || text[directory.size()] == '/' ||
         kEnds.find(text[directory.size()]) != kEnds.npos))
      return directory.size();
  return 0;
}

std::string Scrub::without_paths(std::string_view text) const {
  if (text.find_first_of("/~") == text.npos) return std::string(text);
  std::string shown;
  for (std::size_t i = 0; i < text.size();) {
    const bool is_file_url = text.substr(i, 8) == "file:///";
    if (is_file_url) {
      i += 7;
      shown += "file:";
    }
    const std::string_view before = text.substr(0, i);
    if (text.substr(i, 2) == "//" && before.ends_with(':')) {
      const bool is_web = before.ends_with("http:") || before.ends_with("https:");
      const std::size_t end =
          std::min(text.find_first_of(is_web ? kEndsOfUrl : kEnds, i), text.size());
      // Others have a machine and somebody's name in them.
      shown += is_web ? text.substr(i, end - i) : last_part(text.substr(i, end - i));
      i = end;
      continue;
    }
    if (text[i] == '~' && i + 1 < text.size() &&
        (text[i + 1] == '/' || std::isalpha(static_cast<unsigned char>(text[i + 1]))) &&
        opens_path(before)) {  // somebody's directory
      const std::size_t end = end_of_path(text, i, 0);
      const std::string_view path = text.substr(i, end - i);
      shown += path.find('/') == path.npos ? path : last_part(path);
      i = end;
      continue;
    }
    const bool may_begin = text[i] == '/' && i + 1 < text.size();
    const bool is_apart = may_begin && (is_file_url || opens_path(before));
    const std::size_t known =
        may_begin && (is_apart || !goes_on(text[i - 1])) ? known_directory(text.substr(i)) : 0;
    const std::size_t name = text.find_first_not_of('/', i);  // after "/" or "//"
    if (!may_begin || (known == 0 && !(is_apart && name != text.npos && name <= i + 2 &&
                                       begins_name(text[name])))) {
      shown += text[i++];
      continue;
    }
    const std::size_t end = end_of_path(text, i, known);
    const std::string_view path = text.substr(i, end - i);
    // "/dev" tells nothing of a machine, and "</p>" and "/s" are no paths.
    if (known == 0 && path.find('/', 1) == path.npos)
      shown += path;
    else
      shown += is_home(path) || contains(homes_, path) ? "~" : last_part(path);
    i = end;
  }
  return shown;
}

std::string Scrub::without_names(std::string_view text, bool only_telling) const {
  std::string shown(text);
  for (const std::string& host : hosts_)
    if (!only_telling || is_telling(host)) replace_words(shown, host, "host");
  for (const std::string& user : users_)
    if (!only_telling || is_telling(user)) replace_words(shown, user, "user");
  return shown;
}

std::string Scrub::log(std::string_view text) const {
  std::string shown = without_names(without_paths(text), false);
  remove_process_ids(shown);
  return shown;
}

std::optional<std::string> Scrub::text_of_record(std::span<const std::string> keys,
                                                 const std::string& text) const {
  if (keys.empty()) return without_paths(text);
  const std::string& key = keys.back();
  if (key == records::kSealKey || key == "sha256") return text;
  if (key == "pid" || key == "user" ||
      (key == "name" && keys.size() > 1 && keys[keys.size() - 2] == "host"))
    return std::nullopt;
  if (const auto value = values_.find(text); value != values_.end()) return value->second;
  // An argument of a command may be a path with spaces; the whole of it begins with "lobelia".
  if (text.starts_with('/') && (contains(kPaths, key) || key == "command"))
    return std::string(last_part(text));
  std::string shown = without_paths(text);
  if (!contains(kFreeTexts, key)) return shown;
  const bool is_command = key.ends_with("ommand") || key.ends_with("ommands");
  shown = without_names(shown, is_command);
  if (!is_command) remove_process_ids(shown);
  return shown;
}

std::string Scrub::record(std::string_view text) const {
  const auto changed =
      records::with_texts(text, [&](std::span<const std::string> keys, const std::string& value) {
        return text_of_record(keys, value);
      });
  return changed ? *changed : log(text);
}

std::string Scrub::cell(std::string text, const fs::path& directory) const try {
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

std::optional<std::string> Scrub::file(const fs::path& path) const {
  const std::string extension = path.extension().string();
  if (!contains(kTextFiles, extension)) return std::nullopt;
  const std::string text = read_file(path, records::kMaxRecordBytes);
  if (extension == ".json") {
    std::string shown = record(text);
    return path.filename() == "cell.json" ? cell(std::move(shown), path.parent_path()) : shown;
  }
  return extension == ".log" ? log(text) : without_paths(text);
}

}  // namespace lobelia::gallery
