// Apart from base/pictures/colour.cpp, because what reads scenes needs no OpenColorIO.
#include <cmath>

#include "base/pictures/colour.hpp"

namespace lobelia {

float srgb_decoded(float value) {
  // In float32 and not by OpenColorIO, whose approximate power differs in the last bit: FLIP takes a root of such
  // differences, and would be off its published values by 4e-5.
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

double srgb_encoded(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace lobelia
