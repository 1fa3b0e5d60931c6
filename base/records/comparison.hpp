// Comparisons of two pictures, and of a set of pairs.
#pragma once

#include "base/records/struct_type.hpp"

namespace lobelia::records {

/// The last three are for pictures with noise.
inline constexpr std::string_view kVerdicts[] = {"pass", "differs",   "non-finite",
                                                 "same", "different", "undecided"};
inline constexpr std::string_view kLayerTypes[] = {"colour", "alpha", "depth", "vector",
                                                   "identifier"};
/// Whether limits should find a change.
inline constexpr std::string_view kExpected[] = {"found", "not found", "either"};
/// Whether a limit holds over the whole error bar.
inline constexpr std::string_view kChannels[] = {"red", "green", "blue"};
inline constexpr std::string_view kStandings[] = {"holds", "broken", "open"};

/// Pixels x to x + width - 1, y to y + height - 1; y down.
struct Window {
  int x = 0, y = 0, width = 0, height = 0;
};

/// How a file was read.
struct PictureRead {
  std::string format, layer;
  std::vector<std::string> channels;
  std::string value_type, transfer;
  bool multiplied_by_alpha = false;
  Window data_window, display_window;
  std::optional<int> orientation;
  std::vector<double> chromaticities;
  std::string icc_profile;
  std::optional<bool> icc_profile_is_srgb, icc_profile_applied;
  std::string gain_map;
};

struct PicturesRead {
  PictureRead a, b;
};

struct NonfinitePlace {
  int x = 0, y = 0;
  std::string channel;
  double value = 0;
};

struct NonfinitePlaces {
  std::optional<NonfinitePlace> a, b;
};

struct Nonfinite {
  std::int64_t a = 0, b = 0;
  std::optional<NonfinitePlaces> first;
  std::optional<std::int64_t> equal_allowed;
};

struct HdrExposures {
  double start_stops = 0, stop_stops = 0;
  int count = 2;
  bool automatic = false;
  std::string tone_curve = "aces";
};

struct Display {
  std::string config, config_id, display, view, input_space, decoded_by;
};

struct Viewing {
  double exposure_stops = 0, pixels_per_degree = 0;
  std::optional<HdrExposures> hdr_exposures;
  std::optional<Display> display;
  std::optional<double> tail_stops;
  std::vector<double> further_stops;
};

struct Mask {
  std::int64_t pixels = 0;
  std::vector<std::string> of;
};

struct HighlightRegion {
  std::int64_t pixels = 0;
  double share_of_peak = 0;
};

/// A highlight of the reference, judged by itself, or one that it lacks.
struct LocalHighlight {
  int x = 0, y = 0;
  double peak = 0, base = 0;
  std::int64_t pixels = 0;
  bool gone = false, only_in_a = false;
  double energy = 0, width = 0, shift_x = 0, shift_y = 0, excess = 0;
  std::optional<double> energy_beyond, width_beyond, shift_beyond;
  std::string channel;  ///< "red", "green", "blue", or empty
};

struct NotMeasured {
  std::string metric, because;
};

struct Limit {
  std::string metric;
  double limit = 0, value = 0;
  bool pass = false;
  std::string standing;  ///< "holds", "broken", "open"; empty without noise
  std::optional<double> more_samples;
};

struct PictureNoise {
  double freedom = 0;
  bool shared = false;
  std::string layer;
  std::optional<double> fireflies;
  std::optional<bool> heavy_tails;
};

struct Uncertainty {
  std::optional<PictureNoise> a, b;
  double significance = 0;
  std::optional<int> judges;
  double tests = 0, each = 0;
  int bootstraps = 0;
  std::uint64_t seed = 0;
};

struct ErrorBar {
  double standard_error = 0, noise_floor = 0, noise_floor_most = 0, low = 0, high = 0;
};

struct Tolerance {
  double relative = 0, of_peak = 0;
  std::int64_t allowed_outliers = 0;
  bool on_edges_only = false;
};

struct ReferenceFloor {
  std::string c;
  std::int64_t nonfinite = 0;
  Named<double> metrics;
};

/// A further layer of both files.
struct LayerComparison {
  std::string layer, type, verdict;
  std::optional<Window> overscan;
  std::optional<bool> identical;
  std::string problem;
  std::optional<Nonfinite> nonfinite;
  std::optional<Named<double>> metrics;
  std::optional<std::vector<Limit>> limits;
  std::optional<std::vector<std::string>> disagreement;
  std::vector<NotMeasured> not_measured;
  std::string finding;
  PicturesRead pictures;
};

struct NotCompared {
  std::vector<std::string> layers;
  bool alpha = false;
  std::int64_t overscan_pixels = 0;
  int mip_levels = 0;
};

struct LayersInOne {
  std::vector<std::string> a, b;
};

/// A kind of difference that the values tell.
inline constexpr std::string_view kFaultKinds[] = {"clipped", "encoded as sRGB",
                                                   "one bright pixel"};

struct Fault {
  std::string kind, picture;
  std::optional<double> value, other;
  std::optional<int> x, y;
  std::optional<double> rest;
};

struct Comparison {
  std::string verdict, a, b, type, finding;
  Nonfinite nonfinite;
  Viewing viewing;
  std::optional<Mask> mask, ignored;
  std::optional<Window> crop;
  std::optional<HighlightRegion> highlight;
  std::vector<LocalHighlight> highlights;
  Named<double> metrics;
  std::vector<NotMeasured> not_measured;
  std::vector<Limit> limits, warnings;
  std::vector<std::string> disagreement, blind_limits;
  std::vector<Fault> faults;
  std::optional<Uncertainty> uncertainty;
  std::optional<Named<ErrorBar>> error_bars;
  std::optional<Tolerance> tolerance;
  std::optional<ReferenceFloor> reference_floor;
  std::optional<PicturesRead> pictures;
  std::optional<NotCompared> not_compared;
  std::optional<std::vector<LayerComparison>> layers;
  std::optional<LayersInOne> layers_in_one;
};

struct SetSummary {
  std::size_t pairs = 0, pass = 0, differs = 0, undecided = 0, non_finite = 0, errors = 0,
              missing = 0, extra = 0, passed_over = 0, links_not_followed = 0;
  std::optional<std::size_t> known, misnamed;
};

struct SetNotCompared {
  std::vector<std::string> layers;
  bool alpha = false;
  std::int64_t overscan_pixels = 0;
  int mip_levels = 0;
  std::size_t pairs = 0;
};

struct WorstOfSet {
  double value = 0;
  std::string pair;
  double mean = 0;
};

/// A difference that somebody has explained.
struct Known {
  std::string reason, expires;
  bool is_expired = false;
};

struct PairOfSet {
  std::string name;
  std::optional<Known> known;
  std::optional<int> references;
  std::optional<Comparison> comparison;
  std::string error;
};

struct ComparisonSet {
  std::string a, b, c;
  SetSummary summary;
  SetNotCompared not_compared;
  Named<WorstOfSet> worst;
  std::vector<std::string> missing, extra, links_not_followed, misnamed;
  std::vector<PairOfSet> pairs;
};

/// A changed copy of a picture, compared with it.
struct ChangedCopy {
  std::string name, expected, verdict;
  bool as_expected = false;
  std::vector<std::string> found_by;
};

struct GivenLimit {
  std::string metric;
  double limit = 0;
};

struct Sensitivity {
  std::string a;
  bool as_expected = false, default_limits = true;
  std::vector<GivenLimit> limits;
  std::vector<ChangedCopy> changes;
};

void define_comparison_tables(Tables& tables);

}  // namespace lobelia::records
