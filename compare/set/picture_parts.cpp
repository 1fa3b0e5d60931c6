#include "compare/set/picture_parts.hpp"

#include <algorithm>

#include "base/system/error.hpp"

namespace lobelia {
namespace {

/// Without the pixels that are ignored nothing would be left to compare.
void require_some_left(const PixelFlags& ignored) {
  if (std::ranges::count(ignored, 0) == 0)
    throw Error(ExitCode::kInput, "--ignore: covers every pixel, so nothing is left to compare");
}

}  // namespace

PictureParts::PictureParts(const CompareChoice& choice, ComparisonOptions& options) {
  for (const std::string& text : choice.mask) mask_.push_back(parse_mask_shape("--mask", text));
  for (const std::string& text : choice.ignore)
    ignored_.push_back(parse_mask_shape("--ignore", text));
  options.mask_of.insert(options.mask_of.begin(), choice.mask.begin(), choice.mask.end());
  options.ignored_of = choice.ignore;
  if (choice.crop.empty()) return;
  const MaskShape crop = parse_mask_shape("--crop", "rect:" + choice.crop);
  const auto& [x, y, width, height] = std::get<MaskShape::Rectangle>(crop.form);
  options.crop = PixelWindow{x, y, width, height};
}

void PictureParts::change(std::span<const MaskShape> mask, std::span<const MaskShape> ignored,
                          ComparisonOptions& options) {
  if (!mask.empty()) {
    const auto first = options.mask_of.begin();
    options.mask_of.erase(first, first + std::ptrdiff_t(mask_.size()));
    mask_.assign(mask.begin(), mask.end());
    for (auto shape = mask.rbegin(); shape != mask.rend(); ++shape)
      options.mask_of.insert(options.mask_of.begin(), shape->text);
  }
  for (const MaskShape& shape : ignored) {
    ignored_.push_back(shape);
    options.ignored_of.push_back(shape.text);
  }
}

std::vector<std::filesystem::path> PictureParts::files() const {
  std::vector<std::filesystem::path> files = picture_files(mask_);
  for (std::filesystem::path& file : picture_files(ignored_)) files.push_back(std::move(file));
  return files;
}

void PictureParts::apply(int width, int height, ComparisonOptions& options) const {
  options.mask = options.surfaces;
  if (!mask_.empty()) {
    options.mask = pixels_inside(mask_, width, height);
    for (std::size_t i = 0; i < options.surfaces.size(); ++i)
      if (options.surfaces[i] == 0) options.mask[i] = 0;
  }
  if (!ignored_.empty()) options.ignored = pixels_inside(ignored_, width, height);
  PixelFlags* parts[] = {&options.mask, &options.surfaces, &options.ignored,
                         options.tolerance ? &options.tolerance->edges : nullptr};
  for (PixelFlags* part : parts)
    if (part && options.crop) *part = cut(*part, width, *options.crop);
  if (!ignored_.empty()) require_some_left(options.ignored);
  if (!options.noise) return;
  for (auto* noise : {&options.noise->a, &options.noise->b}) {
    if (!*noise) continue;
    for (Image* errors : (*noise)->images()) {
      if (options.crop) *errors = cut(std::move(*errors), *options.crop);
      for (std::size_t i = 0; i < 3 * options.ignored.size(); ++i)
        if (options.ignored[i / 3] != 0) errors->values()[i] = 0;
    }
  }
}

}  // namespace lobelia
