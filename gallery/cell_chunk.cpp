#include "gallery/cell_chunk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "gallery/cell_page.hpp"
#include "gallery/packed_pixels.hpp"
#include "gallery/packing.hpp"
#include "records/record.hpp"

namespace lobelia::gallery {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t kNewPiece = 0, kEndOfPage = 1, kFirstPiece = 2;
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

std::vector<std::string_view> pieces_of(std::string_view markup) {
  std::vector<std::string_view> pieces;
  while (!markup.empty()) {
    // Html writes '<' and '>' in texts and attributes as entities.
    const std::size_t end = markup.front() == '<' ? markup.find('>') + 1 : markup.find('<');
    pieces.push_back(markup.substr(0, end == 0 ? markup.npos : end));
    markup.remove_prefix(pieces.back().size());
  }
  return pieces;
}

void CellChunk::add(const std::string& id, std::string_view main, records::CellPage page,
                    std::vector<NamedPicture> pictures) {
  for (const std::string_view piece : pieces_of(main)) {
    if (const auto at = numbers_.find(piece); at != numbers_.end()) {
      order_.push_back(at->second);
      continue;
    }
    numbers_.emplace(piece, kFirstPiece + std::uint32_t(texts_.pieces.size()));
    texts_.pieces.emplace_back(piece);
    order_.push_back(kNewPiece);
  }
  order_.push_back(kEndOfPage);
  std::vector<int> counts;
  if (page.profile) counts = take_curves(*page.profile, curves_);
  records::PackedCell& cell =
      texts_.cells.emplace_back(records::PackedCell{id, std::move(page), {}, std::move(counts)});
  pixels_.push_back(pixels_of(std::move(pictures), cell.pictures));
}

records::CellChunk CellChunk::packed() const {
  std::vector<std::uint16_t> halves;
  for (const std::uint32_t number : order_) halves.push_back(std::uint16_t(number & 0xffff));
  for (const std::uint32_t number : order_) halves.push_back(std::uint16_t(number >> 16));
  const std::string_view order(reinterpret_cast<const char*>(halves.data()),
                               halves.size() * sizeof(std::uint16_t));
  return {packed_bytes(records::record_line(texts_)), packed_bytes(order),
          packed_bytes(curves_.bytes()), pixels_};
}

}  // namespace lobelia::gallery
