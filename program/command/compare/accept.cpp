// lobelia accept --undo [B]
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>

#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "compare/accept/replacement.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/compare/compare_options.hpp"
#include "program/command/compare/replaced_references.hpp"
#include "program/command/options.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

struct AcceptArguments {
  std::string references;
  bool undo = false;
};

/// Those of `given`, or else of the project in this directory, or else this directory.
std::set<fs::path> places_to_undo(const std::string& given) {
  PairingChoice choice;
  if (!given.empty()) {
    std::error_code unknown;
    if (!fs::exists(given, unknown) && !is_sequence(given))
      throw Error(ExitCode::kInput, "{}: no such file or folder", printable_path(given));
    choice.given = {given};
    return places_of_references(choice);
  }
  CompareChoice chosen;
  chosen.project = usual_project();
  if (CompareJob unused; !chosen.project.empty()) apply_project(chosen, unused);
  choice = pictures_of(chosen);
  if (!choice.csv.empty()) return places_of_references(pair_pictures(choice));
  std::set<fs::path> places = places_of_references(choice);
  if (places.empty()) places.insert(".");
  return places;
}

/// The folder with the newest acceptance that has to do with one of the places.
std::optional<fs::path> newest_replaced(const std::set<fs::path>& places) {
  std::optional<fs::path> newest;
  fs::file_time_type began;
  for (const fs::path& folder : replaced_above(places)) {
    const auto last = last_replacement(folder);
    const auto is_near = [&](const fs::path& file) {
      return std::ranges::any_of(places, [&](const fs::path& place) {
        std::error_code unknown;
        const fs::path real = fs::canonical(place.empty() ? fs::path(".") : place, unknown);
        return !unknown && is_below(file, real);
      });
    };
    if (!last || (newest && last->began <= began) || std::ranges::none_of(last->files, is_near))
      continue;
    newest = folder;
    began = last->began;
  }
  return newest;
}

/// A folder below one of the places with an acceptance to undo, as a hint. Does not search long.
std::optional<fs::path> replaced_below(const std::set<fs::path>& places) {
  constexpr int kMostEntries = 100'000;
  int entries = 0;
  for (const fs::path& place : places) {
    std::error_code unknown;
    fs::recursive_directory_iterator entry(place.empty() ? fs::path(".") : place,
                                           fs::directory_options::skip_permission_denied, unknown);
    for (const fs::recursive_directory_iterator end;
         !unknown && entry != end && ++entries <= kMostEntries; entry.increment(unknown)) {
      if (entry->path().filename() != kReplacedName) continue;
      entry.disable_recursion_pending();
      try {
        if (fs::path folder = entry->path().parent_path(); last_replacement(folder)) return folder;
      } catch (const Error&) {  // it is damaged or somebody else's: no hint
      }
    }
  }
  return std::nullopt;
}

void undo(const std::string& given) {
  const std::set<fs::path> places = places_to_undo(given);
  const std::optional<fs::path> folder = newest_replaced(places);
  if (!folder) {
    const auto below = replaced_below(places);
    throw Error(ExitCode::kInput, "{}: no acceptance to undo in this folder, nor above it{}",
                printable_path(places.begin()->empty() ? "." : places.begin()->string()),
                below ? "; there is one in " + printable_path(below->string()) : "");
  }
  const ReplacementOutcome done = undo_replacement(known_path(*folder, places));
  if (!verbosity().quiet)
    for (const fs::path& file : done.files) fmt::print("{}\n", printable_path(file.string()));
  say_problems(done);
  fmt::print("{} put back\n", done.files.size());
}

}  // namespace

void add_accept(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand(
      "accept", "Put back the references that the last compare --accept replaced");
  auto options = std::make_shared<AcceptArguments>();
  OptionGroup group(*command);
  group
      .add("B", options->references, "",
           "The references, as lobelia compare has them; default: those of lobelia.toml, or else "
           "this folder")
      ->check(not_empty());
  group.add_flag("--undo", options->undo, "Put them back, all or none. Has to be given");
  command->footer(
      "lobelia compare --accept replaces references. It keeps the old ones until the next acceptance, in\n"
      "the folder .lobelia-accepted beside them. References that were new are taken away again. If one was\n"
      "changed since, it is named, and none is put back.\n"
      "\n"
      "Example: lobelia accept --undo references/\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 3 nothing to undo, or a reference was changed since, 4 a reference\n"
      "cannot be written.");
  command->callback([options] {
    if (!options->undo) throw CLI::RequiredError("--undo");
    undo(options->references);
  });
}

}  // namespace lobelia::cli
