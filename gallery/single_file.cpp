#include "gallery/single_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/html.hpp"
#include "core/sha256.hpp"
#include "gallery/half_picture.hpp"
#include "gallery/page.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

std::string json_text(const std::string& text) { return nlohmann::json(text).dump(); }

/// What a policy names an inline script or style by.
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

/// The content of a site's file for the script: {"page"}, {"name", "data"} or base64 of a picture. Empty: left out.
std::string payload(const std::string& name, const std::string& content) {
  if (name.ends_with(".html")) {
    std::string title, main;
    title = between(content.substr(0, content.find("</title>") + 8), "<title>", "</title>");
    main = between(content, "<main id=\"main\">", "</main>");
    const bool is_cell = content.find("data-view=\"cell\"") != std::string::npos;
    return fmt::format(R"({{"view":{},"title":{},"main":{}}})", is_cell ? "\"cell\"" : "\"grid\"",
                       json_text(title), json_text(main));
  }
  if (name.ends_with(".js")) {
    const Data data = data_in(content);
    return fmt::format(R"({{"name":{},"data":{}}})", json_text(data.name), data.json);
  }
  if (name.ends_with(".png")) return json_text("data:image/png;base64," + base64(content));
  return "";
}

}  // namespace

std::string single_file(const fs::path& directory, const std::string& title) {
  const std::string style = read_file(directory / kStyleFile, kMostBytes);
  const std::string script = read_file(directory / kScriptFile, kMostBytes);
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::ranges::sort(files);

  Html html;
  html.raw("<!DOCTYPE html>\n");
  {
    const Tag root(html, "html", {{"lang", "en"}});
    {
      const Tag head(html, "head");
      html.empty("meta", {{"charset", "utf-8"}});
      html.empty("meta",
                 {{"http-equiv", "Content-Security-Policy"},
                  {"content", fmt::format("default-src 'none'; script-src {}; style-src {}; "
                                          "img-src data:; base-uri 'none'; form-action 'none'",
                                          source_hash(script), source_hash(style))}});
      html.empty("meta",
                 {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
      html.empty("meta", {{"name", "color-scheme"}, {"content", "light dark"}});
      html.element("title", title);
      html.raw("<style>" + style + "</style>");
    }
    const Tag body(html, "body");
    html.raw("<header class=\"site\"><a class=\"site-title\" href=\"#page=index.html\">");
    html.text(title);
    html.raw("</a></header>");
    {
      const Tag main(html, "main", {{"id", "main"}});
      const Tag none(html, "noscript");
      html.text("This file holds a whole report, which its script opens: allow scripts to see it.");
    }
    for (const fs::path& file : files) {
      const std::string name = file.lexically_relative(directory).generic_string();
      if (name == kScriptFile) continue;
      const std::string json = payload(name, read_file(file, kMostBytes));
      if (json.empty()) continue;
      html.raw("\n<script type=\"application/json\" data-file=\"");
      html.text(name);
      html.raw("\">" + within_element(json) + "</script>");
    }
    html.raw("<script>" + script + "</script>");
  }
  return html.str();
}

}  // namespace lobelia::gallery
