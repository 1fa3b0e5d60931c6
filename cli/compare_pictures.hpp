// `lobelia compare` after its command line is read: compares two files, or two folders of them.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "compare/layers.hpp"
#include "compare/set/pairing.hpp"
#include "compare/set/report.hpp"

namespace lobelia::cli {

/// `given`, or if `name` is not empty the file of that name in the folder `given`.
inline std::filesystem::path file_of(const std::filesystem::path& given, const std::string& name) {
  return name.empty() ? given : given / name;
}

/// The options of `lobelia compare` on the noise of the pictures.
class NoiseFlags {
 public:
  void add_to(CLI::App& command);

  /// Sets `options.noise` if there is noise. read() adds the pictures.
  void apply(ComparisonOptions& options) const;
  /// The files that read() reads for a pair of that name.
  std::vector<std::filesystem::path> files(const std::string& name) const;
  /// Reads the pictures of the noise: the named files, or if `name` is not empty the files of that name in the named
  /// folders. `a` and `b` become the means of themselves and their replicates. Throws Error(kInput) for pictures that
  /// cannot be read, have another size, or are no standard errors.
  void read(const std::string& name, Image& a, Image& b, ComparisonOptions& options) const;

 private:
  struct Side {
    std::string error;                    ///< picture of standard errors; empty for none
    std::vector<std::string> replicates;  ///< besides the picture itself
    bool given() const { return !error.empty() || !replicates.empty(); }
  };
  std::optional<PictureNoise> read_side(const Side& side, const std::string& letter,
                                        const std::string& name, Image& image) const;

  Side a_, b_;
  std::string shared_;
  double freedom_ = 15;  ///< as `lobelia reference --standard-error` has it
  NoiseOptions judged_;
};

struct DifferencePicture {
  std::filesystem::path path;   ///< a file, .png or .exr, or of folders a folder; empty for none
  std::string of = "channels";  ///< a difference map's id, or kChannels
  std::string colour_map;       ///< empty: the one that suits the map
  double scale = 0;             ///< the map's last colour; 0: the largest difference
};
/// |A - B| of each channel by itself, in its own colour.
inline constexpr std::string_view kChannels = "channels";

struct CompareJob {
  PairingChoice pictures;
  std::string c;      ///< the second reference, or a folder of them; may be empty
  std::string scene;  ///< the scene file for the mask, or empty
  ComparisonOptions comparison;
  DifferencePicture difference;
  LayerOptions layers;
  NoiseFlags noise;
};

/// Whether there is one pair, whose files were given by themselves.
inline bool is_one_pair(const Pairing& pairing) {
  return pairing.is_one_row && pairing.sets.size() == 2;
}
/// Whether pictures of noise and second references have the names of the rows.
inline bool has_folders_by_name(const CompareJob& job, const Pairing& pairing) {
  return !pairing.is_one_row && pairing.fields.empty() && job.pictures.csv.empty() &&
         job.pictures.pattern.empty();
}

/// Every pair of the rows, without results: each judged set's picture with the reference.
std::vector<PairReport> pairs_of(const Pairing& pairing);

/// The picture that is judged and its reference, with what was taken from the options for them.
struct ComparedPair {
  PicturePair pictures;
  ComparisonOptions options;
};
/// Reads the pair as it is compared: the chosen layer, the mean of its replicates. Throws as read_pair().
ComparedPair read_compared(const PairReport& pair, const CompareJob& job, const Pairing& pairing,
                           ComparisonOptions options);

/// Compares all pairs. A pair that cannot be compared has its error in the report, and the others go on, but where it is
/// the only one its error is thrown. An automatic range of exposures becomes one that holds those of all references.
/// Throws Error(kOutput) where a picture cannot be written.
SetReport compare_pairs(const CompareJob& job, const Pairing& pairing);

/// The file for the difference of a pair of several. The ending is added, so that a.exr and a.png stay apart.
inline std::filesystem::path difference_file(const CompareJob& job, const std::string& name) {
  return job.difference.path / (name + ".png");
}

/// A table on stdout.
void print_pair(const PairReport& pair);
void print_set(const SetReport& report);

}  // namespace lobelia::cli
