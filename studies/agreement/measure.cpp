#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>

#include "core/at_once.hpp"
#include "core/interrupt.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/render.hpp"
#include "studies/agreement/agreement.hpp"

namespace lobelia::agreement {
namespace {

/// From here on double itself would be a part of what is measured.
constexpr double kFiftyDigitsFrom = 1e5;

ReferenceOptions options_of(const Variant& variant) {
  ReferenceOptions options;
  options.fine = variant.fine;
  options.shading = variant.shading;
  return options;
}

Verdict verdict_of(const Variant& variant, const Case& one, const Figures& figures) {
  const auto target = target_of(variant, one.highlight.exponent);
  if (!target) return Verdict::kNoTarget;
  const double value = target->relative ? figures.max_relative : figures.max_of_peak;
  return value <= target->limit && figures.ring_over <= one.ring_allowed ? Verdict::kMet
                                                                         : Verdict::kMissed;
}

/// All about one case that does not depend on the variant.
struct Truth {
  std::string why_not;
  Picture picture;
  std::vector<std::uint8_t> ring;
};

class Measurement {
 public:
  Measurement(const Scope& scope, std::span<const std::unique_ptr<Engine>> engines,
              const OnProgress& on_progress)
      : engines_(engines), on_progress_(on_progress) {
    result_.scope = scope;
    result_.cases = highlight_cases(scope);
    for (Case& effect : effect_cases(scope)) result_.cases.push_back(std::move(effect));
    for (const auto& engine : engines)
      result_.engines.push_back({engine->info(), engine->status()});
  }

  Agreement run() {
    plan();
    evaluate();
    compare_ours();
    for (const Work& work : work_) compare_engine(work);
    compare_directly();
    result_.soft =
        measure_soft(result_.scope, engines_, [this](std::string_view what) { one_done(what); });
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
    total_ += 2 * result_.cases.size() + soft_pictures(result_.scope, engines_);
  }

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
    if (result.error.empty() && result.record.witness != asked) {
      result.failure = FailureClass::kRefused;
      result.error =
          fmt::format("asked for highlights that are {}, the engine rendered some that are {}",
                      asked, result.record.witness);
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
    const Figures figures = difference_from(truths_[i].picture, image, truths_[i].ring);
    result_.rows.push_back(
        {i, variant, figures, verdict_of(variant, result_.cases[i], figures), {}});
  }

  /// The finer format comes later and stays.
  void keep_reimplemented(std::size_t i, const Variant& variant, Image image) {
    auto& pictures = reimplemented_[i];
    const auto found = std::ranges::find(pictures, variant.engine, &EnginePicture::engine);
    if (found == pictures.end())
      pictures.push_back({variant.engine, std::move(image)});
    else
      found->image = std::move(image);
  }

  /// The first engine that was told our formulas, in its finest format, against each other one.
  void compare_directly() {
    for (const auto& [i, pictures] : reimplemented_)
      for (std::size_t k = 1; k < pictures.size(); ++k) {
        const Figures figures =
            difference_from(picture_of(pictures[0].image), pictures[k].image, truths_[i].ring);
        result_.rows.push_back(
            {i, pair_of(pictures[0].engine, pictures[k].engine), figures, Verdict::kNoTarget, {}});
      }
  }

  void one_done(std::string_view what) {
    if (on_progress_) on_progress_(double(++done_) / double(total_), what);
  }

  std::span<const std::unique_ptr<Engine>> engines_;
  const OnProgress& on_progress_;
  Agreement result_;
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

std::size_t Agreement::count(Verdict verdict) const {
  return std::size_t(std::ranges::count(rows, verdict, &Row::verdict) +
                     std::ranges::count(soft, verdict, &SoftRow::verdict));
}

Agreement measure(const Scope& scope, std::span<const std::unique_ptr<Engine>> engines,
                  const OnProgress& on_progress) {
  return Measurement(scope, engines, on_progress).run();
}

}  // namespace lobelia::agreement
