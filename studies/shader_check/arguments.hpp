// The arguments that a shader function may take, by their names: what --arguments says.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/highlight.hpp"
#include "studies/shader_check/points.hpp"
#include "studies/shader_check/run_shaders.hpp"

namespace lobelia::shader_check {

struct ArgumentInfo {
  std::string_view name, meaning;
  int components = 1;
};
/// "N", "V", ..., for the help and docs/check_shader.md. A number such as 1.5 is an argument too.
std::span<const ArgumentInfo> argument_infos();

class Arguments {
 public:
  /// From "N,V,-L,n". Throws Error(kUsage) that names an unknown argument and what is allowed.
  Arguments(const std::string& list, const Highlight& highlight);

  /// The points' components: first those that common_vectors() and the like name, then those of this list.
  ShaderPoints of(const std::vector<Point>& points) const;
  /// "myHighlight(vec3(lobelia_p0.x, ...), ...)"
  std::string call(std::string_view function, ShaderText language) const;
  /// Whether a function with them can know the exponent only through a roughness.
  bool is_of_roughness() const;

 private:
  std::size_t components() const;
  struct Given {
    std::size_t info = 0;
    bool negative = false;
    double number = 0;  ///< if `info` is past the last
  };
  std::vector<Given> given_;
  Highlight highlight_;
};

/// Calls of functions that take the common components.
std::string common_vectors(ShaderText language);  ///< "vec3(...), vec3(...), vec3(...)": N, V, L
std::string common_exponent();
std::string common_coefficient();

}  // namespace lobelia::shader_check
