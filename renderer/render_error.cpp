#include "renderer/render_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lobelia {

Image standard_error_of_render(const Scene& scene, RenderOptions options) {
  const auto on_progress = options.on_progress;
  Image first;
  std::vector<double> sums, squares;
  for (int k = 0; k < kErrorRenders; ++k) {
    if (on_progress)
      options.on_progress = [&](double fraction) { on_progress((k + fraction) / kErrorRenders); };
    Scene again = scene;
    again.sampler.seed += std::uint64_t(k) + 1;
    Image image = render(again, options).image;
    sums.resize(image.values().size());
    squares.resize(image.values().size());
    if (k == 0)
      first = std::move(image);
    else
      for (std::size_t i = 0; i < sums.size(); ++i) {
        // From the first, so that no digits are lost where they are nearly the same.
        const double apart = double(image.values()[i]) - double(first.values()[i]);
        sums[i] += apart;
        squares[i] += apart * apart;
      }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double variance =
        std::max(0.0, squares[i] - sums[i] * sums[i] / kErrorRenders) / kErrorFreedom;
    first.values()[i] = float(std::sqrt(variance));
  }
  return first;
}

}  // namespace lobelia
