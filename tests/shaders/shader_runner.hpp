// For tests that run shaders: they are skipped where nothing does.
#pragma once

#include "base/system/error.hpp"
#include "studies/shader_check/run_shaders.hpp"
#include "tests/test.hpp"

namespace lobelia {

/// Skips a test unless shaders of the language run, or fails it with LOBELIA_REQUIRE_ENGINES=1.
inline void require_shaders(ShaderText language, ShaderApi api) {
  try {
    const std::string zero = std::string(vector_type(language)) + "(0.0)";
    run_programs(api, {1, {0}}, {make_program({language, "probe", "", {zero}}, api, 1, 1)}, 1);
  } catch (const Error& error) {
    const char* required = std::getenv("LOBELIA_REQUIRE_ENGINES");
    if (required && std::string_view(required) == "1") FAIL() << error.what();
    GTEST_SKIP() << error.what();
  }
}

class NeedsShaderRunner : public testing::Test {
 protected:
  void SetUp() override {
    require_shaders(ShaderText::kGlsl, ShaderApi::kEgl);
    if (!IsSkipped()) require_shaders(ShaderText::kHlsl, ShaderApi::kVulkan);
  }
};

class NeedsWebGpu : public testing::Test {
 protected:
  void SetUp() override { require_shaders(ShaderText::kWgsl, ShaderApi::kWebGpu); }
};

}  // namespace lobelia
