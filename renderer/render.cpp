#include "renderer/render.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <chrono>
#include <optional>

#include "base/system/error.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/threads.hpp"
#include "renderer/fused.hpp"
#include "renderer/kernels/kernels.hpp"
#include "renderer/plan/idle_parts.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/small_highlights.hpp"
#include "renderer/tile.hpp"

namespace lobelia {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Rows that are rendered together for a sink.
int band_rows(const Film& film, int pixels) {
  return std::max(kTileSide, pixels / film.width / kTileSide * kTileSide);
}

void require_whole_picture(const Film& film, std::string_view what) {
  if (const std::string problem = whole_picture_problem(film); !problem.empty())
    throw Error(ExitCode::kInput, "{}{}", what, problem);
}

class Render {
 public:
  Render(const Scene& scene, const RenderOptions& options, const RowSink& sink)
      : trimmed_(options.effects == EffectPolicy::kAsCalledFor ? without_idle_parts(scene)
                                                               : std::nullopt),
        scene_(trimmed_ ? *trimmed_ : scene),
        options_(options),
        sink_(sink) {}

  RenderResult run() {
    const auto start = Clock::now();
    result_.plan = make_plan(scene_, options_.effects, options_.precision, options_.experiment);
    result_.instruction_set = kernels().instruction_set;
    result_.plan_seconds = seconds_since(start);
    started_ = Clock::now();
    if (result_.plan.averages_highlights)
      averaged_ = average_small_highlights(scene_, result_.plan, result_.work);
    const bool is_fused = options_.allow_fused && FusedRenderer::can_render(scene_, result_.plan);
    if (is_fused && is_small())
      fused();
    else
      ThreadLimit(options_.threads).run([&] { is_fused ? fused() : in_tiles(); });
    throw_if_interrupted();
    result_.render_seconds = seconds_since(started_);
    return std::move(result_);
  }

 private:
  /// For a fused kernel.
  bool is_small() const {
    return std::size_t(width()) * std::size_t(height()) *
               std::max<std::size_t>(1, scene_.spheres.size() * scene_.lights.size()) <=
           kPixelsOfOneThread;
  }

  int width() const { return scene_.film.width; }
  int height() const { return scene_.film.height; }
  int all_samples() const {
    const int asked = scene_.sampler.sample_count;
    return std::min(asked, options_.max_samples.value_or(asked));
  }

  /// f(tile, workspace) for every tile of some rows.
  template <class F>
  void for_tiles(int y0, int y1, const F& f) {
    const int across = (width() + kTileSide - 1) / kTileSide;
    const int down = (y1 - y0 + kTileSide - 1) / kTileSide;
    oneapi::tbb::parallel_for(0, across * down, [&](int i) {
      if (interrupted()) return;
      const int x = i % across * kTileSide, y = y0 + i / across * kTileSide;
      f(Tile{x, y, std::min(kTileSide, width() - x), std::min(kTileSide, y1 - y)},
        workspaces_->local());
    });
  }

  /// f(y0, y1, rgb) renders rows y0..y1 - 1. Without a sink it is called once for all rows; with one it is called for
  /// band after band, each while the sink takes the one before.
  template <class F>
  void in_bands(const F& f) {
    if (!sink_) {
      require_whole_picture(scene_.film, "");
      result_.image = Image(width(), height());
      f(0, height(), result_.image.values().data());
      put_averages(0, height(), result_.image.values().data());
      return;
    }
    const int rows = std::min(band_rows(scene_.film, options_.band_pixels), height());
    std::vector<float, ZeroedMemory<float>> buffers[2];
    if (rows == height()) {  // without a task_group, which would start oneTBB
      buffers[0].resize(std::size_t(3) * std::size_t(width()) * std::size_t(rows));
      f(0, rows, buffers[0].data());
      put_averages(0, rows, buffers[0].data());
      if (!interrupted()) sink_(0, rows, buffers[0].data());
      return;
    }
    oneapi::tbb::task_group writing;
    for (int y0 = 0, band = 0; y0 < height() && !interrupted(); y0 += rows, ++band) {
      const int y1 = std::min(height(), y0 + rows);
      auto& buffer = buffers[band % 2];
      buffer.resize(std::size_t(3) * std::size_t(width()) * std::size_t(y1 - y0));
      f(y0, y1, buffer.data());
      put_averages(y0, y1, buffer.data());
      if (interrupted()) break;
      writing.wait();
      writing.run([this, y0, y1, &buffer] { sink_(y0, y1 - y0, buffer.data()); });
    }
    writing.wait();
  }

  void put_averages(int y0, int y1, float* rgb) const {
    for (const auto& [x, y, mean] : averaged_) {
      if (y < y0 || y >= y1) continue;
      float* to = rgb + 3 * (std::size_t(width()) * std::size_t(y - y0) + std::size_t(x));
      to[0] = float(mean.r), to[1] = float(mean.g), to[2] = float(mean.b);
    }
  }

  /// One ray a pixel, by one kernel.
  void fused() {
    const FusedRenderer renderer(scene_, result_.plan);
    std::atomic<int> done{0};
    in_bands([&](int y0, int y1, float* rgb) {
      const oneapi::tbb::blocked_range<int> all(y0, y1,
                                                std::size_t(FusedRenderer::rows_of_task(width())));
      const auto render_rows = [&](const oneapi::tbb::blocked_range<int>& rows) {
        if (interrupted()) return;
        renderer.render_rows(
            rows.begin(), rows.end(),
            rgb + std::size_t(3) * std::size_t(width()) * std::size_t(rows.begin() - y0), !sink_);
        report(double(done += rows.end() - rows.begin()) / height());
      };
      if (is_small())
        render_rows(all);
      else
        oneapi::tbb::parallel_for(all, render_rows);
    });
    result_.samples = 1;
    result_.work += renderer.work();
    if (options_.target_error || options_.time_limit)
      result_.stop_reason = "after one sample a pixel: nothing in the scene is random";
  }

  void in_tiles() {
    const auto build = Clock::now();
    tiles_ = std::make_unique<TileRenderer>(scene_, result_.plan);
    workspaces_.emplace();
    result_.build_seconds = seconds_since(build);
    if (options_.target_error || options_.time_limit)
      in_rounds();
    else
      at_once();
    for (const Workspace& workspace : *workspaces_) result_.work += workspace.work;
    const auto release = Clock::now();
    tiles_.reset();
    result_.build_seconds += seconds_since(release);
  }

  /// Every tile with all its samples.
  void at_once() {
    const int samples = all_samples();
    const std::size_t across = std::size_t((width() + kTileSide - 1) / kTileSide);
    std::vector<Spread> spread(across * std::size_t((height() + kTileSide - 1) / kTileSide));
    std::atomic<std::int64_t> pixels{0};
    in_bands([&](int y0, int y1, float* rgb) {
      for_tiles(y0, y1, [&](const Tile& tile, Workspace& workspace) {
        spread[std::size_t(tile.y / kTileSide) * across + std::size_t(tile.x / kTileSide)] =
            tiles_->render(tile, samples, rgb, y0, workspace);
        report(double(pixels += std::int64_t{tile.width} * tile.height) /
               (double(width()) * height()));
      });
    });
    result_.samples = samples;
    Spread sum;
    for (const Spread& s : spread) sum += s;
    if (tiles_->is_random() && samples > tiles_->least_samples()) result_.error = sum.error();
  }

  /// Takes a few samples of all pixels, then as many again, until that is enough.
  void in_rounds() {
    require_whole_picture(scene_.film, "a target error or a time limit: ");
    const int most =
        options_.target_error ? options_.max_samples.value_or(kMostSamples) : all_samples();
    Frame frame(width(), height(), tiles_->negative_weight());
    int done = 0;
    while (done < most && !interrupted()) {
      int next = std::min(most, more_than(done));
      if (options_.time_limit && done > 0) {
        const double elapsed = seconds_since(started_), left = *options_.time_limit - elapsed;
        const int affordable = int(std::min(1e9, left / (elapsed / done)));
        if (affordable < 1) {
          result_.stop_reason = fmt::format("after {} samples a pixel: the time limit of {:g} s",
                                            done, *options_.time_limit);
          break;
        }
        next = std::min(next, done + affordable);
      }
      for_tiles(0, height(), [&](const Tile& tile, Workspace& workspace) {
        tiles_->add(tile, done, next, frame, workspace);
      });
      if (done > 0) result_.error = frame.error(done, next);
      done = next;
      report(progress(done, most));
      if (!tiles_->is_random() && scene_.sampler.sample_count == 1) {
        result_.error.reset();
        result_.stop_reason = "after one sample a pixel: nothing in the scene is random";
        break;
      }
      // Below 8 samples the difference of the halves says little about the error.
      if (options_.target_error && done >= 8 && *result_.error <= *options_.target_error) {
        result_.stop_reason =
            fmt::format("after {} samples a pixel: an error of {:.3g}, {:g} asked", done,
                        *result_.error, *options_.target_error);
        break;
      }
    }
    if (result_.stop_reason.empty())
      result_.stop_reason = fmt::format("after {} samples a pixel: no more were allowed", done);
    result_.samples = done;
    if (interrupted()) return;
    Image image(width(), height());
    frame.resolve(image);
    put_averages(0, height(), image.values().data());
    if (sink_)
      sink_(0, height(), image.values().data());
    else
      result_.image = std::move(image);
  }

  /// Doubles the samples, or less if the target will be reached before: the error falls about as the power 0.7 of the
  /// samples.
  int more_than(int done) const {
    if (done == 0) return tiles_->least_samples();
    double growth = 2;
    if (options_.target_error && done >= 8)
      growth = std::clamp(std::pow(*result_.error / *options_.target_error, 1 / 0.7), 1.25, 2.0);
    return int(std::ceil(growth * done));
  }

  double progress(int done, int most) const {
    double fraction = double(done) / most;
    if (options_.time_limit)
      fraction = std::max(fraction, seconds_since(started_) / *options_.time_limit);
    // Errors fall at least as the square root of the samples.
    if (options_.target_error && result_.error && *result_.error > 0)
      fraction = std::max(fraction, std::pow(*options_.target_error / *result_.error, 2));
    return std::min(1.0, fraction);
  }

  void report(double fraction) const {
    if (options_.on_progress) options_.on_progress(fraction);
  }

  /// Sample indices have 32 bits, and so many samples leave less error than float32.
  static constexpr int kMostSamples = 1 << 20;

  std::optional<Scene> trimmed_;
  const Scene& scene_;
  const RenderOptions& options_;
  const RowSink& sink_;
  Clock::time_point started_;
  std::unique_ptr<TileRenderer> tiles_;
  /// Optional, because it allocates by oneTBB, whose allocator takes longer to load than a small picture to render.
  std::optional<oneapi::tbb::enumerable_thread_specific<Workspace>> workspaces_;
  std::vector<AveragedPixel> averaged_;
  RenderResult result_;
};

}  // namespace

RenderResult render(const Scene& scene, const RenderOptions& options, const RowSink& sink) {
  return Render(scene, options, sink).run();
}

Image standard_error_of_render(const Scene& scene, RenderOptions options) {
  const auto on_progress = options.on_progress;
  Image first;
  std::vector<double> sums, squares;
  for (int k = 0; k < kErrorRenders; ++k) {
    if (on_progress)
      options.on_progress = [&](double fraction) { on_progress((k + fraction) / kErrorRenders); };
    Scene again = scene;
    again.sampler.seed += std::uint64_t(k) + 1;
    Image image = render(again, options).image;
    sums.resize(image.values().size());
    squares.resize(image.values().size());
    if (k == 0)
      first = std::move(image);
    else
      for (std::size_t i = 0; i < sums.size(); ++i) {
        // Relative to the first render: no digits are lost where the values are nearly the same.
        const double apart = double(image.values()[i]) - double(first.values()[i]);
        sums[i] += apart;
        squares[i] += apart * apart;
      }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double variance =
        std::max(0.0, squares[i] - sums[i] * sums[i] / kErrorRenders) / kErrorFreedom;
    first.values()[i] = float(std::sqrt(variance));
  }
  return first;
}

}  // namespace lobelia
