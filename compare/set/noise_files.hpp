// The noise of pictures that are files: where it is read from.
#pragma once

#include <filesystem>

#include "compare/layers.hpp"
#include "compare/set/choice.hpp"
#include "compare/set/report.hpp"

namespace lobelia {

/// `given`, or if `name` is not empty the file of that name in the folder `given`.
inline std::filesystem::path file_of(const std::filesystem::path& given, const std::string& name) {
  return name.empty() ? given : given / name;
}

/// The file beside the picture, of its name but for the ending: "a/x_variance.exr" of "a/x.exr" and "_variance.exr".
std::filesystem::path with_ending(const std::filesystem::path& picture, const std::string& ending);

class NoiseFiles {
 public:
  NoiseFiles() = default;
  /// Sets `options.noise` if there is noise. read() adds the pictures. Throws Error(kUsage) for choices that contradict
  /// each other.
  NoiseFiles(const CompareChoice& choice, ComparisonOptions& options);

  /// The files that read() reads for a pair of that name, without those beside the pictures.
  std::vector<std::filesystem::path> files(const std::string& name) const;
  /// The endings of the files beside the pictures. Such files are no pictures of a set.
  std::vector<std::string> endings() const;
  /// Reads the pictures of the noise: the named files, or if the pair has a name in folders the files of that name in the
  /// named folders, those beside the pair's own files, or the layers of the pair's own files. `pair` become the means of
  /// themselves and their replicates. Throws Error(kInput) for pictures that cannot be read, have another size, or are no
  /// standard errors; errors of noise_of_layers().
  void read(const PairReport& files, PicturePair& pair, ComparisonOptions& options) const;
  /// Whether a picture is the mean of several files.
  bool has_replicates() const { return !a_.replicates.empty() || !b_.replicates.empty(); }

 private:
  struct Side {
    std::string
        error;  ///< picture of standard errors, or '*' and the ending of one; empty for none
    std::string variance;                 ///< likewise of variances
    std::vector<std::string> replicates;  ///< besides the picture itself
    double samples = 0;                   ///< of a pixel; 0: as the file says
    bool given() const { return !error.empty() || !variance.empty() || !replicates.empty(); }
  };
  bool is_from_layers(const std::string& letter) const;
  std::optional<PictureNoise> read_side(const Side& side, const std::string& letter,
                                        const std::string& name, const std::string& file,
                                        Picture& picture) const;

  Side a_, b_;
  std::string shared_, from_layers_;
  double freedom_ = kFreedomOfErrors;
};

}  // namespace lobelia
