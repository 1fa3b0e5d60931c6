#include "renderer/render.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "core/interrupt.hpp"
#include "core/threads.hpp"
#include "renderer/fused.hpp"
#include "renderer/kernels/kernels.hpp"
#include "renderer/tile.hpp"

namespace lobelia {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Rows that are rendered together where a sink takes them: some 4 million pixels.
int band_rows(const Film& film) {
  const int rows = std::max(1, (4 << 20) / film.width);
  return std::max(kTileSide, rows / kTileSide * kTileSide);
}

class Render {
 public:
  Render(const Scene& scene, const RenderOptions& options, const RowSink* sink)
      : scene_(scene), options_(options), sink_(sink) {}

  RenderResult run() {
    const auto start = Clock::now();
    result_.plan = make_plan(scene_, options_.effects, options_.precision, options_.experiment);
    result_.instruction_set = kernels().instruction_set;
    result_.plan_seconds = seconds_since(start);
    started_ = Clock::now();
    ThreadLimit(options_.threads).run([&] {
      if (options_.allow_fused && FusedRenderer::can_render(scene_, result_.plan)) {
        fused();
        return;
      }
      const WaveRenderer renderer(scene_, result_.plan);
      tiles_ = std::make_unique<TileRenderer>(scene_, result_.plan, renderer);
      if (options_.target_error || options_.time_limit)
        in_rounds();
      else
        at_once();
      tiles_.reset();
    });
    throw_if_interrupted();
    for (auto& workspace : workspaces_) result_.work += workspace->work;
    result_.render_seconds = seconds_since(started_);
    return std::move(result_);
  }

 private:
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
        *workspaces_.local());
    });
  }

  /// f(y0, y1, rgb) makes rows y0..y1 - 1 of the picture: all of them, or if a sink takes them, bands of
  /// them one after the other, each while the one before is taken.
  template <class F>
  void in_bands(const F& f) {
    const int rows = sink_ ? std::min(band_rows(scene_.film), height()) : height();
    if (!sink_) {
      result_.image = Image(width(), height());
      f(0, height(), result_.image.values().data());
      return;
    }
    std::vector<float> buffers[2];
    oneapi::tbb::task_group writing;
    for (int y0 = 0, band = 0; y0 < height() && !interrupted(); y0 += rows, ++band) {
      const int y1 = std::min(height(), y0 + rows);
      std::vector<float>& buffer = buffers[band % 2];
      buffer.resize(std::size_t(3) * std::size_t(width()) * std::size_t(y1 - y0));
      f(y0, y1, buffer.data());
      if (interrupted()) break;
      writing.wait();
      writing.run([this, y0, y1, &buffer] { (*sink_)(y0, y1 - y0, buffer.data()); });
    }
    writing.wait();
  }

  /// One ray a pixel, everything in one kernel.
  void fused() {
    const FusedRenderer renderer(scene_, result_.plan);
    std::atomic<int> done{0};
    in_bands([&](int y0, int y1, float* rgb) {
      oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<int>(y0, y1, 8),
                                [&](const oneapi::tbb::blocked_range<int>& rows) {
                                  if (interrupted()) return;
                                  renderer.render_rows(rows.begin(), rows.end(),
                                                       rgb + std::size_t(3) * std::size_t(width()) *
                                                                 std::size_t(rows.begin() - y0));
                                  report(double(done += rows.end() - rows.begin()) / height());
                                });
    });
    result_.samples = 1;
    result_.work += renderer.work();
    if (options_.target_error || options_.time_limit)
      result_.stop_reason = "after one sample a pixel: nothing in the scene is random";
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

  /// All pixels with some samples, then with as many again, until it is enough.
  void in_rounds() {
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
      // One sample against one says little; from 8 on the halves' difference is an error.
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
    if (sink_)
      (*sink_)(0, height(), image.values().data());
    else
      result_.image = std::move(image);
  }

  /// As many again; fewer where the error, which falls about as the power 0.7 of the samples, will be
  /// reached before.
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

  /// Sample indices are 32 bits, and the error by then is below float32's own.
  static constexpr int kMostSamples = 1 << 20;

  const Scene& scene_;
  const RenderOptions& options_;
  const RowSink* sink_;
  Clock::time_point started_;
  std::unique_ptr<TileRenderer> tiles_;
  oneapi::tbb::enumerable_thread_specific<std::unique_ptr<Workspace>> workspaces_{
      [] { return std::make_unique<Workspace>(); }};
  RenderResult result_;
};

}  // namespace

RenderResult render(const Scene& scene, const RenderOptions& options) {
  return Render(scene, options, nullptr).run();
}

RenderResult render(const Scene& scene, const RenderOptions& options, const RowSink& sink) {
  return Render(scene, options, &sink).run();
}

}  // namespace lobelia
