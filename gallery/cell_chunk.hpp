// Neighbouring cells in one script. Their pages differ in a few texts: each tag and each text is written once, and a page
// is a list of their numbers. gallery/web/src/cell/packed_cell.ts reads it back.
#pragma once

#include <map>

#include "core/image.hpp"
#include "gallery/packed_numbers.hpp"
#include "records/pages.hpp"

namespace lobelia::gallery {

struct NamedPicture {
  std::string file;
  DisplayImage image;
};

class CellChunk {
 public:
  /// `main` is markup by Html.
  void add(const std::string& id, std::string_view main, records::CellPage page,
           std::vector<NamedPicture> pictures);
  records::CellChunk packed() const;

 private:
  records::CellTexts texts_;
  std::map<std::string, std::uint32_t, std::less<>> numbers_;  ///< of the pieces
  std::vector<std::uint32_t> order_;
  PackedNumbers curves_;
  std::vector<std::string> pixels_;
};

/// The tags and the texts between them.
std::vector<std::string_view> pieces_of(std::string_view markup);

}  // namespace lobelia::gallery
