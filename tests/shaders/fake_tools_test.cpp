// Compilers and a browser, pretended by shell scripts: what becomes of the ones that hang, crash or quote a shader.
#include <fmt/format.h>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/base64.hpp"
#include "studies/shader_check/run_shaders.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

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
    for (const char* name : {"bin", "tmp", "home"}) fs::create_directory(in(name));
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
  static ShaderRun run_in_the_browser() {
    ShaderProgram program;
    program.name = "mine.wgsl";
    return run_programs(ShaderApi::kWebGpu, {1, {0}}, {program}, 1, {std::chrono::hours(1), 0});
  }

 private:
  const TemporaryDirectory directory_;
  const ChangedVariable path_{"PATH", in("bin").string() + ":/usr/bin:/bin"},
      temporary_{"TMPDIR", in("tmp").string()}, home_{"HOME", in("home").string()};
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

TEST_F(FakeShaderTools, TellACrashFromARefusal) {
  fake("glslangValidator", "kill -SEGV $$");
  EXPECT_EQ(compile(std::chrono::hours(1)),
            "5: mine.hlsl: glslangValidator was ended by signal 11");
}

/// The console of Chromium: a line for each call of `say`.
constexpr char kConsole[] =
    "for page; do :; done\n"
    "say() { echo \"[1:1:INFO:CONSOLE(1)] \\\"$*\\\", source: file://$page (1)\" >&2; }\n";

/// The console's lines for one invocation that gives `value`, each after `word`.
std::string said_by(const std::string& word, const std::string& device, float value) {
  const float result[] = {value, 0, 0, 1};
  return fmt::format("say {0} device {1}\nsay {0} values 0 {2}\nsay {0} done\n", word,
                     base64(device),
                     base64({reinterpret_cast<const char*>(result), sizeof result}));
}

TEST_F(FakeShaderTools, ATextThatTheBrowserQuotesIsNotTakenForAResult) {
  const std::string forged = said_by("lobelia", "FORGED", 2) + said_by("$(printf %032d 0)", "0", 3);
  fake("chromium", kConsole + forged);
  EXPECT_EQ(failure_of(run_in_the_browser),
            "5: mine.wgsl: Chromium ended with exit code 0 while it ran the shader");
  fake("chromium", kConsole + forged +
                       "token=$(sed -n \"s/.*token: '\\([0-9a-f]*\\)'.*/\\1/p\" \"$page\")\n" +
                       said_by("$token", "REAL", 4) + "exec sleep 10000");
  const ShaderRun run = run_in_the_browser();
  EXPECT_EQ(run.device, "REAL");
  EXPECT_EQ(run.values.front().front().r, 4.0f);
}

TEST_F(FakeShaderTools, ABrowsersLeftoversAreRemoved) {
  fake(
      "chromium",
      "mkdir -p \"$TMPDIR/org.chromium.Chromium.x\" \"${XDG_CONFIG_HOME:-$HOME/.config}/chromium\" "
      "\"${XDG_CACHE_HOME:-$HOME/.cache}/dconf\" && exit 7");
  EXPECT_EQ(failure_of(run_in_the_browser),
            "5: mine.wgsl: Chromium ended with exit code 7 while it ran the shader");
  EXPECT_TRUE(fs::is_empty(in("tmp")));
  EXPECT_TRUE(fs::is_empty(in("home")));
}

}  // namespace
}  // namespace lobelia
