#include "renderer/render.hpp"

#include <atomic>

#include "base/system/threads.hpp"
#include "renderer/kernels/kernels.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

Scene canonical(const std::string& name, int width = 96, int height = 96) {
  Scene scene = canonical_scene(name);
  scene.film = {width, height};
  return scene;
}

TEST(Render, IsTheSameBitForBitInAnyNumberOfThreads) {
  for (const char* name : {"oblique_45", "point_light", "two_spheres"}) {
    const Scene scene = canonical(name, 301, 230);
    ASSERT_GT(std::size_t(scene.film.width * scene.film.height), kPixelsOfOneThread)
        << "or one thread renders all";
    RenderOptions one, many;
    one.threads = 1;
    many.threads = 5;
    EXPECT_TRUE(same(render(scene, one).image, render(scene, many).image)) << name;
  }
}

TEST(Kernels, DarkenALightAtTheHorizonInEveryPrecisionAtTheSameCosine) {
  // An RDF has no cosine to fade with: its highlight stands up to the horizon itself.
  Vec3Chunk normal{}, to_eye{}, to_light{};
  alignas(64) double value[kChunk]{};
  const double cosines[] = {0, 0x1p-1074, 1e-310, 1e-40, 0x1p-127, 1e-20, -0x1p-1074, -1e-20};
  for (std::size_t i = 0; i < std::size(cosines); ++i) {
    normal.z[i] = 1;
    to_eye.x[i] = -1, to_eye.z[i] = cosines[i];
    to_light.x[i] = 1, to_light.z[i] = cosines[i];
  }
  for (const Precision precision :
       {Precision::kFloat32, Precision::kMixed, Precision::kFloat64, Precision::kFloat16}) {
    const Highlight highlight{*find_model("phong_rdf"), {}, Normalisation::kExact, 16};
    kernels().shade(highlight, precision)(highlight, std::size(cosines), normal, to_eye, to_light,
                                          value);
    for (std::size_t i = 0; i < std::size(cosines); ++i)
      EXPECT_EQ(value[i], cosines[i] > 0 ? 1 : 0) << name(precision) << " " << cosines[i];
  }
}

TEST(Render, KeepsTheErrorBoundOfHalfFloats) {
  for (const ModelId model : all_models())
    for (const char* lobe : {"cosine", "cs16", "gauss", "schlick"})
      for (const double n : {8.0, 128.0, 1024.0}) {
        Scene scene = canonical("oblique_45", 64, 64);
        Highlight& highlight = scene.materials[0].highlight;
        highlight = {model, *find_lobe(lobe), Normalisation::kExact, n};
        const auto by = [&](Precision precision) {
          RenderOptions options;
          options.precision = precision;
          return render(scene, options).image;
        };
        const Image half = by(Precision::kFloat16), wide = by(Precision::kFloat64);
        double most = 0;
        for (std::size_t i = 0; i < half.values().size(); ++i)
          most = std::max(most, std::abs(double(half.values()[i]) - double(wide.values()[i])));
        most /= radiance_coefficient(highlight);
        // Measured from 6e-4 to 0.03; the light's irradiance is 1.
        EXPECT_GT(most, 1e-4) << info(model).name << " " << lobe << " " << n;
        EXPECT_LE(most, shading_error_bound(Precision::kFloat16, highlight,
                                            min_half_lengths(scene).at(0)))
            << info(model).name << " " << lobe << " " << n;
      }
}

TEST(Render, SpheresInOnePlaceDoNotShadeEachOther) {
  // By exact arithmetic an inner sphere shades nothing of an outer one; by rounding it may seem to.
  for (const double inner : {1.0, std::nextafter(1.0, 0.0), 1 - 1e-14, 1 - 1e-12, 1 - 1e-6, 0.5})
    for (const char* name : {"head_on", "oblique_45", "grazing_80"})
      for (const double size : {1e-6, 1.0, 1e6}) {
        Scene scene = canonical(name);
        scene.materials[0].highlight.exponent = 1;
        scene.camera.origin = size * scene.camera.origin;
        scene.spheres[0].radius = size;
        const Image alone = render(scene, {}).image;
        scene.spheres.push_back({scene.spheres[0].center, inner * size, 0});
        EXPECT_TRUE(same(alone, with_all(scene).image)) << name << " " << inner << " " << size;
      }
}

TEST(Render, ReportsProgressUpToTheEnd) {
  std::atomic<double> largest{0};
  RenderOptions options;
  options.on_progress = [&](double fraction) {
    for (double seen = largest;
         fraction > seen && !largest.compare_exchange_weak(seen, fraction);) {
    }
  };
  render(canonical("head_on"), options);
  EXPECT_EQ(largest, 1);
}

}  // namespace
}  // namespace lobelia
