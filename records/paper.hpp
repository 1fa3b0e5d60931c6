// What came out when the claims of the paper were measured.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "records/chart.hpp"
#include "records/struct_type.hpp"

namespace lobelia::records {

struct Measured {
  std::string what;
  double value = 0;
  std::string text;
  std::string at;
  static const Struct& type();
};

struct Claim {
  std::string name;
  std::string where;
  std::string statement;
  std::string printed;
  std::vector<Measured> measured;
  std::string definition;
  std::string verdict;
  std::string reason;
  static const Struct& type();
};

struct PaperFigure {
  std::string id;
  std::string title;
  std::string description;
  ChartAxis x;
  ChartAxis y;
  std::vector<ChartBand> bands;
  std::vector<ChartSeries> series;
  std::vector<std::string> claims;
  static const Struct& type();
};

struct VerifyPaper {
  std::vector<std::string> command;
  std::size_t confirmed = 0;
  std::size_t not_reproduced = 0;
  std::size_t found = 0;
  std::vector<Claim> claims;
  std::vector<PaperFigure> figures;
  static const Struct& type();
};

}  // namespace lobelia::records
