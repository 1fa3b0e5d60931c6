#include "gallery/page.hpp"

#include "core/version.hpp"

namespace lobelia::gallery {

std::string finish_page(const PageFrame& frame, const Html& main) {
  Html html;
  html.raw("<!DOCTYPE html>\n");
  {
    const Tag root(html, "html", {{"lang", "en"}});
    {
      const Tag head(html, "head");
      html.empty("meta", {{"charset", "utf-8"}});
      html.empty("meta",
                 {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
      html.empty("meta", {{"name", "color-scheme"}, {"content", "light dark"}});
      html.element("title", frame.title);
      html.empty("link", {{"rel", "stylesheet"}, {"href", frame.root + kStyleFile}});
      // A classic script: browsers refuse modules on file://.
      html.element("script", {{"src", frame.root + kScriptFile}, {"defer", "defer"}}, "");
    }
    const Tag body(html, "body", {{"class", frame.kind}});
    html.element("a", {{"class", "skip"}, {"href", "#main"}}, "Skip to the content");
    {
      const Tag content(html, "main", {{"id", "main"}});
      html.raw(main.str());
    }
    const Tag foot(html, "footer");
    html.text("Drawn by " + std::string(kNameAndVersion) + " from the records in this directory");
    if (!frame.made_by.empty()) html.text(", which " + frame.made_by + " wrote");
    html.text(". Numbers are those of the records, rounded for print.");
  }
  return html.str();
}

void write_status(Html& html, CellStatus status) {
  const StatusInfo& s = info(status);
  const Tag badge(html, "span", {{"class", "status " + std::string(s.name)}});
  html.element("span", {{"aria-hidden", "true"}}, s.mark);
  html.text(" ");
  html.text(s.word);
}

void write_command(Html& html, const std::string& command) {
  const Tag pre(html, "pre", {{"class", "command"}, {"tabindex", "0"}});
  html.element("code", command);
}

void write_absence(Html& html, const std::string& words) {
  html.element("p", {{"class", "absent"}}, words);
}

}  // namespace lobelia::gallery
