"""The pages of docs/ and the root as a static site: `make docs`.

The pages stay as GitHub shows them. The parts of docs/README.md become the sidebar, and formulas become MathML, which
needs no script and no font from elsewhere.
"""
import html
import os
import re
import shutil
from pathlib import Path
from urllib.parse import quote

from docutils import nodes
from docutils.utils.math import latex2mathml

ROOT = Path(__file__).resolve().parents[2]

project = "Lobelia"
html_title = "Lobelia"
extensions = ["myst_parser"]
root_doc = "README"
include_patterns = ["*.md", "docs/**", "gallery/web/README.md"]
exclude_patterns = [".*"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 6
highlight_language = "none"
html_theme = "furo"
html_static_path = ["site.css", "/usr/share/fonts/truetype/dejavu/DejaVuMathTeXGyre.ttf"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_copyright = False
smartquotes_action = "qe"  # not dashes: --help
html_math_renderer = "mathml"
nitpicky = True


def links(text):
    """The pages that a text links, each once."""
    found = re.findall(r"\]\(([^)#:]+)\.md[)#]", text)
    return list(dict.fromkeys(found))


def toctree(pages, options):
    return "\n\n```{toctree}\n" + options + "\n" + "\n".join(pages) + "\n```\n"


def add_toctrees(app, name, source):
    if name == "README":
        index = (ROOT / "docs/README.md").read_text().split("\n### ")[0]
        source[0] += toctree(["docs/README"], ":hidden:\n")
        for part in index.split("\n## ")[1:]:
            title = part.split("\n")[0].split(":")[0]
            pages = ["docs/" + page for page in links(part)]
            if title == "Reference":
                pages.append("docs/reference/README")  # of the program, by tools/docs
            source[0] += toctree(pages, f":hidden:\n:caption: {title}\n")
    if name == "docs/README":
        source[0] += toctree(links(source[0].split("\n### ")[1]), ":hidden:\n")
    if name in ("docs/reference/README", "CONTRIBUTING"):
        pages = [page for page in links(source[0]) if not page.startswith("docs/")]
        source[0] += toctree(pages, ":hidden:\n")


linked_folders = set()


def link_folder(app, env, node, contnode):
    """A link to a folder leads to a page that lists its files, as on GitHub."""
    place = os.path.normpath(os.path.join(os.path.dirname(node["refdoc"]), node["reftarget"]))
    if not (ROOT / place).is_dir():
        return None
    linked_folders.add(place)
    uri = app.builder.get_relative_uri(node["refdoc"], place + "/index")
    return nodes.reference("", "", contnode, refuri=uri)


def folder_pages(app):
    for folder in sorted(linked_folders):
        shutil.copytree(ROOT / folder, Path(app.outdir) / folder, dirs_exist_ok=True)
        files = sorted(file for file in (ROOT / folder).rglob("*") if file.is_file())
        names = [file.relative_to(ROOT / folder).as_posix() for file in files]
        rows = "".join(f'<li><a href="{quote(name)}">{html.escape(name)}</a></li>' for name in names)
        body = f"<h1>{folder}</h1><ul>{rows}</ul>"
        yield folder + "/index", {"title": folder, "body": body}, "page.html"


def finish(app, error):
    if error:
        return
    site = Path(app.outdir)
    shutil.copy(site / "README.html", site / "index.html")
    # Debian's furo loads this from the root of a web server.
    style, normalize = site / "_static/styles/furo.css", "/javascript/normalize.css/normalize.css"
    inlined = Path("/usr/share/javascript/normalize.css/normalize.min.css")
    if inlined.is_file():
        text = style.read_text().replace(f"@import url({normalize});", inlined.read_text())
        style.write_text(text)


def visit_math(translator, node, inline=True):
    # MathML sets no space around a function.
    formula = re.sub(r"\\(sin|cos|arccos)(?= [a-z\\])", r"\\,\\\1\\,", node.astext())
    translator.body.append(latex2mathml.tex2mathml(formula, inline=inline))
    raise nodes.SkipNode


def visit_math_block(translator, node):
    visit_math(translator, node, inline=False)


def setup(app):
    app.connect("source-read", add_toctrees)
    app.connect("missing-reference", link_folder)
    app.connect("html-collect-pages", folder_pages)
    app.connect("build-finished", finish)
    app.add_html_math_renderer("mathml", (visit_math, None), (visit_math_block, None))
