#include "core/numbers.hpp"
#include "gallery/cell_sections.hpp"
#include "gallery/link.hpp"
#include "gallery/page.hpp"

namespace lobelia::gallery {
namespace {

/// Sizes that a reader can choose without script: a radio button each, and style.css does the rest.
void write_size_choice(Html& html) {
  struct Size {
    const char *id, *label;
  };
  for (const Size& size : {Size{"fit", "fit"}, Size{"one", "1 : 1"}, Size{"two", "2 : 1"},
                           Size{"four", "4 : 1"}, Size{"eight", "8 : 1"}}) {
    const std::string id = std::string("size-") + size.id;
    Attributes attributes = {{"type", "radio"}, {"name", "size"}, {"id", id}, {"class", "size"}};
    if (id == "size-fit") attributes.push_back({"checked", "checked"});
    html.empty("input", attributes);
    html.element("label", {{"for", id}}, size.label);
  }
}

void write_image(Html& html, const Picture& picture, const std::string& alt) {
  // Scrolls by itself when enlarged, and gallery.js keeps all of them at the same place.
  const Tag frame(html, "div", {{"class", "picture"}, {"tabindex", "0"}});
  const SmallPicture look = picture.first_look();
  const auto write = [&] {
    html.empty("img", {{"src", link_to({look.file})},
                       {"alt", alt},
                       {"width", std::to_string(look.width)},
                       {"height", std::to_string(look.height)},
                       {"loading", "lazy"},
                       {"class", picture.width <= 320 ? "small" : "large"}});
  };
  if (look.file == picture.file || !picture.is_published) return write();
  const Tag link(html, "a", {{"href", link_to({picture.file})}, {"title", "The whole picture"}});
  write();
}

std::string why_no_picture(const records::FarmEngine& engine, const CheckedCell& cell) {
  if (!engine.available) {
    std::string words = engine.title + " was not there";
    if (!engine.why.empty()) words += ": " + engine.why;
    words += ".";
    if (!engine.install.empty()) words += " To get it: " + engine.install;
    return words;
  }
  for (const records::CellProblem& problem : cell.record.problems) {
    if (problem.engine == engine.name) return engine.title + " made no picture: " + problem.message;
  }
  for (const records::NotComparable& one : cell.record.not_comparable) {
    if (one.engine == engine.name) return "Not comparable, because " + one.because + ".";
  }
  if (const EnginePicture* image = cell.find_image(engine.name)) return image->png.why_not;
  return engine.title + " has not made this picture.";
}

std::string witness_words(const EnginePicture& image) {
  if (!image.reference) return "";
  const std::string& witness = image.reference->witness;
  if (witness == "native") return "its own shading of this model";
  return witness == "expressed" ? "the model written in its language"
                                : "the formulas, pixel by pixel";
}

void write_engine_picture(Html& html, const records::FarmEngine& engine, const CheckedCell& cell) {
  const EnginePicture* image = cell.find_image(engine.name);
  const Tag figure(html, "figure");
  {
    const Tag caption(html, "figcaption");
    html.element("strong", engine.title);
    if (!image) {
      // Said in place of the picture.
    } else if (engine.name == kOurEngine) {
      html.text(" · ours");
    } else if (const std::string words = witness_words(*image); !words.empty()) {
      html.text(" · " + words);
    }
  }
  if (image && image->png.shown()) {
    write_image(html, image->png, "The picture by " + engine.title);
  } else {
    write_absence(html, why_no_picture(engine, cell));
  }
}

void write_scale(Html& html, const CheckedComparison& comparison) {
  const records::Difference& difference = comparison.entry.difference;
  const std::string words = "white = " + number_text(difference.white_at) + " = " +
                            percent_text(difference.relative_to_peak) + " of the peak";
  const Tag scale(html, "p", {{"class", "scale"}});
  html.element("span", "0");
  html.element("span", {{"class", "ramp"}, {"aria-hidden", "true"}}, "");
  html.element("span", words);
}

void write_difference(Html& html, const records::FarmEngine& engine, const CheckedCell& cell) {
  const CheckedComparison* comparison = cell.find_comparison(engine.name);
  const Tag figure(html, "figure");
  html.element("figcaption", {}, "Difference from " + engine.title);
  if (!comparison) {
    write_absence(html, "There is nothing to compare with: no picture by " + engine.title + ".");
  } else if (comparison->png.shown()) {
    write_image(html, comparison->png, "Difference between ours and " + engine.title);
    write_scale(html, *comparison);
  } else {
    write_absence(html, comparison->png.why_not);
  }
}

void write_explanation(Html& html, const CheckedCell& cell) {
  const Tag note(html, "div", {{"class", "note"}});
  if (cell.record.exposure_stops) {
    html.element("p", "For the eye, every picture of the first row has the same exposure, " +
                          stops_text(*cell.record.exposure_stops) +
                          ", and is then encoded for an sRGB display. The numbers below are taken "
                          "from the linear float pictures, not from these.");
  }
  html.element("p",
               "A difference picture shows |ours − theirs| for red, green and blue, divided by the "
               "value printed below it and clipped at 1. It is not encoded for the display: half "
               "the value is half the light level in the file.");
}

}  // namespace

void write_pictures(Html& html, const ShownFarm& farm, const CheckedCell& cell) {
  const Tag section(html, "section", {{"class", "pictures"}, {"aria-labelledby", "pictures"}});
  html.element("h2", {{"id", "pictures"}}, "Pictures");
  html.element("span", {{"class", "size-title"}}, "Size");
  write_size_choice(html);
  {
    const Tag row(html, "div", {{"class", "picture-row engines"}});
    for (const records::FarmEngine& engine : farm.record.engines)
      write_engine_picture(html, engine, cell);
  }
  const Tag row(html, "div", {{"class", "picture-row"}});
  for (const records::FarmEngine& engine : farm.record.engines) {
    if (engine.name == kOurEngine) {
      write_explanation(html, cell);
    } else {
      write_difference(html, engine, cell);
    }
  }
}

}  // namespace lobelia::gallery
