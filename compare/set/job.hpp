// A comparison that is ready to run: what a user chose, read and checked.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/records/project.hpp"
#include "compare/layers.hpp"
#include "compare/set/choice.hpp"
#include "compare/set/noise_files.hpp"
#include "compare/set/pairing.hpp"
#include "compare/set/picture_parts.hpp"

namespace lobelia {

/// How a project judges some of the pairs.
struct PairRule {
  std::string match;  ///< of a pair's name, as fnmatch(3) has it
  std::vector<MetricLimit> limits, warnings;
  std::optional<Tolerance> tolerance;
  std::optional<bool> default_limits;
  std::vector<MaskShape> mask, ignored;
};

struct CompareJob {
  PairingChoice pictures;
  std::string c;               ///< the second reference, or a folder of them; may be empty
  std::string scene;           ///< the scene file for the mask, or empty
  std::string project, title;  ///< the project's file and what it calls the whole; may be empty
  std::string ocio;            ///< the file of the OpenColorIO configuration, or empty
  ComparisonOptions comparison;
  LayerOptions layers;
  NoiseFiles noise;
  PictureParts parts;
  std::vector<PairRule> rules;  ///< the last that fits a pair counts most
  std::vector<records::KnownDifference> known;
  std::string today;  ///< "2027-01-31", in UTC
  bool missing_reference_fails = false;
  bool hash_files = false;  ///< for PairReport::hashes
};

/// A scene's facts about a picture, by pixel. Reading one belongs to the front end, because this room knows no scenes.
struct SceneParts {
  PixelFlags surfaces;  ///< not 0 where a surface is seen
  PixelFlags edges;  ///< not 0 at silhouettes, terminators and shadow edges; empty unless asked for
};
using ReadScene = std::function<SceneParts(const std::string& file, bool with_edges)>;

/// The one way from a choice to a comparison: usual_options(), changed by the choice, for which its project stands in.
/// Throws Error(kUsage) for choices that are not allowed or contradict each other, Error(kInput) for a project, scene or
/// mask that cannot be read.
CompareJob make_job(CompareChoice choice, const ReadScene& read_scene);

/// The options of that job, for pictures that are in memory; without those that make_job() leaves to the pictures.
ComparisonOptions judging_options(const CompareChoice& choice);

PairingChoice pictures_of(const CompareChoice& choice);

/// Fills in from the project's file what the choice leaves open. Paths in it are from its own directory. `job` has the
/// limits and the tolerance of the choice, and gets the project's besides. Throws Error(kInput).
void apply_project(CompareChoice& choice, CompareJob& job);

/// The limits, of which `more` replaces those on the same metrics.
std::vector<MetricLimit> with_limits(std::vector<MetricLimit> limits,
                                     const std::vector<MetricLimit>& more);

/// The job with the rules that fit a pair of this name.
CompareJob job_of(const CompareJob& job, const std::string& name);
/// The project's entry for a pair of this name.
std::optional<records::Known> known_of(const CompareJob& job, const std::string& name);

/// Whether there is one pair, whose files were given by themselves.
inline bool is_one_pair(const Pairing& pairing) {
  return pairing.is_one_row && pairing.sets.size() == 2 + pairing.also_accepted;
}
/// Throws unless the second reference and the pictures of noise can be told which pair they are of.
void check_companions(const CompareJob& job, const Pairing& pairing);

}  // namespace lobelia
