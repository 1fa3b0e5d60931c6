// The flags of `lobelia compare` that say what noise the pictures have.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "compare/compare.hpp"

namespace lobelia::cli {

class NoiseFlags {
 public:
  void add_to(CLI::App& command);

  /// Sets what is known before a picture is read: whether there is noise, and how to judge it.
  void apply(ComparisonOptions& options) const;
  /// The files that read() will read for a pair of that name.
  std::vector<std::filesystem::path> files(const std::string& name) const;
  /// Reads the pictures of the noise: the files that were named, or where `name` is not empty those of that name
  /// in the folders that were. `a` and `b` become the means of themselves and their replicates. Throws
  /// Error(kInput) for pictures that cannot be read, do not fit, or are no standard errors.
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
  double freedom_ = 15;  ///< of `lobelia reference --standard-error`
  NoiseOptions judged_;
};

}  // namespace lobelia::cli
