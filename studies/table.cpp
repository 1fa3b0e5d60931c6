#include "studies/table.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "core/text.hpp"

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

template <class Each>
std::string joined(const std::string& before, const std::string& between, const std::string& after,
                   std::size_t count, Each each) {
  std::string line = before;
  for (std::size_t i = 0; i < count; ++i) line += (i > 0 ? between : "") + each(i);
  return line + after;
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
  const auto line = [&](auto cell) {
    std::string words = joined("", "", "", table.columns.size(), [&](std::size_t i) {
      return in_column(cell(i), table.columns[i], table.columns[i].width);
    });
    words.erase(words.find_last_not_of(' ') + 1);
    return words + "\n";
  };
  text += line_above(table.columns) + line([&](std::size_t i) { return table.columns[i].title; });
  for (const auto& row : table.rows)
    text += row.size() == 1
                ? cell_text(row[0], "{}") + "\n"
                : line([&](std::size_t i) { return cell_text(row[i], table.columns[i].format); });
  for (const std::string& remark : table.remarks) text += "  " + remark + "\n";
  return text;
}

std::string table_csv(const Table& table, const char* line_end) {
  const auto line = [&](auto cell) {
    return joined("", ",", line_end, table.columns.size(),
                  [&](std::size_t i) { return csv_field(cell(i)); });
  };
  std::string text = line([&](std::size_t i) {
    return table.columns[i].key.empty() ? table.columns[i].title : table.columns[i].key;
  });
  for (const auto& row : table.rows)
    text += line([&](std::size_t i) { return cell_text(row[i], "{}"); });
  return text;
}

std::string table_markdown(const Table& table) {
  const auto line = [&](auto cell) {
    return joined("| ", " | ", " |\n", table.columns.size(), cell);
  };
  std::string text = line([&](std::size_t i) { return table.columns[i].title; });
  text +=
      joined("|", "|", "|\n", table.columns.size(), [](std::size_t) { return std::string("---"); });
  for (const auto& row : table.rows)
    text += line([&](std::size_t i) { return cell_text(row[i], table.columns[i].format); });
  return text;
}

}  // namespace lobelia::studies
