// Helmholtz reciprocity, f_r(L, V) = f_r(V, L): of every model that carries the cosine, and of no other.
#include "renderer/albedo.hpp"
#include "renderer/reflector.hpp"
#include "tests/renderer/laws/directions.hpp"

namespace lobelia {
namespace {

std::vector<ModelId> brdfs() {
  return models_where([](const ModelInfo& m) { return m.applies_cosine; });
}

/// f_r read out of the radiance.
double brdf(const Reflector& reflector, Vec3 normal, Vec3 to_eye, Vec3 to_light) {
  return reflector.eval(normal, to_eye, to_light).r / dot(normal, to_light);
}

TEST(EveryBrdf, IsTheSameWithLightAndEyeExchanged) {
  const Frame frame;
  for (const Highlight& h : highlights_of_both(brdfs(), kExponents)) {
    const double coefficient = radiance_coefficient(h);
    int bright = 0;
    for (const Rgb diffuse : {Rgb{}, Rgb{0.5, 0.5, 0.5}}) {
      const Reflector reflector({"", h, {0.2, 0.2, 0.2}, diffuse, Fresnel::kSchlick});
      for (const Pair& p : direction_pairs(frame, h.exponent)) {
        const double there = brdf(reflector, frame.normal, p.to_eye, p.to_light),
                     back = brdf(reflector, frame.normal, p.to_light, p.to_eye);
        // Unit vectors are rounded: 1e-16 to N.L, of which what is left is divided by, and to
        // a lobe that is up to sqrt(n) steep.
        const double cosine = std::min(dot(frame.normal, p.to_eye), dot(frame.normal, p.to_light));
        EXPECT_NEAR(there, back, std::max(coefficient, there) * (1e-12 + 1e-15 / cosine))
            << text(h);
        bright += there > 0.01 * coefficient;
      }
    }
    EXPECT_GT(bright, 10) << text(h) << ": the pairs miss the highlight";
  }
}

TEST(ReciprocityGap, IsRoundingForBrdfsButLargeForRdfs) {
  for (const Highlight& h : highlights_of_both(every_model(), kExponents)) {
    const double gap = reciprocity_gap(h);
    // The gap of an RDF is about the lobe's width over the cosine at the last eye, 85 degrees.
    EXPECT_TRUE(info(h.model).applies_cosine
                    ? gap < 1e-11
                    : gap < 1 && gap > std::min(0.25, 5 / std::sqrt(h.exponent)))
        << text(h) << ": " << gap;
  }
}

}  // namespace
}  // namespace lobelia
