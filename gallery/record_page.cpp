#include "core/text.hpp"
#include "gallery/page.hpp"
#include "gallery/page_text.hpp"
#include "gallery/safe_svg.hpp"
#include "gallery/views.hpp"

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

void write_study_chart(ViewPage& page, const std::filesystem::path& run,
                       const std::array<std::string, 2>& at) {
  const auto& [folder, file] = at;
  if (!is_plain_name(file) || !file.ends_with(".svg")) return;
  const std::filesystem::path path = run / folder / file;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error) ||
      std::filesystem::file_size(path, error) > kMaxChartBytes ||
      !is_safe_svg(read_file(path, kMaxChartBytes)))
    return;
  Html& html = page.main;
  const Tag line(html, "p", {{"class", "study-chart"}});
  html.element("a", {{"href", link_to({folder, file})}}, "The study’s own drawing (SVG)");
  page.files.push_back(folder + "/" + file);
}

Attributes scroll_box(const std::string& label) {
  return {{"class", "table-wrap"}, {"tabindex", "0"}, {"role", "region"}, {"aria-label", label}};
}

}  // namespace lobelia::gallery
