// Vectors as the kernels take them, and what they truly point to.
#pragma once

#include <algorithm>
#include <cmath>

#include "renderer/kernels/kernels.hpp"
#include "verify/stability/long_double.hpp"

namespace lobelia::stability {

inline constexpr int kHalvings = 64;  ///< that |L + V| may be below 1

struct Chunk {
  Triple directions[kChunk];
  Vec3Chunk normal{}, to_eye{}, to_light{};
  long double s[kChunk], n_dot_l[kChunk];
  int halvings[kChunk];

  template <class Draw>
  void fill(LobeAngle angle, Draw draw) {
    for (std::size_t i = 0; i < kChunk; ++i) {
      directions[i] = draw();
      const ScreenedVectors v = screen(angle, directions[i]);
      const auto put = [i](Vec3Chunk& to, Vec3 a) { to.x[i] = a.x, to.y[i] = a.y, to.z[i] = a.z; };
      put(normal, v.normal), put(to_eye, v.to_eye), put(to_light, v.to_light);
      s[i] = v.s, n_dot_l[i] = v.n_dot_l;
      halvings[i] = std::clamp(-std::ilogb(v.half_length), 0, kHalvings - 1);
    }
  }
};

}  // namespace lobelia::stability
