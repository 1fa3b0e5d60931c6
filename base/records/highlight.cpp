#include "base/records/highlight.hpp"

#include <sys/utsname.h>

#include <thread>

#include "base/system/host.hpp"

namespace lobelia::records {

Host this_host() {
  utsname system{};
  ::uname(&system);
  return {processor_name(), std::thread::hardware_concurrency(),
          std::string(system.sysname) + " " + system.release + " " + system.machine, ""};
}

Host this_node() {
  Host host = this_host();
  host.name = host_name();
  return host;
}

MeasuredRounds rounds_record(const Times& times) {
  return {times.median, times.spread, times.least, times.most, times.rounds};
}

std::string EngineModel::in_short() const {
  if (native.empty()) return expressed.empty() ? "-" : "expressed";
  std::string text = expressed.empty() ? "native" : "both";
  for (const std::string& lobe : native)
    if (lobe != "cosine") text += ", " + lobe;
  return text;
}

void define_highlight_tables(Tables& tables) {
  tables.define<Host>("The machine.", [](auto& t) { t.key("name").if_any(); });
  tables.define<MeasuredRounds>(
      "What rounds measured. The spread is half the distance of the quartiles, of the median.");
  tables.define<Highlight>("A normalised highlight.", [](auto& t) {
    t.key("exponent").at_least(0);
    t.key("coefficient", "of the radiance").may_be_nonfinite();
    t.key("warning", "where the model is not what it promises").if_any();
    t.key("formula", "of the lobe expression").if_any();
  });
  tables.define<EngineModel>("How an engine shades a model.", [](auto& t) {
    t.key("native", "lobes that it has as highlights of its own");
    t.key("expressed", "lobes that it can be told, as a formula");
  });
}

}  // namespace lobelia::records
