#include "base/words/numbers.hpp"
#include "gallery/cells/cell_page.hpp"

namespace lobelia::gallery {
namespace {

void write_image(Html& html, const Picture& picture, const std::string& alt) {
  const Tag frame(html, "div", {{"class", "picture"}});
  const SmallPicture shown = picture.preview();
  const auto write = [&] {
    html.empty("img", {{"src", link_to({shown.file})},
                       {"alt", alt},
                       {"width", std::to_string(shown.width)},
                       {"height", std::to_string(shown.height)},
                       {"loading", "lazy"},
                       {"class", picture.width <= 320 ? "small" : "large"}});
  };
  if (shown.file == picture.file || !picture.is_published) return write();
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
  for (const records::CellProblem& problem : cell.record.problems)
    if (problem.engine == engine.name) return engine.title + " made no picture: " + problem.message;
  for (const records::NotComparable& one : cell.record.not_comparable)
    if (one.engine == engine.name) return "Not comparable, because " + one.because + ".";
  if (const EnginePicture* image = cell.find_image(engine.name)) return image->png.why_not;
  return engine.title + " has not made this picture.";
}

/// How the engine shaded the model.
std::string shading_words(const EnginePicture& image) {
  if (!image.reference) return "";
  const std::string& shading = image.reference->shading;
  if (shading == "native") return "its own shading of this model";
  if (shading == "outside") return "a renderer from outside";
  return shading == "expressed" ? "the model written in its language"
                                : "the formulas, pixel by pixel";
}

void write_engine_picture(Html& html, const records::FarmEngine& engine, const CheckedCell& cell) {
  const EnginePicture* image = cell.find_image(engine.name);
  const Tag figure(html, "figure");
  {
    const Tag caption(html, "figcaption");
    html.element("strong", engine.title);
    const std::string words = !image || cell.hub != kOurEngine ? ""
                              : engine.name == kOurEngine      ? "ours"
                                                               : shading_words(*image);
    if (!words.empty()) html.text(" · " + words);
  }
  if (image && image->png.shown())
    write_image(html, image->png, "The picture by " + engine.title);
  else
    write_absence(html, why_no_picture(engine, cell));
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
  html.element("figcaption", {},
               (cell.hub == kOurEngine ? "Difference from " : "Difference of ") + engine.title);
  if (!comparison) {
    write_absence(html, "There is nothing to compare with: no picture by " + engine.title + ".");
  } else if (comparison->png.shown()) {
    write_image(html, comparison->png, "Difference of the two pictures: " + engine.title);
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
               "A difference picture shows |a − b| of the two for red, green and blue, divided by "
               "the value printed below it and clipped at 1. It is not encoded for the display: "
               "half the value is half the light level in the file.");
}

}  // namespace

void write_pictures(Html& html, const ShownFarm& farm, const CheckedCell& cell) {
  const Tag section(html, "section", {{"class", "pictures"}, {"aria-labelledby", "pictures"}});
  html.element("h2", {{"id", "pictures"}}, "Pictures");
  {
    const Tag row(html, "div", {{"class", "picture-row engines"}});
    for (const records::FarmEngine& engine : farm.record.engines)
      write_engine_picture(html, engine, cell);
  }
  const Tag row(html, "div", {{"class", "picture-row"}});
  for (const records::FarmEngine& engine : farm.record.engines) {
    if (engine.name == farm.hub)
      write_explanation(html, cell);
    else
      write_difference(html, engine, cell);
  }
}

}  // namespace lobelia::gallery
