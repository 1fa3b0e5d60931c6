#include "program/command/compare/replaced_references.hpp"

#include <algorithm>

#include "base/system/standard_streams.hpp"
#include "base/words/text.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> given_references(const PairingChoice& choice) {
  std::vector<std::string> given = choice.also_accepted;
  // One folder can hold all sets.
  if (!choice.given.empty())
    given.push_back(choice.given[std::min(kReferenceSet, choice.given.size() - 1)]);
  return given;
}

/// Whether anything was left to finish.
bool finish_all(const std::set<fs::path>& places) {
  bool any = false;
  for (const fs::path& folder : replaced_above(places)) {
    const fs::path shown = known_path(folder, places);
    const ReplacementOutcome done = finish_replacement(shown);
    if (done.way == ReplacementOutcome::Way::kNothing) continue;
    any = true;
    say("lobelia: {}: an acceptance was interrupted; {} references are {}\n",
        printable_path(shown.string()), done.files.size(),
        done.way == ReplacementOutcome::Way::kReplaced ? "replaced now" : "what they were before");
    say_problems(done);
  }
  return any;
}

}  // namespace

std::vector<fs::path> folders_of_references(const PairingChoice& choice) {
  std::vector<fs::path> folders;
  for (const std::string& given : given_references(choice)) {
    std::error_code unknown;
    const fs::path real = fs::canonical(given, unknown);
    if (!unknown && fs::is_directory(real, unknown)) folders.push_back(real);
  }
  return folders;
}

std::set<fs::path> places_of_references(const PairingChoice& choice) {
  std::set<fs::path> places;
  for (const std::string& given : given_references(choice)) {
    std::error_code unknown;
    const fs::path path = given;
    places.insert(fs::is_directory(path, unknown) ? path : path.parent_path());
  }
  return places;
}

std::set<fs::path> places_of_references(const Pairing& pairing) {
  std::set<fs::path> places;
  for (const PictureRow& row : pairing.rows)
    for (const std::string& file : pairing.references_of(row))
      places.insert(fs::path(file).parent_path());
  return places;
}

std::vector<fs::path> replaced_above(const std::set<fs::path>& places) {
  std::vector<fs::path> found;
  std::set<fs::path> seen;
  for (const fs::path& place : places) {
    std::error_code unknown;
    const fs::path folder = fs::canonical(place.empty() ? fs::path(".") : place, unknown);
    if (!unknown && seen.insert(folder).second && has_replacements(folder)) found.push_back(folder);
  }
  // Above them anybody may have made a directory that names files of ours.
  for (const fs::path& place : std::set<fs::path>(seen))
    for (fs::path folder = place.parent_path(); seen.insert(folder).second;
         folder = folder.parent_path())
      if (has_replacements(folder, true)) found.push_back(folder);
  return found;
}

Pairing pair_finished(const PairingChoice& choice) {
  finish_all(places_of_references(choice));
  Pairing pairing = pair_pictures(choice);
  // Some may lie deeper, and tables say only now where theirs lie.
  return finish_all(places_of_references(pairing)) ? pair_pictures(choice) : pairing;
}

void say_problems(const ReplacementOutcome& done) {
  for (const std::string& problem : done.problems) say("lobelia: {}\n", printable_path(problem));
}

fs::path known_path(const fs::path& folder, const std::set<fs::path>& known) {
  std::error_code unknown;
  for (fs::path part : known)
    for (bool is_last = false; !is_last; part = part.parent_path()) {
      is_last = part == part.parent_path();
      if (!part.has_filename() && !is_last) continue;  // "refs/"
      const fs::path shown = part.empty() ? fs::path(".") : part;
      if (fs::canonical(shown, unknown) == folder && !unknown) return shown;
    }
  const fs::path relative = fs::proximate(folder, unknown);
  return unknown || relative.empty() || *relative.begin() == ".." ? folder : relative;
}

}  // namespace lobelia::cli
