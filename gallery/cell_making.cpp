#include "core/numbers.hpp"
#include "gallery/cell_sections.hpp"
#include "gallery/names.hpp"
#include "gallery/page.hpp"

namespace lobelia::gallery {
namespace {

void write_fact(Html& html, const std::string& name, const std::string& value) {
  if (value.empty()) return;
  const Tag item(html, "div");
  html.element("dt", name);
  html.element("dd", value);
}

void write_file_link(Html& html, const std::string& file, const std::string& what) {
  if (file.empty()) return;
  const Tag item(html, "li");
  html.element("a", {{"href", link_to({file})}}, file);
  html.text(" " + what);
}

std::string seconds_words(const NamedNumbers& seconds) {
  std::string words;
  for (const auto& [stage, value] : seconds) {
    if (!words.empty()) words += ", ";
    words += stage + " " + seconds_text(value);
  }
  return words;
}

void write_engine(Html& html, const EngineEntry& engine, const CellImage* image) {
  const Tag block(html, "div", {{"class", "engine"}});
  html.element("h3", engine.title);
  if (!image) {
    if (engine.available) {
      write_absence(html, "It has made no picture of this cell.");
    } else {
      write_absence(html, "It was not there" + (engine.why.empty() ? "" : ": " + engine.why) + ".");
      if (!engine.install.empty()) write_command(html, engine.install);
    }
    return;
  }
  if (!image->problem.empty()) write_absence(html, "Its record cannot be read. " + image->problem);
  {
    const Tag list(html, "dl", {{"class", "facts"}});
    if (!image->version.empty()) {
      const Tag item(html, "div");
      html.element("dt", "Version");
      const Tag value(html, "dd");
      html.element("code", {{"class", "copied"}, {"data-what", "the version of " + engine.title}},
                   image->version);
    }
    write_fact(html, "Written by", image->made_by);
    write_fact(html, "Witness", image->witness);
    write_fact(html, "Time", seconds_words(image->seconds));
    for (const auto& [name, value] : image->facts) write_fact(html, name, value);
  }
  if (!image->command.empty()) {
    html.element("p", "The command, to be typed in the cell’s directory:");
    write_command(html, image->command);
  }
  if (!image->engine_commands.empty()) {
    html.element("p", "What it ran:");
    std::string lines;
    for (const std::string& command : image->engine_commands) {
      lines += (lines.empty() ? "" : "\n") + command;
    }
    write_command(html, lines);
  }
  if (!image->exr_sha256.empty()) {
    const Tag line(html, "p", {{"class", "hashes"}});
    html.text("SHA-256 of the linear picture: ");
    html.element("code",
                 {{"class", "copied"}, {"data-what", "the hash of the picture by " + engine.title}},
                 image->exr_sha256);
  }
  const Tag files(html, "ul", {{"class", "files"}});
  write_file_link(html, image->exr, "linear float picture");
  write_file_link(html, image->record, "record");
  write_file_link(html, image->log, "the engine’s own output");
}

}  // namespace

void write_making(Html& html, const FarmData& farm, const CellData& cell) {
  const Tag section(html, "section", {{"class", "making"}, {"aria-labelledby", "making"}});
  if (cell.has_record) {
    html.element("h2", {{"id", "making"}}, "How each picture was made");
    for (const EngineEntry& engine : farm.engines) {
      write_engine(html, engine, cell.find_image(engine.name));
    }
    html.element("h3", "Files of the cell");
  } else {
    html.element("h2", {{"id", "making"}}, "Files of the cell");
  }
  const Tag files(html, "ul", {{"class", "files"}});
  if (cell.has_scene) {
    write_file_link(html, "scene.xml", "the scene, complete");
  } else {
    html.element("li", "The scene file is not there, or not as the farm wrote it.");
  }
  if (!cell.has_record) return;
  write_file_link(html, "cell.json", "what belongs to the cell");
  for (const CellComparison& comparison : cell.comparisons) {
    if (comparison.problem.empty()) write_file_link(html, comparison.record, "comparison");
  }
  if (cell.profile.problem.empty()) write_file_link(html, cell.profile.file, "profile");
}

}  // namespace lobelia::gallery
