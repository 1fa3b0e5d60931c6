#include "gallery/metric_notes.hpp"

#include "core/numbers.hpp"

namespace lobelia::gallery {
namespace {

struct Entry {
  std::string_view id, title, meaning;
  MetricUnit unit;
};

constexpr Entry kEntries[] = {
    {"rmse", "Root mean square difference", "Over all pixels and channels, in radiance.",
     MetricUnit::kRadiance},
    {"mae", "Mean difference", "Of all pixels and channels without their signs, in radiance.",
     MetricUnit::kRadiance},
    {"mse", "Mean square difference", "The square of the root mean square difference.",
     MetricUnit::kPlain},
    {"psnr", "Peak signal-to-noise ratio", "In decibels, of the reference’s peak; more is better.",
     MetricUnit::kPlain},
    {"drift", "Mean difference, with its sign",
     "Positive where ours is brighter; noise cancels here.", MetricUnit::kRadiance},
    {"relmse.eps=0.01", "Relative mean square difference",
     "Each squared difference divided by the reference’s squared value plus 0.01.",
     MetricUnit::kPlain},
    {"max_abs", "Largest difference",
     "Of any channel of any pixel, in radiance; and at which pixel.", MetricUnit::kRadiance},
    {"peak", "Peak", "The brightest value of the reference picture.", MetricUnit::kRadiance},
    {"max_rel_peak", "Largest difference, of the peak",
     "The largest difference divided by the peak.", MetricUnit::kShare},
    {"ciede2000.mean", "CIEDE2000, mean",
     "Colour difference as seen on a display at the cell’s exposure; 1 is about just noticeable.",
     MetricUnit::kPlain},
    {"ciede2000.p50", "CIEDE2000, median", "Half of the pixels differ by no more than this.",
     MetricUnit::kPlain},
    {"ciede2000.p95", "CIEDE2000, 95th percentile", "95 of 100 pixels differ by less than this.",
     MetricUnit::kPlain},
    {"ciede2000.p99", "CIEDE2000, 99th percentile", "99 of 100 pixels differ by no more than this.",
     MetricUnit::kPlain},
    {"ciede2000.max", "CIEDE2000, largest", "The pixel whose colour differs most.",
     MetricUnit::kPlain},
    {"delta_e_itp.mean", "Delta E ITP, mean",
     "Colour difference on a display of high dynamic range, white at 203 cd/m²; 1 is just "
     "noticeable at best.",
     MetricUnit::kPlain},
    {"delta_e_itp.p95", "Delta E ITP, 95th percentile",
     "95 of 100 pixels differ by no more than this.", MetricUnit::kPlain},
    {"delta_e_itp.max", "Delta E ITP, largest", "The pixel whose colour differs most.",
     MetricUnit::kPlain},
    {"ssim", "SSIM", "How alike the structure is, 1 for equal pictures; more is better.",
     MetricUnit::kPlain},
    {"ms_ssim", "MS-SSIM", "The same at five scales, the coarse ones as from farther away.",
     MetricUnit::kPlain},
    {"flip.ldr.mean", "LDR-FLIP, mean",
     "What a person notices on flipping between the two pictures: 0 nothing, 1 everything.",
     MetricUnit::kPlain},
    {"flip.ldr.max", "LDR-FLIP, largest", "The pixel where a person would notice most.",
     MetricUnit::kPlain},
    {"flip.hdr.mean", "HDR-FLIP, mean",
     "The same at the exposure that shows each pixel’s difference best.", MetricUnit::kPlain},
    {"flip.hdr.max", "HDR-FLIP, largest", "The pixel where a person would notice most.",
     MetricUnit::kPlain},
    {"outliers", "Pixels beyond the tolerance",
     "A few pixels may be: on the silhouette and on the terminator rounding decides what a ray "
     "hits.",
     MetricUnit::kCount},
    {"outliers.off_edge", "Of these, away from the edges",
     "Not on a silhouette, a terminator or a shadow’s edge, where only rounding decides.",
     MetricUnit::kCount},
    {"z.max", "Largest difference, in units of its noise",
     "As a standard normal number; beyond the critical one it is no chance.", MetricUnit::kPlain},
    {"z.critical", "Critical number of the noise",
     "What as many pixels and regions as were looked at exceed by chance in few pictures alone.",
     MetricUnit::kPlain},
    {"z.beyond", "Pixels beyond the noise",
     "Pixels with a value that differs by more than noise explains.", MetricUnit::kCount},
    {"z.beyond.off_edge", "Of these, away from the edges", "Not on an edge of the scene.",
     MetricUnit::kCount},
    {"z.regions", "Regions beyond the noise",
     "Squares of 2, 4, 8, ... pixels whose sum differs by more than noise explains.",
     MetricUnit::kCount},
    {"z.open", "Pixels that noise leaves open", "Not sure to lie within the tolerance.",
     MetricUnit::kCount},
    {"mae.mask", "Mean difference, inside the mask", "Of the pixels that see a surface.",
     MetricUnit::kRadiance},
    {"rmse.mask", "Root mean square difference, inside the mask",
     "Of the pixels that see a surface.", MetricUnit::kRadiance},
    {"drift.mask", "Mean difference with its sign, inside the mask",
     "Of the pixels that see a surface.", MetricUnit::kRadiance},
    {"max_abs.mask", "Largest difference, inside the mask", "Of the pixels that see a surface.",
     MetricUnit::kRadiance},
};

}  // namespace

MetricNote metric_note(std::string_view id) {
  for (const Entry& entry : kEntries) {
    if (entry.id != id) continue;
    const bool more_is_better = id == "psnr" || id == "ssim" || id == "ms_ssim";
    return {std::string(entry.title), entry.meaning, entry.unit, more_is_better};
  }
  return {std::string(id), "", MetricUnit::kPlain, false};
}

std::string unit_name(MetricUnit unit) {
  switch (unit) {
    case MetricUnit::kShare:
      return "share";
    case MetricUnit::kCount:
      return "count";
    case MetricUnit::kRadiance:
      return "radiance";
    case MetricUnit::kPlain:
      break;
  }
  return "plain";
}

bool is_coordinate(std::string_view id) { return id.ends_with(".x") || id.ends_with(".y"); }

std::string metric_text(std::string_view id, double value) {
  switch (metric_note(id).unit) {
    case MetricUnit::kShare:
      return percent_text(value);
    case MetricUnit::kCount:
      return count_text(value);
    case MetricUnit::kRadiance:
    case MetricUnit::kPlain:
      break;
  }
  return number_text(value);
}

}  // namespace lobelia::gallery
