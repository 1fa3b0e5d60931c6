// A block of equal spheres: <shape type="sphere_lattice">, many spheres in a few lines.
#pragma once

#include "renderer/scene/scene.hpp"

namespace lobelia {

struct SphereLattice {
  int columns = 1, rows = 1, layers = 1;  ///< along x, y, z, >= 1
  Vec3 step;                              ///< from centre to centre, >= 0
  Vec3 center;                            ///< of the whole lattice
  double radius = 1;
  double jitter = 0;  ///< 0..1
  std::uint64_t seed = 0;
  int material = 0;

  std::int64_t count() const { return std::int64_t{columns} * rows * layers; }
  /// The largest absolute coordinate that a centre may have.
  double reach() const;
  void append_to(std::vector<Sphere>& spheres) const;
};

/// The formula of the centres, for docs/scene_format.md: enough for another program to make the same.
std::string lattice_rule();

}  // namespace lobelia
