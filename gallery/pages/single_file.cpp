#include "gallery/pages/single_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/records/pages.hpp"
#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/sha256.hpp"
#include "base/words/base64.hpp"
#include "base/words/html.hpp"
#include "gallery/pages/page.hpp"
#include "gallery/site/publisher.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

/// A policy's name for an inline script or style.
std::string source_hash(std::string_view text) {
  const Sha256Digest digest = sha256(text);
  return "'sha256-" + base64({reinterpret_cast<const char*>(digest.data()), digest.size()}) + "'";
}

/// JSON that cannot end the element that holds it: in JSON a '<' stands in texts alone.
std::string within_element(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

std::string_view between(std::string_view text, std::string_view from, std::string_view to) {
  const std::size_t start = text.find(from);
  const std::size_t end = text.rfind(to);
  if (start == std::string_view::npos || end == std::string_view::npos || end < start + from.size())
    throw Error(ExitCode::kInternal, "a page of the report has no content");
  return text.substr(start + from.size(), end - start - from.size());
}

/// data_script() taken apart again.
struct Data {
  std::string name, json;
};

Data data_in(std::string_view script) {
  Data data{std::string(between(script.substr(0, script.find(',')), "lobelia('", "'")), ""};
  const std::string_view quoted = between(script, ",'", "');");
  for (std::size_t i = 0; i < quoted.size(); ++i) {
    if (quoted[i] == '\\' && i + 1 < quoted.size()) ++i;
    data.json += quoted[i];
  }
  return data;
}

records::InlinedPage page_in(std::string_view html) {
  const bool is_cell = html.find("data-view=\"cell\"") != std::string_view::npos;
  std::string main(between(html, "<main id=\"main\">", "</main>"));
  // Parts for readers without scripts are useless in a file that needs one.
  constexpr std::string_view kOpen = "<noscript>", kClose = "</noscript>";
  for (std::size_t from = main.find(kOpen); from != std::string::npos;
       from = main.find(kOpen, from))
    main.erase(from, main.find(kClose, from) + kClose.size() - from);
  return {is_cell ? "cell" : "grid",
          std::string(between(html.substr(0, html.find("</title>") + 8), "<title>", "</title>")),
          std::move(main)};
}

/// An element that holds a file of the site; nothing for a file that no page opens.
void write_file_element(Html& html, const std::string& name, const std::string& content) {
  Attributes attributes{{"type", "application/json"}, {"data-file", name}};
  std::string text;
  if (name.ends_with(".html")) {
    text = within_element(records::record_line(page_in(content)));
  } else if (name.ends_with(".js")) {
    const Data data = data_in(content);
    attributes.push_back({"data-name", data.name});
    text = within_element(data.json);
  } else if (name.ends_with(".png")) {
    attributes.front().value = "text/plain";
    text = "data:image/png;base64," + base64(content);
  } else {
    return;
  }
  html.raw("\n");
  const Tag element(html, "script", attributes);
  html.raw(text);
}

}  // namespace

std::string single_file(const fs::path& directory, const std::string& title,
                        const std::string& first_page) {
  const std::string style = read_file(directory / kStyleFile, kMostBytes);
  const std::string script = read_file(directory / kScriptFile, kMostBytes);
  std::vector<fs::path> files = regular_files_below(directory);
  std::ranges::sort(files);

  const std::string first = first_page.empty() ? "index.html" : first_page;
  const bool is_report = kind_of_site(directory) == SiteKind::kReport;
  Html html;
  html.raw("<!DOCTYPE html>\n");
  {
    const Tag root(html, "html", {{"lang", "en"}});
    {
      const Tag head(html, "head");
      html.empty("meta", {{"charset", "utf-8"}});
      html.empty("meta",
                 {{"http-equiv", "Content-Security-Policy"},
                  {"content", fmt::format("default-src 'none'; script-src {}{}; style-src {}; "
                                          "img-src data:; base-uri 'none'; form-action 'none'",
                                          source_hash(script), is_report ? "" : kRunsWebAssembly,
                                          source_hash(style))}});
      html.empty("meta",
                 {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
      html.empty("meta",
                 {{"name", "generator"},
                  {"content", is_report ? "Lobelia, a report in one file" : kSingleFileMark}});
      html.empty("meta", {{"name", "color-scheme"}, {"content", "light dark"}});
      html.element("title", title);
      html.raw("<style>" + style + "</style>");
    }
    const Tag body(html, "body");
    {
      const Tag header(html, "header", {{"class", "site"}});
      html.element("a", {{"class", "site-title"}, {"href", "#page=" + link_to({first})}}, title);
    }
    {
      const Tag main(html, "main", {{"id", "main"}, {"data-page", first}});
      const Tag none(html, "noscript");
      html.text("This file holds a whole report, which its script opens: allow scripts to see it.");
    }
    for (const fs::path& file : files) {
      const std::string name = file.lexically_relative(directory).generic_string();
      const bool is_page = name.ends_with(".html");
      if (name == kScriptFile || (is_page && !first_page.empty() && name != first_page)) continue;
      write_file_element(html, name, read_file(file, kMostBytes));
    }
    html.raw("<script>" + script + "</script>");
  }
  return html.str();
}

}  // namespace lobelia::gallery
