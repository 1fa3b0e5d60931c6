// Parts of many records: the machine, what rounds measured, the highlight, and how an engine shades one.
#pragma once

#include "base/records/struct_type.hpp"
#include "base/system/timing.hpp"

namespace lobelia::records {

struct Host {
  std::string processor;
  unsigned threads = 0;
  std::string system;
  std::string name;  ///< empty in records that do not name nodes
};

/// This machine, without its name.
Host this_host();
/// This machine with its name.
Host this_node();

/// Seconds, or a count or ratio that was taken in rounds.
struct MeasuredRounds {
  double median = 0, spread = 0, least = 0, most = 0;
  int rounds = 0;
};
MeasuredRounds rounds_record(const Times& times);

struct Highlight {
  std::string model, lobe, normalisation;
  double exponent = 0, coefficient = 0;
  std::string warning;
  std::string formula;  ///< of the lobe "expression"; otherwise empty
};

/// The lobes with which an engine shades a model. Other lobes cannot be compared.
struct EngineModel {
  std::string model, title;
  std::vector<std::string> native, expressed;

  /// For a table: "native" (cos^n, and the other lobes that it names), "expressed", "both", or "-".
  std::string in_short() const;
};

void define_highlight_tables(Tables& tables);

}  // namespace lobelia::records
