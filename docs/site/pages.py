"""The pages that tools/site makes besides those that are written: links, the references, the gallery, the programs."""
import json
import re
import subprocess

from headers import Headers

MIRRORED = ("docs", "jobs", "include", "tools")  # what pages may link to
TOP_FILES = ("CHANGELOG.md", "CITATION.cff", "LICENSE")


def write_all(source, pages, xml, programs):
    """Fills the folder `pages`, new: Sphinx's sources. `xml` is Doxygen's folder, `programs` paths by name."""
    mirror(source, pages)
    sections = {
        "Tutorials": written(source, "tutorials"),
        "Manual": written(source, "manual") + ["jobs/campaigns/README"],
        "Design": written(source, "design"),
        "Findings": written(source, "findings") + ["docs/paper", "docs/results/README", write_gallery(source, pages)],
        "Reference": [write_programs(pages, programs), write_python_reference(pages),
                      write_cpp_reference(source, pages, xml), "CHANGELOG"],
    }
    write_front_page(source, pages, sections)


def mirror(source, pages):
    """Links to the repository's files, where they stand in the repository, so that relative links hold."""
    files = [file for folder in MIRRORED for file in sorted((source / folder).rglob("*")) if file.is_file()]
    for file in files + [source / name for name in TOP_FILES]:
        link = pages / file.relative_to(source)
        link.parent.mkdir(parents=True, exist_ok=True)
        link.symlink_to(file)


def written(source, section):
    """The pages of a folder of docs/, in the order of README.md's list of documentation, then any that it does not have."""
    listed = (source / "README.md").read_text().split("\n## Documentation\n")[-1]
    order = re.findall(r"\]\((docs/[\w/-]+)\.md\)", listed)
    found = [f"docs/{section}/{file.stem}" for file in sorted((source / "docs" / section).glob("*.md"))]
    return sorted(found, key=lambda page: order.index(page) if page in order else len(order))


def write(file, text):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)


def contents(pages, hidden=True, caption=None):
    """A table of contents in Markdown."""
    options = [":hidden:"] * hidden + ([f":caption: {caption}"] if caption else []) + [":maxdepth: 1"]
    return "\n".join(["```{toctree}", *options, "", *pages, "```", ""])


def write_front_page(source, pages, sections):
    """README.md, with the contents of the whole site for the side bar."""
    lists = [contents(names, caption=caption) for caption, names in sections.items()]
    write(pages / "index.md", "\n".join([(source / "README.md").read_text(), *lists]))


# -- gallery: docs/images, docs/results

def title_of(picture):
    """What an SVG says it shows."""
    found = re.search(r"<title>([^<]*)</title>", picture.read_text())
    return found[1] if found else picture.stem


def figure(source, picture, more="", here=""):
    """A picture with its caption; a click shows it alone. `here`: the folder of the page."""
    place = picture.relative_to(source / here)
    title = title_of(picture)
    options = [f":target: {place}", f":alt: {json.dumps(title)}"]
    return "\n".join([f":::{{figure}} {place}", *options, "", f"{title}. {more}".strip(), ":::", ""])


def question_of(campaign):
    """What a campaign asks: the first paragraph of its file."""
    if not campaign.exists():
        return ""
    lines = []
    for line in campaign.read_text().splitlines():
        if not line.startswith("# "):
            break
        lines.append(line[2:])
    return " ".join(lines)


def write_campaign_page(source, pages, folder):
    """The page of a folder of docs/results: question, figures, tables. Returns its title."""
    title = json.loads((folder / "summary.json").read_text())["title"]
    campaign = source / "jobs" / "campaigns" / f"{folder.name}.toml"
    lines = [f"# {title}", "", question_of(campaign), ""]
    for picture in sorted(folder.glob("*.svg")):
        lines.append(figure(source, picture, here=folder))
    if campaign.exists():
        lines.append(f"* [{campaign.name}](../../../jobs/campaigns/{campaign.name}): the campaign, to repeat it")
    lines += [f"* [{file.name}]({file.name})" for file in sorted(folder.iterdir())
              if file.suffix in {".html", ".csv", ".json"}]
    write(pages / "docs" / "results" / folder.name / "index.md", "\n".join(lines) + "\n")
    return title


def write_gallery(source, pages):
    """All pictures; those of a campaign lead to its page."""
    lines = ["# Gallery", "", "Every picture of these pages; a click shows it alone.", "",
             "::::{container} gallery", ""]
    for picture in sorted((source / "docs" / "images").glob("*.svg")):
        lines.append(figure(source, picture, "[Where it comes from](index.md)."))
    lines += ["::::", ""]
    folders = sorted(file.parent for file in (source / "docs" / "results").glob("*/summary.json"))
    for folder in folders:
        title = write_campaign_page(source, pages, folder)
        place = folder.relative_to(source)
        shown = [figure(source, picture, f"[{title}]({place}/index.md).") for picture in sorted(folder.glob("*.svg"))]
        if shown:
            lines += [f"## {title}", "", f"[The campaign, its question and its tables]({place}/index.md)", ""]
            lines += ["::::{container} gallery", "", *shown, "::::", ""]
    lines.append(contents([f"{folder.relative_to(source)}/index" for folder in folders]))
    write(pages / "gallery.md", "\n".join(lines))
    return "gallery"


# -- programs: what --help prints

def help_of(program, *command):
    return subprocess.run([program, *command, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout


def write_programs(pages, programs):
    """A page for each program, with a section for each of its commands."""
    for name, path in programs.items():
        text = help_of(path)
        lines = [f"# {name}", "", "```text", text.rstrip(), "```", ""]
        commands = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.M)
        for command in re.findall(r"^  (\w[\w-]*)", commands[1], re.M) if commands else []:
            own = help_of(path, command).split("\nExamples:\n")[0]  # the examples are the program's
            lines += [f"## {name} {command}", "", "```text", own.rstrip(), "```", ""]
        write(pages / "reference" / "programs" / f"{name}.md", "\n".join(lines))
    write(pages / "reference" / "programs.md", "\n".join(
        ["# Programs", "", "What each program says to `--help`.", "",
         contents([f"programs/{name}" for name in programs], hidden=False)]))
    return "reference/programs"


# -- Python: docstrings

def write_python_reference(pages):
    write(pages / "reference" / "python.rst", """Python reference
================

:doc:`Results in Python </docs/manual/python>` tells how to begin.

.. automodule:: lore
   :members:
   :undoc-members:
   :special-members: __len__, __getitem__, __iter__

lore.plot
---------

.. automodule:: lore.plot
   :members:
   :undoc-members:

lore_world
----------

.. automodule:: lore_world
   :members:

lore_gymnasium
--------------

.. automodule:: lore_gymnasium
   :members:
""")
    return "reference/python"


# -- C++: the headers

def modules(source):
    """(name, contents) of every module, from the table of docs/design/architecture.md."""
    table = (source / "docs" / "design" / "architecture.md").read_text()
    return re.findall(r"^\| \d+ \| `(\w+)` \| (.*) \|$", table, re.M)


def write_cpp_reference(source, pages, xml):
    """A page for each module, with a section for each header."""
    headers, names = Headers(xml), []
    for file in sorted((source / "include" / "lore").glob("*.h")):  # in C, and written to be read as it is
        title = f"lore/{file.name}"
        names.append(file.stem + "_h")
        write(pages / "reference" / "cpp" / f"{names[-1]}.rst", "\n".join(
            [title, "=" * len(title), "", f".. literalinclude:: /include/{title}", "   :language: c", ""]))
    for module, duty in modules(source):
        files = sorted((source / "include" / "lore" / module).glob("*.h"))
        if not files:
            continue
        names.append(module)
        lines = [module, "=" * len(module), "", f"{duty[0].upper()}{duty[1:]}.", ""]
        for file in files:
            place = f"lore/{module}/{file.name}"
            lines += [file.name, "-" * len(file.name), "", ".. code-block:: cpp", "", f"   #include <{place}>", "",
                      headers.directives(place)]
        write(pages / "reference" / "cpp" / f"{module}.rst", "\n".join(lines))
    write(pages / "reference" / "cpp.md", "\n".join(
        ["# C++ reference", "", "The headers of `include/lore`, module by module, from the lowest level up",
         "([architecture](../docs/design/architecture.md)).", "",
         contents([f"cpp/{name}" for name in names], hidden=False)]))
    return "reference/cpp"
