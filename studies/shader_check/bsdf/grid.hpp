// Cells of a hemisphere, small where directions are dense, with points for integrals over them.
#pragma once

#include <span>
#include <vector>

#include "base/words/vec.hpp"

namespace lobelia::shader_check::bsdf {

class HemisphereGrid {
 public:
  struct Node {
    Vec3 direction;
    double solid_angle = 0;  ///< a sum over the nodes with it is the integral
    std::size_t cell = 0;
  };

  HemisphereGrid() = default;
  /// Above the surface (z > 0), or below. `dense` are directions there, by which two thirds of the `bands` and of the `sectors` of
  /// each band are laid; the others are even. `order` is that of Gauss and Legendre along a side: 2, 3 or 4.
  HemisphereGrid(std::span<const Vec3> dense, bool is_above, int bands, int sectors, int order);

  const std::vector<Node>& nodes() const { return nodes_; }
  std::size_t cells() const { return first_.empty() ? 0 : first_.back(); }
  /// The cell of a direction on its side of the surface.
  std::size_t cell_of(Vec3 direction) const;

 private:
  std::vector<double> angles_;  ///< of the bands' edges from the normal, or its opposite
  std::vector<std::vector<double>> turns_;  ///< of the sectors' edges, for each band
  std::vector<std::size_t> first_;          ///< cell of each band, and the number of all
  std::vector<Node> nodes_;
};

}  // namespace lobelia::shader_check::bsdf
