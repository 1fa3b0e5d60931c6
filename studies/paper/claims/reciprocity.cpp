// Helmholtz reciprocity: f_r(L, V) = f_r(V, L), tried for pairs of directions.
#include "studies/paper/claim.hpp"

namespace lobelia::paper {
namespace {

struct Direction {
  Real x, y, z;  // z along the normal
};
Direction direction(Real theta, Real azimuth) {
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
          std::cos(theta)};
}
Real angle_between(Direction a, Direction b) {
  const Real chord = std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
  return 2 * std::asin(std::min<Real>(1, chord / 2));
}

/// As a BRDF, without the coefficient, which cancels.
Real brdf(const Row& row, Lobe lobe, Real n, Direction to_light, Direction to_eye) {
  Real angle;
  if (row.half_angle || row.distribution) {
    Direction half{to_light.x + to_eye.x, to_light.y + to_eye.y, to_light.z + to_eye.z};
    const Real length = std::hypot(half.x, half.y, half.z);
    half = {half.x / length, half.y / length, half.z / length};
    angle = angle_between(half, {0, 0, 1});
  } else {
    angle = angle_between(to_light, {-to_eye.x, -to_eye.y, to_eye.z});
  }
  if (angle >= kRightAngle) return 0;
  return value(lobe, angle, n) / (row.is_rdf() ? to_light.z : 1);
}

struct Asymmetry {
  Real largest_ratio = 1;
  int pairs = 0;
};

/// Over pairs of directions from 5 to 85 degrees in steps of 10, and azimuths in steps of 20.
void widen(Asymmetry& asymmetry, const Row& row) {
  const auto radians = [](int degrees) { return degrees * kPi / 180; };
  for (const Lobe lobe : {Lobe::kCosine, Lobe::kCs16})
    for (const Real n : {16.0L, 64.0L})
      for (int light = 5; light <= 85; light += 10)
        for (int eye = 5; eye <= 85; eye += 10)
          for (int azimuth = 0; azimuth <= 180; azimuth += 20) {
            const Direction l = direction(radians(light), 0),
                            v = direction(radians(eye), radians(azimuth));
            const Real there = brdf(row, lobe, n, l, v), back = brdf(row, lobe, n, v, l);
            // Where cs16 has nearly ended, its value is all rounding.
            if (there < 1e-9L || back < 1e-9L) continue;
            ++asymmetry.pairs;
            asymmetry.largest_ratio = std::max(asymmetry.largest_ratio, there / back);
          }
}

constexpr char kModelsText[] = "text on the models";
constexpr char kPairs[] =
    "f_r(L, V) / f_r(V, L) - 1 over pairs of directions 5 to 85 degrees from the normal, both lobes, n = 16"
    " and 64, where f_r/coefficient exceeds 1e-9";

}  // namespace

Claim reciprocity_of_brdfs() {
  Asymmetry asymmetry;
  for (const Row& row : kRows)
    if (!row.is_rdf()) widen(asymmetry, row);
  const Real excess = asymmetry.largest_ratio - 1;
  Claim claim{"reciprocity-brdf", kModelsText,
              "the modified models and the distributions satisfy Helmholtz reciprocity", ""};
  claim.measured = {vanishing("largest asymmetry", excess, 1e-12)};
  claim.definition = std::string(kPairs) + "; a distribution with G = (N.L)(N.V), f_r = D/4";
  claim.verdict = confirmed_if(asymmetry.pairs > 0 && excess < 1e-12L);
  claim.reason = "R.V = L.R_V, and H does not tell L from V";
  return claim;
}

Claim reciprocity_of_rdfs() {
  Asymmetry asymmetry;
  for (const Row& row : kRows)
    if (row.is_rdf()) widen(asymmetry, row);
  Claim claim{"reciprocity-rdf", kModelsText,
              "Phong (RDF) and Blinn-Phong (RDF) satisfy Helmholtz reciprocity", ""};
  claim.measured = {figure("largest ratio of f_r there to f_r back", asymmetry.largest_ratio, 3,
                           "light and eye up to 85 degrees from the normal"),
                    figure("the ratio for light at 60 and eye at 30 degrees",
                           std::cos(kPi / 6) / std::cos(kPi / 3), 3)};
  claim.definition = std::string(kPairs) + "; as a BRDF an RDF is coefficient lobe / (N.L)";
  claim.verdict = confirmed_if(asymmetry.largest_ratio < 1 + 1e-12L);
  claim.reason =
      "the lobe is symmetric, 1/(N.L) is not. The ratio is (N.V)/(N.L), without bound towards grazing light";
  return claim;
}

}  // namespace lobelia::paper
