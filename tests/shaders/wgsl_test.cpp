// The exported WGSL, run by Chromium's WebGPU, against the formulas in 50 digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "core/files.hpp"
#include "core/process.hpp"
#include "lobelia_paths.hpp"
#include "tests/shaders/export_values.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFloatsOfPoint = 10;

/// Several exports in one text, as somebody puts them together in a language without a preprocessor: each function
/// once.
class Module {
 public:
  explicit Module(const std::vector<ShaderExport>& requests) : outputs_(outputs_of(requests)) {
    for (const ShaderExport& request : requests) add(request);
  }
  const std::vector<ExportOutput>& outputs() const { return outputs_; }

  /// With a `main` that calls every function.
  std::string text(const std::vector<CalledPoint>& points) const {
    std::string given, calls;
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      const ExportOutput& output = outputs_[k];
      for (const double n : kRunExponents)
        given += fmt::format("{:.9g}, ", truth::coefficient(output.highlight(n)));
      const std::string call =
          output.is_coefficient
              ? coefficient_name_of(output.request, output.model) + "(exponent)"
              : call_of(output.request, output.model, "normal, to_eye, to_light", "exponent",
                        fmt::format("coefficients[{} + of_exponent]", k * std::size(kRunExponents)),
                        fmt::format("vec3f({}, {}, {})", kReflectance.r, kReflectance.g,
                                    kReflectance.b));
      calls += fmt::format("    put({}, i, vec3f({}));\n", k, call);
    }
    return functions_ + fmt::format(
                            "\n@group(0) @binding(0) var<storage, read> points: array<f32>;\n"
                            "@group(0) @binding(1) var<storage, read_write> results: array<f32>;\n"
                            "var<private> coefficients = array<f32, {0}>({1});\n"
                            "fn vector(at: u32) -> vec3f\n"
                            "{{ return vec3f(points[at], points[at + 1], points[at + 2]); }}\n"
                            "fn put(k: u32, i: u32, c: vec3f)\n"
                            "{{ for (var j = 0u; j < 3u; j++) "
                            "{{ results[3 * ({2} * k + i) + j] = c[j]; }} }}\n"
                            "@compute @workgroup_size(64)\n"
                            "fn main(@builtin(global_invocation_id) id: vec3u)\n"
                            "{{\n"
                            "    let i = id.x;\n"
                            "    if (i >= {2}) {{ return; }}\n"
                            "    let of_exponent = i / {3};\n"
                            "    let normal = vector({4} * i);\n"
                            "    let to_eye = vector({4} * i + 3);\n"
                            "    let to_light = vector({4} * i + 6);\n"
                            "    let exponent = points[{4} * i + 9];\n"
                            "{5}}}\n",
                            outputs_.size() * std::size(kRunExponents), given, points.size(),
                            points.size() / std::size(kRunExponents), kFloatsOfPoint, calls);
  }

 private:
  void add(const ShaderExport& request) {
    const std::string text = shader_text(request);
    for (std::size_t at = text.find("\n\n"); at != std::string::npos;
         at = text.find("\n\n", at + 1)) {
      const std::size_t end = std::min(text.find("\n}\n", at), text.size() - 3) + 3;
      add_function(text.substr(at, end - at));
      at = end - 2;
    }
  }
  void add_function(const std::string& function) {
    const std::size_t name = function.find("\nfn ");
    if (name == std::string::npos) return;
    const auto [known, is_new] =
        known_.try_emplace(function.substr(name, function.find('(', name) - name), function);
    if (is_new) functions_ += function;
    EXPECT_EQ(known->second, function) << "functions of one name differ";
  }

  std::map<std::string, std::string> known_;
  std::string functions_;
  std::vector<ExportOutput> outputs_;
};

class RunByWebGpu : public testing::Test {
 protected:
  void SetUp() override {
    const bool required = is_set("LOBELIA_REQUIRE_ENGINES");
    for (const char* program : {"node", "chromium"})
      if (find_program(program).empty())
        return lack(fmt::format("no program '{}'", program), required);
    // From npm, which is not always to be reached.
    if (!fs::exists(kRoot / "gallery/web/node_modules/playwright-core"))
      lack("gallery/web/node_modules is not there: scripts/web fetches it",
           is_set("LOBELIA_REQUIRE_WEB"));
  }

  static bool is_set(const char* variable) {
    const char* value = std::getenv(variable);
    return value && std::string_view(value) == "1";
  }
  void lack(const std::string& what, bool required) {
    if (required) FAIL() << what;
    GTEST_SKIP() << what;
  }

  /// The output of each shader, in one run of the browser; nothing if that has no WebGPU.
  std::vector<std::vector<float>> run(const std::vector<CalledPoint>& points,
                                      const std::vector<std::string>& shaders, std::size_t floats) {
    std::vector<float> input;
    for (const CalledPoint& p : points) {
      for (const Vec3 v : {p.directions.normal, p.directions.to_eye, p.directions.to_light})
        input.insert(input.end(), {float(v.x), float(v.y), float(v.z)});
      input.push_back(float(p.exponent));
    }
    write_file(scratch_.path() / "points",
               std::string_view(reinterpret_cast<const char*>(input.data()), 4 * input.size()));
    std::vector<std::string> command{find_program("node").string(),
                                     (kRoot / "tests/shaders/webgpu.mjs").string(), "points",
                                     std::to_string(points.size()), std::to_string(floats)};
    for (const std::string& shader : shaders) {
      command.push_back(fmt::format("{}.wgsl", command.size()));
      write_file(scratch_.path() / command.back(), shader);
    }
    ProcessOptions options;
    options.working_directory = scratch_.path();
    const ProcessResult result = run_process(command, options);
    said_ = result.output_tail;
    if (result.exit_code == 77) lack("Chromium has no WebGPU", is_set("LOBELIA_REQUIRE_ENGINES"));
    if (result.exit_code != 0) return {};
    std::vector<std::vector<float>> outputs;
    for (std::size_t i = 0; i < shaders.size(); ++i) {
      const std::string bytes = read_file(
          scratch_.path() / (command[command.size() - shaders.size() + i] + ".out"), 1 << 26);
      std::vector<float>& values = outputs.emplace_back(bytes.size() / 4);
      std::memcpy(values.data(), bytes.data(), bytes.size());
    }
    return outputs;
  }

  inline static const fs::path kRoot = LOBELIA_SOURCE_DIR;
  TemporaryDirectory scratch_;
  std::string said_;  ///< by the last run
};

TEST_F(RunByWebGpu, EveryFunctionHasTheRadianceOfTheFormulas) {
  const std::vector<CalledPoint> points = called_points();
  std::vector<Module> modules;
  std::vector<std::string> texts;
  std::size_t most = 0;
  for (const auto& requests : exports_to_run("wgsl")) {
    texts.push_back(modules.emplace_back(requests).text(points));
    most = std::max(most, modules.back().outputs().size());
  }
  const auto results = run(points, texts, 3 * most * points.size());
  if (IsSkipped() || HasFatalFailure()) return;
  ASSERT_EQ(results.size(), modules.size()) << said_;

  ExportJudge judge(points);
  for (std::size_t m = 0; m < modules.size(); ++m) {
    const std::vector<ExportOutput>& outputs = modules[m].outputs();
    for (std::size_t k = 0; k < outputs.size(); ++k)
      for (std::size_t i = 0; i < points.size(); ++i) {
        const float* colour = &results[m][3 * (k * points.size() + i)];
        ASSERT_NO_FATAL_FAILURE(judge.add(outputs[k], i, {colour[0], colour[1], colour[2]}));
      }
  }
  judge.expect_as_documented("wgsl");
}

TEST_F(RunByWebGpu, AMistakeWouldBeSeen) {
  std::string text = shader_text(every_export("wgsl").front());
  text.replace(text.find("n_dot_l > 0.0"), 1, "m");
  EXPECT_TRUE(run({}, {text}, 64).empty());
  if (IsSkipped()) return;
  EXPECT_NE(said_.find("m_dot_l"), std::string::npos) << said_;
}

}  // namespace
}  // namespace lobelia
