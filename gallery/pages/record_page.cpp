#include "base/words/text.hpp"
#include "gallery/pages/page.hpp"
#include "gallery/pages/views.hpp"
#include "gallery/site/published_texts.hpp"

namespace lobelia::gallery {

ViewPage unreadable_page(const char* title, const Error& error) {
  ViewPage page{title, "", {}, "", {}};
  page.main.element("h1", title);
  write_absence(page.main, without_paths(std::string("It cannot be shown: ") + error.what()));
  return page;
}

void write_lead(Html& html, const char* title, const std::string& words) {
  const Tag header(html, "header");
  html.element("h1", title);
  html.element("p", {{"class", "lead"}}, words);
}

void write_source(Html& html, const std::string& command, const char* file) {
  const Tag section(html, "section");
  html.element("h2", "How it was measured");
  write_command(html, command);
  const Tag line(html, "p");
  html.text("All of it is in ");
  html.element("a", {{"href", file}}, file);
  html.text(".");
}

Attributes scroll_box(const std::string& label) {
  return {{"class", "table-wrap"}, {"tabindex", "0"}, {"role", "region"}, {"aria-label", label}};
}

}  // namespace lobelia::gallery
