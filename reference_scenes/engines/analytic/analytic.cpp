#include "reference_scenes/engines/analytic/analytic.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/threads.hpp"
#include "base/system/version.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

using Clock = std::chrono::steady_clock;

class AnalyticSession final : public SimpleSession {
 public:
  AnalyticSession(const EngineStatus& status, const ReferenceOptions& options)
      : status_(status), options_(options), threads_(options.threads) {}

  /// Rows of a picture are divided among the threads.
  int at_once(std::size_t) const override { return 1; }
  void stop() override { stop_ = true; }

  ReferenceResult render(const Scene& scene, std::size_t) override {
    ReferenceResult result;
    result.record = reference_record(kAnalyticInfo, status_, scene);
    const auto began = result.begun = Clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - began); };
    std::atomic<bool> too_late = false;
    std::vector<Rgb> picture;
    threads_.run([&] {
      picture = truth::evaluate(
          scene, options_.fine ? truth::Digits::kFifty : truth::Digits::kDouble, [&] {
            if (elapsed() > options_.time_limit) too_late = true;
            return too_late || stop_ || interrupted();
          });
    });
    throw_if_interrupted();
    if (stop_) throw Error(ExitCode::kInterrupted, "interrupted");
    if (too_late) {
      result.failure = FailureClass::kTimedOut;
      result.error = fmt::format("{} was stopped after {:.6g} s, the time limit of a picture",
                                 kAnalyticInfo.title, options_.time_limit.count());
      return result;
    }
    result.image = truth::as_picture(picture, scene.film);
    result.record.shading = "analytic";
    result.record.method = fmt::format(
        "textbook formulas in {}, one ray per pixel centre, none of the renderer's kernels",
        options_.fine ? "50 digits" : "double precision");
    result.record.passes = 1;
    result.record.seconds.total = elapsed().count();
    return result;
  }

 private:
  const EngineStatus& status_;
  const ReferenceOptions options_;
  ThreadLimit threads_;
  std::atomic<bool> stop_ = false;
};

class Analytic final : public Engine {
 public:
  const EngineInfo& info() const override { return kAnalyticInfo; }
  const EngineStatus& status() override { return status_; }

 protected:
  std::string why_not_simple(const Scene& scene, const ReferenceOptions&) const override {
    return truth::why_not_evaluated(scene);
  }
  std::unique_ptr<SimpleSession> open_simple(const ReferenceOptions& options) override {
    return std::make_unique<AnalyticSession>(status_, options);
  }

 private:
  const EngineStatus status_{EngineState::kReady, {}, kVersion, {}};
};

}  // namespace

std::unique_ptr<Engine> make_analytic(const std::filesystem::path& program) {
  if (!program.empty())
    throw Error(ExitCode::kUsage,
                "the engine 'analytic' is part of lobelia; there is no program to name");
  return std::make_unique<Analytic>();
}

void keep_analytic_input(const Scene& scene, const ReferenceOptions& options,
                         const std::filesystem::path& directory) {
  write_file(directory / "scene.xml", scene_to_xml(scene));
  write_file(
      directory / "analytic.sh",
      fmt::format("lobelia reference scene.xml --engine analytic --precision {} -o analytic.exr\n",
                  options.fine ? kAnalyticInfo.fine : kAnalyticInfo.plain));
}

}  // namespace lobelia
