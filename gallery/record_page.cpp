#include "gallery/record_page.hpp"

#include "core/error.hpp"
#include "core/files.hpp"
#include "gallery/page.hpp"

namespace lobelia::gallery {

std::optional<ViewPage> detail::record_page(
    const std::filesystem::path& run, const char* file, const char* title,
    const std::function<void(ViewPage& page, const std::string& text)>& draw) {
  if (!std::filesystem::exists(run / file)) return std::nullopt;
  const auto empty = [&] { return ViewPage{title, "", {}, "", {}}; };
  try {
    ViewPage page = empty();
    page.files.push_back(file);
    draw(page, read_file(run / file, records::kMaxRecordBytes));
    return page;
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    ViewPage page = empty();
    page.main.element("h1", title);
    write_absence(page.main, std::string("It cannot be shown: ") + error.what());
    return page;
  }
}

void write_lead(Html& html, const char* title, const std::string& words) {
  const Tag header(html, "header");
  html.element("h1", title);
  html.element("p", {{"class", "lead"}}, words);
}

void write_columns(Html& html, std::initializer_list<std::string> columns) {
  const Tag head(html, "thead");
  const Tag row(html, "tr");
  for (const std::string& column : columns) html.element("th", {{"scope", "col"}}, column);
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

}  // namespace lobelia::gallery
