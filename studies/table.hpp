// The one table of all studies: columns and rows, and the forms in which people and programs read them.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lobelia::studies {

/// A number is printed by its column's format, a text as it is.
struct Cell {
  template <std::convertible_to<std::string_view> Text>
  Cell(const Text& shown) : text(std::string_view(shown)) {}
  template <class Number>
  requires std::is_arithmetic_v<Number> Cell(Number value) : number(double(value)) {}
  std::string text = {};
  std::optional<double> number = {};
};

struct Column {
  std::string title = {};  ///< in text and Markdown, and in CSV without a key
  int width = 0;  ///< in text: negative to the left; 0 as wide as its cell; wider where a cell is
  std::string format = "{}";  ///< of numbers in text and Markdown; CSV has all digits
  int gap = 0;                ///< blanks before it in text
  std::string above = {};     ///< a heading over this and the next columns that have none
  int margin = 0;             ///< blanks that a cell leaves of the width at least
  std::string key = {};       ///< in CSV
};

struct Table {
  std::string title;
  std::vector<Column> columns;
  /// A row of a single cell in a table of more columns is a heading of the rows below it.
  std::vector<std::vector<Cell>> rows;
  std::vector<std::string> remarks = {};  ///< sentences, each printed on a line of its own

  /// Widens the columns to what the rows need, also where some are then left out.
  void fit();
};

std::string table_text(Table table);
std::string table_csv(const Table& table, const char* line_end = "\n");
/// The columns and rows alone: titles and remarks are a page's own.
std::string table_markdown(const Table& table);

}  // namespace lobelia::studies
