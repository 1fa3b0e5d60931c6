#include <fmt/format.h>

#include <cmath>

#include "bench/sections.hpp"
#include "core/colour.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"

namespace lobelia::bench {

void reading() {
  const TemporaryDirectory directory;
  fmt::print(
      "\nReading a picture: by this process, and contained in one of its own; interleaved rounds\n"
      "{:<6}{:>6}{:>12}{:>9}{:>14}{:>9}{:>12}\n",
      "file", "side", "direct ms", "spread", "contained ms", "spread", "price ms");
  double least_price = 1e9;
  for (const int side : {64, 512, 4096})
    for (const char* kind : {"exr", "png"}) {
      Image image(side, side);
      for (std::size_t i = 0; i < image.values().size(); ++i)
        image.values()[i] = float(std::sin(0.001 * double(i)) + 1);
      const std::filesystem::path path = directory.path() / fmt::format("a.{}", kind);
      if (path.extension() == ".exr")
        write_exr(path, image, {});
      else
        write_png(path, to_display(image, 0));
      const auto times = interleaved({[&] { read_trusted_image(path); }, [&] { read_image(path); }},
                                     side > 1000 ? 9 : 41);
      const double price = 1e3 * (times[1].median - times[0].median);
      least_price = std::min(least_price, price);
      fmt::print("{:<6}{:>6}{:>12.2f}{:>8.0f}%{:>14.2f}{:>8.0f}%{:>12.2f}\n", kind, side,
                 1e3 * times[0].median, 1e2 * times[0].spread, 1e3 * times[1].median,
                 1e2 * times[1].spread, price);
    }
  fmt::print(
      "Limit: of small pictures the fork and what the child copies of its parent's memory ({:.1f} ms), of "
      "large ones the pipe.\n",
      least_price);
}

void starting() {
  const auto times = interleaved({[] { run_process({"/bin/true"}, {}); }}, 1000).front();
  fmt::print("a program that does nothing: {:.2f} ms, spread {:.0f} %, {:.2f} to {:.2f} ms\n",
             1e3 * times.median, 100 * times.spread, 1e3 * times.least, 1e3 * times.most);
}

}  // namespace lobelia::bench
