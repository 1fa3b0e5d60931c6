#include <fmt/format.h>

#include "base/records/catalogue.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"

namespace lobelia::cli {
namespace {

struct RecordsArguments {
  std::string kind, output;
  bool typescript = false;
};

const records::Kind& kind_of(const std::string& name) {
  std::vector<std::string_view> names;
  for (const records::Kind& kind : records::kinds()) {
    if (kind.type().kind() == name) return kind;
    names.push_back(kind.type().kind());
  }
  throw Error(ExitCode::kUsage, "no kind of record '{}'{}; 'lobelia records' lists them",
              printable(name), did_you_mean(name, names));
}

void write_reference(const std::filesystem::path& directory) {
  make_directories(directory);
  FilesTogether files;
  write_file(directory / "README.md", records::reference_index());
  for (const records::Kind& kind : records::kinds()) {
    const std::string name(kind.type().kind());
    write_file(directory / (name + ".md"), records::reference_page(kind));
    write_file(directory / (name + ".schema.json"), records::schema_text(kind));
  }
  files.commit();
}

void run_records(const RecordsArguments& options) {
  if (options.typescript)
    fmt::print("{}", records::typescript_text());
  else if (!options.output.empty())
    write_reference(options.output);
  else if (!options.kind.empty())
    fmt::print("{}", records::schema_text(kind_of(options.kind)));
  else
    for (const records::Kind& kind : records::kinds())
      fmt::print("{:<20}{}\n", kind.type().kind(), kind.type().meaning());
}

}  // namespace

void add_records(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand(
      "records",
      "List the kinds of records; print the JSON Schema of one, or write all reference pages");
  auto options = std::make_shared<RecordsArguments>();
  auto* kind = command->add_option("KIND", options->kind, "Print the JSON Schema of this kind");
  OptionGroup group(*command);
  auto* output =
      add_common(group, "--output", options->output, ": a page and a schema of every kind", "DIR");
  command->add_flag("--typescript", options->typescript, "Print the types of the gallery's scripts")
      ->excludes(kind)
      ->excludes(output);
  output->excludes(kind);
  command->footer("Example: lobelia records comparison > comparison.schema.json");
  command->callback([options] { run_records(*options); });
}

}  // namespace lobelia::cli
