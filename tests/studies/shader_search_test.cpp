// The search for mistakes as WebAssembly against the same files compiled for this processor: the same points and values
// give the same words. Skipped where the build has no WebAssembly, or node is missing.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "lobelia_paths.hpp"
// Its functions, not their WebAssembly.
#include "studies/shader_check/web/search.cpp"

namespace lobelia {
namespace {

using shader_check::Point;

struct Case {
  const char* model;
  std::function<double(const shader_check::Geometry&, double n)> radiance;
};

double half_power(const shader_check::Geometry& g, double n) {
  return std::pow(std::max(1 - g.s_half, 0.0), n) * std::max(g.n_dot_l, 0.0);
}
double mirror_power(const shader_check::Geometry& g, double n) {
  return g.n_dot_l > 0 ? std::pow(std::max(1 - g.s_mirror, 0.0), n) : 0;
}
constexpr double kPi = std::numbers::pi;

const Case kCases[] = {
    {"blinn_phong_ndf",
     [](const auto& g, double n) { return (n + 1) / (8 * kPi) * half_power(g, n); }},
    {"blinn_phong_ndf",
     [](const auto& g, double n) { return (n + 1) / (2 * kPi) * half_power(g, n); }},
    {"blinn_phong_ndf",
     [](const auto& g, double n) { return (n + 1) / (8 * kPi) * half_power(g, n / 4); }},
    {"modified_phong",
     [](const auto& g, double n) { return (n + 2) / 2 * mirror_power(g, n) * g.n_dot_l; }},
    {"modified_phong",
     [](const auto& g, double n) { return (n + 2) / (2 * kPi) * mirror_power(g, n); }},
    {"phong_rdf", [](const auto& g, double n) { return (n + 8) / (8 * kPi) * half_power(g, n); }},
    {"microfacet_smith",
     [](const auto& g, double n) { return std::min((n + 2) / (8 * kPi) * half_power(g, n), 1.0); }},
    {"modified_phong", [](const auto&, double) { return 0.0; }},
    {"modified_phong", [](const auto&, double) { return std::nan(""); }},
    // No mistake that has a name.
    {"modified_phong", [](const auto& g, double n) { return std::sin(40 * g.n_dot_v) + n; }},
};

std::vector<double> vectors_of(const std::vector<Point>& points) {
  std::vector<double> all;
  for (const Point& p : points) {
    for (const Vec3 v : {p.normal, p.to_eye, p.to_light}) all.insert(all.end(), {v.x, v.y, v.z});
    all.push_back(p.exponent);
  }
  return all;
}

std::string asked(const char* model) {
  return fmt::format(
      "{}\ncosine\nexact\nglsl\n\n\n\n"
      "float h(vec3 N, vec3 V, vec3 L, float n) {{ return 1.0; }}",
      model);
}

template <class Number>
void append(std::string& bytes, const std::vector<Number>& numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

/// The first line that is another one; "" if there is none. Numbers may differ as the last digits of pow() do: measured
/// 1e-14 relative, and 1e-15 of the peak for differences.
std::string first_difference(const std::string& ours, const std::string& theirs) {
  const auto a = split(ours, "\n"), b = split(theirs, "\n");
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const auto x = split(i < a.size() ? a[i] : "", " "), y = split(i < b.size() ? b[i] : "", " ");
    bool is_same = x.size() == y.size();
    for (std::size_t k = 0; is_same && k < x.size(); ++k) {
      double p = 0, q = 0;
      is_same = x[k] == y[k] || (parse_number(x[k], p) && parse_number(y[k], q) &&
                                 std::abs(p - q) < 1e-9 * std::abs(p) + 1e-12);
    }
    if (!is_same) return fmt::format("line {}: {} and {}", i, fmt::join(x, " "), fmt::join(y, " "));
  }
  return "";
}

TEST(ShaderSearch, GivesTheSameWordsAsWebAssembly) {
  const std::filesystem::path wasm =
      std::filesystem::path(LOBELIA_PROGRAM).parent_path().parent_path() /
      "studies/shader_check/web/search.wasm";
  const auto node = find_program("node");
  if (!std::filesystem::exists(wasm) || node.empty())
    GTEST_SKIP() << "tools/setup wasm browser installs what it needs";
  const TemporaryDirectory scratch;
  std::string ours;
  std::vector<std::string> command{
      node.string(), LOBELIA_SOURCE_DIR "/tests/studies/shader_search.mjs", wasm.string()};
  for (const Case& one : kCases) {
    std::vector<Point> points;
    for (const double n : shader_check::kUsualExponents)
      for (const Point& point :
           shader_check::domain_points({*find_model(one.model), *find_lobe("cosine")}, n, 600))
        points.push_back(point);
    const std::vector<double> vectors = vectors_of(points);
    std::vector<float> values;
    for (const Point& point : points) {
      const float value = float(one.radiance(shader_check::Geometry(point), point.exponent));
      values.insert(values.end(), {value, value, value, 1});
    }
    const std::string text = asked(one.model);
    std::ranges::copy(text, shader_check::search_text(text.size()));
    shader_check::search_begin(64);
    std::ranges::copy(vectors, shader_check::search_vectors(points.size()));
    ASSERT_EQ(shader_check::search_take(), points.size());
    std::ranges::copy(values, shader_check::search_values());
    ours += shader_check::search_judge();

    std::string bytes;
    append(bytes, vectors);
    append(bytes, values);
    const auto file = scratch.path() / fmt::format("{}.bin", command.size());
    write_file(file, bytes);
    command.push_back(text);
    command.push_back(file.string());
  }
  ProcessOptions options;
  options.log = scratch.path() / "log";
  EXPECT_EQ(run_process(command, options).exit_code, 0);
  EXPECT_EQ(first_difference(ours, read_file(options.log, 1 << 20)), "");
  EXPECT_THAT(ours, testing::HasSubstr("pi-missing"));
  EXPECT_THAT(ours, testing::HasSubstr("passes"));
}

}  // namespace
}  // namespace lobelia
