#include "compare/set/pairing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <utility>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "compare/set/csv_table.hpp"
#include "compare/set/folder_walk.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

/// Rows by name while they are gathered.
class Rows {
 public:
  explicit Rows(std::size_t sets) : sets_(sets) {}

  /// Throws Error(kInput) if the place is taken.
  void put(const std::string& name, std::size_t set, const std::string& file,
           const std::vector<std::string>& fields = {}) {
    PictureRow& row = rows_[name];
    row.name = name;
    row.fields = fields;
    row.files.resize(sets_);
    if (!row.files[set].empty())
      throw Error(ExitCode::kInput, "{} and {}: both are the picture of {}", row.files[set], file,
                  printable(name));
    row.files[set] = file;
  }
  std::vector<PictureRow> sorted() && {
    std::vector<PictureRow> list;
    for (auto& [name, row] : rows_) list.push_back(std::move(row));
    return list;
  }

 private:
  std::size_t sets_;
  std::map<std::string, PictureRow> rows_;
};

std::string last_name(const std::string& path) {
  const fs::path clean = fs::path(path).lexically_normal();
  return (clean.has_filename() ? clean : clean.parent_path()).filename().string();
}

/// The last names of the paths, or the paths themselves where two are the same.
std::vector<std::string> titles_of(const std::vector<std::string>& paths) {
  std::vector<std::string> titles;
  for (const std::string& path : paths) titles.push_back(last_name(path));
  if (std::set(titles.begin(), titles.end()).size() < titles.size()) titles = paths;
  std::set<std::string> taken;
  for (std::string& title : titles)
    for (int i = 2; !taken.insert(title).second; ++i) title = fmt::format("{} ({})", title, i);
  return titles;
}

std::string file_in(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

std::string without_ending(const std::string& name) {
  return fs::path(name).replace_extension().generic_string();
}

/// Moves each picture that stands alone to the row of the only reference with its name but for the ending.
void pair_across_endings(std::vector<PictureRow>& rows) {
  const std::size_t sets = rows.empty() ? 0 : rows.front().files.size();
  for (std::size_t set = 0; set < sets; ++set) {
    if (set == kReferenceSet) continue;
    std::map<std::string, std::vector<PictureRow*>> alone, lacking;  // by name without ending
    for (PictureRow& row : rows) {
      const bool has = !row.files[set].empty(), has_reference = !row.files[kReferenceSet].empty();
      if (has != has_reference) (has ? alone : lacking)[without_ending(row.name)].push_back(&row);
    }
    for (const auto& [name, from] : alone)
      if (const auto to = lacking.find(name);
          from.size() == 1 && to != lacking.end() && to->second.size() == 1)
        std::swap(from.front()->files[set], to->second.front()->files[set]);
  }
  std::erase_if(rows, [](const PictureRow& row) {
    return std::ranges::all_of(row.files, &std::string::empty);
  });
}

/// Walks each different folder once.
std::map<std::string, FolderWalk> walk_all(const PairingChoice& choice, Pairing& pairing) {
  std::map<std::string, FolderWalk> walks;
  for (const std::string& folder : choice.given) {
    const auto [at, is_new] = walks.try_emplace(folder, folder, choice.most_files);
    if (!is_new) continue;
    for (const std::string& ending : choice.companions)
      std::erase_if(at->second.pictures,
                    [&](const std::string& name) { return name.ends_with(ending); });
    pairing.passed_over += at->second.passed_over;
    pairing.not_followed.insert(pairing.not_followed.end(), at->second.not_followed.begin(),
                                at->second.not_followed.end());
  }
  return walks;
}

Pairing pair_folders(const PairingChoice& choice) {
  Pairing pairing{titles_of(choice.given), {}, {}, 0, {}};
  pairing.is_by_name = true;
  const auto walks = walk_all(choice, pairing);
  Rows rows(choice.given.size());
  for (std::size_t set = 0; set < choice.given.size(); ++set)
    for (const std::string& name : walks.at(choice.given[set]).pictures)
      rows.put(name, set, file_in(choice.given[set], name));
  pairing.rows = std::move(rows).sorted();
  pair_across_endings(pairing.rows);
  return pairing;
}

/// The field that tells the sets apart, and its value in each.
struct SetField {
  std::string name;
  std::vector<std::string> values;
};

SetField parse_sets(const std::string& text) {
  const std::size_t equals = text.find('=');
  SetField field;
  if (equals != std::string::npos)
    field = {text.substr(0, equals), split(std::string_view(text).substr(equals + 1), ",")};
  if (field.name.empty() || field.values.size() < 2 ||
      std::set(field.values.begin(), field.values.end()).size() < field.values.size())
    throw Error(ExitCode::kUsage,
                "--sets {}: expected FIELD=JUDGED,REFERENCE and perhaps more values, "
                "each once, for example engine=mine,reference",
                printable(text));
  return field;
}

/// "{scene}_{engine}.exr": text and fields.
class NamePattern {
 public:
  NamePattern(const std::string& pattern, const SetField& sets) {
    constexpr std::size_t kMostFields = 16;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      if (pattern[i] != '{') {
        if (pattern[i] == '}') fail(pattern, "a '}' without its '{'");
        if (pieces_.empty() || pieces_.back().is_field) pieces_.emplace_back();
        pieces_.back().texts.front() += pattern[i];
        continue;
      }
      const std::size_t end = pattern.find('}', i);
      if (end == std::string::npos) fail(pattern, "a '{' without its '}'");
      const std::string field = pattern.substr(i + 1, end - i - 1);
      if (!field.empty() && std::ranges::count(fields, field) > 0)
        fail(pattern, "a field that stands there twice");
      const bool tells_sets = field == sets.name && !field.empty();
      pieces_.push_back({true, tells_sets ? sets.values : std::vector<std::string>{}});
      fields.push_back(field);
      i = end;
    }
    if (fields.empty()) fail(pattern, "no {field}");
    if (fields.size() > kMostFields) fail(pattern, "over 16 fields");
    if (!sets.name.empty() && std::ranges::count(fields, sets.name) == 0)
      throw Error(ExitCode::kUsage, "--sets: --pattern {} has no field {{{}}}", printable(pattern),
                  printable(sets.name));
  }

  std::vector<std::string> fields;  ///< in their order; "" tells nothing apart

  /// The values of the fields, the first as long as it can be; empty if the name does not fit.
  std::vector<std::string> values_in(const std::string& name) const {
    std::vector<std::string> values;
    // Where a piece was tried in vain: without it, some names take a time that grows exponentially.
    std::vector<bool> in_vain(pieces_.size() * (name.size() + 1));
    if (!fits(name, 0, 0, values, in_vain)) values.clear();
    return values;
  }

 private:
  struct Piece {
    bool is_field = false;
    std::vector<std::string> texts{""};  ///< what it may be; of a field, none: any text without '/'
  };

  [[noreturn]] static void fail(const std::string& pattern, std::string_view what) {
    throw Error(ExitCode::kUsage,
                "--pattern {}: {}; expected a name with fields, "
                "for example {{scene}}_{{engine}}.exr",
                printable(pattern), what);
  }
  bool fits(const std::string& name, std::size_t at, std::size_t piece,
            std::vector<std::string>& values, std::vector<bool>& in_vain) const {
    if (piece == pieces_.size()) return at == name.size();
    const std::size_t state = piece * (name.size() + 1) + at;
    if (in_vain[state]) return false;
    const auto goes_on = [&](std::size_t length) {
      if (pieces_[piece].is_field) values.push_back(name.substr(at, length));
      if (fits(name, at + length, piece + 1, values, in_vain)) return true;
      if (pieces_[piece].is_field) values.pop_back();
      return false;
    };
    for (const std::string& text : pieces_[piece].texts)
      if (name.compare(at, text.size(), text) == 0 && goes_on(text.size())) return true;
    if (pieces_[piece].texts.empty())
      for (std::size_t n = std::min(name.find('/', at), name.size()) - at; n > 0; --n)
        if (goes_on(n)) return true;
    in_vain[state] = true;
    return false;
  }
  std::vector<Piece> pieces_;
};

Pairing pair_by_pattern(const PairingChoice& choice) {
  const SetField sets = choice.sets.empty() ? SetField{} : parse_sets(choice.sets);
  const NamePattern pattern(choice.pattern, sets);
  const bool one_folder = choice.given.size() == 1;
  if (one_folder && sets.name.empty())
    throw Error(ExitCode::kUsage,
                "--pattern with one folder needs --sets: which field tells the sets apart, and "
                "its values, for example --sets engine=mine,reference");
  if (!one_folder && !sets.name.empty() && sets.values.size() != choice.given.size())
    throw Error(ExitCode::kUsage, "--sets names {} sets, and there are {} folders",
                sets.values.size(), choice.given.size());
  Pairing pairing;
  pairing.sets = one_folder ? sets.values : titles_of(choice.given);
  for (const std::string& field : pattern.fields)
    if (!field.empty() && field != sets.name) pairing.fields.push_back(field);
  const auto walks = walk_all(choice, pairing);
  Rows rows(pairing.sets.size());
  const auto place = [&](const std::string& name, std::size_t only_set, const std::string& file) {
    const std::vector<std::string> values = pattern.values_in(name);
    if (values.empty()) return false;
    std::size_t set = only_set;
    std::vector<std::string> own;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string& field = pattern.fields[i];
      if (field.empty()) continue;
      if (field != sets.name) {
        own.push_back(values[i]);
        continue;
      }
      const auto at = std::size_t(std::ranges::find(sets.values, values[i]) - sets.values.begin());
      if (!one_folder && at != only_set) return false;
      set = at;
    }
    rows.put(own.empty() ? values.front() : fmt::format("{}", fmt::join(own, "/")), set, file, own);
    return true;
  };
  for (std::size_t set = 0; set < choice.given.size(); ++set)
    for (const std::string& name : walks.at(choice.given[set]).pictures)
      if (!place(name, set, file_in(choice.given[set], name))) ++pairing.passed_over;
  pairing.rows = std::move(rows).sorted();
  return pairing;
}

/// The text before and after a sequence's number, and the least number of its digits.
struct Sequence {
  std::string before, after;
  std::size_t digits = 0;
};

std::optional<Sequence> sequence_in(const std::string& path) {
  static const std::regex kNumber("%(0([1-9]))?d|#+");
  const std::string name = fs::path(path).filename().string();
  std::smatch match;
  constexpr std::size_t kLongest = 255;
  if (name.size() > kLongest || !std::regex_search(name, match, kNumber)) return std::nullopt;
  const std::string after = match.suffix();
  if (std::regex_search(after, kNumber)) return std::nullopt;
  const bool is_hashes = match[0].str().front() == '#';
  return Sequence{match.prefix(), after,
                  is_hashes          ? std::size_t(match.length(0))
                  : match[2].matched ? std::size_t(match[2].str().front() - '0')
                                     : 1};
}

/// The frame's number without leading zeros; empty if the file is none of the sequence's.
std::string frame_of(const std::string& name, const Sequence& sequence) {
  const std::size_t around = sequence.before.size() + sequence.after.size();
  if (name.size() < around + sequence.digits || !name.starts_with(sequence.before) ||
      !name.ends_with(sequence.after))
    return "";
  std::string digits = name.substr(sequence.before.size(), name.size() - around);
  const bool is_padded = digits.size() > sequence.digits && digits.front() == '0';
  if (is_padded || digits.find_first_not_of("0123456789") != std::string::npos) return "";
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
  return digits;
}

/// Whether the name is a frame's but for how its number is written ("f.01.exr" of f.%d.exr, "f.-001.exr", a frame in between
/// as "f.0001.5.exr"), or for upper and lower case.
bool is_nearly_frame(const std::string& name, const Sequence& sequence) {
  const std::size_t before = sequence.before.size(), after = sequence.after.size();
  if (name.size() <= before + after ||
      lower_case(name.substr(0, before)) != lower_case(sequence.before) ||
      lower_case(name.substr(name.size() - after)) != lower_case(sequence.after))
    return false;
  std::string number = name.substr(before, name.size() - before - after);
  if (number.front() == '-' || number.front() == '+') number.erase(0, 1);
  // "f.2.0001.exr" is no frame of f.%04d.exr, but of another sequence: its 2 has too few digits.
  if (const std::size_t point = number.find('.');
      point != std::string::npos && point + 1 < number.size() &&
      !frame_of(sequence.before + number.substr(0, point) + sequence.after, sequence).empty())
    number.erase(point, 1);
  return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
}

Pairing pair_sequences(const PairingChoice& choice) {
  Pairing pairing{titles_of(choice.given), {"frame"}, {}, 0, {}};
  std::set<fs::path> misnamed, taken;
  struct Frame {
    std::string number;
    std::size_t set;
    std::string file;
  };
  std::vector<Frame> frames;
  std::size_t longest = 1;
  for (std::size_t set = 0; set < choice.given.size(); ++set) {
    const fs::path path = choice.given[set];
    const Sequence sequence = *sequence_in(choice.given[set]);
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::error_code error;
    std::size_t files = 0;
    fs::path nearly;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      if (++files > choice.most_files)
        throw Error(ExitCode::kInput, "{}: holds over {} files", folder.string(),
                    choice.most_files);
      const std::string name = entry->path().filename().string();
      const fs::path file = path.parent_path() / name;
      const std::string number = frame_of(name, sequence);
      if (number.empty()) {
        if (!is_nearly_frame(name, sequence)) continue;
        nearly = file.lexically_normal();
        misnamed.insert(nearly);
        continue;
      }
      longest = std::max(longest, number.size());
      frames.push_back({number, set, file.string()});
      taken.insert(file.lexically_normal());
    }
    if (error)
      throw Error(ExitCode::kInput, "{}: cannot be read: {}", folder.string(), error.message());
    if (std::ranges::none_of(frames, [&](const Frame& frame) { return frame.set == set; }))
      throw Error(
          ExitCode::kInput,

          "{}: no file is a frame of this sequence{}", printable_path(choice.given[set]),
          nearly.empty() ? "" : fmt::format("; {} nearly is one", printable_path(nearly.string())));
  }
  for (const fs::path& file : misnamed)  // in a folder of both sequences it may be the other's
    if (!taken.contains(file)) pairing.misnamed.push_back(file.string());
  // With leading zeros, so that names sort as numbers.
  constexpr std::size_t kUsualDigits = 4;
  longest = std::max(longest, kUsualDigits);
  Rows rows(choice.given.size());
  for (const Frame& frame : frames) {
    const std::string name = std::string(longest - frame.number.size(), '0') + frame.number;
    rows.put(name, frame.set, frame.file, {name});
  }
  pairing.rows = std::move(rows).sorted();
  return pairing;
}

Pairing pair_by_csv(const PairingChoice& choice) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 28;
  constexpr std::size_t kMostSets = 64;
  const auto records = csv_records(choice.csv, read_file(choice.csv, kMostBytes));
  const auto fail = [&](std::string_view why) {
    throw Error(ExitCode::kInput, "{}: {}", printable_path(choice.csv), why);
  };
  if (records.empty()) fail("is empty; its first line has the titles of the sets");
  std::vector<std::string> header = records.front();
  const auto name_at = std::size_t(std::ranges::find(header, "name") - header.begin());
  Pairing pairing;
  for (std::size_t i = 0; i < header.size(); ++i)
    if (i != name_at) pairing.sets.push_back(printable(header[i]));
  if (pairing.sets.size() < 2 || pairing.sets.size() > kMostSets)
    fail("its first line must have the titles of two sets or more, the reference second");
  if (std::set(pairing.sets.begin(), pairing.sets.end()).size() < pairing.sets.size())
    fail("two sets have one title");
  if (records.size() > choice.most_files) fail("has too many lines");
  const fs::path folder = fs::path(choice.csv).parent_path();
  Rows rows(pairing.sets.size());
  for (std::size_t line = 1; line < records.size(); ++line) {
    if (records[line].size() != header.size())
      fail(fmt::format("record {} has {} fields, the first {}", line + 1, records[line].size(),
                       header.size()));
    std::vector<std::string> files;
    for (std::size_t i = 0; i < header.size(); ++i)
      if (i != name_at) files.push_back(records[line][i]);
    for (const std::string& field : records[line])
      if (field.find('\0') != std::string::npos) fail(fmt::format("record {} has a NUL", line + 1));
    const auto some = std::ranges::find_if_not(files, &std::string::empty);
    if (some == files.end()) fail(fmt::format("record {} names no file", line + 1));
    const std::string& reference = files[kReferenceSet];
    const std::string name = name_at < header.size() && !records[line][name_at].empty()
                                 ? records[line][name_at]
                             : reference.empty() ? *some
                                                 : reference;
    for (std::size_t set = 0; set < files.size(); ++set)
      if (!files[set].empty()) rows.put(name, set, (folder / files[set]).string());
  }
  pairing.rows = std::move(rows).sorted();
  return pairing;
}

bool is_folder(const std::string& path) {
  std::error_code unknown;
  return fs::is_directory(path, unknown);
}

/// Whether all are such, or none. Throws Error(kInput) for a mixture.
bool all_are(const std::vector<std::string>& given, bool (*is_such)(const std::string&),
             std::string_view such) {
  const bool first = is_such(given.front());
  for (const std::string& path : given)
    if (std::error_code unknown;
        is_such(path) != first && !fs::exists(path, unknown) && !is_sequence(path))
      throw Error(ExitCode::kInput, "{}: no such file or folder", printable_path(path));
    else if (is_such(path) != first)
      throw Error(ExitCode::kInput,
                  "{} is {}a {}, but {} is{}; compare files with files, folders with "
                  "folders and sequences with sequences",
                  printable_path(given.front()), first ? "" : "not ", such, printable_path(path),
                  first ? " not" : "");
  return first;
}

}  // namespace

bool Pairing::is_reference(std::size_t set) const {
  return set == kReferenceSet || set + also_accepted >= sets.size();
}

std::vector<std::string> Pairing::references_of(const PictureRow& row) const {
  std::vector<std::string> files;
  for (std::size_t set = 0; set < sets.size(); ++set)
    if (is_reference(set) && !row.files[set].empty()) files.push_back(row.files[set]);
  return files;
}

bool is_sequence(const std::string& path) {
  std::error_code unknown;
  return !fs::exists(path, unknown) && sequence_in(path).has_value();
}

Pairing pair_pictures(PairingChoice choice) {
  if (!choice.also_accepted.empty()) {
    if (choice.given.size() < 2)
      throw Error(ExitCode::kUsage,
                  "a further reference needs A and B: files, folders or sequences");
    choice.given.insert(choice.given.end(), choice.also_accepted.begin(),
                        choice.also_accepted.end());
    const std::size_t further = std::exchange(choice.also_accepted, {}).size();
    Pairing pairing = pair_pictures(std::move(choice));
    pairing.also_accepted = further;
    return pairing;
  }
  if (!choice.sets.empty() && choice.pattern.empty())
    throw Error(ExitCode::kUsage, "--sets needs --pattern, which has the field");
  if (!choice.csv.empty()) {
    if (!choice.given.empty() || !choice.pattern.empty())
      throw Error(ExitCode::kUsage, "--pairs names all pictures: leave out A, B and --pattern");
    return pair_by_csv(choice);
  }
  const bool folders = all_are(choice.given, is_folder, "folder");
  if (!choice.pattern.empty()) {
    if (!folders)
      throw Error(ExitCode::kInput, "{} is no folder, which --pattern needs",
                  printable_path(choice.given.front()));
    return pair_by_pattern(choice);
  }
  if (choice.given.size() < 2)
    throw Error(ExitCode::kUsage, "B is required: the reference picture");
  if (folders) return pair_folders(choice);
  if (all_are(choice.given, is_sequence, "sequence")) return pair_sequences(choice);
  Pairing pairing{titles_of(choice.given), {}, {}, 0, {}};
  pairing.rows.push_back({fs::path(choice.given.front()).filename().string(), choice.given});
  pairing.is_one_row = true;
  return pairing;
}

}  // namespace lobelia
