// lobelia scene SCENE [--from mitsuba] [--to FORMAT]
#include "base/system/files.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"
#include "reference_scenes/formats/catalogue.hpp"
#include "reference_scenes/formats/mitsuba.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

struct SceneArguments {
  std::string scene, from, to, output;
  SceneOverrides overrides;
};

fs::path directory_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// The pictures of the scene's lights, which are read and not copied.
std::vector<std::string> pictures_of(const Scene& scene) {
  std::vector<std::string> pictures;
  for (const Light& light : scene.lights)
    if (std::string file = picture_file(light); !file.empty()) pictures.push_back(std::move(file));
  return pictures;
}

void warn_of_pictures(const std::vector<std::string>& pictures, const fs::path& from,
                      const fs::path& to) {
  std::error_code unknown;
  if (pictures.empty() || fs::equivalent(from, to, unknown)) return;
  for (const std::string& picture : pictures)
    warn(fmt::format("the scene names the picture {}, which is not copied to {}",
                     printable_path(picture), printable_path(to.string())));
}

void write_texts(const std::map<std::string, std::string>& texts, const SceneFormat& format,
                 const SceneArguments& options, const std::vector<std::string>& pictures) {
  if (options.output.empty()) {
    if (texts.size() > 1)
      throw Error(ExitCode::kUsage, "{} takes {} files; give a directory for them with -o DIR",
                  format.title, texts.size());
    fmt::print("{}", texts.begin()->second);
    return;
  }
  const fs::path output = options.output, from = directory_of(options.scene);
  const fs::file_type there = file_type_at(output, ExitCode::kOutput);
  const bool is_directory =
      texts.size() > 1 || there == fs::file_type::directory || !output.has_filename();
  if (is_directory && there != fs::file_type::not_found && there != fs::file_type::directory)
    throw Error(ExitCode::kUsage, "{}: {} takes {} files, and this is no directory",
                printable_path(options.output), format.title, texts.size());
  OutputFiles outputs;
  outputs.reads(options.scene);
  for (const std::string& picture : pictures) outputs.reads(from / picture);
  std::map<fs::path, const std::string*> files;
  for (const auto& [name, text] : texts) files[is_directory ? output / name : output] = &text;
  for (const auto& [file, text] : files) outputs.writes(file);
  if (is_directory) make_directories(output);
  FilesTogether together;
  for (const auto& [file, text] : files) write_file(file, *text);
  together.commit();
  warn_of_pictures(pictures, from, is_directory ? output : directory_of(output));
}

std::string format_names() {
  std::string names;
  for (const SceneFormat& format : scene_formats())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
  return names;
}

/// The scene, of whatever program's file.
Scene scene_of(const SceneArguments& options) {
  if (options.from.empty()) return read_scene(options.scene);
  ImportedScene imported = parse_mitsuba(read_file(options.scene, kMaxSceneBytes), options.scene,
                                         directory_of(options.scene));
  for (const std::string& problem : imported.problems) warn(problem);
  return std::move(imported.scene);
}

void run_scene(const SceneArguments& options) {
  if (options.to.empty() && options.from.empty())
    throw Error(ExitCode::kUsage, "give a format with --to FORMAT: {}", format_names());
  const SceneFormat& format = scene_format(options.to.empty() ? "lobelia" : options.to);
  Scene scene = scene_of(options);
  options.overrides.apply(scene);
  if (const std::string why = format.why_not(scene); !why.empty())
    throw Error(ExitCode::kInput, "{}: cannot be written for {}, because {}", options.scene,
                format.title, why);
  write_texts(format.write(scene), format, options, pictures_of(scene));
}

/// Each format and what is written for it.
std::string format_words() {
  std::string words;
  for (const SceneFormat& format : scene_formats())
    words += fmt::format("  {:<16}{}\n", format.name, format.meaning);
  return words;
}

}  // namespace

void add_scene(CLI::App& app, ExitCode&) {
  auto* command =
      app.add_subcommand("scene", "Write a scene for other programs, or read one of theirs");
  auto options = std::make_shared<SceneArguments>();
  OptionGroup group(*command);
  group.add("SCENE", options->scene, "", "Scene file (see lobelia scene-format)")->required();
  group.add("--to", options->to, "FORMAT",
            fmt::format("Format to write: {}; lobelia with --from", format_names()));
  group.add("--from", options->from, "PROGRAM", "The scene file is of another program: mitsuba")
      ->check(CLI::IsMember({"mitsuba"}));
  add_common(group, "--output", options->output,
             ": a file, or a directory; otherwise stdout, if the format is one file", "FILE|DIR");
  options->overrides.add_to(*command);
  command->footer(fmt::format(
      "Formats:\n{}\ndocs/scenes_for_others.md says what each can say.\n\n"
      "With --from, every part of the file that Lobelia cannot show is a warning with its line.\n\n"
      "Examples:\n"
      "  lobelia scene reference_scenes/scenes/oblique_45.xml --to json\n"
      "  lobelia scene reference_scenes/scenes/oblique_45.xml --to povray -o oblique\n"
      "  lobelia scene theirs.xml --from mitsuba -o ours.xml",
      format_words()));
  command->callback([options] { run_scene(*options); });
}

}  // namespace lobelia::cli
