// The reference is itself held against numbers that are known without it.
#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "base/words/constants.hpp"

#include "renderer/render.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

LobeId lobe(const char* name) { return *find_lobe(name); }
ModelId model(const char* name) { return *find_model(name); }

TEST(TheReference, KnowsLobesOfSimpleArgumentsToTheLastDigit) {
  // Exact binary fractions: (3/4)^2, (1 - 2/2 1/4)^2, (1/2)/(1/2 + 3/2), (1 - 1/4)^16.
  EXPECT_EQ(truth::lobe(lobe("cosine"), 0.25, 2), 0.5625);
  EXPECT_EQ(truth::lobe(lobe("cs2"), 0.25, 2), 0.5625);
  EXPECT_EQ(truth::lobe(lobe("schlick"), 0.5, 3), 0.25);
  EXPECT_EQ(truth::lobe(lobe("cs16"), 0.25, 16), 43046721.0 / 4294967296.0);
  EXPECT_EQ(truth::lobe(lobe("spherical_gaussian"), 0.5, 2), std::exp(-1.0));
  // arccos 1/2 is pi/3: e^(-9 pi^2 / 18).
  EXPECT_NEAR(truth::lobe(lobe("gauss"), 0.5, 9), std::exp(-kPi * kPi / 2), 1e-17);
}

TEST(TheReference, LosesNoDigitAtTinyAngles) {
  // s = 1e-20, n = 1e20: (1 - s)^n = 1/e (1 - s n s / 2 ...).
  EXPECT_DOUBLE_EQ(truth::lobe(lobe("cosine"), 1e-20, 1e20), std::exp(-1.0));
  EXPECT_DOUBLE_EQ(truth::one_minus_cos(1e-12), 5e-25);
  EXPECT_DOUBLE_EQ(truth::one_minus_cos(kPi / 3), 0.5);
}

TEST(TheReference, FindsTheClosedFormsOfThePapersTableByQuadrature) {
  const LobeId cosine = lobe("cosine");
  int cases = 0;
  for (const double n : {0.1, 1.0, 2.0, 15.9, 16.0, 1024.0, 1e4, 1e6, 1e8}) {
    const double tiny = std::exp2(-n / 2);
    const std::pair<const char*, double> rows[] = {
        {"phong_rdf", (n + 1) / (2 * kPi)},
        {"modified_phong", (n + 2) / (2 * kPi)},
        {"blinn_phong_rdf", (n + 2) / (4 * kPi * (2 - tiny))},
        {"modified_blinn_phong", (n + 2) * (n + 4) / (8 * kPi * (tiny + n))},
        {"blinn_phong_ndf", (n + 1) / (8 * kPi)},
        {"blinn_phong_heightfield", (n + 2) / (8 * kPi)}};
    for (const auto& [name, closed] : rows) {
      ++cases;
      EXPECT_NEAR(truth::coefficient(model(name), cosine, n) / closed, 1, 1e-15)
          << name << " " << n;
    }
  }
  EXPECT_EQ(cases, 54);
}

TEST(TheReference, FindsTheEnergyOfOtherLobesByQuadrature) {
  const ModelId rdf = model("phong_rdf");
  for (const double n : {32.0, 1024.0, 1e6}) {
    // cs_k ends before the right angle: n (k + 1) / (2 pi k). Gaussian: n / (2 pi (1 - e^-n)).
    EXPECT_NEAR(truth::coefficient(rdf, lobe("cs16"), n) / (n * 17 / (32 * kPi)), 1, 1e-15) << n;
    EXPECT_NEAR(truth::coefficient(rdf, lobe("cs2"), n) / (n * 3 / (4 * kPi)), 1, 1e-15) << n;
    EXPECT_NEAR(
        truth::coefficient(rdf, lobe("spherical_gaussian"), n) / (n / (2 * kPi * -std::expm1(-n))),
        1, 1e-15);
    // Integral of (1 - s)/(1 + m s), m = n - 1, over s: (n ln n - m) / m^2.
    const double m = n - 1, integral = (n * std::log(n) - m) / (m * m);
    EXPECT_NEAR(truth::coefficient(rdf, lobe("schlick"), n) * 2 * kPi * integral, 1, 2e-15) << n;
  }
}

TEST(TheReference, FindsTheEnergyOfAFormulaOnAnyScaleAndWithCorners) {
  for (const char* formula :
       {"max(0, 1 - n*s/16)^16", "max(0, 1 - n*s)", "max(0, 1 - n^1.5*s)", "exp(-sqrt(n*s))",
        "1/(1 + n*s)^2", "exp(-n*x^2/2)", "max(max(0, 1 - n*s), 0.125*max(0, 2 - n*s))"})
    for (const ModelId id : all_models())
      for (const double n : {3.0, 64.0, 1e4}) {
        const Highlight highlight{id, formula_lobe(formula), Normalisation::kExact, n};
        EXPECT_NEAR(truth::coefficient(highlight) / radiance_coefficient(highlight), 1, 1e-9)
            << formula << " " << info(id).name << " " << n;
      }
}

TEST(TheReference, TakesVectorsOfAnyLength) {
  const Highlight cos2{model("modified_phong"), lobe("cosine"), Normalisation::kExact, 2};
  // N = V = z, L at arctan 3/4: N.L = R.L = 4/5; (4/5)^3.
  const Vec3 n{0, 0, 1e-310}, v{0, 0, 3}, l{3e150, 0, 4e150};
  EXPECT_DOUBLE_EQ(truth::shape(cos2, n, v, l), 0.512);
  EXPECT_EQ(truth::shape(cos2, n, v, {0, 0, -1}), 0);
  const Highlight half{model("blinn_phong_rdf"), lobe("cosine"), Normalisation::kExact, 2};
  // L at a right angle from V: H at 45 degrees, cos^2 = 1/2, but N.L = 0.
  EXPECT_EQ(truth::shape(half, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}), 0);
  EXPECT_DOUBLE_EQ(truth::shape(half, {1, 0, 1}, {0, 0, 1}, {1, 0, 0}), 1);
}

Scene one_sphere() {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 28};
  scene.film = {9, 9};
  scene.lights = {DirectionalLight{{0, 0, -1}, {1, 2, 3}}};
  scene.materials = {{"",
                      {model("phong_rdf"), lobe("cosine"), Normalisation::kExact, 2},
                      {0.5, 0.5, 0.5},
                      {},
                      Fresnel::kNone}};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  return scene;
}

TEST(TheReference, SeesASphereTouchedByOneUlp) {
  Scene scene = one_sphere();
  scene.spheres[0].center = {1, 0, 0};  // the middle ray runs along its tangent
  const std::size_t middle = 40;
  EXPECT_EQ(truth::Picture(scene).sphere(middle), -1);
  scene.spheres[0].radius = std::nextafter(1.0, 2.0);
  EXPECT_EQ(truth::Picture(scene).sphere(middle), 0);
  scene.spheres[0].radius = std::nextafter(1.0, 0.0);
  EXPECT_EQ(truth::Picture(scene).sphere(middle), -1);
}

TEST(TheReference, AFilmAsideShowsThePictureMovedByWholePixels) {
  Scene scene = one_sphere();
  scene.film = {40, 30};
  const Image straight = render(scene, {}).image;
  scene.camera.principal_point_offset_x = 5 / 40.0;
  scene.camera.principal_point_offset_y = 3 / 30.0;
  const Image moved = render(scene, {}).image;
  for (int y = 3; y < 30; ++y)
    for (int x = 0; x < 35; ++x)
      EXPECT_NEAR(moved.pixel(x + 5, y - 3)[1], straight.pixel(x, y)[1], 1e-6) << x << ", " << y;
}

}  // namespace
}  // namespace lobelia
