#include "studies/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "base/words/text.hpp"

namespace lobelia::studies {
namespace {

std::string cell_text(const Cell& cell, const std::string& format) {
  return cell.number ? fmt::format(fmt::runtime(format), *cell.number) : cell.text;
}

std::string in_column(const std::string& text, const Column& column, int width) {
  return std::string(std::size_t(column.gap), ' ') +
         (width > 0 ? fmt::format("{:>{}}", text, width) : fmt::format("{:<{}}", text, -width));
}

/// The headings over several columns, or nothing.
std::string line_above(const std::vector<Column>& columns) {
  std::string line;
  for (std::size_t i = 0; i < columns.size();) {
    const Column& first = columns[i];
    int width = std::abs(first.width);
    for (++i; i < columns.size() && columns[i].above.empty(); ++i)
      width += columns[i].gap + std::abs(columns[i].width);
    line += in_column(first.above, first, -width);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line.empty() ? line : line + "\n";
}

/// The texts of the titles and of each row.
std::vector<std::vector<std::string>> grid(const Table& table) {
  std::vector<std::vector<std::string>> lines(1);
  for (const Column& column : table.columns) lines[0].push_back(column.title);
  for (const auto& row : table.rows) {
    auto& line = lines.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i)
      line.push_back(cell_text(row[i], table.columns[i].format));
  }
  return lines;
}

}  // namespace

void Table::fit() {
  for (const auto& row : rows)
    for (std::size_t i = 0; i < columns.size() && row.size() == columns.size(); ++i) {
      Column& column = columns[i];
      const int needed = int(cell_text(row[i], column.format).size()) + column.margin;
      if (column.width != 0 && needed > std::abs(column.width))
        column.width = column.width > 0 ? needed : -needed;
    }
}

std::string table_text(Table table) {
  table.fit();
  std::string text = table.title.empty() ? "" : "\n" + table.title + "\n";
  text += line_above(table.columns);
  for (const auto& cells : grid(table)) {
    std::string line = cells.size() == 1 ? cells[0] : "";
    for (std::size_t i = 0; i < cells.size() && cells.size() > 1; ++i)
      line += in_column(cells[i], table.columns[i], table.columns[i].width);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  for (const std::string& remark : table.remarks) text += "  " + remark + "\n";
  return text;
}

std::string table_csv(Table table, const char* line_end) {
  for (Column& column : table.columns) column.format = "{}";
  std::string text;
  for (auto& cells : grid(table)) {
    std::ranges::transform(cells, cells.begin(), csv_field);
    text += fmt::format("{}{}", fmt::join(cells, ","), line_end);
  }
  return text;
}

std::string table_markdown(const Table& table) {
  std::string text, rule = "|";
  for (std::size_t i = 0; i < table.columns.size(); ++i) rule += "---|";
  rule += "\n";
  for (const auto& cells : grid(table)) {
    text += fmt::format("| {} |\n", fmt::join(cells, " | "));
    text += std::exchange(rule, "");
  }
  return text;
}

}  // namespace lobelia::studies
