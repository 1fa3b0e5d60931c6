// A comparison and its layers as records.
#include "base/pictures/orientation.hpp"
#include "compare/highlight_region.hpp"
#include "compare/layers.hpp"

namespace lobelia {
namespace {

records::Viewing viewing_record(const Viewing& viewing, bool measured) {
  records::Viewing record{viewing.exposure_stops, viewing.pixels_per_degree, std::nullopt,
                          std::nullopt,           viewing.tail_stops,        viewing.further_stops};
  if (const auto& range = viewing.hdr_exposures; range && range->problem.empty() && measured)
    record.hdr_exposures =
        records::HdrExposures{range->start_stops, range->stop_stops, range->count, range->automatic,
                              std::string(kToneCurveNames[std::size_t(range->curve)])};
  if (const auto& display = viewing.display) {
    const auto& choice = display->choice();
    record.display =
        records::Display{choice.config, display->config_id(), choice.display,
                         choice.view,   choice.input_space,   std::string(display->decoded_by())};
  }
  return record;
}

records::Window window_record(const PixelWindow& window) {
  return {window.x, window.y, window.width, window.height};
}

records::PictureRead picture_record(const PictureSource& source) {
  records::PictureRead record;
  record.format = source.format;
  record.layer = source.layer;
  record.channels = source.channels;
  record.value_type = source.value_type;
  record.transfer = source.transfer;
  record.multiplied_by_alpha = source.multiplied_by_alpha;
  record.data_window = window_record(source.data);
  record.display_window = window_record(source.display);
  if (source.orientation != kUpright) record.orientation = source.orientation;
  record.chromaticities = source.chromaticities;
  record.icc_profile = source.icc_profile;
  if (!source.icc_profile.empty()) {
    record.icc_profile_is_srgb = source.icc_is_srgb;
    record.icc_profile_applied = source.transfer == kByProfile;
  }
  if (source.has_gain_map) record.gain_map = "not applied";
  return record;
}

records::LayerComparison layer_record(const LayerComparison& layer) {
  records::LayerComparison record;
  record.layer = layer.name;
  record.type = layer_type_name(layer.type);
  record.verdict = verdict_name(layer.verdict());
  if (layer.overscan) record.overscan = window_record(*layer.overscan);
  if (layer.identical) record.identical = true;
  record.problem = layer.problem;
  if (layer.comparison) {
    records::Comparison whole = comparison_record(*layer.comparison, "", "");
    record.nonfinite = std::move(whole.nonfinite);
    record.metrics = std::move(whole.metrics);
    record.limits = std::move(whole.limits);
    record.disagreement = std::move(whole.disagreement);
    record.not_measured = std::move(whole.not_measured);
    record.finding = std::move(whole.finding);
  }
  record.pictures = pictures_record(layer.a, layer.b);
  return record;
}

}  // namespace

records::Comparison comparison_record(const Comparison& comparison, const std::string& a,
                                      const std::string& b, const std::string& c) {
  records::Comparison record;
  record.verdict = verdict_name(comparison.verdict);
  record.a = a;
  record.b = b;
  if (comparison.type != LayerType::kColour) record.type = layer_type_name(comparison.type);
  record.finding = comparison.finding;
  record.nonfinite = comparison.nonfinite;
  record.viewing = viewing_record(comparison.viewing, !comparison.metrics.empty());
  if (comparison.mask_pixels)
    record.mask = records::Mask{*comparison.mask_pixels, comparison.mask_of};
  record.ignored = comparison.ignored;
  if (comparison.crop) record.crop = window_record(*comparison.crop);
  if (comparison.highlight_pixels)
    record.highlight = records::HighlightRegion{*comparison.highlight_pixels, kHighlightShare};
  record.highlights = comparison.highlights;
  record.metrics = comparison.metrics;
  record.not_measured = comparison.not_measured;
  record.limits = comparison.limits;
  record.warnings = comparison.warnings;
  record.disagreement = comparison.disagreement;
  record.blind_limits = comparison.blind_limits;
  record.faults = comparison.faults;
  record.uncertainty = comparison.uncertainty;
  if (comparison.uncertainty) record.error_bars = comparison.error_bars;
  if (comparison.tolerance)
    record.tolerance = records::Tolerance{
        comparison.tolerance->relative, comparison.tolerance->of_peak,
        comparison.tolerance->allowed_outliers, !comparison.tolerance->edges.empty()};
  record.reference_floor = comparison.reference_floor;
  if (record.reference_floor) record.reference_floor->c = c;
  return record;
}

records::PicturesRead pictures_record(const PictureSource& a, const PictureSource& b) {
  return {picture_record(a), picture_record(b)};
}

void add_layers(records::Comparison& record, Verdict worst, const OtherLayers& others) {
  record.verdict = verdict_name(worst);
  record.not_compared = others.not_compared;
  auto& layers = record.layers.emplace();
  for (const LayerComparison& layer : others.compared) layers.push_back(layer_record(layer));
  if (others.common)
    record.layers_in_one = records::LayersInOne{others.common->only_a, others.common->only_b};
}

}  // namespace lobelia
