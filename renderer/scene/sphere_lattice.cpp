#include "renderer/scene/sphere_lattice.hpp"

namespace lobelia {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014) with its state as an argument, so that any value can be computed alone. std's
/// distributions would give other scenes with another library.
std::uint64_t split_mix(std::uint64_t state) {
  std::uint64_t z = state + 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

double unit_interval(std::uint64_t bits) { return double(bits >> 11) * 0x1p-53; }

double room(double step, double radius) { return std::max(0.0, step / 2 - radius); }

}  // namespace

double SphereLattice::reach() const {
  const auto along = [&](double c, int n, double d) {
    return std::abs(c) + 0.5 * (n - 1) * d + jitter * room(d, radius);
  };
  return std::max({along(center.x, columns, step.x), along(center.y, rows, step.y),
                   along(center.z, layers, step.z)});
}

void SphereLattice::append_to(std::vector<Sphere>& spheres) const {
  std::uint64_t counter = split_mix(seed);
  const auto along = [&](double c, int i, int n, double d) {
    const double u = unit_interval(split_mix(counter++));
    return c + (i - 0.5 * (n - 1)) * d + jitter * room(d, radius) * (2 * u - 1);
  };
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        // Separate statements: a compiler may evaluate a function's arguments in any order.
        const double x = along(center.x, i, columns, step.x);
        const double y = along(center.y, j, rows, step.y);
        const double z = along(center.z, k, layers, step.z);
        spheres.push_back({{x, y, z}, radius, material});
      }
}

std::string lattice_rule() {
  return R"(A lattice becomes plain spheres when it is read: layer by layer, in it row by row, in it
column by column. Sphere number s has along axis a (0, 1, 2 for x, y, z) the coordinate
`center + (i - (n - 1) / 2) step + jitter max(0, step / 2 - radius) (2 u - 1)`, where i of 0
to n - 1 is its place along the axis and u the top 53 bits of m(m(seed) + 3 s + a) as a
fraction; m is a step of SplitMix64, which adds 0x9E3779B97F4A7C15 and mixes.
)";
}

}  // namespace lobelia
