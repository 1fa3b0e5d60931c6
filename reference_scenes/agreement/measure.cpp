#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "core/interrupt.hpp"
#include "reference_scenes/agreement/agreement.hpp"
#include "renderer/render.hpp"
#include "verify/truth/evaluation.hpp"

namespace lobelia::agreement {
namespace {

/// From here on double itself would be a part of what is measured.
constexpr double kFiftyDigitsFrom = 1e5;

ReferenceOptions options_of(const WitnessKind& witness) {
  ReferenceOptions options;
  options.fine = witness.fine;
  options.witness = witness.witness;
  return options;
}

Verdict verdict_of(const WitnessKind& witness, const Case& one, const Figures& figures) {
  const auto target = target_of(witness, one.highlight.exponent);
  if (!target) return Verdict::kNoTarget;
  const double value = target->relative ? figures.max_relative : figures.max_of_peak;
  return value <= target->limit && figures.ring_over <= one.ring_allowed ? Verdict::kMet
                                                                         : Verdict::kMissed;
}

/// All about one case that does not depend on the witness.
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
      return std::pair(rank_of(row.witness), row.index);
    });
    return std::move(result_);
  }

 private:
  struct Work {
    WitnessKind witness;
    Engine* engine;
    std::vector<std::size_t> cases;
  };

  static std::ptrdiff_t rank_of(const WitnessKind& witness) {
    if (witness.name == kOurs.name) return -1;
    return std::ranges::find(witnesses(), witness.name, &WitnessKind::name) - witnesses().begin();
  }

  void plan() {
    for (const WitnessKind& witness : witnesses())
      for (const auto& engine : engines_) {
        if (engine->info().name != witness.engine || !engine->status().available()) continue;
        Work work{witness, engine.get(), {}};
        for (std::size_t i = 0; i < result_.cases.size(); ++i) {
          const Case& one = result_.cases[i];
          std::string why = engine->why_not(one.scene, options_of(witness));
          if (why.empty())
            work.cases.push_back(i);
          else
            result_.rows.push_back({i, witness, {}, Verdict::kNotComparable, std::move(why)});
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
        add(i, kOurs, render(result_.cases[i].scene, {}).image);
      else
        result_.rows.push_back({i, kOurs, {}, Verdict::kNotComparable, truths_[i].why_not});
      one_done(kOurs.title);
    }
  }

  void compare_engine(const Work& work) {
    std::vector<Scene> scenes;
    for (const std::size_t i : work.cases) scenes.push_back(result_.cases[i].scene);
    work.engine->render(scenes, options_of(work.witness),
                        [&](std::size_t index, ReferenceResult result) {
                          take(work.cases[index], work.witness, std::move(result));
                          one_done(work.witness.title);
                        });
  }

  void take(std::size_t i, const WitnessKind& witness, ReferenceResult result) {
    const std::string_view asked = kWitnessNames[std::size_t(witness.witness)];
    if (result.error.empty() && result.record.witness != asked) {
      result.failure = FailureClass::kRefused;
      result.error =
          fmt::format("asked for highlights that are {}, the engine rendered some that are {}",
                      asked, result.record.witness);
    }
    if (!result.error.empty()) {
      result_.rows.push_back({i, witness, {}, Verdict::kFailed, result.error});
      return;
    }
    add(i, witness, result.image);
    // The finer format comes later and stays.
    if (witness.witness == Witness::kExpressed)
      told_[i].insert_or_assign(std::string(witness.engine), std::move(result.image));
  }

  void add(std::size_t i, const WitnessKind& witness, const Image& image) {
    const Figures figures = difference_from(truths_[i].picture, image, truths_[i].ring);
    result_.rows.push_back(
        {i, witness, figures, verdict_of(witness, result_.cases[i], figures), {}});
  }

  void compare_directly() {
    for (const auto& [i, pictures] : told_) {
      const auto povray = pictures.find("povray"), blender = pictures.find("blender");
      if (povray == pictures.end() || blender == pictures.end()) continue;
      result_.rows.push_back(
          {i,
           kDirect,
           difference_from(picture_of(povray->second), blender->second, truths_[i].ring),
           Verdict::kNoTarget,
           {}});
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
  std::map<std::size_t, std::map<std::string, Image>> told_;  ///< by case and engine
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
