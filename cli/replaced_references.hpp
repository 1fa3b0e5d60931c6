// Where references lie, and what acceptances have replaced there (core/replacement.hpp).
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

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

/// From the current directory, if it lies below that.
std::filesystem::path shortest_path(const std::filesystem::path& path);

}  // namespace lobelia::cli
