#include "gallery/pages/page.hpp"

#include <fmt/format.h>

#include "base/system/version.hpp"
#include "gallery/site/published_texts.hpp"

namespace lobelia::gallery {
namespace {

constexpr char kIcon[] =
    "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 16 16'%3E%3Ccircle cx='8' cy='8' "
    "r='8' fill='%23223'/%3E%3Ccircle cx='10' cy='6' r='2.5' fill='%23fff'/%3E%3C/svg%3E";

void write_head(Html& html, const SiteFrame& site, const PageFrame& frame) {
  const auto meta = [&](const char* key, const char* name, const std::string& content) {
    html.empty("meta", {{key, name}, {"content", content}});
  };
  const Tag head(html, "head");
  html.empty("meta", {{"charset", "utf-8"}});
  // First, because it governs only what follows.
  meta("http-equiv", "Content-Security-Policy",
       fmt::format(kContentSecurityPolicy, frame.runs_web_assembly ? kRunsWebAssembly : ""));
  meta("name", "viewport", "width=device-width, initial-scale=1");
  meta("name", "color-scheme", "light dark");
  meta("name", "referrer", "no-referrer");
  html.element("title", frame.title == site.title ? site.title : frame.title + " · " + site.title);
  if (!site.base_url.empty()) {
    html.empty("link", {{"rel", "canonical"}, {"href", site.base_url + frame.path}});
    meta("property", "og:title", frame.title);
    meta("property", "og:site_name", site.title);
    meta("property", "og:url", site.base_url + frame.path);
    if (!frame.picture.empty()) meta("property", "og:image", site.base_url + frame.picture);
  }
  // Inline, or a browser would ask the server for /favicon.ico.
  html.empty("link", {{"rel", "icon"}, {"href", kIcon}});
  html.empty("link", {{"rel", "stylesheet"}, {"href", frame.root + site.style}});
  // Classic scripts: browsers refuse modules on file://.
  html.element("script", {{"src", frame.root + site.script}, {"defer", "defer"}}, "");
  if (!frame.data.empty()) html.element("script", {{"src", frame.data}, {"defer", "defer"}}, "");
}

void write_navigation(Html& html, const SiteFrame& site, const PageFrame& frame) {
  const Tag header(html, "header", {{"class", "site"}});
  html.element("a", {{"class", "site-title"}, {"href", frame.root + site.pages.front().file}},
               frame.path == site.pages.front().file ? "Lobelia" : site.title);
  const Tag nav(html, "nav", {{"aria-label", "Views"}});
  for (const PageLink& page : site.pages) {
    Attributes attributes = {{"href", frame.root + page.file}};
    if (page.file == frame.path) attributes.push_back({"aria-current", "page"});
    html.element("a", attributes, page.title);
  }
}

}  // namespace

std::string finish_page(const SiteFrame& site, const PageFrame& frame, const Html& main) {
  Html html;
  html.raw("<!DOCTYPE html>\n");
  {
    const Tag root(html, "html", {{"lang", "en"}});
    write_head(html, site, frame);
    const Tag body(html, "body", {{"class", "view-" + frame.view}, {"data-view", frame.view}});
    html.element("a", {{"class", "skip"}, {"href", "#main"}}, "Skip to the content");
    if (!site.pages.empty()) write_navigation(html, site, frame);
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

std::string data_script(std::string_view name, std::string_view json) {
  std::string script = "lobelia('" + std::string(name) + "','";
  script.reserve(script.size() + json.size() + json.size() / 16);
  for (const char c : json) {
    if (c == '\\' || c == '\'') script += '\\';
    script += c;
  }
  return script + "');\n";
}

std::string link_to(std::initializer_list<std::string_view> parts) {
  constexpr std::string_view kUnreserved =  // RFC 3986, section 2.3
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.~";
  std::string link;
  for (const std::string_view part : parts) {
    if (!link.empty()) link += '/';
    for (const char c : part)
      link += kUnreserved.find(c) != kUnreserved.npos
                  ? std::string(1, c)
                  : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return link;
}

std::string cell_link(const SiteFrame& site, const std::string& id) {
  return site.is_packed ? "cell.html#cell=" + link_to({id}) : link_to({"cells", id, "index.html"});
}

void write_badge(Html& html, std::string_view style, std::string_view mark, std::string_view word) {
  const Tag badge(html, "span", {{"class", fmt::format("status {}", style)}});
  html.element("span", {{"aria-hidden", "true"}}, mark);
  html.text(fmt::format(" {}", word));
}

void write_status(Html& html, const StatusInfo& status) {
  write_badge(html, status.name, status.mark, status.word);
}

void write_command(Html& html, const std::string& command) {
  const Tag pre(html, "pre", {{"class", "command"}, {"tabindex", "0"}});
  html.element("code", without_paths(command));
}

void write_absence(Html& html, const std::string& words) {
  html.element("p", {{"class", "absent"}}, words);
}

void write_fact(Html& html, const std::string& name, const std::string& value) {
  if (value.empty()) return;
  const Tag item(html, "div");
  html.element("dt", name);
  html.element("dd", value);
}

void write_columns(Html& html, const std::vector<std::string>& titles) {
  const Tag head(html, "thead");
  const Tag row(html, "tr");
  for (const std::string& title : titles) html.element("th", {{"scope", "col"}}, title);
}

}  // namespace lobelia::gallery
