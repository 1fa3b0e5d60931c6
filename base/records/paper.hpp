// The paper's claims with the measured values.
#pragma once

#include "base/records/chart.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct Measured {
  std::string what;
  double value = 0;
  std::string text, at;
};

struct Claim {
  std::string name;
  std::string where;
  std::string statement;
  std::string printed;
  std::vector<Measured> measured = {};
  std::string definition = {};
  std::string verdict = "found";
  std::string reason = {};
};

struct PaperFigure {
  std::string id, title, description;
  ChartAxis x, y;
  std::vector<ChartBand> bands;
  std::vector<ChartSeries> series;
  std::vector<std::string> claims;
};

struct VerifyPaper {
  std::vector<std::string> command;
  std::size_t confirmed = 0, not_reproduced = 0, found = 0;
  std::vector<Claim> claims;
  std::vector<PaperFigure> figures;
};

void define_paper_tables(Tables& tables);

}  // namespace lobelia::records
