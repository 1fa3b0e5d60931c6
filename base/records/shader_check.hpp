// The findings of `lobelia check-shader` on a shader function.
#pragma once

#include "base/records/cost.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

inline constexpr std::string_view kShaderVerdicts[] = {"passes", "differs"};
inline constexpr std::string_view kShaderBindings[] = {"set", "name", "trial", "own value",
                                                       "result"};
inline constexpr std::string_view kShaderApis[] = {"egl", "vulkan", "webgpu"};

/// A call of the function.
struct ShaderPlace {
  double exponent = 0, n_dot_l = 0, n_dot_v = 0, lobe_degrees = 0, value = 0, expected = 0;
};

struct ShaderError {
  double exponent = 0, max_of_peak = 0, allowed_of_peak = 0;
  ShaderPlace place;
};

struct ShaderFactor {
  double exponent = 0, factor = 0;
};

struct ShaderExplanation {
  std::vector<std::string> mistakes;
  std::string sentence;
  bool complete = false;
  double left_of_peak = 0;
  std::vector<ShaderFactor> factors;
};

struct ShaderEnergy {
  double exponent = 0, incidence_degrees = 0, energy = 0, of_model = 0;
};

/// Numbers of calls.
struct ShaderOddities {
  std::size_t calls = 0, nan = 0, infinite = 0, negative = 0, outside_support = 0, unwritten = 0,
              coloured = 0;
  std::optional<ShaderPlace> first_nonfinite, first_outside;
  std::size_t hard_calls = 0, hard_nonfinite = 0;
  std::size_t below_calls = 0, below_nonfinite = 0, below_lit = 0;
};

struct ShaderHalf {
  double exponent = 0, max_of_peak = 0;
  std::size_t nonfinite = 0;
};

struct ShaderCost {
  std::string name;
  std::optional<std::size_t> instructions;
};

/// A variable or a part of it, and where its value is from.
struct ShaderBinding {
  std::string name, type, value, by;
};

struct ShaderCheck {
  std::vector<std::string> command;
  std::string file, sha256, language, function, arguments;
  std::string model, lobe, normalisation;
  bool model_found = false;
  std::vector<ShaderBinding> bindings;
  std::string api, device, driver;
  std::string verdict;
  std::vector<ShaderError> errors;
  std::optional<ShaderExplanation> explanation;
  std::vector<ShaderEnergy> energy;
  ShaderOddities oddities;
  std::vector<ShaderHalf> half_floats;
  std::vector<ShaderCost> costs;
  std::vector<std::string> remarks;
};

void define_shader_check_tables(Tables& tables);

}  // namespace lobelia::records
