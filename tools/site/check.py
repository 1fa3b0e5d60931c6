"""check.py DIR: fails if a page there has a dead link, or loads something that is not beside it."""
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.anchors, self.links, self.loads = {""}, [], []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.update(values[name] for name in ("id", "name") if values.get(name))
        if "style" in values:
            self.loads += css_loads(values["style"])
        for name in ("href", "src", "data", "poster", "srcset"):
            if name in values:
                (self.links if tag == "a" else self.loads).append(values[name])


def css_loads(text):
    return re.findall(r"(?:@import\s+|url\(\s*)[\"']?([^\"')\s;]+)", text)


def problems(site):
    pages = {path: Page(path) for path in site.rglob("*.html")}
    if not pages:
        yield f"{site}: no pages"
    loads = [(path, load) for path, page in pages.items() for load in page.loads]
    loads += [(path, load) for path in site.rglob("*.css") for load in css_loads(path.read_text())]
    for path, load in loads:
        url = urlsplit(load)
        if url.scheme == "data" or load.startswith("#"):
            continue
        if (url.scheme or url.netloc or load.startswith("/")
                or not (path.parent / unquote(url.path)).is_file()):
            yield f"{path.relative_to(site)}: loads {load}"
    for path, page in pages.items():
        for link in page.links:
            url = urlsplit(link)
            if url.scheme or url.netloc:
                continue
            target = (path.parent / unquote(url.path)).resolve() if url.path else path
            if not target.is_file():
                yield f"{path.relative_to(site)}: {link} leads nowhere"
            elif target in pages and unquote(url.fragment) not in pages[target].anchors:
                yield f"{path.relative_to(site)}: {link} has no such anchor"


found = list(problems(Path(sys.argv[1]).resolve()))
print(*found, sep="\n", end="\n" if found else "", file=sys.stderr)
sys.exit(1 if found else 0)
