"""How Sphinx makes the site; tools/site calls it, with the pages in a folder of links to the repository's files."""
import os
import pathlib
import posixpath
import re
import shutil
import sys

from docutils import nodes
from sphinx import addnodes

SOURCE = pathlib.Path(os.environ["LORE_SITE_SOURCE"])
sys.path.insert(0, str(SOURCE / "tools" / "python"))
sys.dont_write_bytecode = True

project = "Lore"
author = "the authors of Lore"
version = release = re.search(r"project\(Lore VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
extensions = ["myst_parser", "sphinx.ext.autodoc"]
suppress_warnings = ["myst.header"]

# Anchors of headings as GitHub makes them; figures in ::: fences.
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence"]
highlight_language = "none"

toc_object_entries_show_parents = "hide"

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_class_signature = "separated"
default_role = "code"  # `name` in a docstring
python_use_unqualified_type_names = True
autodoc_mock_imports = ["matplotlib", "pandas"]  # which the package takes where they are there

html_theme = "furo"
html_title = f"Lore {release}"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_static_path = ["site.css"]
html_css_files = ["site.css"]
html_theme_options = {"top_of_page_button": None}


def link_directories(app, docname, text):
    """A link to a folder that has a page of its own is one to that page, and README.md is the front page."""
    here = posixpath.dirname(docname)

    def linked(match):
        page = posixpath.normpath(posixpath.join(here, match[1], "index"))
        return f"]({match[1]}/index.md)" if page in app.env.found_docs else match[0]

    text[0] = re.sub(r"\]\(((?:\.\./)*)README\.md", r"](\1index.md", text[0])
    text[0] = re.sub(r"\]\(([\w./-]+)\)", linked, text[0])


def link_files(app, doctree):
    """A linked file that is no page keeps its place in the site, instead of going to a folder of downloads."""
    here = posixpath.dirname(app.env.docname)
    for node in list(doctree.findall(addnodes.download_reference)):
        file = posixpath.normpath(posixpath.join(here, node["reftarget"]))
        link = nodes.reference("", "", *node.children, refuri=node["reftarget"], internal=True)
        node.replace_self(link)
        app.published.add(file)


def leave_std(app, doctree):
    """Nothing of the standard library is here: not to look for it saves a quarter of Sphinx's time."""
    for node in list(doctree.findall(addnodes.pending_xref)):
        if node["refdomain"] == "cpp" and node["reftarget"].split("::")[0] in ("std", "size_t"):
            node.replace_self(node.children)


def publish(app, failure):
    """The linked files, and those of the folders that figures point to."""
    if failure:
        return
    folders = [pathlib.Path(app.srcdir, "docs", name) for name in ("images", "results")]
    files = {str(file.relative_to(app.srcdir)) for folder in folders for file in folder.rglob("*")
             if file.suffix != ".md"}
    for name in sorted(app.published | files):
        file = pathlib.Path(app.srcdir, name)
        if file.is_file():
            goal = pathlib.Path(app.outdir, name)
            goal.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, goal)


def mend_theme(app, failure):
    """Makes the distribution's build of Furo work from files, and dark where the reader's system is.

    Debian's style sheet imports another from the web server and has its dark colors behind a button alone; its script
    imports a module, which a page without a server may not. A Furo that has none of this is left as it is.
    """
    style, script = (pathlib.Path(app.outdir, "_static", name) for name in ("styles/furo.css", "scripts/furo.js"))
    if failure or not (style.is_file() and script.is_file()):
        return
    text = re.sub(r"@import url\((/javascript/[^)]*)\);",
                  lambda match: file.read_text() if (file := pathlib.Path(f"/usr/share{match[1]}")).is_file() else "",
                  style.read_text())
    dark = re.search(r'body\[data-theme="dark"\] *\{([^}]*)\}', text)
    if dark and "prefers-color-scheme" not in text:
        text += f'\n@media (prefers-color-scheme: dark) {{ body[data-theme="auto"] {{{dark[1]}}} }}\n'
    style.write_text(text)
    script.write_text(re.sub(r'^import \w+ from "\./([\w.-]+)";$', lambda match: (script.parent / match[1]).read_text(),
                             script.read_text(), flags=re.M))


def mark_examples(app, what, name, thing, options, lines):
    """An indented block of a docstring is code."""
    result = []
    for line in lines:
        begins = line.startswith("    ") and len(result) > 1 and not result[-1] and not result[-2].startswith(" ")
        result += ["::", ""] * begins + [line]
    lines[:] = result


def skip_plain_constructors(app, what, name, thing, skipped, options):
    """A data class's own constructor says nothing that its fields do not."""
    return True if name == "__init__" and not thing.__doc__ else None


def setup(app):
    app.published = set()
    app.connect("source-read", link_directories)
    app.connect("doctree-read", link_files, priority=100)  # before Sphinx gathers downloads
    app.connect("build-finished", mend_theme)
    app.connect("autodoc-process-docstring", mark_examples)
    app.connect("autodoc-skip-member", skip_plain_constructors)
    app.connect("doctree-read", leave_std)
    app.connect("build-finished", publish)
