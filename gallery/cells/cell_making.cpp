#include <fmt/format.h>

#include "base/records/words.hpp"
#include "base/words/numbers.hpp"
#include "base/words/text.hpp"
#include "gallery/cells/cell_page.hpp"

namespace lobelia::gallery {
namespace {

void write_file_link(Html& html, const SiteFrame& site, const std::string& file,
                     const std::string& what) {
  if (file.empty()) return;
  const Tag item(html, "li");
  if (site.is_packed)
    html.element("code", file);
  else
    html.element("a", {{"href", link_to({file})}}, file);
  html.text(" " + what);
}

template <class Seconds>
std::string seconds_words(const Seconds& seconds) {
  std::string words;
  for (const auto& [stage, value] : numbers_of(seconds))
    words += (words.empty() ? "" : ", ") + stage + " " + seconds_text(value);
  return words;
}

void write_version(Html& html, const records::FarmEngine& engine, const std::string& version) {
  if (version.empty()) return;
  const Tag item(html, "div");
  html.element("dt", "Version");
  const Tag value(html, "dd");
  html.element("code", {{"class", "copied"}, {"data-what", "the version of " + engine.title}},
               version);
}

void write_facts(Html& html, const records::FarmEngine& engine, const EnginePicture& image) {
  const Tag list(html, "dl", {{"class", "facts"}});
  if (image.render) write_version(html, engine, image.render->engine.version);
  if (image.reference) write_version(html, engine, image.reference->engine.version);
  write_fact(html, "Written by", image.made_by);
  if (const auto& made = image.render) {
    write_fact(html, "Time", seconds_words(made->seconds));
    write_fact(html, "Samples per pixel", count_text(made->samples));
    write_fact(html, "Rays", in_words(made->rays));
    write_fact(html, "Instruction set", made->instruction_set);
  }
  if (const auto& made = image.reference) {
    write_fact(html, "Shading", made->shading);
    write_fact(html, "Time", seconds_words(made->seconds));
    write_fact(html, "Method", made->method);
    write_fact(html, "Passes", count_text(double(made->passes)));
    write_fact(html, "Options", fmt::format("{}", fmt::join(made->engine_options, ", ")));
  }
}

void write_engine(Html& html, const SiteFrame& site, const records::FarmEngine& engine,
                  const EnginePicture* image) {
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
  write_facts(html, engine, *image);
  if (image->render || image->reference) {
    html.element("p", "The command, to be typed in the cell’s directory:");
    write_command(html,
                  shell_join(image->render ? image->render->command : image->reference->command));
  }
  if (image->reference && !image->reference->engine_commands.empty()) {
    html.element("p", "What it ran:");
    write_command(html, fmt::format("{}", fmt::join(image->reference->engine_commands, "\n")));
  }
  if (!image->exr_sha256.empty()) {
    const Tag line(html, "p", {{"class", "hashes"}});
    html.text("SHA-256 of the linear picture: ");
    html.element("code",
                 {{"class", "copied"}, {"data-what", "the hash of the picture by " + engine.title}},
                 image->exr_sha256);
  }
  const Tag files(html, "ul", {{"class", "files"}});
  write_file_link(html, site, image->exr, "linear float picture");
  write_file_link(html, site, image->record, "record");
  write_file_link(html, site, image->log, "the engine’s own output");
}

/// For a report: where each picture comes from, and how to compare them again.
void write_origins(Html& html, const ShownFarm& farm, const CheckedCell& cell) {
  const Tag section(html, "section", {{"class", "making"}, {"aria-labelledby", "making"}});
  html.element("h2", {{"id", "making"}}, "Where the pictures come from");
  for (const EnginePicture& image : cell.images) {
    const Tag block(html, "div", {{"class", "engine"}});
    html.element("h3", farm.engine_title(image.engine));
    const Tag list(html, "dl", {{"class", "facts"}});
    for (const auto& [name, value] : image.facts) write_fact(html, name, value);
  }
}

}  // namespace

void write_making(Html& html, const SiteFrame& site, const ShownFarm& farm,
                  const CheckedCell& cell) {
  if (farm.is_report) return write_origins(html, farm, cell);
  const Tag section(html, "section", {{"class", "making"}, {"aria-labelledby", "making"}});
  if (cell.has_record) {
    html.element("h2", {{"id", "making"}}, "How each picture was made");
    for (const records::FarmEngine& engine : farm.record.engines)
      write_engine(html, site, engine, cell.find_image(engine.name));
    html.element("h3", "Files of the cell");
  } else {
    html.element("h2", {{"id", "making"}}, "Files of the cell");
  }
  if (site.is_packed)
    html.element(
        "p",
        "This small site has no copies of them. They are in the farm’s own directory, in cells/" +
            cell.id + ".");
  const Tag files(html, "ul", {{"class", "files"}});
  if (cell.has_scene)
    write_file_link(html, site, "scene.xml", "the scene, complete");
  else
    html.element("li", "The scene file is not there, or not as the farm wrote it.");
  if (!cell.has_record) return;
  write_file_link(html, site, "cell.json", "what belongs to the cell");
  for (const CheckedComparison& comparison : cell.comparisons)
    if (comparison.problem.empty())
      write_file_link(html, site, comparison.entry.record, "comparison");
  if (cell.profile) write_file_link(html, site, cell.record.profile, "profile");
}

}  // namespace lobelia::gallery
