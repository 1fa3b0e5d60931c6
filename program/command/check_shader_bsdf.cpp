#include "program/command/check_shader_bsdf.hpp"

#include "base/records/record.hpp"
#include "base/system/standard_streams.hpp"
#include "program/command/common_options.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"

namespace lobelia::cli {

void add_bsdf_options(CLI::App& command, BsdfOptions& options) {
  OptionGroup bsdf(command, "BSDF");
  bsdf.add_flag("--bsdf", options.is_wanted,
                "Test the functions eval, sample and pdf of a BSDF against each other, without a "
                "model: GLSL and HLSL");
  const std::string list =
      ", alone or with what it takes, NAME(LIST): N, V, L, u (random numbers; u1, u2, u3 of one "
      "number each), n, alpha, roughness, or numbers; otherwise by the names in the file";
  bsdf.add("--eval", options.eval, "NAME", "The function eval" + list);
  bsdf.add("--sample", options.sample, "NAME", "The function sample; as --eval");
  bsdf.add("--pdf", options.pdf, "NAME", "The function pdf; as --eval");
}

void set_bsdf_options(const BsdfOptions& options, shader_check::bsdf::BsdfRequest& request) {
  if (request.language == ShaderText::kWgsl)
    throw Error(ExitCode::kUsage, "--bsdf: allowed for GLSL and HLSL, not for WGSL");
  request.eval = options.eval;
  request.sample = options.sample;
  request.pdf = options.pdf;
}

ExitCode run_check_bsdf(const shader_check::bsdf::BsdfRequest& request, const std::string& json) {
  records::BsdfCheck record = shader_check::bsdf::check_bsdf(request);
  record.command = command_line();
  if (!json.empty() && json != kStdout) write_record(json, record);
  fmt::print("{}", json == kStdout ? records::record_text(record)
                                   : shader_check::bsdf::bsdf_report(record));
  return record.verdict == records::kBsdfVerdicts[0] ? ExitCode::kSuccess : ExitCode::kDiffers;
}

}  // namespace lobelia::cli
