#include "gallery/cells/cell_chunk.hpp"

#include <algorithm>
#include <utility>

#include "base/records/record.hpp"
#include "gallery/cells/cell_page.hpp"
#include "gallery/packed/packed_pixels.hpp"
#include "gallery/packed/packing.hpp"

namespace lobelia::gallery {
namespace {

/// Takes the curves out of the profile. Those that agree with the formula to many digits are kept as their differences from
/// it, which the page shows too.
std::vector<int> take_curves(records::ShownProfile& profile, PackedNumbers& numbers) {
  std::vector<int> counts{int(profile.degrees.size())};
  numbers.add(profile.degrees, kDigits, true);
  profile.degrees.clear();
  const auto formula = std::ranges::find(profile.curves, kAnalytic, &records::ShownCurve::name);
  const std::vector<double> exact =
      formula == profile.curves.end() ? std::vector<double>{} : formula->values;
  for (records::ShownCurve& curve : profile.curves) {
    std::vector<double> values = std::exchange(curve.values, {});
    counts.push_back(int(values.size()));
    const bool is_difference =
        curve.name != kAnalytic && !exact.empty() && values.size() == exact.size();
    if (is_difference) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] -= exact[i];
      profile.from_formula.push_back(curve.name);
    }
    numbers.add(values, is_difference ? kDigitsOfDifference : kDigits, !is_difference);
  }
  return counts;
}

std::string pixels_of(std::vector<NamedPicture> pictures, std::vector<records::PackedShown>& list) {
  std::vector<DisplayImage> images;
  for (NamedPicture& picture : pictures) images.push_back(std::move(picture.image));
  const PackedPixels packed = packed_pixels(images);
  for (std::size_t i = 0; i < images.size(); ++i)
    list.push_back({pictures[i].file, images[i].width, images[i].height, packed.ways[i]});
  return packed_bytes(packed.bytes);
}

}  // namespace

void CellChunk::add(const std::string& id, std::string main, records::CellPage page,
                    std::vector<NamedPicture> pictures) {
  std::vector<int> counts;
  if (page.profile) counts = take_curves(*page.profile, curves_);
  records::PackedCell& cell = texts_.cells.emplace_back(
      records::PackedCell{id, std::move(main), std::move(page), {}, std::move(counts)});
  pixels_.push_back(pixels_of(std::move(pictures), cell.pictures));
}

records::CellChunk CellChunk::packed() const {
  return {packed_bytes(records::record_line(texts_)), packed_bytes(curves_.bytes()), pixels_};
}

}  // namespace lobelia::gallery
