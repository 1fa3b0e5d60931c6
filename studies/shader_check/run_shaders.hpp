// Runs shader functions on a real driver, in a process of their own (docs/decisions/0007).
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia {

enum class ShaderApi : std::uint8_t {
  kEgl,     ///< OpenGL without a window: GLSL as fragment shaders
  kVulkan,  ///< GLSL and HLSL as compute shaders, compiled to SPIR-V by glslang
  kWebGpu,  ///< WGSL, in Chromium without a window
};
inline constexpr std::string_view kShaderApiNames[] = {"egl", "vulkan", "webgpu"};

enum class ShaderText : std::uint8_t { kGlsl, kHlsl, kWgsl };
inline constexpr std::string_view kShaderTextNames[] = {"glsl", "hlsl", "wgsl"};

/// "vec3", "float3", "vec3f"
std::string_view vector_type(ShaderText language);

/// A file with functions, and calls of them.
struct ShaderSource {
  ShaderText language = ShaderText::kGlsl;
  std::string name;  ///< of the file, for messages
  std::string text;
  /// Each is an expression of a number or a vector of 3 or 4. It may use the components of a point: component 5 is
  /// shader_component(5).
  std::vector<std::string> calls;
  bool is_own = false;       ///< Lobelia's own: if it fails, the driver is wrong
  std::string prelude = {};  ///< declarations before the text; behind it in WGSL
  std::string setup = {};    ///< statements before the calls
};

/// "lobelia_p1.y" for 5.
std::string shader_component(std::size_t i);

/// Points for which shaders are called: float32 components, point after point.
struct ShaderPoints {
  std::size_t components = 0;  ///< of each point
  std::vector<float> values;
  std::size_t count() const { return components == 0 ? 0 : values.size() / components; }
};

/// The result of a call for one point.
struct ShaderValue {
  float r = 0, g = 0, b = 0;  ///< all the same of a call that gives a number
  bool written = false;       ///< false if the shader ended without a result, such as by `discard`
};

struct ShaderRun {
  std::string device, driver;  ///< as the driver names them
  /// For each source: the values of the first call for all points, then those of the second.
  std::vector<std::vector<ShaderValue>> values;
  std::vector<std::vector<double>>
      seconds;  ///< of each source: for each round, a run of all points
};

/// A program in the form that is run: GLSL for EGL, SPIR-V for Vulkan, WGSL.
struct ShaderProgram {
  std::string name;
  std::string bytes;
  std::size_t first_line = 0, lines = 0;  ///< of the source in the text, for messages
  std::size_t version_line = 0;  ///< of the source's #version in it, from 1; 0: it has none
  bool is_own = false;
};

/// The usual limit, which ends an endless loop.
inline constexpr std::chrono::duration<double> kShaderTimeLimit = std::chrono::seconds(60);

/// A limit on time that begins when it is made. Compilers and drivers that are given the same one share its time.
class TimeLimit {
 public:
  template <class Number, class Unit>
  TimeLimit(std::chrono::duration<Number, Unit> allowed)
      : allowed_(allowed),
        end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(allowed_)) {}
  double seconds() const { return allowed_.count(); }  ///< in all
  /// 0 or less once it is over.
  std::chrono::duration<double> left() const { return end_ - Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  std::chrono::duration<double> allowed_;
  Clock::time_point end_;
};

/// Makes a program for points of that number. Throws Error(kInput), naming file and line, if the text has an #include or
/// glslang refuses it, and naming the file if glslang does not end in time; Error(kEngine) if glslang is missing or
/// crashes. Nothing compiles GLSL for EGL and WGSL before they run.
ShaderProgram make_program(const ShaderSource& source, ShaderApi api, std::size_t points,
                           std::size_t components, const TimeLimit& limit = kShaderTimeLimit);

/// The program with all its float arithmetic in half floats, by spirv-opt; for Vulkan. Throws Error(kInput) if spirv-opt
/// does not end in time, and Error(kEngine) if it is missing, crashes or refuses the program.
ShaderProgram in_half_floats(const ShaderProgram& program,
                             const TimeLimit& limit = kShaderTimeLimit);

/// The number of instructions of the optimised program that compute, compare or branch, by spirv-opt; for Vulkan. Errors
/// as in_half_floats().
std::size_t count_instructions(const ShaderProgram& program,
                               const TimeLimit& limit = kShaderTimeLimit);

struct ShaderRunOptions {
  TimeLimit time_limit = kShaderTimeLimit;
  int rounds = 0;  ///< for `seconds`: each round runs every program once
};

/// Runs programs that were made for these points, by turns. Throws Error(kInput) if the driver refuses a program or one does
/// not end in time, and Error(kEngine) if the program is Lobelia's own, or the runner or a driver is missing or crashes.
ShaderRun run_programs(ShaderApi api, const ShaderPoints& points,
                       const std::vector<ShaderProgram>& programs, std::size_t calls,
                       const ShaderRunOptions& options = {});

}  // namespace lobelia
