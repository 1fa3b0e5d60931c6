// The protocol between the program and lobelia_shader_runner.
//
//   lobelia_shader_runner egl|vulkan TOKEN POINTS TEXELS OUTPUTS ROUNDS PROGRAM...
//
// runs in a directory of its own. The file "points" there has POINTS times TEXELS times four floats. Each PROGRAM is a
// file: a fragment shader for EGL, SPIR-V of a compute shader for Vulkan. Invocation i works on point i % POINTS and
// output i / POINTS, and writes four floats to PROGRAM.out, the last of them 1. With ROUNDS, all programs are run by
// turns, and "seconds K S" is printed for each run of program K. "device NAME" and "driver VERSION" come first, and "program K"
// before program K is compiled and before it is run. TOKEN and a blank precede each of these lines. Other lines are a compiler's or a driver's: they may quote the shader.
#pragma once

#include <cstddef>

namespace lobelia {

inline constexpr char kShaderRunnerFile[] = "lobelia_shader_runner";
inline constexpr char kPointsFile[] = "points";
inline constexpr char kDeviceLine[] = "device ", kDriverLine[] = "driver ";
inline constexpr char kProgramLine[] = "program ", kSecondsLine[] = "seconds ";

enum RunnerExit : int {
  kRunnerDone = 0,
  kRunnerRefusedProgram = 3,  ///< it prints the compiler's log
  kRunnerNoDevice = 5,
  kRunnerBroken = 70,
};

/// Width of EGL's textures: of the points and of the results.
inline constexpr std::size_t kRunnerWidth = 1024;
/// Most invocations of a program, and most texels of all points: what every driver's textures and buffers can have.
inline constexpr std::size_t kMostInvocations = kRunnerWidth * 8192;
/// A work group of Vulkan, and the groups in a row of the dispatch.
inline constexpr std::size_t kGroupSize = 64, kGroupsInRow = 32768;

}  // namespace lobelia
