// Where references lie, and what acceptances have replaced there (compare/accept/replacement.hpp).
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "compare/accept/replacement.hpp"
#include "compare/set/pairing.hpp"

namespace lobelia::cli {

/// The folders of references that were given, without links. Files, sequences and tables have none.
std::vector<std::filesystem::path> folders_of_references(const PairingChoice& choice);

/// Those folders, or the folders of the files and sequences. Throws nothing.
std::set<std::filesystem::path> places_of_references(const PairingChoice& choice);
/// The folders of all references.
std::set<std::filesystem::path> places_of_references(const Pairing& pairing);

/// The folders at or above these places in which files were replaced, without links.
std::vector<std::filesystem::path> replaced_above(const std::set<std::filesystem::path>& places);

/// pair_pictures(), once what an interrupted acceptance left among the references is finished, and said on stderr. Also
/// throws as finish_replacement().
Pairing pair_finished(const PairingChoice& choice);

/// Says on stderr which files are not what they should be, and why.
void say_problems(const ReplacementOutcome& done);

/// A folder as the user knows it: what leads to it of one of the `known` paths, which are in it or lead to it themselves.
/// Otherwise from the current directory, if it lies below that. `folder` is without links.
std::filesystem::path known_path(const std::filesystem::path& folder,
                                 const std::set<std::filesystem::path>& known);

}  // namespace lobelia::cli
