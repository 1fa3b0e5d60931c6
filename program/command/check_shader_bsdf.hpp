// The options of `lobelia check-shader --bsdf`.
#pragma once

#include "program/command/commands.hpp"
#include "studies/shader_check/bsdf/check.hpp"

namespace lobelia::cli {

struct BsdfOptions {
  bool is_wanted = false;
  std::string eval, sample, pdf;
};

void add_bsdf_options(CLI::App& command, BsdfOptions& options);
/// Into a request that has the rest.
void set_bsdf_options(const BsdfOptions& options, shader_check::bsdf::BsdfRequest& request);

/// Prints the report, or writes the record.
ExitCode run_check_bsdf(const shader_check::bsdf::BsdfRequest& request, const std::string& json);

}  // namespace lobelia::cli
