// The exported WGSL, run by Chromium's WebGPU, against the formulas in 50 digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <tuple>

#include "core/files.hpp"
#include "core/process.hpp"
#include "lobelia_paths.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/fresnel.hpp"
#include "tests/shaders/directions.hpp"
#include "tests/shaders/exports.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

constexpr double kExponents[] = {1, 10, 100, 1000, 1e4, 1e6};
constexpr Rgb kReflectance{0.04, 0.5, 1};
constexpr std::size_t kRandom = 140, kFloatsOfPoint = 10;

/// As the shader has them: in float32.
Directions rounded(const Directions& d) {
  const auto to_float = [](Vec3 v) { return Vec3{float(v.x), float(v.y), float(v.z)}; };
  return {to_float(d.normal), to_float(d.to_eye), to_float(d.to_light)};
}

/// Where a quotient, a root or a logarithm might have no value, or no finite one.
std::vector<Directions> hard_directions() {
  const Vec3 up{0, 0, 1}, x{1, 0, 0}, high{0.6, 0, 0.8};
  const Vec3 low = normalize({0.6, 0.3, -0.01}), grazing = normalize({1, 0, 1e-7});
  return {{up, up, up},      {up, high, high},  {up, high, {-0.6, 0, 0.8}},
          {up, -high, high}, {up, -x, x},       {up, grazing, grazing},
          {up, x, x},        {up, high, -up},   {up, high, low},
          {up, high, x},     {up, -up, up},     {up, normalize({-1, 0, 1e-7}), grazing},
          {up, up, grazing}, {up, grazing, up}, {high, high, high},
          {low, low, low},   {up, low, high},   {up, {0, 0, 0}, {0, 0, 0}}};
}

struct Point {
  Directions directions;
  double exponent;
  bool is_hard;
};
std::vector<Point> all_points() {
  std::vector<Point> points;
  for (const double n : kExponents) {
    RandomDirections random(n);
    for (std::size_t i = 0; i < kRandom; ++i) points.push_back({rounded(random()), n, false});
    for (const Directions& d : hard_directions()) points.push_back({rounded(d), n, true});
  }
  return points;
}

/// A colour for each point.
struct Output {
  ShaderExport request;
  ModelId model;
  bool is_coefficient;
  Highlight highlight(double exponent) const {
    return {model, request.lobe, request.normalisation, exponent};
  }
};

/// Several exports in one text, as somebody puts them together in a language without a preprocessor: each function
/// once.
class Module {
 public:
  void add(const ShaderExport& request) {
    const std::string text = shader_text(request);
    for (std::size_t at = text.find("\n\n"); at != std::string::npos;
         at = text.find("\n\n", at + 1)) {
      const std::size_t end = std::min(text.find("\n}\n", at), text.size() - 3) + 3;
      add_function(text.substr(at, end - at));
      at = end - 2;
    }
    for (const ModelId model : request.models) outputs_.push_back({request, model, false});
    // They are the same with the Fresnel factor and where the function calls them itself.
    if (request.coefficient != CoefficientFrom::kArgument || request.fresnel != Fresnel::kNone)
      return;
    for (const ModelId model : request.models)
      if (!coefficient_name_of(request, model).empty()) outputs_.push_back({request, model, true});
  }

  const std::vector<Output>& outputs() const { return outputs_; }

  /// With a `main` that calls every function.
  std::string text(const std::vector<Point>& points) const {
    std::string given, calls;
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      const Output& output = outputs_[k];
      for (const double n : kExponents)
        given += fmt::format("{:.9g}, ", truth::coefficient(output.highlight(n)));
      const std::string call =
          output.is_coefficient
              ? coefficient_name_of(output.request, output.model) + "(exponent)"
              : call_of(output.request, output.model, "normal, to_eye, to_light", "exponent",
                        fmt::format("coefficients[{} + of_exponent]", k * std::size(kExponents)),
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
                            outputs_.size() * std::size(kExponents), given, points.size(),
                            points.size() / std::size(kExponents), kFloatsOfPoint, calls);
  }

 private:
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
  std::vector<Output> outputs_;
};

/// For each lobe one module with the coefficients computed or fixed, and one with them as arguments: the functions of
/// both have the same names.
std::vector<Module> all_modules() {
  std::vector<Module> modules;
  for (const LobeId& lobe : every_lobe())
    for (const auto from : {CoefficientFrom::kComputed, CoefficientFrom::kArgument}) {
      Module& module = modules.emplace_back();
      for (const Normalisation normalisation : {Normalisation::kExact, Normalisation::kPaper})
        for (const Fresnel fresnel : {Fresnel::kNone, Fresnel::kSchlick}) {
          if (normalisation == Normalisation::kPaper && !has_paper_coefficient(lobe)) continue;
          ShaderExport request{*find_shader_language("wgsl"),
                               {all_models().begin(), all_models().end()},
                               lobe,
                               normalisation,
                               {},
                               from,
                               fresnel};
          const bool closed_form = can_be_made(request);
          if (closed_form) module.add(request);
          if (from == CoefficientFrom::kArgument) continue;
          for (const double n : kExponents) {
            if (n != 100 && (closed_form || fresnel != Fresnel::kNone)) continue;
            request.exponent = n;
            module.add(request);
          }
        }
    }
  return modules;
}

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
  std::vector<std::vector<float>> run(const std::vector<Point>& points,
                                      const std::vector<std::string>& shaders, std::size_t floats) {
    std::vector<float> input;
    for (const Point& p : points) {
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

/// truth::shape, once for all functions of a model and a lobe.
class Shapes {
 public:
  explicit Shapes(const std::vector<Point>& points) : points_(points) {}
  double at(const Highlight& highlight, std::size_t i) {
    auto& known = of_[{highlight.model.index, highlight.lobe.index, highlight.lobe.order}];
    known.resize(points_.size(), -1);
    if (known[i] < 0) {
      const Directions& d = points_[i].directions;
      Highlight here = highlight;
      here.exponent = points_[i].exponent;
      known[i] = truth::shape(here, d.normal, d.to_eye, d.to_light);
    }
    return known[i];
  }

 private:
  const std::vector<Point>& points_;
  std::map<std::tuple<int, int, int>, std::vector<double>> of_;
};

/// Where the value jumps: a rounding decides on which side float32 is.
bool is_at_an_edge(ModelId model, const Directions& d) {
  const double n_dot_l = dot(d.normal, d.to_light);
  const double cosine = info(model).angle == LobeAngle::kReflection
                            ? 2 * dot(d.normal, d.to_eye) * n_dot_l - dot(d.to_eye, d.to_light)
                            : dot(d.normal, normalize(d.to_eye + d.to_light));
  return std::abs(n_dot_l) < 1e-6 || std::abs(cosine) < 1e-5;
}

TEST_F(RunByWebGpu, EveryFunctionHasTheRadianceOfTheFormulas) {
  const std::vector<Point> points = all_points();
  const std::vector<Module> modules = all_modules();
  std::vector<std::string> texts;
  std::size_t most = 0;
  for (const Module& module : modules) {
    texts.push_back(module.text(points));
    most = std::max(most, module.outputs().size());
  }
  const auto results = run(points, texts, 3 * most * points.size());
  if (IsSkipped() || HasFatalFailure()) return;
  ASSERT_EQ(results.size(), modules.size()) << said_;

  Shapes shapes(points);
  std::map<double, double> worst, worst_opposite;  // of the peak, by exponent
  double worst_coefficient = 0;
  std::size_t compared = 0;
  for (std::size_t m = 0; m < modules.size(); ++m) {
    const std::vector<Output>& outputs = modules[m].outputs();
    for (std::size_t k = 0; k < outputs.size(); ++k)
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Output& output = outputs[k];
        const auto& [d, n, is_hard] = points[i];
        const float* colour = &results[m][3 * (k * points.size() + i)];
        for (int c = 0; c < 3; ++c)
          ASSERT_TRUE(std::isfinite(colour[c]) && colour[c] >= 0)
              << function_name_of(output.request, output.model) << " point " << i;
        const Highlight highlight = output.highlight(n);
        if (output.request.exponent.value_or(n) != n) continue;
        const double peak = truth::coefficient(highlight);
        if (output.is_coefficient) {
          worst_coefficient = std::max(worst_coefficient, std::abs(colour[0] / peak - 1));
          continue;
        }
        if (is_hard || is_at_an_edge(output.model, d)) continue;
        const double shape = shapes.at(highlight, i);
        const Rgb fresnel =
            output.request.fresnel == Fresnel::kNone
                ? Rgb{1, 1, 1}
                : fresnel_factor(Fresnel::kSchlick, kReflectance, d.to_eye, d.to_light);
        const double expected[] = {fresnel.r, fresnel.g, fresnel.b};
        double& largest = length(d.to_eye + d.to_light) < 0.2 ? worst_opposite[n] : worst[n];
        for (int c = 0; c < 3; ++c)
          largest = std::max(largest, std::abs(colour[c] / peak - expected[c] * shape));
        ++compared;
      }
  }
  // Measured: as docs/export.md says.
  for (const double n : kExponents) {
    fmt::print(
        "n = {:g}: within {:.1e} of the peak, and {:.1e} where light and eye are nearly opposite\n",
        n, worst[n], worst_opposite[n]);
    const double allowed = n <= 1000 ? 1e-5 : 2e-7 * std::sqrt(n);
    EXPECT_LE(worst[n], allowed) << n;
    EXPECT_LE(worst_opposite[n], 10 * allowed) << n;
  }
  fmt::print("coefficients within {:.1e}; {} values of {} modules\n", worst_coefficient, compared,
             modules.size());
  EXPECT_LE(worst_coefficient, 3e-6);
  EXPECT_GT(compared, 100'000u);
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
