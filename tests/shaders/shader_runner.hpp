// For tests that run shaders: they are skipped where nothing does.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

#include "core/error.hpp"
#include "shaders/run_shaders.hpp"

namespace lobelia {

class NeedsShaderRunner : public testing::Test {
 protected:
  void SetUp() override {
    for (const ShaderApi api : {ShaderApi::kEgl, ShaderApi::kVulkan}) {
      try {
        const ShaderSource source{ShaderText::kGlsl, "probe", "", {"vec3(0.0)"}};
        const ShaderPoints point{1, {0}};
        run_programs(api, point, {make_program(source, api, 1, 1)}, 1);
      } catch (const Error& error) {
        const char* required = std::getenv("LOBELIA_REQUIRE_ENGINES");
        if (required && std::string_view(required) == "1") FAIL() << error.what();
        GTEST_SKIP() << error.what();
      }
    }
  }
};

}  // namespace lobelia
