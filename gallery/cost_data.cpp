#include "gallery/cost_data.hpp"

#include <cmath>
#include <limits>

#include "core/text.hpp"

namespace lobelia::gallery {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

CostWay read_way(const Fields& fields, const std::vector<CostError>& errors) {
  CostWay way{fields.text("name"), kUnknown, 0, {}, {}};
  if (const auto seconds = fields.object("seconds")) {
    way.median = seconds->number("median").value_or(kUnknown);
    way.spread = seconds->number("spread").value_or(0);
  } else {
    way.median = fields.number("count").value_or(kUnknown);
  }
  const auto values = fields.object("errors"), spreads = fields.object("errorSpreads");
  for (const CostError& error : errors) {
    way.errors.push_back(values ? values->number(error.id).value_or(kUnknown) : kUnknown);
    way.error_spreads.push_back(spreads ? spreads->number(error.id).value_or(0) : 0);
  }
  return way;
}

CostTable read_table(const Fields& fields) {
  const std::string unit = fields.text("unit");
  CostTable table{fields.text("level"),
                  fields.text("title"),
                  fields.text("per"),
                  unit == "s" ? "" : unit,
                  {},
                  {},
                  fields.texts("remarks")};
  const auto fronts = fields.object("fronts");
  for (const Fields& one : fields.objects("errors")) {
    CostError error{one.text("id"), one.text("meaning"), {}, {}};
    if (const auto front = fronts ? fronts->object(error.id) : std::nullopt) {
      error.front = front->texts("ways");
      error.in_words = front->texts("inWords");
    }
    table.errors.push_back(std::move(error));
  }
  for (const Fields& one : fields.objects("ways"))
    table.ways.push_back(read_way(one, table.errors));
  return table;
}

}  // namespace

CostData read_cost(const Fields& fields) {
  CostData data{shell_join(fields.texts("command")), {}, {}};
  if (const auto host = fields.object("host")) data.host = host->described_members();
  for (const Fields& table : fields.objects("tables")) data.tables.push_back(read_table(table));
  return data;
}

}  // namespace lobelia::gallery
