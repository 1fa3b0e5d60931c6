// The one table of all studies: columns and rows, as text, CSV and Markdown.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lobelia::studies {

/// A number, printed in its column's format, or a text.
struct Cell {
  template <std::convertible_to<std::string_view> Text>
  Cell(const Text& shown) : text(std::string_view(shown)) {}
  template <class Number>
  requires std::is_arithmetic_v<Number> Cell(Number value) : number(double(value)) {}
  std::string text = {};
  std::optional<double> number = {};
};

struct Column {
  std::string title = {};
  int width = 0;  ///< in text, at least: negative aligns to the left; 0 is the width of each cell
  std::string format = "{}";  ///< of numbers in text and Markdown; CSV has all digits
  int gap = 0;                ///< blanks before it in text
  std::string above = {};  ///< a heading over this column and the following ones without their own
  int margin = 0;          ///< the least blanks in a cell's width
};

struct Table {
  std::string title;
  std::vector<Column> columns;
  /// A row with a single cell is a heading of the rows below it.
  std::vector<std::vector<Cell>> rows;
  std::vector<std::string> remarks = {};  ///< sentences, each on its own line

  /// Widens the columns to fit the rows: before rows are left out, if the widths should stay.
  void fit();
};

std::string table_text(Table table);
std::string table_csv(Table table, const char* line_end = "\n");
/// The columns and rows alone: titles and remarks are a page's own.
std::string table_markdown(const Table& table);

}  // namespace lobelia::studies
