#include "base/records/project.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <tuple>

#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kMissingReference[] = {"notice", "fail"};

/// "2026-02-30" is no day.
bool is_day(const std::string& text) {
  int year = 0, month = 0, day = 0;
  std::sscanf(text.c_str(), "%4d-%2d-%2d", &year, &month, &day);
  return text == fmt::format("{:04}-{:02}-{:02}", year, month, day) &&
         std::chrono::year_month_day(std::chrono::year(year), std::chrono::month(unsigned(month)),
                                     std::chrono::day(unsigned(day)))
             .ok();
}

std::string contradiction_of_known(const KnownDifference& known) {
  return is_day(known.expires) ? "" : "expires: expected a day, such as 2027-01-31";
}

std::string contradiction_of_project(const Project& project) {
  const bool has_folders = !project.judged.empty() || !project.references.empty();
  if (!project.pairs.empty() && has_folders)
    return "pairs names all pictures: leave out judged and references";
  return "";
}

/// Dates and times are the text that stands in the file.
Json json_of(const toml::node& node) {
  if (const toml::table* table = node.as_table()) {
    Json object = Json::object();
    for (const auto& [key, value] : *table) object[std::string(key.str())] = json_of(value);
    return object;
  }
  if (const toml::array* array = node.as_array()) {
    Json list = Json::array();
    for (const toml::node& value : *array) list.push_back(json_of(value));
    return list;
  }
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto number = node.value_exact<std::int64_t>()) return *number;
  if (const auto number = node.value_exact<double>()) return *number;
  if (const auto truth = node.value_exact<bool>()) return *truth;
  std::ostringstream out;
  if (const auto* date = node.as_date()) out << *date;
  if (const auto* time = node.as_time()) out << *time;
  if (const auto* both = node.as_date_time()) out << *both;
  return out.str();
}

/// Throws if a key has more parts than any in a project: toml++ 3.3 nests a table for each, without a bound, and
/// recurses into them.
void require_short_keys(const std::string& text, const std::string& where) {
  constexpr int kMostParts = 32;
  int parts = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const std::string three(3, c),
          quote = text.compare(i, 3, three) == 0 ? three : three.substr(2);
      for (i += quote.size(); i < text.size() && text.compare(i, quote.size(), quote) != 0; ++i)
        if (c == '"' && text[i] == '\\') ++i;
      i += quote.size() - 1;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      parts = 0;
    } else if (c == '.' && ++parts == kMostParts) {
      throw Error(ExitCode::kInput, "{}: a key has over {} parts", printable_path(where),
                  kMostParts);
    } else if (std::string_view("\n=,{[").find(c) != std::string_view::npos) {
      parts = 0;
    }
  }
}

Json parse_toml(const std::string& text, const std::string& where) {
  require_short_keys(text, where);
  try {
    return json_of(toml::parse(text, where));
  } catch (const toml::parse_error& error) {
    throw Error(ExitCode::kInput, "{}: line {}, column {}: {}", printable_path(where),
                error.source().begin.line, error.source().begin.column,
                printable(error.description()));
  }
}

/// Refuses what JSON allows and nobody means: a key that stands twice, of which the last would count, and a NUL, where
/// a path would end.
void require_clear_json(const std::string& text, const std::string& where) {
  const auto refuse = [&](std::string_view why) {
    throw Error(ExitCode::kInput, "{}: {}", printable_path(where), why);
  };
  std::vector<std::set<std::string>> keys;  // of the objects around
  using Event = Json::parse_event_t;
  const auto look = [&](int, Event event, Json& json) {
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end) keys.pop_back();
    const auto* text_there = json.get_ptr<const std::string*>();
    if (event == Event::key && !keys.back().insert(*text_there).second)
      refuse(fmt::format("the key {} stands twice", printable(*text_there)));
    if (event == Event::value && text_there && text_there->find('\0') != std::string::npos)
      refuse("a text has a NUL");
    return true;
  };
  std::ignore = Json::parse(text, look, false);
}

}  // namespace

Project read_project(const std::filesystem::path& path) {
  constexpr std::uint64_t kMostBytes = 4 << 20;
  const std::string text = read_file(path, kMostBytes);
  const std::string json =
      path.extension() == ".json" ? text : parse_toml(text, path.string()).dump();
  require_clear_json(json, path.string());
  return parse_record<Project>(json, path.string());
}

void define_project_tables(Tables& tables) {
  tables.define<ProjectRule>("How some of the pairs are judged.", [](auto& t) {
    t.by_hand();
    t.all().if_any();
    t.key("match", "names of pairs; * fits any text, ? any character").not_empty().always();
    t.key("fail", "as --fail; on the same metric in place of the project's");
    t.key("warn", "as --warn");
    t.key("mask", "as --mask, in place of the project's");
    t.key("ignore", "as --ignore, besides the project's");
    t.key("tolerance", "as --tolerance");
    t.key("defaultLimits", "false: without the default limits");
  });
  tables.define<KnownDifference>("A difference that is no failure until it expires.", [](auto& t) {
    t.by_hand();
    t.key("match", "names of pairs; * fits any text, ? any character").not_empty();
    t.key("reason", "for the report").not_empty();
    t.key("expires", "the last day on which it counts, in UTC: 2027-01-31");
    t.check(contradiction_of_known);
  });
  tables.define<Project>(
      "Sets of pictures and how to judge them: 'lobelia compare --project'.", [](auto& t) {
        t.kind("project");
        t.by_hand();
        t.all().if_any();
        t.key("title", "of the report");
        t.key("judged", "files, folders or sequences, from where the file lies");
        t.key("references", "likewise; the picture is judged by the one that it fits best");
        t.key("pairs", "as --pairs, in place of judged and references");
        t.key("pattern", "as --pattern");
        t.key("sets", "as --sets");
        t.key("fail", "as --fail: \"rmse=0.001\"");
        t.key("warn", "as --warn");
        t.key("mask", "as --mask");
        t.key("ignore", "as --ignore");
        t.key("tolerance", "as --tolerance");
        t.key("defaultLimits", "false: as --no-default-limits");
        t.key("exposure", "as --exposure");
        t.key("layer", "as --layer");
        t.key("layerTypes", "as --layer-type: \"N=vector\"");
        t.key("scene", "as --scene");
        t.key("ignoreAlpha", "as --ignore-alpha");
        t.key("judgedVariance", "as --a-variance: \"*_variance.exr\" is beside each picture");
        t.key("referenceVariance", "as --b-variance, likewise");
        t.key("judgedSamples", "as --a-samples").at_least(1);
        t.key("referenceSamples", "as --b-samples").at_least(1);
        t.key("missingReference", "as --missing-reference").one_of(kMissingReference);
        t.key("rules", "the last that fits a pair counts most");
        t.check(contradiction_of_project);
      });
}

}  // namespace lobelia::records
