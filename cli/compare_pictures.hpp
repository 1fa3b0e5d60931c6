// `lobelia compare` after its command line is read: compares two files, or two folders of them.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compare/layers.hpp"
#include "compare/mask.hpp"
#include "compare/set/pairing.hpp"
#include "compare/set/report.hpp"
#include "records/project.hpp"

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
  /// folders, or the layers of the pair's own files. `pair` become the means of themselves and their replicates. Throws
  /// Error(kInput) for pictures that cannot be read, have another size, or are no standard errors; errors of
  /// noise_of_layers().
  void read(const std::string& name, const PairReport& files, PicturePair& pair,
            ComparisonOptions& options) const;
  /// Whether a picture is the mean of several files.
  bool has_replicates() const { return !a_.replicates.empty() || !b_.replicates.empty(); }

 private:
  struct Side {
    std::string error;                    ///< picture of standard errors; empty for none
    std::vector<std::string> replicates;  ///< besides the picture itself
    double samples = 0;                   ///< of a pixel; 0: as the file says
    bool given() const { return !error.empty() || !replicates.empty(); }
  };
  bool is_from_layers(const std::string& letter) const;
  std::optional<PictureNoise> read_side(const Side& side, const std::string& letter,
                                        const std::string& name, const std::string& file,
                                        Picture& picture) const;

  Side a_, b_;
  std::string shared_, from_layers_;
  double freedom_ = kFreedomOfErrors;
  NoiseOptions judged_;
};

/// The options of `lobelia compare` on parts of the pictures.
class RegionFlags {
 public:
  void add_to(CLI::App& command);

  /// Reads the shapes and their pictures, and sets the words and the cut in `options`. Throws as parse_mask_shape().
  void read(ComparisonOptions& options);
  /// Adds the parts of a project. Its `mask` counts only if the command line has none.
  void add(const std::vector<std::string>& mask, const std::vector<std::string>& ignore);
  /// After read(): the parts of a rule. Its `mask`, if there is one, replaces the others.
  void change(std::span<const MaskShape> mask, std::span<const MaskShape> ignored,
              ComparisonOptions& options);
  /// Pictures that read() reads.
  std::vector<std::filesystem::path> files() const;
  /// Sets the parts for pictures of this size in `options`, which has those of the scene and the noise of whole
  /// pictures. Throws Error(kInput) if the picture of a mask has another size, a cut does not lie inside, or every pixel
  /// is ignored.
  void apply(int width, int height, ComparisonOptions& options) const;

 private:
  std::vector<std::string> mask_texts_, ignore_texts_;
  std::string crop_text_;
  std::vector<MaskShape> mask_, ignored_;
};

/// |A - B| of each channel by itself, in its own colour.
inline constexpr std::string_view kChannels = "channels";

/// The options of `lobelia compare` on pictures of the difference, and on the histogram of FLIP.
struct DifferencePicture {
  std::filesystem::path path;  ///< a file, .png or .exr, or of folders a folder; empty for none
  std::string of{kChannels};   ///< a difference map's id, or kChannels
  std::string colour_map;      ///< empty: the one that suits the map
  double scale = 0;            ///< the map's last colour; 0: the one that suits the map
  bool only_failed = false;    ///< none of a pair that passes
  std::filesystem::path histogram;  ///< a file, .svg or .csv; empty for none
  std::string histogram_of = "flip.ldr";

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
  void write_histogram(const Image& a, const Image& b, const Comparison& comparison) const;
};

/// The options of `lobelia compare` on the viewer and the exposures.
class ViewingFlags {
 public:
  void add_to(CLI::App& command, Viewing& viewing);
  /// Takes this exposure, unless it is empty or the command line has one.
  void suggest_exposure(const std::string& exposure);
  /// Throws Error(kUsage) for numbers and ranges that cannot be read.
  void apply(Viewing& viewing) const;

 private:
  std::string exposure_ = "auto", exposures_, tone_curve_ = "aces";
  double distance_ = 0.7, width_ = 0.7, pixels_ = 3840;  ///< FLIP's viewer
  const CLI::Option* exposure_option_ = nullptr;
};

/// How a project judges some of the pairs.
struct PairRule {
  std::string match;  ///< of a pair's name, as fnmatch(3) has it
  std::vector<MetricLimit> limits, warnings;
  std::optional<Tolerance> tolerance;
  std::optional<bool> default_limits;
  std::vector<MaskShape> mask, ignored;
};

/// The limits, of which `more` replaces those on the same metrics.
std::vector<MetricLimit> with_limits(std::vector<MetricLimit> limits,
                                     const std::vector<MetricLimit>& more);

struct CompareJob {
  PairingChoice pictures;
  std::string c;      ///< the second reference, or a folder of them; may be empty
  std::string scene;  ///< the scene file for the mask, or empty
  ComparisonOptions comparison;
  DifferencePicture difference;
  LayerOptions layers;
  NoiseFlags noise;
  RegionFlags regions;
  std::vector<PairRule> rules;  ///< the last that fits a pair counts most
  std::vector<records::KnownDifference> known;
  std::string today;        ///< "2027-01-31", in UTC
  bool hash_files = false;  ///< for PairReport::hashes
};

/// The job with the rules that fit a pair of this name.
CompareJob job_of(const CompareJob& job, const std::string& name);

/// Whether there is one pair, whose files were given by themselves.
inline bool is_one_pair(const Pairing& pairing) {
  return pairing.is_one_row && pairing.sets.size() == 2 + pairing.also_accepted;
}
/// Whether pictures of noise and second references have the names of the rows.
inline bool has_folders_by_name(const CompareJob& job, const Pairing& pairing) {
  return !pairing.is_one_row && pairing.fields.empty() && job.pictures.csv.empty() &&
         job.pictures.pattern.empty();
}

/// Every pair of the rows, without results: each judged set's picture with the first of its references.
std::vector<PairReport> pairs_of(const Pairing& pairing);

/// How the files of a compared pair became light, A first: reading_facts(), and the layers that have their noise.
std::array<records::Named<std::string>, 2> reading_of(const PairReport& pair);

/// Reads the pair as it is compared: the part of the chosen layer, or of the mean of its replicates. `job` is that of the
/// pair. Sets what depends on the pictures in `options`. Throws as read_pair().
PicturePair read_compared(const PairReport& pair, const CompareJob& job, const Pairing& pairing,
                          ComparisonOptions& options);

/// Compares all pairs, each with the reference that it fits best. A pair that cannot be compared has its error in the report, and the others go on, but where it is
/// the only one its error is thrown. An automatic range of exposures becomes one that holds those of all references.
/// Throws Error(kOutput) where a picture cannot be written.
///
/// Calls done(pairs so far) after each, from any thread.
SetReport compare_pairs(const CompareJob& job, const Pairing& pairing,
                        const std::function<void(std::size_t)>& done);

/// A plain name that stays the same from report to report. One that had to be changed is told apart by a hash.
std::string plain_id(const std::string& name);

/// The file for the difference of a pair of several, inside the folder that was given. The ending is added, so that a.exr
/// and a.png stay apart.
std::filesystem::path difference_file(const CompareJob& job, const std::string& name);

/// How the table is printed.
struct PrintChoice {
  bool quiet = false;    ///< only what does not pass
  bool verbose = false;  ///< of a set, a line for each pair
  bool colour = false;
};
void print_pair(const PairReport& pair, const PrintChoice& choice);
void print_set(const SetReport& report, const PrintChoice& choice);

}  // namespace lobelia::cli
