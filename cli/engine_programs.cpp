#include "cli/engine_programs.hpp"

#include <fmt/format.h>

#include "reference_scenes/engine.hpp"

namespace lobelia::cli {

void EnginePrograms::add_to(CLI::App& command) {
  for (const EngineInfo& engine : engine_infos())
    if (engine.is_program)
      command
          .add_option(fmt::format("--{}", engine.name), typed_[std::string(engine.name)],
                      fmt::format("Program to use for {}, if not the one in $PATH", engine.title))
          ->type_name("PATH");
}

std::map<std::string, std::filesystem::path> EnginePrograms::given() const {
  std::map<std::string, std::filesystem::path> programs;
  for (const auto& [engine, program] : typed_)
    if (!program.empty()) programs[engine] = program;
  return programs;
}

std::filesystem::path EnginePrograms::of(const std::string& engine) const {
  const auto found = typed_.find(engine);
  return found == typed_.end() ? std::string() : found->second;
}

}  // namespace lobelia::cli
