#include "gallery/derived_pictures.hpp"

#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/sha256.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

constexpr int kSmallSide = 160;  // pixels, of the longer side
/// A picture file up to this size is its own preview.
constexpr std::uintmax_t kLightBytes = 48 << 10;

/// Each pixel is the linear mean of the pixels that it covers.
Image reduced(const Image& image, int width, int height) {
  const auto covered = [](int i, int count, int size) {
    const auto from = int(std::int64_t{i} * size / count);
    return std::pair(from, std::max(from + 1, int(std::int64_t{i + 1} * size / count)));
  };
  Image result(width, height);
  for (int y = 0; y < height; ++y) {
    const auto [y0, y1] = covered(y, height, image.height());
    for (int x = 0; x < width; ++x) {
      const auto [x0, x1] = covered(x, width, image.width());
      double sum[3] = {};
      for (int v = y0; v < y1; ++v)
        for (int u = x0; u < x1; ++u)
          for (int c = 0; c < 3; ++c) sum[c] += image.pixel(u, v)[c];
      for (int c = 0; c < 3; ++c)
        result.pixel(x, y)[c] = static_cast<float>(sum[c] / (double(x1 - x0) * (y1 - y0)));
    }
  }
  return result;
}

std::string small_png(const fs::path& picture, int width, int height) {
  const TemporaryDirectory scratch;
  const fs::path file = scratch.path() / "small.png";
  try {
    write_png(file, to_display(reduced(read_image(picture), width, height), 0));
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    return "";  // a broken picture has no preview
  }
  return read_file(file, std::uint64_t{1} << 24);
}

void publish_small(const fs::path& run, const std::string& folder, bool all, Picture& picture,
                   Publisher& publisher) {
  if (!picture.shown() || std::max(picture.width, picture.height) <= kSmallSide) return;
  const fs::path file = run / folder / picture.file;
  std::error_code ignored;
  if (!all && fs::file_size(file, ignored) <= kLightBytes) return;
  const double factor = double(kSmallSide) / std::max(picture.width, picture.height);
  const int width = std::max(1, static_cast<int>(picture.width * factor + 0.5));
  const int height = std::max(1, static_cast<int>(picture.height * factor + 0.5));
  const std::string name = fs::path(picture.file).stem().string() + ".small.png";
  if (publisher.derive(folder + name, "small picture 1 of " + hex(sha256_of_file(file)),
                       [&] { return small_png(file, width, height); }))
    picture.small = {name, width, height};
  if (all && !picture.small.file.empty()) picture.is_published = false;
}

}  // namespace

void publish_small_pictures(const fs::path& run, CheckedCell& cell, bool all,
                            Publisher& publisher) {
  const std::string folder = "cells/" + cell.id + "/";
  for (EnginePicture& image : cell.images) publish_small(run, folder, all, image.png, publisher);
  for (CheckedComparison& comparison : cell.comparisons)
    publish_small(run, folder, all, comparison.png, publisher);
}

}  // namespace lobelia::gallery
