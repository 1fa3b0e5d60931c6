#include "studies/shader_check/bsdf/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>

#include "base/system/error.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/bsdf/calls.hpp"
#include "studies/shader_check/bsdf/explain.hpp"
#include "studies/shader_check/read_shader.hpp"

namespace lobelia::shader_check::bsdf {
namespace {

constexpr std::size_t kPilotSamples = 8192, kPairs = 16;

/// Columns are the axes of the local frame in the world.
struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3 world(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
  Vec3 local(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};

/// Beside all axes, for functions that take a normal.
Frame frame_of(bool has_normal, std::size_t setting) {
  if (!has_normal) return {};
  std::mt19937_64 random(setting);
  std::normal_distribution<double> normal;
  const auto any = [&] { return normalize({normal(random), normal(random), normal(random)}); };
  Frame frame;
  frame.z = any();
  const Vec3 across = any();
  frame.x = normalize(across - dot(across, frame.z) * frame.z);
  frame.y = cross(frame.z, frame.x);
  return frame;
}

/// Numbers in (0, 1) that float32 holds.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : random_(seed) {}
  double operator()() { return (double(random_() >> 41) + 0.5) / double(1 << 23); }
  Vec3 three() {
    const double x = (*this)(), y = (*this)();
    return {x, y, (*this)()};
  }

 private:
  std::mt19937_64 random_;
};

class Run {
 public:
  explicit Run(const BsdfRequest& request)
      : request_(request),
        source_{request.language, printable_path(request.file), request.text, {}},
        shader_(read_shader(source_)),
        functions_(
            bsdf_functions(source_, shader_->declared, request.eval, request.sample, request.pdf)) {
    source_.text = shader_->text;
    source_.prelude = shader_->prelude;
    set_globals();
    called_ = with_bsdf_calls(source_, functions_);
    values_.has_given_pdf = gives_pdf(functions_.sample);
    values_.has_given_weight = gives_weight(functions_.sample);
    const bool has_normal = functions_.sample.takes(BsdfRole::kNormal);
    const bool has_parameter = takes_parameter();
    for (const double n : request.exponents)
      for (const double degrees : kEyeDegrees) {
        BsdfSettingValues& setting = values_.settings.emplace_back();
        setting.exponent = n;
        setting.eye_degrees = degrees;
        frames_.push_back(frame_of(has_normal, frames_.size()));
        // The eye as the shader has it.
        setting.eye = frames_.back().local(rounded(frames_.back().world(eye_at(degrees))));
        if (!has_parameter && n != request.exponents.front()) {
          values_.settings.pop_back();
          frames_.pop_back();
        }
      }
  }

  records::BsdfCheck check() {
    run_samples();
    run_grids();
    run_hard_cases();
    records::BsdfCheck record;
    record.file = printable_path(request_.file);
    record.sha256 = hex(sha256(request_.text));
    record.language = kShaderTextNames[std::size_t(request_.language)];
    record.eval = functions_.eval.words();
    record.sample = functions_.sample.words();
    record.pdf = functions_.pdf.words();
    record.api = kShaderApiNames[std::size_t(request_.api)];
    record.device = device_;
    record.driver = driver_;
    judge_bsdf(values_, record);
    if (needs_variants(values_, record)) add_variants();
    explain_bsdf(values_, variants_, record);
    return record;
  }

 private:
  static Vec3 rounded(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }

  /// Statements for --set. Throws Error(kUsage) for a variable that is read and not set.
  void set_globals() {
    std::set<std::string> set;
    for (const auto& [name, value] : request_.settings) {
      const GlobalVariable* global = shader_->declared.find_global(name);
      const std::vector<std::string> numbers = split(value, ",");
      double number = 0;
      if (!global || global->kind == GlobalVariable::Kind::kConstant ||
          !std::ranges::all_of(numbers,
                               [&](const std::string& one) { return parse_number(one, number); }))
        throw Error(ExitCode::kUsage,
                    "--set {}={}: with --bsdf a global variable and its numbers are allowed",
                    printable(name), printable(value));
      source_.setup += fmt::format("    {} = {}({});\n", inner_name(name, request_.language),
                                   global->type, value);
      set.insert(name);
    }
    for (const BsdfFunction* function : {&functions_.eval, &functions_.sample, &functions_.pdf}) {
      const Reach reach =
          reach_of(function->name, shader_->tokens, shader_->declared, shader_->dropped);
      for (const GlobalVariable& one : shader_->declared.globals)
        if (reach.globals.contains(one.name) && !set.contains(one.name) && one.value.empty() &&
            one.kind != GlobalVariable::Kind::kConstant &&
            one.kind != GlobalVariable::Kind::kPrivate)
          throw Error(ExitCode::kUsage, "{}: {} reads {} {}, which nothing sets: --set {}=NUMBER",
                      source_.name, function->name, printable(one.type), printable(one.name),
                      printable(one.name));
    }
  }

  bool takes_parameter() const {
    for (const BsdfFunction* function : {&functions_.eval, &functions_.sample, &functions_.pdf})
      for (const BsdfRole role : {BsdfRole::kExponent, BsdfRole::kAlpha, BsdfRole::kRoughness})
        if (function->takes(role)) return true;
    return false;
  }

  std::vector<ShaderValue> run(const std::vector<BsdfPoint>& points,
                               std::vector<std::string> calls) {
    ShaderSource source = called_;
    source.calls = std::move(calls);
    const ShaderPoints shader = shader_points(points);
    const ShaderRun run = run_programs(request_.api, shader,
                                       {make_program(source, request_.api, shader.count(),
                                                     shader.components, request_.time_limit)},
                                       source.calls.size(), {request_.time_limit, 0});
    device_ = run.device;
    driver_ = run.driver;
    return run.values.front();
  }

  BsdfPoint point(std::size_t setting, Vec3 light, Vec3 random) const {
    const Frame& frame = frames_[setting];
    return {frame.z, frame.world(values_.settings[setting].eye), frame.world(light), random,
            values_.settings[setting].exponent};
  }

  /// Counts a value that is not finite or is negative.
  void see(const ShaderValue& value, const char* function, const BsdfPoint& at) {
    ++values_.calls;
    const double number = value.written ? double(value.r) : std::nan("");
    const bool is_odd = !std::isfinite(number) || number < 0;
    if (!std::isfinite(number))
      ++values_.not_finite;
    else if (number < 0)
      ++values_.negative;
    if (is_odd && values_.first_odd.empty())
      values_.first_odd =
          fmt::format("{} gives {:g} at n = {:g}, N.L = {:.4g}, N.V = {:.4g}", function, number,
                      at.exponent, dot(at.normal, at.to_light), dot(at.normal, at.to_eye));
  }

  BsdfSample sample_of(std::size_t setting, const BsdfPoint& at, const ShaderValue& direction,
                       const ShaderValue& pdf, const ShaderValue& weight, const ShaderValue& eval) {
    BsdfSample sample;
    const Vec3 world{direction.r, direction.g, direction.b};
    const double size = length(world);
    const bool is_marked = pdf.g == 0 || size == 0;
    const bool is_unit = direction.written && std::abs(size - 1) < 1e-3;
    sample.is_valid = is_unit && !is_marked;
    if (!is_marked && !is_unit) ++values_.not_unit;
    if (!sample.is_valid) return sample;
    sample.direction = frames_[setting].local(world);
    BsdfPoint there = at;
    there.to_light = world;
    see(eval, "eval", there);
    see({pdf.b, pdf.b, pdf.b, pdf.written}, "pdf", there);
    sample.given_pdf = double(pdf.r);
    sample.pdf = double(pdf.b);
    sample.given_weight = double(weight.r);
    sample.eval = double(eval.r);
    // A pdf of 0 marks a sample below the surface, too.
    if (values_.has_given_pdf && sample.direction.z <= 0 && sample.given_pdf == 0)
      sample.is_valid = false;
    return sample;
  }

  void run_samples() {
    const std::size_t each = kPilotSamples + request_.samples;
    std::vector<BsdfPoint> points;
    points.reserve(values_.settings.size() * each);
    RandomNumbers random(1);
    for (std::size_t k = 0; k < values_.settings.size(); ++k)
      for (std::size_t i = 0; i < each; ++i) points.push_back(point(k, {0, 0, 1}, random.three()));
    const auto pairs = add_pairs(points, random);
    const ShaderText language = request_.language;
    std::vector<std::string> calls;
    for (const Sampled what :
         {Sampled::kDirection, Sampled::kPdf, Sampled::kWeight, Sampled::kEval})
      calls.push_back(call_of_sample(language, what));
    const auto values = run(points, std::move(calls));
    const std::size_t count = points.size();
    for (std::size_t k = 0; k < values_.settings.size(); ++k) {
      BsdfSettingValues& setting = values_.settings[k];
      std::vector<Vec3> above, below;
      for (std::size_t i = 0; i < each; ++i) {
        const std::size_t at = k * each + i;
        const BsdfSample sample = sample_of(k, points[at], values[at], values[count + at],
                                            values[2 * count + at], values[3 * count + at]);
        // Other random numbers lay the cells than are counted in them.
        if (i >= kPilotSamples)
          setting.samples.push_back(sample);
        else if (sample.is_valid)
          (sample.direction.z > 0 ? above : below).push_back(sample.direction);
      }
      setting.above.grid = HemisphereGrid(above, true, 27, 24, 3);
      setting.check.grid = HemisphereGrid(above, true, 21, 18, 3);
      setting.below.grid = HemisphereGrid(below, false, 18, 15, 3);
    }
    see_pairs(pairs, values);
  }

  struct Pair {
    int changed;
    std::size_t one, other;
  };
  /// Points that differ in one random number only.
  std::vector<Pair> add_pairs(std::vector<BsdfPoint>& points, RandomNumbers& random) const {
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < values_.settings.size(); ++k)
      for (std::size_t i = 0; i < kPairs; ++i)
        for (const int changed : {0, 1}) {
          Vec3 u = random.three();
          pairs.push_back({changed, points.size(), points.size() + 1});
          points.push_back(point(k, {0, 0, 1}, u));
          (changed == 0 ? u.x : u.y) = random();
          points.push_back(point(k, {0, 0, 1}, u));
        }
    return pairs;
  }
  void see_pairs(const std::vector<Pair>& pairs, const std::vector<ShaderValue>& directions) {
    values_.random_unused[0] = values_.random_unused[1] = true;
    for (const auto& [changed, one, other] : pairs) {
      const ShaderValue &a = directions[one], &b = directions[other];
      if (a.r != b.r || a.g != b.g || a.b != b.b) values_.random_unused[changed] = false;
    }
  }

  template <class Visit>
  void for_each_grid(BsdfValues& values, Visit visit) {
    for (std::size_t k = 0; k < values.settings.size(); ++k)
      for (GridValues BsdfSettingValues::*grid :
           {&BsdfSettingValues::above, &BsdfSettingValues::check, &BsdfSettingValues::below})
        visit(k, values.settings[k].*grid);
  }

  std::vector<BsdfPoint> grid_points() {
    std::vector<BsdfPoint> points;
    for_each_grid(values_, [&](std::size_t k, GridValues& grid) {
      for (const auto& node : grid.grid.nodes())
        points.push_back(point(k, node.direction, {0.5, 0.5, 0.5}));
    });
    return points;
  }

  void run_grids() {
    const std::vector<BsdfPoint> points = grid_points();
    const ShaderText language = request_.language;
    const auto values = run(points, {call_of_eval(language, false), call_of_eval(language, true),
                                     call_of_pdf(language)});
    std::size_t at = 0;
    for_each_grid(values_, [&](std::size_t, GridValues& grid) {
      for (std::size_t i = 0; i < grid.grid.nodes().size(); ++i, ++at) {
        const ShaderValue &eval = values[at], &swapped = values[points.size() + at],
                          &pdf = values[2 * points.size() + at];
        see(eval, "eval", points[at]);
        see(pdf, "pdf", points[at]);
        values_.coloured += eval.r != eval.g || eval.r != eval.b;
        grid.values.push_back({double(eval.r), double(swapped.r), double(pdf.r)});
      }
    });
  }

  /// Grazing, below the surface, L = -V, L = V, and random numbers at their ends.
  void run_hard_cases() {
    const Vec3 up{0, 0, 1}, high = eye_at(50), grazing = eye_at(89.9),
                            low = normalize({0.6, 0.3, -0.2}),
                            across{-grazing.x, -grazing.y, grazing.z};
    std::vector<BsdfPoint> points;
    for (std::size_t k = 0; k < values_.settings.size(); k += std::size(kEyeDegrees))
      for (const Vec3 eye : {up, high, grazing, low, -up})
        for (const Vec3 light : {up, high, grazing, across, low, -up, -eye, eye})
          for (const Vec3 u : {Vec3{0, 0, 0}, Vec3{0, 0.999999, 0}, Vec3{0.999999, 0, 0.5},
                               Vec3{0.999999, 0.999999, 0.999999}}) {
            BsdfPoint one = point(k, light, u);
            one.to_eye = frames_[k].world(eye);
            points.push_back(one);
          }
    const ShaderText language = request_.language;
    const auto values = run(points, {call_of_eval(language, false), call_of_pdf(language),
                                     call_of_sample(language, Sampled::kDirection)});
    for (std::size_t i = 0; i < points.size(); ++i) {
      see(values[i], "eval", points[i]);
      see(values[points.size() + i], "pdf", points[i]);
      const ShaderValue& d = values[2 * points.size() + i];
      const double sum = double(d.r) + double(d.g) + double(d.b);
      // A direction may be negative.
      const float size = d.written && std::isfinite(sum) ? 1.0F : std::nanf("");
      if (dot(points[i].normal, points[i].to_eye) > 0)
        see({size, size, size, true}, "sample", points[i]);
    }
  }

  /// pdf with another parameter, at the same directions.
  void add_variants() {
    const bool is_exponent = functions_.pdf.takes(BsdfRole::kExponent);
    const std::vector<std::pair<ChangedParameter, std::string_view>> changes =
        is_exponent
            ? std::vector<std::pair<ChangedParameter,
                                    std::string_view>>{{ChangedParameter::kDoubled,
                                                        "pdf takes half of the exponent of sample"},
                                                       {ChangedParameter::kHalved,
                                                        "pdf takes twice the exponent of sample"}}
            : std::vector<std::pair<ChangedParameter, std::string_view>>{
                  {ChangedParameter::kSquared,
                   "pdf takes for its alpha what is the root of sample's: it lacks a square"},
                  {ChangedParameter::kRoot, "pdf takes for its alpha the square of sample's"}};
    if (!is_exponent && !functions_.pdf.takes(BsdfRole::kAlpha) &&
        !functions_.pdf.takes(BsdfRole::kRoughness))
      return;
    std::vector<BsdfPoint> points = grid_points();
    const std::size_t of_samples = points.size();
    for (std::size_t k = 0; k < values_.settings.size(); ++k)
      for (const BsdfSample& sample : values_.settings[k].samples)
        points.push_back(point(k, sample.direction, {0.5, 0.5, 0.5}));
    std::vector<std::string> calls;
    for (const auto& [changed, words] : changes)
      calls.push_back(call_of_pdf(request_.language, changed));
    const auto values = run(points, calls);
    for (std::size_t c = 0; c < changes.size(); ++c) {
      BsdfVariant& variant =
          variants_.emplace_back(BsdfVariant{"pdf-other-parameter", changes[c].second, values_});
      std::size_t at = c * points.size();
      for_each_grid(variant.values, [&](std::size_t, GridValues& grid) {
        for (NodeValue& value : grid.values) value.pdf = double(values[at++].r);
      });
      at = c * points.size() + of_samples;
      for (BsdfSettingValues& setting : variant.values.settings)
        for (BsdfSample& sample : setting.samples) sample.pdf = double(values[at++].r);
    }
  }

  const BsdfRequest& request_;
  ShaderSource source_;
  std::unique_ptr<ReadShader> shader_;
  BsdfFunctions functions_;
  ShaderSource called_;
  BsdfValues values_;
  std::vector<Frame> frames_;
  std::vector<BsdfVariant> variants_;
  std::string device_, driver_;
};

}  // namespace

records::BsdfCheck check_bsdf(const BsdfRequest& request) { return Run(request).check(); }

}  // namespace lobelia::shader_check::bsdf
