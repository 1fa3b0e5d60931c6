// Every effect: rays in waves of a chunk, from the camera to what they meet, to the lights, and on.
#pragma once

#include "renderer/waves/waves.hpp"

namespace lobelia {

using waves::Workspace;

class WaveRenderer {
 public:
  /// Both must outlive it.
  WaveRenderer(const Scene& scene, const Plan& plan) : prepared_(scene, plan) {}

  /// At most kChunk samples; one result each.
  void render(std::span<const PixelSample> samples, std::span<SampleResult> results,
              Workspace& work) const;

  const FilterSampler& filter() const { return prepared_.filter; }

 private:
  void follow(waves::Wave& wave, Workspace& work) const;
  void shade(waves::Wave& wave, Workspace& work) const;

  waves::PreparedScene prepared_;
};

}  // namespace lobelia
