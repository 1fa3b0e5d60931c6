// The parts of pictures that are measured by themselves, left out, or compared alone.
#pragma once

#include "compare/mask.hpp"
#include "compare/set/choice.hpp"

namespace lobelia {

class PictureParts {
 public:
  PictureParts() = default;
  /// Reads the shapes and their pictures, and sets the words and the cut in `options`. Throws as parse_mask_shape().
  PictureParts(const CompareChoice& choice, ComparisonOptions& options);

  /// The parts of a rule. Its `mask`, if there is one, replaces the others.
  void change(std::span<const MaskShape> mask, std::span<const MaskShape> ignored,
              ComparisonOptions& options);
  /// Pictures of masks.
  std::vector<std::filesystem::path> files() const;
  /// Sets the parts for pictures of this size in `options`, which has those of the scene and the noise of whole
  /// pictures. Throws Error(kInput) if the picture of a mask has another size, a cut does not lie inside, or every pixel
  /// is ignored.
  void apply(int width, int height, ComparisonOptions& options) const;

 private:
  std::vector<MaskShape> mask_, ignored_;
};

}  // namespace lobelia
