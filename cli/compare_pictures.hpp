// What `lobelia compare` does once its command line is read: a pair of files, or two folders of them.
#pragma once

#include <filesystem>
#include <string>

#include "cli/compare_noise.hpp"
#include "compare/layers.hpp"
#include "compare/set/folder_pairs.hpp"
#include "compare/set/report.hpp"

namespace lobelia::cli {

struct DifferencePicture {
  std::filesystem::path path;   ///< a file, .png or .exr, or of folders a folder; empty for none
  std::string of = "channels";  ///< a difference map's id, or kChannels
  std::string colour_map;       ///< empty: what suits the map
  double scale = 0;             ///< the map's last colour; 0: the largest difference
};
/// |A - B| of each channel by itself, in its own colour.
inline constexpr std::string_view kChannels = "channels";

struct CompareJob {
  std::string a, b, c;  ///< files, or folders; c is the second reference or empty
  std::string scene;    ///< the file that the mask is made of, or empty
  ComparisonOptions comparison;
  DifferencePicture difference;
  LayerOptions layers;
  NoiseFlags noise;
};

/// Throws what reading, measuring and writing throw.
SetReport compare_files(const CompareJob& job);

/// Each pair by itself: one that cannot be compared has its error in the report, and the others go on. An
/// automatic range of exposures becomes one that holds those of all references.
/// Throws Error(kInput) where a folder cannot be read, Error(kOutput) where a picture cannot be written.
SetReport compare_folders(const CompareJob& job, const FolderPairs& names);

/// Where the difference of a folders' pair goes. The ending is added, not exchanged: a.exr and a.png would meet.
inline std::filesystem::path difference_file(const CompareJob& job, const std::string& name) {
  return job.difference.path / (name + ".png");
}

/// For a person, on stdout.
void print_pair(const PairReport& pair);
void print_set(const SetReport& report);

}  // namespace lobelia::cli
