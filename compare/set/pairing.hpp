// Sets of pictures, and which pictures of them belong together.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lobelia {

/// Pictures of the same thing, at most one of each set.
struct PictureRow {
  /// Shared by all files, such as "lights/area.exr", a frame's number, or the values of pattern fields, joined by '/'.
  std::string name;
  std::vector<std::string> files;        ///< by set; empty where it has none
  std::vector<std::string> fields = {};  ///< values of Pairing::fields
};

struct Pairing {
  std::vector<std::string> sets;  ///< titles, all different; the second is the reference
  std::vector<std::string>
      fields;                    ///< names of what tells the rows apart, if the files' names say it
  std::vector<PictureRow> rows;  ///< sorted by name, each once
  std::size_t passed_over =
      0;  ///< files without a picture's ending, or that the pattern does not fit
  /// Links to a folder outside the set's, or to nothing; their paths begin with the folder's.
  std::vector<std::string> not_followed = {};
  /// Files that look like frames of a sequence, but their numbers are written in another way. Sorted.
  std::vector<std::string> misnamed = {};
  bool is_one_row = false;  ///< files that were given one by one
  bool is_by_name =
      false;  ///< folders: pictures of noise and second references have the rows' names
  std::size_t also_accepted = 0;  ///< this many of the last sets are further references

  bool is_reference(std::size_t set) const;
  /// Files of the references that the row has.
  std::vector<std::string> references_of(const PictureRow& row) const;
};
inline constexpr std::size_t kReferenceSet = 1;

/// How to read what the user gave.
struct PairingChoice {
  std::vector<std::string>
      given;  ///< files, folders or sequences: a set each; one folder with `pattern` and `sets`
  /// Further references, in the form of `given`. The best one counts.
  std::vector<std::string> also_accepted = {};
  std::string csv;      ///< a table of files, in place of `given`
  std::string pattern;  ///< "{scene}_{engine}.exr", of paths within the folders; may be empty
  std::string
      sets;  ///< "engine=mine,reference": the field that tells the sets apart, and its values
  std::size_t most_files = 1'000'000;
  /// Files of folders with such an ending belong to pictures and are none themselves: "_variance.exr".
  std::vector<std::string> companions = {};
};

/// Whether the file's name stands for a sequence: it holds %04d, %d or ####, once.
bool is_sequence(const std::string& path);

/// Pairs two files, or
/// - folders by name within them, and what is left by name without its ending, if that is unique on both sides;
/// - folders by the fields of a pattern: {name} fits any text without '/', {} as well but tells nothing apart;
/// - sequences by their frames' numbers; a file that nearly is a frame ("f.01.exr" of f.%d.exr) is in Pairing::misnamed;
/// - the columns of a CSV file (RFC 4180, with a header: the titles of the sets, and perhaps "name"), whose paths are
///   relative to it.
/// Walks folders and the folders inside them. Follows a link to a folder inside, but never to one that contains the link.
/// Throws Error(kUsage) for a choice that does not fit together, Error(kInput) if a folder or the table cannot be read,
/// two files have one place, or a folder holds over `most_files`, probably the wrong one.
Pairing pair_pictures(PairingChoice choice);

}  // namespace lobelia
