#include <algorithm>

#include "cli/compare_pictures.hpp"
#include "cli/options.hpp"
#include "compare/uncertainty/noise.hpp"

namespace lobelia::cli {
namespace {

/// Without the pixels that are ignored nothing would be left to compare.
void require_some_left(const PixelFlags& ignored) {
  if (std::ranges::count(ignored, 0) == 0)
    throw Error(ExitCode::kInput, "--ignore: covers every pixel, so nothing is left to compare");
}

}  // namespace

void RegionFlags::add_to(CLI::App& command) {
  OptionGroup group(command, "Parts of the pictures");
  const auto add = [&](const char* name, std::vector<std::string>& texts, const char* help) {
    group.add(name, texts, "FILE|rect:X,Y,W,H|polygon:X,Y X,Y ...", help)->expected(1)->take_all();
  };
  add("--mask", mask_texts_,
      "Measure on this part as well (ids in .mask) and on the rest (.outside): the pixels of a picture "
      "that are not 0, a rectangle, or a polygon, in quotes; may be given again, which adds to "
      "the part. With --scene, only what lies on a surface too is inside");
  add("--ignore", ignore_texts_,
      "These pixels count as equal in every metric: A has the values of B there; may be given again");
  group.add("--crop", crop_text_, "X,Y,W,H",
            "Compare this part of both pictures alone. Masks and scenes are of the whole pictures");
}

void RegionFlags::read(ComparisonOptions& options) {
  for (const std::string& text : mask_texts_) mask_.push_back(parse_mask_shape("--mask", text));
  for (const std::string& text : ignore_texts_)
    ignored_.push_back(parse_mask_shape("--ignore", text));
  options.mask_of.insert(options.mask_of.begin(), mask_texts_.begin(), mask_texts_.end());
  options.ignored_of = ignore_texts_;
  if (crop_text_.empty()) return;
  const MaskShape crop = parse_mask_shape("--crop", "rect:" + crop_text_);
  const auto& [x, y, width, height] = std::get<MaskShape::Rectangle>(crop.form);
  options.crop = PixelWindow{x, y, width, height};
}

void RegionFlags::add(const std::vector<std::string>& mask,
                      const std::vector<std::string>& ignore) {
  if (mask_texts_.empty()) mask_texts_ = mask;
  ignore_texts_.insert(ignore_texts_.begin(), ignore.begin(), ignore.end());
}

void RegionFlags::change(std::span<const MaskShape> mask, std::span<const MaskShape> ignored,
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

std::vector<std::filesystem::path> RegionFlags::files() const {
  std::vector<std::filesystem::path> files = picture_files(mask_);
  for (std::filesystem::path& file : picture_files(ignored_)) files.push_back(std::move(file));
  return files;
}

void RegionFlags::apply(int width, int height, ComparisonOptions& options) const {
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
    for (Image* errors : {&(*noise)->standard_error, &(*noise)->cautious}) {
      if (options.crop) *errors = cut(std::move(*errors), *options.crop);
      for (std::size_t i = 0; i < 3 * options.ignored.size(); ++i)
        if (options.ignored[i / 3] != 0) errors->values()[i] = 0;
    }
  }
}

}  // namespace lobelia::cli
