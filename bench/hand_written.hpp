// The head-on picture with cs16 by a loop written for it alone: a unit sphere before an eye on its axis, lit from the eye.
// The renderer's own kernel is compared with it. There is one source file for each instruction set.
#pragma once

#include <vector>

namespace lobelia::bench {

/// The picture and its numbers; coordinates of the film are in units of the distance 1 before the eye.
struct HandWrittenPicture {
  int side = 0;
  double half_width = 0;          ///< of the film
  double distance = 5;            ///< of the eye from the sphere's centre
  double slope = 0, peak = 0;     ///< peak (1 - slope s)^16
  double lit_radius_squared = 0;  ///< on the film; beyond it is black
  float* rgb = nullptr;
};

namespace avx2 {
void render(const HandWrittenPicture& picture);
}  // namespace avx2
namespace avx512 {
void render(const HandWrittenPicture& picture);
}  // namespace avx512

class HandWritten {
 public:
  enum class Set { kAvx2, kAvx512 };
  /// Throws std::runtime_error if its picture is not the renderer's.
  HandWritten(Set set, int side);
  double seconds();

 private:
  Set set_;
  std::vector<float> rgb_;
  HandWrittenPicture picture_;
};

}  // namespace lobelia::bench
