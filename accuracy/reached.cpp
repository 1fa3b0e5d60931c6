#include <algorithm>
#include <cmath>
#include <vector>

#include "accuracy/accuracy.hpp"
#include "accuracy/picture_truth.hpp"
#include "core/image_values.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"

namespace lobelia::accuracy {
namespace {

/// Over the pixels that are not edges.
double max_of_peak(const Image& picture, const Image& truth,
                   const std::vector<std::uint8_t>& edges) {
  const auto a = picture.values(), b = truth.values();
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (edges.empty() || !edges[i / 3])
      most = std::max(most, std::abs(double(a[i]) - double(b[i])));
  return most == 0 ? 0 : most / peak_value(truth);
}

}  // namespace

Reached measure_reached(const Scene& scene, const Choice& choice, const Image& picture) {
  // Four times the samples of what is judged: the truth's own noise is then the smaller part of what is seen.
  const PictureTruth truth =
      picture_truth(scene, choice.samples ? std::max(64, 4 * *choice.samples) : 1);
  Reached reached{0, truth.how, truth.seconds};
  reached.black = peak_value(picture) == 0 && peak_value(truth.image) == 0;
  if (reached.black) return reached;
  switch (choice.measure) {
    case Measure::kCiede2000P99:
      reached.value = measure_at_peak("ciede2000.p99", picture, truth.image);
      break;
    case Measure::kRmsOfPeak:
      reached.value = rms_of_peak(picture, truth.image);
      break;
    case Measure::kMaxOfPeak: {
      // On an edge the formulas may see another surface: that is no error of a lobe or of its precision.
      const bool formulas = truth::why_not_evaluated(scene).empty();
      const auto edges = formulas ? truth::edge_ring(scene) : std::vector<std::uint8_t>();
      reached.value = max_of_peak(picture, truth.image, edges);
      if (formulas) reached.against += ", but for pixels on edges";
    }
  }
  return reached;
}

}  // namespace lobelia::accuracy
