// Pictures of differences, and the table of `lobelia compare` on stdout.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>

#include "compare/set/run.hpp"

namespace lobelia::cli {

/// |A - B| of each channel by itself, in its own colour.
inline constexpr std::string_view kChannels = "channels";

/// The options of `lobelia compare` on pictures of the difference.
struct DifferencePicture {
  std::filesystem::path path;  ///< a file, .png or .exr, or of folders a folder; empty for none
  std::string of{kChannels};   ///< a difference map's id, or kChannels
  std::string colour_map;      ///< empty: the one that suits the map
  double scale = 0;            ///< the map's last colour; 0: the one that suits the map
  bool only_failed = false;    ///< none of a pair that passes

  void add_to(CLI::App& command);
  /// Throws Error(kUsage) for options that contradict each other or the pictures.
  void check(bool folders, bool has_exposures) const;
  /// Whether the scale does not depend on the pictures.
  bool has_own_scale() const;
  /// Whether a pair with this verdict has a picture.
  bool is_wanted(Verdict verdict) const;
  /// The largest value of the map.
  double largest(const Image& a, const Image& b, const Comparison& comparison) const;
  /// Writes the picture. `of_set`: the last colour, unless the scale is fixed; without it that of the largest value.
  void write(const std::filesystem::path& file, const Image& a, const Image& b,
             const Comparison& comparison, std::optional<double> of_set) const;
};

/// compare_pairs(), and the pictures of the differences. Throws Error(kOutput) where one cannot be written.
SetReport compare_and_show(const CompareJob& job, const DifferencePicture& difference,
                           const Pairing& pairing, const std::function<void(std::size_t)>& done);

/// A plain name that stays the same from report to report. One that had to be changed is told apart by a hash.
std::string plain_id(const std::string& name);

/// The file for the difference of a pair of several, inside the folder `path`. The ending is added, so that a.exr and
/// a.png stay apart.
std::filesystem::path difference_file(const std::filesystem::path& path, const std::string& name);

/// How the table is printed.
struct PrintChoice {
  bool quiet = false;    ///< only what does not pass
  bool verbose = false;  ///< of a set, a line for each pair
  bool colour = false;
};
void print_pair(const PairReport& pair, const PrintChoice& choice);
void print_set(const SetReport& report, const PrintChoice& choice);

}  // namespace lobelia::cli
