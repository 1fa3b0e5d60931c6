// Compilers, pretended by shell scripts: what becomes of the ones that hang or crash.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "core/error.hpp"
#include "core/files.hpp"
#include "shaders/run_shaders.hpp"
#include "tests/cli/run_lobelia.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

/// Another value of an environment variable while it lives.
class ChangedVariable {
 public:
  ChangedVariable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~ChangedVariable() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
  ChangedVariable(const ChangedVariable&) = delete;
  ChangedVariable& operator=(const ChangedVariable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

class FakeShaderTools : public testing::Test {
 protected:
  FakeShaderTools() {
    for (const char* name : {"bin", "home"}) fs::create_directory(in(name));
  }
  fs::path in(const char* name) const { return directory_.path() / name; }
  void fake(const char* name, const std::string& body) const {
    const fs::path file = in("bin") / name;
    write_file(file, "#!/bin/sh\n" + body + "\n");
    fs::permissions(file, fs::perms::owner_all);
  }
  /// Its code and message, if the call fails.
  template <class Call>
  static std::string failure_of(Call call) {
    try {
      call();
    } catch (const Error& error) {
      return fmt::format("{}: {}", int(error.code()), error.what());
    }
    return "";
  }
  static std::string compile(const TimeLimit& limit) {
    return failure_of([&] {
      make_program({ShaderText::kHlsl, "mine.hlsl", "", {"0.0"}}, ShaderApi::kVulkan, 1, 1, limit);
    });
  }

 private:
  const TemporaryDirectory directory_;
  const ChangedVariable path_{"PATH", in("bin").string() + ":/usr/bin:/bin"};
};

TEST_F(FakeShaderTools, ACompilerThatDoesNotEndIsEndedByTheTimeLimit) {
  const std::chrono::milliseconds limit(200);
  fake("glslangValidator", "exec sleep 10000");
  EXPECT_EQ(compile(limit), "3: mine.hlsl: glslangValidator did not end within 0.2 s");
  fake("spirv-opt", "exec sleep 10000");
  ShaderProgram program;
  program.name = "mine.hlsl";
  EXPECT_EQ(failure_of([&] { count_instructions(program, limit); }),
            "3: mine.hlsl: spirv-opt did not end within 0.2 s");
  EXPECT_EQ(failure_of([&] { in_half_floats(program, limit); }),
            "3: mine.hlsl: spirv-opt did not end within 0.2 s");
}

TEST_F(FakeShaderTools, TheCommandsTimeLimitIsThatOfItsCompilersToo) {
  fake("glslangValidator", "exec sleep 10000");
  write_file(in("home") / "mine.hlsl", "float f(float n) { return n; }\n");
  expect_one_line(run_lobelia({"check-shader", "mine.hlsl", "--function", "f", "--arguments", "n",
                               "--model", "phong_rdf", "--time-limit", "0.2"},
                              in("home")),
                  3, "mine.hlsl: glslangValidator did not end within 0.2 s");
}

TEST_F(FakeShaderTools, NoCompilerIsStartedOnceTheSharedTimeIsOver) {
  fake("glslangValidator", "echo SPIR-V > out");
  EXPECT_EQ(compile(std::chrono::hours(1)), "");
  EXPECT_EQ(compile(std::chrono::seconds(0)),
            "3: mine.hlsl: glslangValidator did not end within 0 s");
}

TEST_F(FakeShaderTools, ACompilerThatCrashesIsNotTakenForOneThatRefuses) {
  fake("glslangValidator", "kill -SEGV $$");
  EXPECT_EQ(compile(std::chrono::hours(1)),
            "5: mine.hlsl: glslangValidator was ended by signal 11");
}

}  // namespace
}  // namespace lobelia
