// Neighbouring cells in one script. gallery/web/src/cell/packed_cell.ts reads it back.
#pragma once

#include "base/pictures/image.hpp"
#include "base/records/pages.hpp"
#include "gallery/packed/packed_numbers.hpp"

namespace lobelia::gallery {

struct NamedPicture {
  std::string file;
  DisplayImage image;
};

class CellChunk {
 public:
  /// `main` is the markup of the cell's <main>.
  void add(const std::string& id, std::string main, records::CellPage page,
           std::vector<NamedPicture> pictures);
  records::CellChunk packed() const;

 private:
  records::CellTexts texts_;
  PackedNumbers curves_;
  std::vector<std::string> pixels_;
};

}  // namespace lobelia::gallery
