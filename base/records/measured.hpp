// Models fitted to a measured material.
#pragma once

#include "base/records/scene.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct MeasuredFit {
  std::string model, lobe;
  double exponent = 0;
  std::optional<double> alpha;
  Triple diffuse{}, specular{};
  double rms_of_measured = 0, largest_of_measured = 0;
  double mean_ciede2000 = 0, largest_ciede2000 = 0;
  bool is_end_of_range = false;
};

struct MeasuredFits {
  std::vector<std::string> command;
  std::string file, format;
  std::vector<std::string> remarks;
  std::size_t direction_pairs = 0;
  double measured_rms = 0, measured_largest = 0;
  std::vector<MeasuredFit> fits;
};

void define_measured_tables(Tables& tables);

}  // namespace lobelia::records
