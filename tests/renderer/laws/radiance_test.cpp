// Every model multiplies its lobe by the cosine where it should, is black below the horizon, and is finite.

#include "base/words/constants.hpp"
#include "renderer/reflector.hpp"
#include "tests/renderer/laws/directions.hpp"

namespace lobelia {
namespace {

/// Smith's G / ((N.L) (N.V)) for GGX as Heitz prints it.
double textbook_shadowing(double exponent, double n_dot_l, double n_dot_v) {
  const auto lambda = [&](double c) {
    return (std::sqrt(1 + 2 / (exponent + 2) * (1 / (c * c) - 1)) - 1) / 2;
  };
  return 1 / ((1 + lambda(n_dot_l) + lambda(n_dot_v)) * n_dot_l * n_dot_v);
}

TEST(EveryModel, HasTheFactorsOfItsCatalogueEntry) {
  for (const Highlight& h : highlights_of_both(every_model(), kExponents))
    for (const double n_dot_l : {1e-9, 0.25, 0.5, 1.0})
      for (const double n_dot_v : {1e-9, 0.3, 1.0}) {
        const double factor =
            (info(h.model).applies_cosine ? n_dot_l : 1) *
            (info(h.model).has_shadowing ? textbook_shadowing(h.exponent, n_dot_l, n_dot_v) : 1);
        EXPECT_NEAR(highlight_radiance(h, n_dot_l, n_dot_v, 0), radiance_coefficient(h) * factor,
                    1e-14 * radiance_coefficient(h) * std::max(1.0, factor))
            << text(h);
        EXPECT_LE(factor, largest_shadowing(h.model, h.exponent)) << text(h);
      }
}

TEST(EveryModel, IsDarkWhereTheLightIsBelowTheHorizon) {
  for (const Highlight& h : highlights_of_both(every_model(), kExponents))
    for (const double n_dot_l : {0.0, -1e-300, -0.5, std::nan("")})
      EXPECT_EQ(highlight_radiance(h, n_dot_l, 0.5, 0), 0) << text(h);
}

TEST(EveryModel, IsFiniteWithoutNegativesAboveTheHorizon) {
  const Frame frame;
  for (const Highlight& h : highlights_of_both(every_model(), kExponents)) {
    const Reflector reflector({"", h, {1, 1, 1}, {0.5, 0.5, 0.5}, Fresnel::kSchlick});
    for (const Pair& p : direction_pairs(frame, h.exponent)) {
      const double radiance = reflector.eval(frame.normal, p.to_eye, p.to_light).r;
      const double pdf = reflector.pdf(frame.normal, p.to_eye, p.to_light);
      EXPECT_TRUE(std::isfinite(radiance) && radiance >= 0) << text(h) << ": " << radiance;
      EXPECT_TRUE(std::isfinite(pdf) && pdf >= 0) << text(h) << ": " << pdf;
    }
  }
}

TEST(EveryModel, IsZeroBelowTheHorizonOrForNoDirection) {
  const Vec3 up{0, 0, 1}, down{0.1, 0, -1}, aside{1, 0, 0};
  const Vec3 none[] = {{0, 0, 0}, {kInfinity, 0, 1}, {0, std::nan(""), 1}};
  for (const Highlight& h : highlights(every_model(), std::vector{16.0})) {
    const Reflector reflector({"", h, {1, 1, 1}, {1, 1, 1}});
    std::vector<std::array<Vec3, 3>> cases{
        {up, up, down}, {up, down, up}, {up, up, aside}, {up, aside, up}};
    for (const Vec3 v : none) cases.insert(cases.end(), {{v, up, up}, {up, v, up}, {up, up, v}});
    for (const auto& [normal, to_eye, to_light] : cases) {
      EXPECT_EQ(reflector.eval(normal, to_eye, to_light), Rgb{}) << text(h);
      EXPECT_EQ(reflector.pdf(normal, to_eye, to_light), 0) << text(h);
    }
    for (const Vec3 v : {none[0], none[1], none[2], down, aside})
      EXPECT_FALSE(reflector.sample(up, v, 0, 0.5, 0.5)) << text(h);
  }
}

TEST(EveryModel, AsksDirectionsForNoLength) {
  const Frame frame;
  for (const Highlight& h : highlights(every_model(), std::vector{16.0})) {
    const Reflector reflector({"", h, {1, 1, 1}, {1, 1, 1}});
    const Vec3 to_eye = frame(0.6, 1), to_light = frame(0.5, 4);
    const double radiance = reflector.eval(frame.normal, to_eye, to_light).r;
    for (const double length : {1e-300, 1e-3, 1e300})
      EXPECT_NEAR(
          reflector.eval(length * frame.normal, length * to_eye, length * to_light).r / radiance, 1,
          1e-12)
          << text(h) << " " << length;
  }
}

TEST(Names, LeadBackToTheirEntries) {
  for (const ModelId id : every_model()) EXPECT_EQ(find_model(info(id).name), id);
  for (const LobeId& id : lobes()) EXPECT_EQ(find_lobe(info(id).name), id);
  EXPECT_FALSE(find_model("phong"));
  for (const char* name : {"", "cs", "cs0", "cs1", "cs15", "cs1026", "cs-2", "cs016", "cs2 ", "pk",
                           "pk3", "pk3.0", "pk3.5", "pk4", "pk3_2", "pk3.20"})
    EXPECT_FALSE(find_lobe(name)) << name;
}

}  // namespace
}  // namespace lobelia
