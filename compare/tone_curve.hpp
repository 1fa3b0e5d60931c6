// How light comes to fit into what a display shows, for rows of values.
#pragma once

#include <cstddef>

namespace lobelia {

/// out[i] = gain * in[i], computed in double, clipped to [0, 1] and rounded.
void clip_values(double gain, const float* in, float* out, std::size_t count);

/// K. Narkowicz's fit of the ACES reference curve, 2015, for 0.6 times the light:
/// (c0 x^2 + c1 x + c2) / (c3 x^2 + c4 x + c5), with NVIDIA's FLIP tool's constants and their roundings.
inline constexpr float kAces[6] = {0.6f * 0.6f * 2.51f, 0.6f * 0.03f, 0.0f,
                                   0.6f * 0.6f * 2.43f, 0.6f * 0.59f, 0.14f};

/// That of gain * in[i], clipped to [0, 1], in float32 and the tool's order of operations. What is below 0 is
/// black; what is so bright that its square is infinite is white.
void aces_values(float gain, const float* in, float* out, std::size_t count);

}  // namespace lobelia
