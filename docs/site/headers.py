"""The C++ reference: what Doxygen reads in a header, as directives of Sphinx's C++ domain, in the header's order."""
import collections
import functools
import re
import textwrap
import xml.etree.ElementTree as tree

LONGEST_INITIALIZER = 60


def text_of(element):
    """The plain text below an element, "" where there is none."""
    return "".join(element.itertext()).strip() if element is not None else ""


def compact(code):
    """C++ without the spaces that Doxygen puts: span< int const > & becomes span<int const>&."""
    code = re.sub(r"<\s+", "<", re.sub(r"\s+>", ">", re.sub(r"\s+", " ", code)))
    return re.sub(r"\s+([&*]+)\s*", r"\1 ", code).strip()


def inline(element):
    """The text of a paragraph as reStructuredText, code as code."""
    def escaped(text):
        return re.sub(r"([\\*`_|])", r"\\\1", text or "")

    parts = [escaped(element.text)]
    for child in element:
        if child.tag == "computeroutput":
            # Where a word touches it, an escaped space that is not shown.
            before = "\\ " * bool(re.search(r"\w$", "".join(parts)))
            parts.append(f"{before}``{text_of(child)}``" + "\\ " * bool(re.match(r"\w", child.tail or "")))
        elif child.tag == "ndash":
            parts.append("--")
        else:
            parts.append(inline(child))
        parts.append(escaped(child.tail))
    return "".join(parts)


def described(entry):
    """The comment of an entry: paragraphs of reStructuredText."""
    paragraphs = [" ".join(inline(para).split()) for kind in ("briefdescription", "detaileddescription")
                  for para in entry.iterfind(f"{kind}/para")]
    return "\n\n".join(paragraph for paragraph in paragraphs if paragraph)


def template(entry):
    """`template<class T, int W> `, or "" of what is no template."""
    parameters = entry.find("templateparamlist")
    if parameters is None:
        return ""
    names = []
    for each in parameters:
        default = text_of(each.find("defval"))
        names.append(compact(f"{text_of(each.find('type'))} {text_of(each.find('declname'))}")
                     + (f" = {compact(default)}" if default else ""))
    return f"template<{', '.join(names)}> "


def placed(entry):
    """(file, line) of an entry's declaration; the file as it is included."""
    place = entry.find("location")
    if place is None:
        return "", 0
    return place.get("declfile") or place.get("file"), int(place.get("declline") or place.get("line"))


def function(entry):
    before = {"static": "static ", "explicit": "explicit "}
    words = "".join(word for name, word in before.items() if entry.get(name) == "yes")
    words += "virtual " * (entry.get("virt") in ("virtual", "pure-virtual"))
    kind = compact(text_of(entry.find("type")))
    words = "" if words.strip() and kind.startswith(words.strip()) else words
    arguments = re.sub(r"\s*(?<![=<>!])=(?!=)\s*", " = ", compact(text_of(entry.find("argsstring"))))
    return "function", f"{template(entry)}{words}{kind} {text_of(entry.find('name'))}{arguments}"


def variable(entry):
    value = compact(text_of(entry.find("initializer")))
    value = f" {value}" if 0 < len(value) <= LONGEST_INITIALIZER else ""
    kind = compact(text_of(entry.find("type")))
    static = "static " if entry.get("static") == "yes" and "static" not in kind else ""
    name = text_of(entry.find("name")) + text_of(entry.find("argsstring"))
    return "member", f"{template(entry)}{static}{kind} {name}{value}"


def alias(entry):
    return "type", f"{template(entry)}{text_of(entry.find('name'))} = {compact(text_of(entry.find('type')))}"


def enumeration(entry):
    underlying = compact(text_of(entry.find("type")))
    return ("enum-class" if entry.get("strong") == "yes" else "enum",
            text_of(entry.find("name")) + (f" : {underlying}" if underlying else ""))


SIGNATURES = {"function": function, "variable": variable, "typedef": alias, "enum": enumeration}


def directive(kind, signature, *bodies):
    body = textwrap.indent("\n\n".join(each.strip("\n") for each in bodies if each), "   ")
    return f".. cpp:{kind}:: {' '.join(signature.split())}\n\n{body}\n"


def member(entry):
    """A function, variable, alias or enumeration."""
    kind, signature = SIGNATURES[entry.get("kind")](entry)
    values = [directive("enumerator", f"{text_of(value.find('name'))} {text_of(value.find('initializer'))}",
                        described(value)) for value in entry.iterfind("enumvalue")]
    return directive(kind, signature, described(entry), *values)


class Headers:
    """Doxygen's XML of all headers; `xml` is its folder."""

    def __init__(self, xml):
        self._xml = xml
        self._entries = collections.defaultdict(list)  # by header: (line, namespace, directive)
        for entry in tree.parse(xml / "index.xml").getroot():
            if entry.get("kind") == "namespace":
                self._read_namespace(self._compound(entry.get("refid")))
            elif entry.get("kind") == "file":
                self._read_macros(self._compound(entry.get("refid")))
        for entries in self._entries.values():
            entries.sort(key=lambda entry: entry[0])

    def directives(self, header):
        """What a header declares, as reStructuredText."""
        return "\n".join(f".. cpp:namespace:: {space}\n\n{text}" for _, space, text in self._entries[header])

    @functools.cache
    def _compound(self, identity):
        return tree.parse(self._xml / f"{identity}.xml").getroot().find("compounddef")

    def _add(self, entry, space, text):
        file, line = placed(entry)
        self._entries[file].append((line, space, text))

    def _read_namespace(self, space):
        name = space.findtext("compoundname")
        if not re.fullmatch(r"lore(::\w+)*", name):
            return
        for inner in space.iterfind("innerclass"):
            compound = self._compound(inner.get("refid"))
            self._add(compound, name, self._class(compound, name))
        for entry in space.iter("memberdef"):
            if entry.get("kind") in SIGNATURES:
                self._add(entry, name, member(entry))

    def _class(self, compound, scope):
        """A class with its public members, classes among them."""
        name = compact(text_of(compound.find("compoundname")).removeprefix(f"{scope}::"))
        bases = ", ".join(f"{base.get('prot')} {compact(text_of(base))}"
                          for base in compound.iterfind("basecompoundref"))
        parts = [(placed(entry)[1], member(entry)) for entry in compound.iter("memberdef")
                 if entry.get("prot") == "public" and entry.get("kind") in SIGNATURES]
        for inner in compound.iterfind("innerclass"):
            if inner.get("prot") == "public":
                nested = self._compound(inner.get("refid"))
                parts.append((placed(nested)[1], self._class(nested, text_of(compound.find("compoundname")))))
        parts.sort(key=lambda part: part[0])
        signature = f"{template(compound)}{name}{' : ' + bases if bases else ''}"
        return directive(compound.get("kind"), signature, described(compound), *[text for _, text in parts])

    def _read_macros(self, file):
        for entry in file.iter("memberdef"):
            if entry.get("kind") == "define" and (comment := described(entry)):
                arguments = ", ".join(text_of(each) for each in entry.iterfind("param"))
                name = entry.findtext("name") + (f"({arguments})" if arguments else "")
                self._add(entry, "lore", f".. c:macro:: {name}\n\n{textwrap.indent(comment, '   ')}\n")
