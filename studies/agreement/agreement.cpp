#include "studies/agreement/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "base/system/interrupt.hpp"
#include "base/words/constants.hpp"
#include "reference_scenes/at_once.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "reference_scenes/replicates.hpp"
#include "renderer/render.hpp"

namespace lobelia::agreement {
namespace {

constexpr EngineVariant kOursVariant{.name = "ours", .title = "Lobelia", .floor = kOursFloor};

/// From this exponent on the rounding of double would count.
constexpr double kFiftyDigitsFrom = 1e5;

/// So that a NaN counts as the largest difference.
double or_infinite(double value) { return std::isfinite(value) ? value : kInfinity; }

Picture picture_of(const Image& image) {
  Picture picture(image.pixel_count());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const float* const rgb = image.values().data() + 3 * i;
    picture[i] = {rgb[0], rgb[1], rgb[2]};
  }
  return picture;
}

ReferenceOptions options_of(const Variant& variant) {
  ReferenceOptions options;
  options.fine = variant.fine;
  options.shading = variant.shading;
  return options;
}

Verdict verdict_of(const Variant& variant, const Case& one, const Figures& figures,
                   std::int64_t ring_allowed) {
  const auto target = target_of(variant, one);
  if (!target) return Verdict::kNoTarget;
  const double value = target->relative ? figures.max_relative : figures.max_of_peak;
  // Larger errors also count inside the ring.
  const bool ring_counts = target->relative || target->limit < kRingOfPeak;
  return value <= target->limit && (!ring_counts || figures.ring_over <= ring_allowed)
             ? Verdict::kMet
             : Verdict::kMissed;
}

/// The parts of a case that do not depend on the variant.
struct Truth {
  std::string why_not;
  Picture picture;
  PixelFlags ring;
};

class Measurement {
 public:
  Measurement(const Scope& scope, std::span<const std::unique_ptr<Engine>> engines,
              const OnProgress& on_progress)
      : engines_(engines), on_progress_(on_progress) {
    result_.scope = scope;
    soft_ = soft_cases(scope);
    result_.cases = highlight_cases(scope);
    for (Case& effect : effect_cases(scope)) result_.cases.push_back(std::move(effect));
    for (const auto& engine : engines) {
      const EngineInfo& info = engine->info();
      const EngineStatus& status = engine->status();
      const bool available = status.available();
      result_.engines.push_back({std::string(info.name), std::string(info.title), available,
                                 std::string(state_name(status.state)),
                                 available ? status.version : "", available ? "" : status.why});
    }
  }

  Agreement run() {
    plan();
    evaluate();
    compare_ours();
    for (const Work& work : work_) compare_engine(work);
    compare_directly();
    measure_soft();
    std::ranges::stable_sort(result_.rows, {}, [](const Row& row) {
      return std::pair(rank_of(row.variant), row.index);
    });
    return std::move(result_);
  }

 private:
  struct Work {
    Variant variant;
    Engine* engine;
    std::vector<std::size_t> cases;
  };

  static std::ptrdiff_t rank_of(const Variant& variant) {
    if (variant.name == ours().name) return -1;
    return std::ranges::find(variants(), variant.name, &Variant::name) - variants().begin();
  }

  void plan() {
    for (const Variant& variant : variants())
      for (const auto& engine : engines_) {
        if (engine->info().name != variant.engine || !engine->status().available()) continue;
        Work work{variant, engine.get(), {}};
        for (std::size_t i = 0; i < result_.cases.size(); ++i) {
          const Case& one = result_.cases[i];
          std::string why = engine->why_not(one.scene, options_of(variant));
          if (why.empty())
            work.cases.push_back(i);
          else
            result_.rows.push_back({i, variant, {}, Verdict::kNotComparable, std::move(why)});
        }
        total_ += work.cases.size();
        work_.push_back(std::move(work));
      }
    total_ += 2 * result_.cases.size();
    const auto soft_variants = std::size_t(std::ranges::count_if(work_, averages));
    if (soft_variants > 0)
      total_ += soft_.size() * (1 + soft_variants * soft_points(result_.scope).size());
  }

  static bool averages(const Work& work) { return work.variant.rounding > 0; }

  void evaluate() {
    for (const Case& one : result_.cases) {
      throw_if_interrupted();
      Truth& truth = truths_.emplace_back();
      truth.why_not = truth::why_not_evaluated(one.scene);
      if (truth.why_not.empty()) {
        truth.picture = truth::evaluate(one.scene, one.highlight.exponent < kFiftyDigitsFrom
                                                       ? truth::Digits::kDouble
                                                       : truth::Digits::kFifty);
        truth.ring = truth::edge_ring(one.scene);
      }
      one_done("formulas");
    }
  }

  void compare_ours() {
    for (std::size_t i = 0; i < result_.cases.size(); ++i) {
      if (truths_[i].why_not.empty())
        add(i, ours(), render(result_.cases[i].scene, {}).image);
      else
        result_.rows.push_back({i, ours(), {}, Verdict::kNotComparable, truths_[i].why_not});
      one_done(ours().title);
    }
  }

  void compare_engine(const Work& work) {
    if (work.cases.empty()) return;
    ReferenceOptions options = options_of(work.variant);
    options.scenes = work.cases.size();
    Session session(*work.engine, options);
    std::mutex mutex;
    for_each_at_once(
        work.cases.size(), session.at_once(),
        [&](std::size_t k) {
          const std::size_t i = work.cases[k];
          ReferenceResult result = session.render(result_.cases[i].scene);
          const std::scoped_lock lock(mutex);
          take(i, work.variant, std::move(result));
          one_done(work.variant.title);
        },
        [&] { session.stop(); });
  }

  void take(std::size_t i, const Variant& variant, ReferenceResult result) {
    const std::string_view asked = kShadingNames[std::size_t(variant.shading)];
    if (result.error.empty() && result.record.shading != asked) {
      result.failure = FailureClass::kRefused;
      result.error =
          fmt::format("asked for highlights that are {}, the engine rendered some that are {}",
                      asked, result.record.shading);
    }
    if (!result.error.empty()) {
      result_.rows.push_back({i, variant, {}, Verdict::kFailed, result.error});
      return;
    }
    add(i, variant, result.image);
    if (variant.shading == Shading::kReimplemented)
      keep_reimplemented(i, variant, std::move(result.image));
  }

  void add(std::size_t i, const Variant& variant, const Image& image) {
    PixelFlags ring = truths_[i].ring;
    const Case& one = result_.cases[i];
    const std::int64_t grazing = truth::mark_grazing(one.scene, variant.floor.least_cosine, ring);
    const Figures figures = difference_from(truths_[i].picture, image, ring);
    result_.rows.push_back(
        {i, variant, figures, verdict_of(variant, one, figures, one.ring_allowed + grazing), {}});
  }

  /// Replaces a coarser format of the same engine, which comes earlier.
  void keep_reimplemented(std::size_t i, const Variant& variant, Image image) {
    auto& pictures = reimplemented_[i];
    const auto found = std::ranges::find(pictures, variant.engine, &EnginePicture::engine);
    if (found == pictures.end())
      pictures.push_back({variant.engine, std::move(image)});
    else
      found->image = std::move(image);
  }

  /// The first engine with our formulas, in its finest format, against each other one.
  void compare_directly() {
    for (const auto& [i, pictures] : reimplemented_)
      for (std::size_t k = 1; k < pictures.size(); ++k) {
        const Figures figures =
            difference_from(picture_of(pictures[0].image), pictures[k].image, truths_[i].ring);
        result_.rows.push_back(
            {i, pair_of(pictures[0].engine, pictures[k].engine), figures, Verdict::kNoTarget, {}});
      }
  }

  void measure_soft() {
    if (std::ranges::none_of(work_, averages)) return;
    std::vector<Image> truths;
    for (const SoftCase& one : soft_) {
      truths.push_back(render(one.converged, {}).image);
      one_done("our own samples");
    }
    for (const Work& work : work_) {
      if (!averages(work)) continue;
      const std::size_t first = result_.soft.size();
      for (const SoftCase& one : soft_)
        result_.soft.push_back({one.what, work.variant, {}, {}, {}});
      for (const int points : soft_points(result_.scope)) {
        ReferenceOptions options = options_of(work.variant);
        options.points = points;
        Session session(*work.engine, options);
        // Each is an average of many pictures, which are rendered side by side.
        for (std::size_t i = 0; i < soft_.size(); ++i) {
          const ReferenceResult result = session.render(soft_[i].scene);
          one_done(work.variant.title);
          take_average(result, truths[i], points, result_.soft[first + i]);
        }
      }
    }
  }

  static void take_average(const ReferenceResult& result, const Image& truth, int points,
                           SoftRow& row) {
    if (!result.error.empty()) {
      row.verdict = Verdict::kFailed;
      row.why = result.error;
      return;
    }
    const auto found = replicate_statistics(result, truth, points, row.variant.rounding);
    const double peak = *std::ranges::max_element(truth.values());
    row.counts.push_back({points, found.values, found.beyond, found.rms / peak});
    if (row.verdict == Verdict::kFailed) return;
    if (found.beyond > kBeyondAllowed) row.verdict = Verdict::kMissed;
    if (row.verdict == Verdict::kNoTarget) row.verdict = Verdict::kMet;
  }

  void one_done(std::string_view what) {
    if (on_progress_) on_progress_(double(++done_) / double(total_), what);
  }

  std::span<const std::unique_ptr<Engine>> engines_;
  const OnProgress& on_progress_;
  Agreement result_;
  std::vector<SoftCase> soft_;
  std::vector<Work> work_;
  std::vector<Truth> truths_;
  struct EnginePicture {
    std::string_view engine;
    Image image;
  };
  std::map<std::size_t, std::vector<EnginePicture>> reimplemented_;  ///< by case
  std::size_t done_ = 0, total_ = 0;
};

}  // namespace

const Variant& ours() {
  static const Variant variant{"", kOursVariant};
  return variant;
}

std::span<const Variant> variants() {
  static const std::vector<Variant> all = [] {
    std::vector<Variant> found;
    for (const EngineInfo& engine : engine_infos())
      for (const EngineVariant& variant : engine.variants) found.push_back({engine.name, variant});
    return found;
  }();
  return all;
}

Variant pair_of(std::string_view first, std::string_view second) {
  struct Names {
    std::string name, title;
  };
  static std::map<std::pair<std::string_view, std::string_view>, Names> pairs;
  Names& names = pairs[{first, second}];
  if (names.name.empty())
    names = {fmt::format("{}_{}", first, second),
             fmt::format("{} against {}", engine_info(first).title, engine_info(second).title)};
  return {"", {.name = names.name, .title = names.title}};
}

std::optional<Target> target_of(const Variant& variant, const Case& one) {
  const EngineFloor& floor = variant.floor;
  if (floor.of_value > 0) return Target{true, floor.of_value};
  if (const double limit = floor.of_peak_in(one.scene); limit > 0) return Target{false, limit};
  return {};
}

std::string short_number(double value) {
  if (value == 0) return "0";
  if (!std::isfinite(value)) return "inf";
  std::string text = fmt::format("{:.1e}", value);  // 4.9e-04
  const auto digits = text.find('e') + 2;
  while (digits + 1 < text.size() && text[digits] == '0') text.erase(digits, 1);
  if (text[digits - 1] == '+') text.erase(digits - 1, 1);
  if (const auto zero = text.find(".0e"); zero != std::string::npos) text.erase(zero, 2);
  return text;
}

std::string target_text(const Target& target) {
  return fmt::format("{} of the {}", short_number(target.limit),
                     target.relative ? "value" : "peak");
}

Figures difference_from(const Picture& reference, const Image& image,
                        std::span<const std::uint8_t> ring) {
  Figures f;
  double peak = 0, squares = 0;
  for (const Rgb& value : reference) peak = std::max(peak, max_component(value));
  std::size_t lit = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const float* const rgb = image.values().data() + 3 * i;
    const double values[] = {reference[i].r, reference[i].g, reference[i].b};
    double of_peak = 0, relative = 0;
    bool black = true;
    for (int c = 0; c < 3; ++c) {
      const double apart = std::abs(double(rgb[c]) - values[c]);
      black = black && values[c] == 0 && rgb[c] == 0;
      of_peak = std::max(of_peak, apart == 0 ? 0 : or_infinite(apart / peak));
      if (values[c] > kRelativeFrom * peak)
        relative = std::max(relative, or_infinite(apart / values[c]));
      if (ring[i] == 0) squares += apart * apart;
    }
    if (ring[i] != 0) {
      ++f.ring_pixels;
      f.ring_over += of_peak > kRingOfPeak;
      f.ring_max_of_peak = std::max(f.ring_max_of_peak, of_peak);
      continue;
    }
    lit += !black;
    f.max_of_peak = std::max(f.max_of_peak, of_peak);
    f.max_relative = std::max(f.max_relative, relative);
  }
  if (lit > 0) f.rms_of_peak = or_infinite(std::sqrt(squares / (3 * double(lit))) / peak);
  return f;
}

std::size_t Agreement::count(Verdict verdict) const {
  return std::size_t(std::ranges::count(rows, verdict, &Row::verdict) +
                     std::ranges::count(soft, verdict, &SoftRow::verdict));
}

Agreement measure(const Scope& scope, std::span<const std::unique_ptr<Engine>> engines,
                  const OnProgress& on_progress) {
  return Measurement(scope, engines, on_progress).run();
}

}  // namespace lobelia::agreement
