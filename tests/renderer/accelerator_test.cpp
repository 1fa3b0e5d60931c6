#include "renderer/accelerator.hpp"

#include "renderer/chord.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

struct Crowd {
  std::vector<Sphere> spheres;
  std::mt19937_64 random{1};
  double even() { return double(random() >> 11) * 0x1p-52 - 1; }  // in [-1, 1)
  Vec3 vector() { return {even(), even(), even()}; }
};

/// The loop that the accelerator stands for.
Accelerator::Hit nearest(const Crowd& crowd, Vec3 origin, Vec3 direction, int leaves) {
  Accelerator::Hit best{-1, 0};
  for (int k = 0; k < int(crowd.spheres.size()); ++k) {
    const Chord chord = chord_of(crowd.spheres[std::size_t(k)], origin, direction);
    if (k == leaves || !(chord.half_squared > 0 && chord.entry() > 0)) continue;
    if (!is_outside(crowd.spheres[std::size_t(k)], origin)) continue;
    if (best.sphere < 0 || chord.entry() < best.distance) best = {k, chord.entry()};
  }
  return best;
}

bool blocked(const Crowd& crowd, Vec3 point, Vec3 to_light, double distance, int leaves) {
  for (int k = 0; k < int(crowd.spheres.size()); ++k) {
    const Sphere& s = crowd.spheres[std::size_t(k)];
    if (k != leaves && blocks(s, inner_radius(s), point, to_light, distance)) return true;
  }
  return false;
}

TEST(Accelerator, AnswersAsALoopOverAllSpheresBitForBit) {
  int hits = 0, hidden = 0;
  for (const double scale : {1.0, 1e6, 1e-6})
    for (const double away : {0.0, 1e7}) {
      Crowd crowd;
      const Vec3 middle{away * scale, 0, 0};
      for (int i = 0; i < 500; ++i)
        crowd.spheres.push_back({middle + scale * crowd.vector(),
                                 scale * std::pow(10, -2 + std::abs(crowd.even())) * 0.5, 0});
      const Accelerator accelerator(crowd.spheres);
      for (int ray = 0; ray < 4000; ++ray) {
        const bool from_surface = ray % 2;
        const int leaves = from_surface ? int(crowd.random() % crowd.spheres.size()) : -1;
        Vec3 origin = middle + scale * Vec3{5 * crowd.even(), 5 * crowd.even(), 1e3 * crowd.even()};
        Vec3 direction = normalize(middle + scale * crowd.vector() - origin);
        if (from_surface) {
          const Sphere& s = crowd.spheres[std::size_t(leaves)];
          origin = s.center + s.radius * normalize(crowd.vector());
          direction = normalize(crowd.vector());
        }
        const auto expected = nearest(crowd, origin, direction, leaves);
        const auto found = accelerator.nearest(origin, direction, leaves);
        ASSERT_EQ(found.sphere, expected.sphere);
        if (expected.sphere >= 0) {
          ASSERT_EQ(found.distance, expected.distance);
        }
        hits += expected.sphere >= 0;
        const double distance = scale * std::abs(crowd.even());
        const bool in_the_way = blocked(crowd, origin, direction, distance, leaves);
        ASSERT_EQ(accelerator.blocked(origin, direction, distance, leaves), in_the_way);
        hidden += in_the_way;
      }
    }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(hidden, 200);
}

}  // namespace
}  // namespace lobelia
