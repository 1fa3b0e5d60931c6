// A test that needs a real engine is skipped where there is none, and fails there if the
// environment says LOBELIA_REQUIRE_ENGINES=1.
#pragma once

#include <fmt/format.h>

#include <memory>

#include "reference_scenes/engine.hpp"
#include "tests/test.hpp"

namespace lobelia {

/// To be called from SetUp.
inline void require_engine(Engine& engine) {
  if (engine.status().available()) return;
  const char* required = std::getenv("LOBELIA_REQUIRE_ENGINES");
  const std::string why = fmt::format("{} is needed for this test: {}; {}", engine.info().title,
                                      engine.status().why, engine.info().install_hint);
  if (required && std::string_view(required) == "1") FAIL() << why;
  GTEST_SKIP() << why;
}

/// Tests of the real engine whose name is the parameter.
class WithRealEngine : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    engine_ = make_engine(GetParam(), {});
    require_engine(*engine_);
  }
  std::unique_ptr<Engine> engine_;
};

}  // namespace lobelia
