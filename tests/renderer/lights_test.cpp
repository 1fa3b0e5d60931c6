// Draws from lights with a size, against what a ray meets of them.
#include <memory>

#include "base/words/constants.hpp"
#include "renderer/scene/lights/envmap_table.hpp"
#include "renderer/scene/lights/prepared_light.hpp"
#include "renderer/sobol.hpp"
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

Vec3 evenly(double u, double v) {
  const double c = 1 - 2 * u, s = std::sqrt(std::max(0.0, 1 - c * c));
  return {s * std::cos(2 * kPi * v), s * std::sin(2 * kPi * v), c};
}

struct LightHit {
  double distance = 0, pdf = 0;  ///< 0 where it is missed
};

struct LightDraw {
  Vec3 to_light;
  double distance = 0, pdf = 0;  ///< 0 where there is nothing to draw
};

/// A light, one ray at a time.
class OneByOne {
 public:
  explicit OneByOne(const Light& light) : light_(prepare(light)) {}

  LightDraw sample(Vec3 point, double u, double v) const {
    put(point, buffers_->point);
    buffers_->u[0] = u, buffers_->v[0] = v;
    LightSamples& drawn = buffers_->drawn;
    light_->sample(1, buffers_->point, buffers_->u, buffers_->v, drawn);
    const double inverse = drawn.factor[0];
    return {{drawn.to_light.x[0], drawn.to_light.y[0], drawn.to_light.z[0]},
            drawn.distance[0],
            inverse > 0 ? 1 / inverse : 0};
  }

  LightHit meet(Vec3 point, Vec3 direction) const {
    put(point, buffers_->point);
    put(-direction, buffers_->to_eye);
    light_->meet(1, buffers_->point, buffers_->to_eye, true, buffers_->met);
    if (std::isinf(buffers_->met.distance[0])) return {};
    return {buffers_->met.distance[0], buffers_->met.pdf[0]};
  }

 private:
  struct Buffers {
    Vec3Chunk point{}, to_eye{};
    alignas(64) double u[16]{}, v[16]{};  // a whole register is read
    LightSamples drawn;
    LightMeetings met;
  };
  static void put(Vec3 v, Vec3Chunk& to) { to.x[0] = v.x, to.y[0] = v.y, to.z[0] = v.z; }

  std::unique_ptr<const PreparedLight> light_;
  std::unique_ptr<Buffers> buffers_ = std::make_unique<Buffers>();
};

/// The mean of (1, x, y, z, xy, yz, zx) over the light's solid angle, by its own draws and by looking in
/// every direction.
struct Moments {
  double solid_angle = 0, of[6] = {};
  void add(Vec3 d, double weight) {
    solid_angle += weight;
    const double products[] = {d.x, d.y, d.z, d.x * d.y, d.y * d.z, d.z * d.x};
    for (int i = 0; i < 6; ++i) of[i] += weight * products[i];
  }
};

void expect_same_light(const OneByOne& light, Vec3 point, double allowed) {
  constexpr std::uint32_t kDraws = 1 << 14, kLooks = 1 << 21;
  Moments drawn, seen;
  for (std::uint32_t k = 0; k < kDraws; ++k) {
    const auto [u, v] = sobol::pair(1, k, 0);
    const LightDraw s = light.sample(point, u, v);
    if (s.pdf == 0) continue;
    drawn.add(s.to_light, 1 / s.pdf / kDraws);
    EXPECT_NEAR(length(s.to_light), 1, 1e-14);
    const LightHit met = light.meet(point, s.to_light);
    if (met.pdf == 0) continue;  // at the very rim rounding may decide
    EXPECT_NEAR(met.pdf / s.pdf, 1, 1e-9);
    EXPECT_NEAR(met.distance / s.distance, 1, 1e-6);
  }
  for (std::uint32_t k = 0; k < kLooks; ++k) {
    const auto [u, v] = sobol::pair(2, k, 0);
    const Vec3 direction = evenly(u, v);
    if (light.meet(point, direction).pdf > 0) seen.add(direction, 4 * kPi / kLooks);
  }
  EXPECT_NEAR(drawn.solid_angle, seen.solid_angle, allowed);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(drawn.of[i], seen.of[i], allowed) << i;
}

TEST(RectangleLight, DrawsEvenlyFromTheSolidAngleThatItIsSeenUnder) {
  const OneByOne light(RectangleLight{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 1, 1}});
  for (const Vec3 point : {Vec3{0, 0, 1}, {3, 1, 0.2}, {0.3, 0.3, 1e-2}, {-2, 5, 1}, {1, 1, 1}})
    expect_same_light(light, point, 3e-3);
}

TEST(RectangleLight, FarAwayIsItsAreaTimesTheCosine) {
  const OneByOne light(RectangleLight{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 1, 1}});
  for (const double distance : {1e2, 1e4, 1e8}) {
    const Vec3 point = distance * normalize(Vec3{1, 2, 3});
    double sum = 0;
    constexpr std::uint32_t kDraws = 1024;
    for (std::uint32_t k = 0; k < kDraws; ++k) {
      const auto [u, v] = sobol::pair(1, k, 0);
      sum += 1 / light.sample(point, u, v).pdf / kDraws;
    }
    const double expected = 8 * normalize(Vec3{1, 2, 3}).z / (distance * distance);
    EXPECT_NEAR(sum / expected, 1, 2 / distance);
  }
}

TEST(RectangleLight, ShinesToOneSideOnly) {
  const OneByOne light(RectangleLight{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 1, 1}});
  EXPECT_EQ(light.sample({0, 0, -1}, 0.5, 0.5).pdf, 0);
  EXPECT_EQ(light.meet({0, 0, -1}, {0, 0, 1}).pdf, 0);
  EXPECT_GT(light.meet({0, 0, 1}, {0, 0, -1}).pdf, 0);
  EXPECT_EQ(light.sample({0, 0, 0}, 0.5, 0.5).pdf, 0);  // in its plane
}

TEST(SphereLight, DrawsEvenlyFromTheConeThatItFills) {
  const OneByOne light(SphereLight{{0, 1, 0}, 1, {1, 1, 1}});
  for (const Vec3 point : {Vec3{0, 0, 2}, {0, 2.01, 0}, {4, 1, 0}})
    expect_same_light(light, point, 3e-3);
}

TEST(SphereLight, FillsItsSolidAngleAtAnySizeAndDistance) {
  for (const double radius : {1e-9, 1e-3, 1.0, 1e6})
    for (const double ratio : {1 + 1e-9, 1.5, 1e3, 1e7}) {
      const OneByOne light(SphereLight{{0, 0, 0}, radius, {1, 1, 1}});
      const double distance = ratio * radius;
      const LightDraw s = light.sample({distance, 0, 0}, 0.5, 0.25);
      const double sine_squared = 1 / (ratio * ratio);
      const double solid_angle = 2 * kPi * sine_squared / (1 + std::sqrt(1 - sine_squared));
      EXPECT_NEAR(s.pdf * solid_angle, 1, 1e-9) << radius << ' ' << ratio;
      EXPECT_GE(s.distance, (distance - radius) * (1 - 1e-6) - 1e-12);
      EXPECT_LE(s.distance, distance);
    }
}

EnvmapTable with_image(int width, int height, const std::function<float(int, int)>& value,
                       double floor = 0) {
  auto image = std::make_shared<Image>(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (float& c : image->pixel(x, y)) c = value(x, y);
  return {image, {1, 1, 1}, floor};
}

TEST(EnvironmentImage, DrawsOnlyPixelsAboveItsFloor) {
  for (const double floor : {0.0, 0.05, 0.1, 50.0}) {
    const EnvmapTable environment = with_image(
        64, 32,
        [](int x, int y) { return (x == 10 && y == 5) || y == 0 ? 100.0f
                                  : x < 20                      ? 0.1f
                                                                : 0.0f; },
        floor);
    double by_draws = 0, by_looks = 0, density = 0;
    constexpr std::uint32_t kDraws = 1 << 20;
    for (std::uint32_t k = 0; k < kDraws; ++k) {
      const auto [u, v] = sobol::pair(3, k, 0);
      const DirectionSample s = environment.sample(u, v);
      ASSERT_GT(s.pdf, 0);
      const EnvironmentLook there = environment.look(s.to_light);
      ASSERT_NEAR(there.pdf / s.pdf, 1, 1e-6);
      ASSERT_NEAR(there.bright.r / s.radiance.r, 1, 1e-6);
      by_draws += s.radiance.r / s.pdf / kDraws;
      const EnvironmentLook anywhere = environment.look(evenly(u, v));
      by_looks += 4 * kPi / kDraws * anywhere.bright.r;
      density += 4 * kPi / kDraws * anywhere.pdf;
      ASSERT_LE(anywhere.smooth.r, floor * (1 + 1e-9));
      ASSERT_EQ(anywhere.pdf > 0, anywhere.bright.r > 0);
    }
    EXPECT_NEAR(by_draws / by_looks, 1, 2e-3) << floor;
    EXPECT_NEAR(density, 1, 2e-3) << floor;
  }
}

TEST(EnvironmentImage, DrawsInProportionToItsBrightnessBetweenThePixelsToo) {
  // So each draw brings the same light, but for the change of the sine within a pixel.
  const EnvmapTable environment = with_image(256, 128, [](int x, int y) {
    return y < 8 || (x * 7 + y * 3) % 11 < 2 ? float(1 + x % 5) : 0.0f;
  });
  constexpr std::uint32_t kDraws = 20000;
  double mean = 0;
  std::vector<std::pair<double, double>> draws;
  for (std::uint32_t k = 0; k < kDraws; ++k) {
    const auto [u, v] = sobol::pair(5, k, 0);
    const DirectionSample s = environment.sample(u, v);
    draws.push_back({s.to_light.y, s.radiance.r / s.pdf});
    mean += s.radiance.r / s.pdf / kDraws;
  }
  for (const auto& [cosine, light] : draws) {
    if (std::abs(cosine) > 0.97) continue;  // beside a pole it changes a lot
    const double change = kPi / 128 * std::abs(cosine) / std::sqrt(1 - cosine * cosine);
    ASSERT_NEAR(light / mean, 1, 2e-3 + 1.2 * change) << cosine;
  }
}

TEST(EnvironmentImage, MayBeOfOnePixelBlackOrEven) {
  const auto even = [](int, int) { return 2.0f; };
  const EnvmapTable one = with_image(1, 1, even);
  EXPECT_NEAR(one.look({0.6, 0.8, 0}).radiance().g, 2, 1e-6);
  EXPECT_GT(one.sample(0.3, 0.7).pdf, 0);
  for (const EnvmapTable& none :
       {with_image(8, 4, [](int, int) { return 0.0f; }), with_image(8, 4, even, 2)}) {
    EXPECT_TRUE(none.is_black());
    EXPECT_EQ(none.sample(0.3, 0.7).pdf, 0);
    EXPECT_EQ(none.look({0, 1, 0}).pdf, 0);
  }
}

TEST(SmoothLuminance, IsAtMostFourTimesTheMeanBelowIt) {
  const auto smooth = [](const std::function<float(int, int)>& value) {
    return smooth_luminance(*sky(value));
  };
  EXPECT_GT(smooth([](int, int) { return 1.0f; }), 1) << "an even sky has nothing above it";
  EXPECT_GT(smooth([](int, int y) { return y < 16 ? 1.0f : 0.0f; }), 1);
  // A sun does not raise it by more than the light that it sheds on the mean.
  const double with_sun = smooth([](int x, int y) {
    return x == 20 && y == 9 ? 1e6f : y < 16 ? 1.0f : 0.0f;
  });
  EXPECT_GT(with_sun, 1);
  EXPECT_LT(with_sun, 2.2);
  // A patch that fills too little of the sky is drawn as a whole.
  EXPECT_LT(smooth([](int x, int y) { return x < 4 && y == 9 ? 1.0f : 0.0f; }), 1e-3);
}

}  // namespace
}  // namespace lobelia
