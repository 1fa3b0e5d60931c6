// A user's choices for a comparison, and the table of these options. Command line, Python, the C++ library, the farm
// and the studies all fill the same struct.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "compare/compare.hpp"

namespace lobelia {

/// Texts are as on the command line; empty where nothing was chosen. make_job() reads them.
struct CompareChoice {
  std::vector<std::string>
      given;  ///< files, folders or sequences: the judged one, the reference, further judged ones
  std::string pairs, pattern, sets, project, reference_floor;
  std::vector<std::string> also_accept;
  std::string missing_reference;  ///< empty: "notice"

  std::string layer;
  std::vector<std::string> layer_type;
  bool all_layers = false, ignore_alpha = false;

  std::vector<std::string> fail, warn;
  std::string metrics, tolerance, scene;
  bool no_default_limits = false, allow_equal_nonfinite = false;

  std::vector<std::string> mask, ignore;
  std::string crop;

  std::vector<std::string> a_replicate, b_replicate;
  std::string a_error, b_error, a_variance, b_variance, noise_from_layers, shared_noise;
  double a_samples = 0, b_samples = 0;  ///< of a pixel; 0: as the file says
  double freedom = kFreedomOfErrors;
  double significance = NoiseOptions().significance;
  int bootstrap = NoiseOptions().bootstraps;
  std::uint64_t seed = NoiseOptions().seed;

  std::string exposure;  ///< empty: "auto"
  std::string exposures, tone_curve = "aces";
  double pixels_per_degree = kDefaultPixelsPerDegree;
  /// FLIP's viewer, in place of that: metres, metres, and pixels of the display's width.
  double display_distance = 0.7, display_width = 0.7, display_pixels = 3840;
  std::string ocio, display, view, input_space;

  int threads = 0;
};

/// A choice at this exposure, and on a plain display whatever $OCIO says: for work that is the same on every machine.
CompareChoice plain_choice(double exposure_stops);

/// One option. Adding one is a member of CompareChoice and a line in the table.
struct CompareOption {
  using Place =
      std::variant<bool CompareChoice::*, int CompareChoice::*, std::uint64_t CompareChoice::*,
                   double CompareChoice::*, std::string CompareChoice::*,
                   std::vector<std::string> CompareChoice::*>;
  /// The comparisons that it is for: of any two pictures, even in memory; of pictures in files; or of sets of files.
  enum class For : std::uint8_t { kPictures, kFiles, kSets };

  std::string_view name;  ///< "no-default-limits"; Python and C++ have it with underscores, too
  Place place;            ///< a flag, a number, a text, or a text for each time that it is given
  For applies_to;
  std::string_view heading;  ///< of the program's help
  std::string_view value;    ///< "METRIC=LIMIT"; empty: the type says enough
  std::string meaning;  ///< of an option that several commands have: how its meaning goes on here
  double least = 0, most = 0;           ///< of a number
  std::vector<std::string> words = {};  ///< if not empty, these are allowed
  std::string_view usual = {};  ///< what the help calls the default, if the member does not say it
  std::vector<std::string_view> excludes = {}, needs = {};  ///< other options
};

/// The table, in the order of the help.
std::span<const CompareOption> compare_options();

/// An option that was given by its name, with its texts.
struct GivenOption {
  std::string name;
  /// One text, or several where that is allowed; for a flag also none, which is "true". Not set: nothing was given.
  std::optional<std::vector<std::string>> texts;
};

/// Reads options by name. Throws Error(kUsage) for a name that is unknown, an option that is for more than `pictures`, a
/// value that is not allowed, and options that exclude or need each other.
CompareChoice read_choice(std::span<const GivenOption> options,
                          CompareOption::For pictures = CompareOption::For::kSets);

/// Throws Error(kUsage) unless `text` is METRIC=LIMIT. `where` names it: "--fail".
MetricLimit parse_limit(std::string_view where, const std::string& text);
std::vector<MetricLimit> parse_limits(std::string_view where, std::span<const std::string> texts);
/// Throws Error(kUsage) unless `text` is RELATIVE,OF_PEAK,OUTLIERS.
Tolerance parse_tolerance(std::string_view where, const std::string& text);
/// The id with a threshold in its shortest form, as a record has it.
std::string metric_in_short(const std::string& id);

/// Sets the exposures and the viewer. Throws Error(kUsage) for numbers and ranges that cannot be read.
void choose_viewing(const CompareChoice& choice, Viewing& viewing);

}  // namespace lobelia
