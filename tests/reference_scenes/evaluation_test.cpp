// A whole scene by formulas per pixel: held against numbers that are known without it, and double against 50
// digits.
#include <fmt/format.h>

#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/stability/cases.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/more_samples.hpp"
#include "tests/reference_scenes/hall_scene.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using truth::Digits;

constexpr HighlightChoice kPhong{"phong_rdf", "cosine", "exact", 9};

std::vector<Rgb> picture(const Scene& scene) { return truth::evaluate(scene, Digits::kDouble); }
/// The middle pixel of an odd film.
Rgb middle(const Scene& scene) {
  const auto all = picture(scene);
  return all[all.size() / 2];
}

/// Seen from above, a plane y = 0 of a Lambertian white: the middle pixel is the origin.
Scene plane_scene() {
  Scene scene = sphere_scene(kPhong, {DirectionalLight{{0, -1, 0}, {kPi, kPi, kPi}}}, 9);
  scene.camera = {{0, 5, 0}, {0, 0, 0}, {0, 0, -1}, 28};
  scene.spheres.clear();
  scene.materials[0].specular_reflectance = {};
  scene.materials[0].diffuse_reflectance = kWhite;
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, 0, 0, 1}};
  return scene;
}
Material matt(double albedo) {
  Material material;
  material.highlight = highlight_of(kPhong);
  material.diffuse_reflectance = albedo * kWhite;
  return material;
}
Material mirror(double reflectance) {
  Material material = matt(0);
  material.mirror_reflectance = reflectance * kWhite;
  return material;
}

TEST(Evaluation, PeakByALampBehindTheEyeIsTheCoefficientTimesTheIrradiance) {
  EXPECT_NEAR(middle(sphere_scene(kPhong, {directional_at(0)}, 9)).r, 10 / (2 * kPi), 1e-14);
  const std::pair<const char*, double> paper[] = {
      {"phong_rdf", 1.063 * 40 / (2 * kPi)},
      {"modified_phong", (1.063 * 40 + 1) / (2 * kPi)},
      {"blinn_phong_rdf", (1.068 * 40 + 0.96) / (8 * kPi)},
      {"modified_blinn_phong", (1.027 * 40 + 4.8) / (8 * kPi)},
      {"blinn_phong_ndf", 1.063 * 40 / (8 * kPi)},
      {"blinn_phong_heightfield", (1.063 * 40 + 1) / (8 * kPi)}};
  for (const auto& [model, coefficient] : paper)
    EXPECT_NEAR(middle(sphere_scene({model, "cs16", "paper", 40}, {directional_at(0)}, 9)).g,
                coefficient, 1e-13)
        << model;
  EXPECT_NEAR(
      middle(sphere_scene({"modified_blinn_phong", "cosine", "paper", 2}, {directional_at(0)}, 9))
          .b,
      4.0 * 6 / (4 * kPi * 2.5), 1e-14)
      << "with the paper's misprint";
}

constexpr std::pair<double, Vec3> kPlaces[] = {
    {1, {}}, {1e-3, {}}, {1e4, {}}, {1, {1e5, -2e5, 3e4}}, {1e-3, {1e5, -2e5, 3e4}}};
/// Where a lamp stands that lights the floor's middle by 0.8 / 25.
constexpr Vec3 kLampPlace{3, 4, 0};
constexpr double kLit = 0.8 / 25;

/// A film of one pixel that sees the middle of plane_scene() at some scale and place, with a lamp so many closenesses
/// from a plane. A closeness is 1e-12 of the largest coordinate, which is less than 6 here, or that of the place.
Scene lamp_beside_a_plane(double scale, Vec3 away, Vec3 normal, double aside) {
  const auto map = [&](Vec3 v) { return scale * (v + away); };
  const double close = 1e-12 * scale * (length(away) > 0 ? length(away) : 5.0);
  Scene scene = plane_scene();
  scene.film = {1, 1};
  scene.camera = {map({0.01, 5, 0.02}), map({0, 0, 0}), {0, 0, -1}, 28};
  scene.planes[0].point = map({3, 0, 2});
  scene.planes.push_back({map(kLampPlace), normal, 0, 0, 1});
  scene.lights = {PointLight{map(kLampPlace) + aside * close * normal, {kPi, kPi, kPi}}};
  return scene;
}

Vec3 unit_vector(int i) {
  return normalize({std::sin(1 + 7.0 * i), std::sin(2 + 11.0 * i), std::sin(3 + 13.0 * i)});
}

TEST(Evaluation, LightsBothSidesOfAPlaneWithALampInIt) {
  int before = 0, behind = 0;
  for (const auto& [scale, away] : kPlaces)
    for (int i = 0; i < 50; ++i) {
      const Vec3 normal = unit_vector(i);
      // It must not come between the camera and the floor's middle, nor through that.
      const double middle = -dot(kLampPlace, normal),
                   eye = dot(Vec3{0.01, 5, 0.02} - kLampPlace, normal);
      if (!(middle * eye > 0) || std::abs(middle) < 0.1) continue;
      (middle > 0 ? before : behind) += 1;
      for (const double aside : {0.0, 0.1, -0.1, 10.0, -10.0}) {
        const Scene scene = lamp_beside_a_plane(scale, away, normal, aside);
        const double lit = std::abs(aside) < 1 || aside * middle > 0 ? kLit : 0;
        for (const Digits digits : {Digits::kDouble, Digits::kFifty})
          EXPECT_NEAR(scale * scale * truth::evaluate(scene, digits)[0].r, lit,
                      1e-6)  // moved by a hair
              << scale << " " << away.x;
      }
    }
  EXPECT_GT(before, 20);
  EXPECT_GT(behind, 20);
}

double peak_of(const std::vector<Rgb>& pixels) {
  double peak = 0;
  for (const Rgb& pixel : pixels) peak = std::max(peak, max_component(pixel));
  return peak;
}
double difference(Rgb a, Rgb b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

TEST(Evaluation, IsTheSameInDoubleAsIn50Digits) {
  double worst = 0;
  std::string where;
  std::size_t number = 0;
  const auto expect_same = [&](const Scene& scene, const std::string& name) {
    const auto fine = truth::evaluate(scene, Digits::kFifty), quick = picture(scene);
    const auto ring = truth::edge_ring(scene);
    const double peak = peak_of(fine);
    ASSERT_GT(peak, 0) << name;
    for (std::size_t i = 0; i < fine.size(); ++i) {
      const double here = ring[i] ? 0 : difference(fine[i], quick[i]) / peak;
      if (here > worst) worst = here, where = name;
    }
  };
  for (const ModelInfo& model : models())
    for (const char* lobe : {"cosine", "cs16", "cs64", "schlick", "gauss", "spherical_gaussian"})
      for (const double n : {1.0, 16.0, 1024.0, 1e6}) {
        if (is_left_out(number++, 5)) continue;
        const HighlightChoice choice{model.name, lobe, "exact", n};
        Scene scene = hall_scene(choice, 16);
        if (n > 16) {
          scene = stability::close_to_highlight(scene, n).at(0);
          scene.film = {12, 12};
        }
        expect_same(scene, fmt::format("{} {} {}", model.name, lobe, n));
      }
  EXPECT_LT(worst, 3e-9) << where;  // measured: 5.9e-10, at n = 1e6
}

TEST(Evaluation, HoldsInDoubleForTheHardCasesOfSizeAndDistance) {
  double worst = 0;
  for (const auto& hard : stability::hard_scenes())
    for (Scene scene : stability::close_to_highlight(hard.scene, 1e6)) {
      scene.materials[0].highlight = highlight_of({"modified_phong", "cosine", "exact", 1e6});
      const auto fine = truth::evaluate(scene, Digits::kFifty), quick = picture(scene);
      const double peak = peak_of(fine);
      for (std::size_t i = 0; i < fine.size(); ++i)
        worst = std::max(worst, difference(fine[i], quick[i]) / peak);
    }
  EXPECT_LT(worst, 5e-6);  // measured: 1.9e-6 from 1e7 radii away, nearer 8.7e-10
}

std::ptrdiff_t ring_size(const Scene& scene) {
  const auto ring = truth::edge_ring(scene);
  return std::count(ring.begin(), ring.end(), 1);
}

TEST(EdgeRing, HasTheTwoColumnsOrRowsOfPixelsBesideABoundaryOfSquares) {
  Scene scene = plane_scene();
  scene.materials.push_back(matt(0.5));
  for (const Vec3 corner : {Vec3{0.1, 0, 100}, Vec3{100, 0, 0.1}}) {
    scene.planes = {{corner, {0, 1, 0}, 0, 1, 1000}};
    EXPECT_EQ(ring_size(scene), 18) << corner.x;
  }
  scene.planes[0].checker_material = 0;
  EXPECT_EQ(ring_size(scene), 0);
}

TEST(EdgeRing, HasTheTwoColumnsOfPixelsBesideALampsHorizon) {
  Scene scene = plane_scene();
  scene.lights = {PointLight{{0.1, 1, 0}, kWhite, {1, 0, 0}}};
  EXPECT_EQ(ring_size(scene), 18);
}

TEST(EdgeRing, HasTheShadowsEdgeOfASphereAndOfAPlaneOutOfSight) {
  Scene scene = plane_scene();
  scene.spheres = {{{0, 8, 0}, 1, 0}};
  EXPECT_GT(ring_size(scene), 8);
  scene.spheres.clear();
  scene.lights = {PointLight{{0.2, 7, 0}, kWhite}};
  scene.planes.push_back({{0, 6, 0}, normalize({1, 0.1, 0}), 0, 0, 1});
  EXPECT_GT(ring_size(scene), 8);
}

TEST(EdgeRing, HasSilhouettesSeenInMirrors) {
  Scene scene = plane_scene();
  scene.lights.clear();
  scene.materials.push_back(mirror(1));
  scene.planes[0].material = scene.planes[0].checker_material = 1;
  scene.spheres = {{{0, 8, 0}, 1, 0}};
  EXPECT_EQ(ring_size(scene), 0);
  scene.depth.mirror = 1;
  EXPECT_GT(ring_size(scene), 8);
}

TEST(EdgeRing, RunsAboutTheSilhouetteOfASphereLitFromTheCamera) {
  Scene scene = canonical_scene("head_on");
  scene.film = {128, 128};
  const auto edges = truth::edge_ring(scene);
  // Radius of the silhouette: tan(asin(1/5)) / tan(14 degrees) of half the picture.
  const double radius = 64 * 0.204124 / 0.249328;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      const double r = std::hypot(x - 63.5, y - 63.5);
      if (std::abs(r - radius) > 2.5) {
        EXPECT_EQ(edges[std::size_t(128 * y + x)], 0) << x << " " << y;
      }
    }
  EXPECT_GT(std::count(edges.begin(), edges.end(), 1), int(2 * 3.14 * radius));
}

TEST(Evaluation, RefusesUnknownInputInWords) {
  const auto refuses = [](const char* word, auto change) {
    Scene scene = hall_scene(kPhong, 8);
    ASSERT_EQ(truth::why_not_evaluated(scene), "");
    change(scene);
    EXPECT_NE(truth::why_not_evaluated(scene).find(word), std::string::npos) << word;
    EXPECT_THROW(truth::evaluate(scene, Digits::kDouble), Error) << word;
    EXPECT_THROW(truth::edge_ring(scene), Error) << word;
  };
  refuses("light with a size", [](Scene& s) { s.lights.emplace_back(SphereLight{}); });
  refuses("light with a size", [](Scene& s) { s.lights.emplace_back(ConstantLight{}); });
  refuses("lens", [](Scene& s) { s.camera.aperture_radius = 0.1; });
  refuses("4 samples", [](Scene& s) { s.sampler.sample_count = 4; });
  refuses("inter-reflection", [](Scene& s) { s.depth.glossy = 1; });
  refuses("spheres", [](Scene& s) { s.spheres.resize(2000); });
}

TEST(SurfaceMask, IsWhereTheRayThroughThePixelMeetsASphere) {
  Scene scene = sphere_scene(kPhong, {directional_at(30)}, 33);
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const auto mask = truth::surface_mask(scene);
  int inside = 0;
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 33; ++x) {
      const bool hit =
          nearest_hit(scene, scene.camera.origin, normalize(centre_ray(frame, x, y))).has_value();
      EXPECT_EQ(mask[std::size_t(33 * y + x)] != 0, hit) << x << ", " << y;
      inside += hit;
    }
  EXPECT_GT(inside, 100);
  EXPECT_LT(inside, 1000);
}

TEST(SurfaceMask, HasPlanesToo) {
  const auto mask = truth::surface_mask(plane_scene());
  EXPECT_EQ(std::count(mask.begin(), mask.end(), 1), 81);
}

// The reference is itself held against numbers that are known without it.

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
