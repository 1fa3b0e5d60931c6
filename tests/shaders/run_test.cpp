// The exported GLSL, HLSL and WGSL, run by drivers and in Chromium, against the formulas in 50 digits.
#include "base/pictures/image_io_module.hpp"
#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "studies/shader_check/program_text.hpp"
#include "studies/shader_check/runner_protocol.hpp"
#include "tests/shaders/export_values.hpp"
#include "tests/shaders/shader_runner.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class RunByADriver : public NeedsShaderRunner {};
class RunInABrowser : public NeedsWebGpu {};

constexpr std::size_t kExponentAt = 9, kFirstCoefficient = 10;

/// A coefficient for each model, lobe and normalisation of the outputs, as an argument of their functions.
class CoefficientColumns {
 public:
  explicit CoefficientColumns(const std::vector<std::vector<ExportOutput>>& programs) {
    for (const std::vector<ExportOutput>& outputs : programs)
      for (const ExportOutput& output : outputs)
        if (columns_.try_emplace(key(output), columns_.size()).second)
          highlights_.push_back(output.highlight(1));
  }
  std::size_t of(const ExportOutput& output) const { return columns_.at(key(output)); }

  /// The input for each point: normal, directions to eye and light, exponent, all coefficients.
  ShaderPoints points(const std::vector<CalledPoint>& called, KnownValues& known) const {
    ShaderPoints made{kFirstCoefficient + highlights_.size(), {}};
    for (const CalledPoint& point : called) {
      for (const Vec3 v :
           {point.directions.normal, point.directions.to_eye, point.directions.to_light})
        made.values.insert(made.values.end(), {float(v.x), float(v.y), float(v.z)});
      made.values.push_back(float(point.exponent));
      for (Highlight highlight : highlights_) {
        highlight.exponent = point.exponent;
        made.values.push_back(point.exponent > 0 ? float(known.coefficient(highlight)) : 1);
      }
    }
    return made;
  }

 private:
  static KnownValues::Key key(const ExportOutput& output) {
    return KnownValues::key(output.highlight(1));
  }
  std::map<KnownValues::Key, std::size_t> columns_;
  std::vector<Highlight> highlights_;
};

/// Several exports in one text, as somebody puts them together. WGSL has no preprocessor: there each function once.
std::string text_of(ShaderText language, const std::vector<ShaderExport>& requests) {
  std::string all;
  std::map<std::string, std::string> known;
  for (const ShaderExport& request : requests) {
    const std::string text = shader_text(request);
    if (language != ShaderText::kWgsl) {
      all += text;
      continue;
    }
    for (std::size_t at = text.find("\n\n"); at != text.npos; at = text.find("\n\n", at + 1)) {
      const std::size_t end = std::min(text.find("\n}\n", at), text.size() - 3) + 3;
      const std::string function = text.substr(at, end - at);
      at = end - 2;
      const std::size_t name = function.find("\nfn ");
      if (name == function.npos) continue;
      const auto [one, is_new] =
          known.try_emplace(function.substr(name, function.find('(', name) - name), function);
      if (is_new) all += function;
      EXPECT_EQ(one->second, function) << "functions of one name differ";
    }
  }
  return all;
}

ShaderSource source_of(ShaderText language, const std::vector<ShaderExport>& requests,
                       const std::vector<ExportOutput>& outputs,
                       const CoefficientColumns& columns) {
  const std::string_view vector = vector_type(language);
  std::string vectors;
  for (std::size_t v = 0; v < 3; ++v)
    vectors += fmt::format("{}{}({}, {}, {})", v == 0 ? "" : ", ", vector, shader_component(3 * v),
                           shader_component(3 * v + 1), shader_component(3 * v + 2));
  ShaderSource source{language, "exports", text_of(language, requests), {}};
  for (const ExportOutput& output : outputs)
    source.calls.push_back(
        output.is_coefficient
            ? fmt::format("{}({})", output.coefficient_name(), shader_component(kExponentAt))
            : call_of(output.request, output.model, vectors, shader_component(kExponentAt),
                      shader_component(kFirstCoefficient + columns.of(output)),
                      fmt::format("{}({:#}, {:#}, {:#})", vector, kReflectance.r, kReflectance.g,
                                  kReflectance.b)));
  return source;
}

using Lists = std::vector<std::vector<ShaderExport>>;

/// Calls `visit` with what every function gives for every point; `in_half`: with all arithmetic in half floats. A program
/// for each list, and all of them in one process: a browser takes longer to start than to run one.
template <class Visit>
void run_exports(ShaderText language, ShaderApi api, const std::vector<CalledPoint>& points,
                 const Lists& lists, bool in_half, KnownValues& known, Visit visit) {
  std::vector<std::vector<ExportOutput>> outputs;
  std::size_t calls = 0;
  for (const auto& requests : lists)
    calls = std::max(calls, outputs.emplace_back(outputs_of(requests)).size());
  const CoefficientColumns columns(outputs);
  const ShaderPoints called = columns.points(points, known);
  std::vector<ShaderProgram> programs;
  for (std::size_t j = 0; j < lists.size(); ++j) {
    ShaderSource source = source_of(language, lists[j], outputs[j], columns);
    source.calls.resize(calls, std::string(vector_type(language)) + "(0.0)");
    programs.push_back(make_program(source, api, called.count(), called.components));
    if (in_half) programs.back() = in_half_floats(programs.back());
  }
  const ShaderRun run = run_programs(api, called, programs, calls, {std::chrono::hours(1), 0});
  for (std::size_t j = 0; j < lists.size(); ++j)
    for (std::size_t k = 0; k < outputs[j].size(); ++k)
      for (std::size_t i = 0; i < points.size(); ++i) {
        const ShaderValue& value = run.values[j][k * points.size() + i];
        ASSERT_TRUE(value.written);
        ASSERT_NO_FATAL_FAILURE(visit(outputs[j][k], i, Rgb{value.r, value.g, value.b}));
      }
}

void expect_the_formulas(ShaderText language, ShaderApi api) {
  const std::vector<CalledPoint> points = called_points();
  KnownValues known(points);
  ExportJudge judge(points, known);
  const Lists lists = exports_to_run(std::string(kShaderTextNames[std::size_t(language)]));
  run_exports(
      language, api, points, lists, false, known,
      [&](const ExportOutput& output, std::size_t i, Rgb colour) { judge.add(output, i, colour); });
  if (testing::Test::HasFatalFailure()) return;
  judge.expect_as_documented(std::string(kShaderTextNames[std::size_t(language)]));
}

TEST_F(RunByADriver, EveryGlslFunctionHasTheRadianceOfTheFormulasOnOpenGl) {
  expect_the_formulas(ShaderText::kGlsl, ShaderApi::kEgl);
}

TEST_F(RunByADriver, EveryHlslFunctionHasTheRadianceOfTheFormulasOnVulkan) {
  expect_the_formulas(ShaderText::kHlsl, ShaderApi::kVulkan);
}

TEST_F(RunByADriver, EveryFunctionIsFiniteForExtremeExponents) {
  std::vector<CalledPoint> points;
  for (const double n : {0.0, 3.0, kMaxExponent})
    for (const Directions& d : hard_directions()) points.push_back({d, n, true});
  KnownValues known(points);
  std::size_t numbers = 0;
  run_exports(ShaderText::kGlsl, ShaderApi::kEgl, points, exports_to_run("glsl"), false, known,
              [&](const ExportOutput& output, std::size_t i, Rgb colour) {
                ASSERT_TRUE(std::isfinite(colour.r + colour.g + colour.b))
                    << function_name_of(output.request, output.model) << " point " << i;
                ++numbers;
              });
  EXPECT_GT(numbers, 10'000u);
}

/// Every model and lobe in half floats, with the coefficient as an argument.
Lists half_exports(const std::string& language) {
  std::map<LobeId, std::vector<ShaderExport>> by_lobe;
  for (const ShaderExport& request : every_half_export(language))
    if (request.coefficient == CoefficientFrom::kArgument) by_lobe[request.lobe].push_back(request);
  Lists lists;
  for (const auto& [lobe, requests] : by_lobe) lists.push_back(requests);
  return lists;
}

/// The largest error of the peak by exponent and angle, for light and eye within 70 degrees of the normal.
std::map<std::pair<double, LobeAngle>, double> half_export_errors(ShaderText language,
                                                                  ShaderApi api, bool in_half) {
  std::vector<CalledPoint> points;
  for (const double n : {8.0, 128.0, 1024.0}) {
    RandomDirections random(n);
    while (points.size() % 300 != 299 || points.back().exponent != n) {
      const Directions d = random();
      if (dot(d.normal, d.to_eye) > 0.35 && dot(d.normal, d.to_light) > 0.35)
        points.push_back({d, n, false});
    }
  }
  KnownValues known(points);
  std::map<std::pair<double, LobeAngle>, double> errors;
  run_exports(language, api, points, half_exports(std::string(kShaderTextNames[int(language)])),
              in_half, known, [&](const ExportOutput& output, std::size_t i, Rgb colour) {
                if (output.is_coefficient) return;
                const auto& [d, n, is_hard] = points[i];
                const Highlight h = output.highlight(n);
                const Rgb fresnel =
                    output.request.fresnel == Fresnel::kNone
                        ? Rgb{1, 1, 1}
                        : fresnel_factor(Fresnel::kSchlick, kReflectance, d.to_eye, d.to_light);
                const double error =
                    std::abs(colour.g / known.coefficient(h) - fresnel.g * known.shape(h, i));
                double& largest = errors[{n, info(h.model).angle}];
                largest = error <= largest ? largest : error;
              });
  for (const auto& [where, error] : errors)
    fmt::print("{}{}: n = {:g}, {}: within {:.1e} of the peak\n", kShaderTextNames[int(language)],
               in_half ? " in half floats" : "", where.first,
               where.second == LobeAngle::kReflection ? "mirror" : "half vector", error);
  EXPECT_EQ(errors.size(), 6u);
  return errors;
}

TEST_F(RunByADriver, EveryExportInHalfFloatsIsRightWhereTheDriverIgnoresThat) {
  // In float32 arithmetic only the short series are left: 1.8e-4 measured.
  for (const auto& errors : {half_export_errors(ShaderText::kGlsl, ShaderApi::kEgl, false),
                             half_export_errors(ShaderText::kHlsl, ShaderApi::kVulkan, false)})
    for (const auto& [where, error] : errors) EXPECT_LT(error, 1e-3);
}

TEST_F(RunByADriver, EveryExportInHalfFloatsHoldsInHalfFloats) {
  for (const auto& [where, error] : half_export_errors(ShaderText::kHlsl, ShaderApi::kVulkan, true))
    EXPECT_LT(error, 0.05) << where.first;  // measured 0.015, of cs64, to 0.025
}

TEST_F(RunInABrowser, EveryWgslFunctionHasTheRadianceOfTheFormulasOnWebGpu) {
  expect_the_formulas(ShaderText::kWgsl, ShaderApi::kWebGpu);
}

TEST_F(RunByADriver, AFailureNamesItsProgram) {
  const auto failure = [](const std::string& own, const std::string& theirs) {
    ShaderProgram ours =
        program_text({ShaderText::kGlsl, "mine", "", {own}, true}, ShaderApi::kEgl, 1, 1);
    try {
      run_programs(
          ShaderApi::kEgl, {1, {0}},
          {ours, program_text({ShaderText::kGlsl, "mine", "", {theirs}}, ShaderApi::kEgl, 1, 1)}, 1,
          {std::chrono::hours(1), 0});
    } catch (const Error& error) {
      return fmt::format("{}: {}", int(error.code()), error.what());
    }
    return std::string();
  };
  EXPECT_EQ(failure("1.0", "2.0"), "");
  EXPECT_THAT(failure("none", "none"),
              testing::StartsWith("5: Lobelia's own shader does not compile on this driver: "));
  EXPECT_THAT(failure("1.0", "none"),
              testing::StartsWith("3: mine: the call of the function does not compile: "));
}

TEST_F(RunByADriver, TheTokenBeginsTheRunnersOwnLinesAlone) {
  const TemporaryDirectory scratch;
  write_file(scratch.path() / kPointsFile, std::string(4 * sizeof(float), '\0'));
  write_file(scratch.path() / "program", "#version 330\n#error device FORGED\n");
  std::vector<std::string> own, others;
  ProcessOptions options;
  options.working_directory = scratch.path();
  options.on_line = [&](std::string_view line) {
    (line.starts_with("TOKEN ") ? own : others).emplace_back(line);
  };
  const ProcessResult result = run_process(
      {companion_file(kShaderRunnerFile).string(), "egl", "TOKEN", "1", "1", "1", "0", "program"},
      options);
  EXPECT_EQ(result.exit_code, int(kRunnerRefusedProgram));
  EXPECT_THAT(own, testing::ElementsAre(testing::StartsWith("TOKEN device "),
                                        testing::StartsWith("TOKEN driver "), "TOKEN program 0"));
  EXPECT_THAT(others, testing::Contains(testing::HasSubstr("FORGED")));
}

}  // namespace
}  // namespace lobelia
