#!/usr/bin/env python3
"""Does what a tutorial says, in an empty directory, and compares what it shows.

    tests/tutorials/tutorial.py docs/tutorials/first-transfer.md --prefix /usr --scratch DIRECTORY

Lore is installed below --prefix; DIRECTORY is made anew. Fenced blocks of the page are read in order:

    ```sh                  commands. All blocks of a page are one shell (bash -euo pipefail): directories and variables
                           last from block to block, and the first command that fails ends the test
    ```sh needs COMMAND    commands that are left out where COMMAND fails
    ```text                right after commands: what they print, all of it. '...' stands for any text within a line, a
                           line '...' for any lines
    ```toml, ```c, ...     whose first line is a comment of a file's name alone, as in '# mine.toml' or '/* mine.c */':
                           that file is written, into the directory in which the shell is then

Other blocks and indented lines are not read: what is for the reader alone. '/usr' in a page is where Lore is installed.

Exit codes: 0 all is as the page says, 1 it is not, 2 the page breaks a rule above. A failure names page and line.
"""
import argparse
import dataclasses
import os
import pathlib
import re
import shutil
import subprocess
import sys


@dataclasses.dataclass
class Block:
    """A fenced block. `line` is that of its opening fence, from 1."""

    line: int
    language: str
    more: str           # what stands behind the language
    lines: list
    follows: object = None  # the block before it, if nothing but empty lines stands between

    @property
    def file(self):
        """The name of the file that the block is, or None."""
        name = re.fullmatch(r"(?:#|//|/\*|<!--) *([\w./-]+\.\w+) *(?:\*/|-->)?", self.lines[0]) if self.lines else None
        return name[1] if name and self.language not in ("sh", "text") else None


class PageError(Exception):
    """A page that breaks a rule; the text names the line."""


def read_page(text):
    """The blocks of a page, in order."""
    blocks, open_block, last = [], None, None
    for number, line in enumerate(text.splitlines(), 1):
        fence = re.fullmatch(r"```(\w*) *(.*)", line)
        if open_block and line == "```":
            blocks.append(open_block)
            last, open_block = open_block, None
        elif open_block:
            open_block.lines.append(line)
        elif fence:
            open_block = Block(number, fence[1], fence[2], [], last)
        elif line.strip():
            last = None
    if open_block:
        raise PageError(f"line {open_block.line}: the block does not end")
    for block in blocks:
        if block.language == "sh" and block.more and not block.more.startswith("needs "):
            raise PageError(f"line {block.line}: '{block.more}' is not 'needs COMMAND'")
        if block.language == "text" and not (block.follows and block.follows.language == "sh"):
            raise PageError(f"line {block.line}: no commands stand before this text")
    return blocks


def script_of(page, blocks, stash):
    """The page as a script of as many lines: line n of it is line n of the page, so that bash names the page's lines.

    A block's fence prints a mark into the output, or copies a file that was laid down in the folder `stash`.
    """
    lines = [""] * (len(page.splitlines()) + 1)
    for block in blocks:
        end = block.line + len(block.lines)
        if block.language == "sh":
            begin = f"printf '%s\\n' '{mark(block.line)}'"
            if block.more:
                needed = block.more.removeprefix("needs ")
                begin = f"if ! {needed} >/dev/null 2>&1; then printf '%s\\n' '{mark(block.line, 'skipped')}'; else {begin}"
                lines[end] = "fi"
            lines[block.line - 1] = begin
            lines[block.line:end] = block.lines
        elif block.file:
            laid = stash / str(block.line)
            laid.write_text("\n".join(block.lines) + "\n")
            lines[block.line - 1] = f"mkdir -p \"$(dirname '{block.file}')\"; cp '{laid}' '{block.file}'"
    return "\n".join(lines) + "\n"


def mark(line, what="begins"):
    """Stands in the output where the block of that line begins or is left out."""
    return f"\x1e{what} {line}\x1e"


def outputs_of(said):
    """What each block has printed, by the line of its fence; None for one that was left out."""
    found = {}
    parts = re.split(r"\x1e(begins|skipped) (\d+)\x1e\n", said)
    for what, line, text in zip(parts[1::3], parts[2::3], parts[3::3]):
        found[int(line)] = text if what == "begins" else None
    return found


def pattern_of(lines):
    """A regular expression for the text that the lines of a text block allow."""
    any_lines = r"(?:[^\n]*\n)*?"
    return "".join(any_lines if line.strip() == "..." else
                   ".*?".join(re.escape(part) for part in line.rstrip().split("...")) + r"[ \t]*\n" for line in lines)


def differs(shown, said):
    """The number (from 0) of the first shown line that the output does not have, len(shown) if it has more; or None."""
    said = said if said.endswith("\n") or not said else said + "\n"
    if re.fullmatch(pattern_of(shown), said):
        return None
    return next((n for n in range(len(shown)) if not re.match(pattern_of(shown[:n + 1]), said)), len(shown))


def environment(prefix, scratch):
    """What a user of an installed Lore has, and what mpirun needs where ranks are more than cores or root starts them."""
    prefix = str(prefix)
    search = [f"{prefix}/bin", str(pathlib.Path(sys.executable).parent), os.environ.get("PATH", "/usr/bin:/bin")]
    own = {"PATH": ":".join(search), "HOME": str(scratch), "LC_ALL": "C.UTF-8",
           "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
           "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_rmaps_base_oversubscribe": "1",
           "OMPI_MCA_hwloc_base_binding_policy": "none",
           # launchers of other tests, ending, would remove the folder that this one's are about to use
           "OMPI_MCA_orte_tmpdir_base": f"{scratch}/.session"}
    if prefix != "/usr":
        own |= {"C_INCLUDE_PATH": f"{prefix}/include", "CPLUS_INCLUDE_PATH": f"{prefix}/include"}
    return {**os.environ, **own}


def follow(page, prefix, scratch):
    """Runs the page; returns what is wrong, a text, or None."""
    text = page.read_text().replace("/usr/", f"{prefix}/")
    blocks = read_page(text)
    work, stash = scratch / "work", scratch / "stash"
    shutil.rmtree(scratch, ignore_errors=True)
    for folder in (work, stash):
        folder.mkdir(parents=True)
    script = scratch / page.with_suffix(".sh").name
    script.write_text(script_of(text, blocks, stash))
    preamble = scratch / "preamble"
    preamble.write_text("set -euo pipefail -o errtrace\n"
                        f"trap 'echo \"$LINENO exit code $?: $BASH_COMMAND\" >\"{scratch}/failed\"' ERR\n")
    with open(scratch / "output", "w") as output:
        code = subprocess.run(["bash", script], cwd=work, stdin=subprocess.DEVNULL, stdout=output,
                              stderr=subprocess.STDOUT,
                              env={**environment(prefix, scratch), "BASH_ENV": str(preamble)}).returncode
    said = outputs_of((scratch / "output").read_text(errors="replace"))
    for line, part in said.items():
        if part is None:
            print(f"{page}:{line}: left out: this needs '{next(b.more for b in blocks if b.line == line)[6:]}'")
    for block in blocks:
        if block.language == "text" and (part := said.get(block.follows.line)) is not None:
            at = differs(block.lines, part)
            if at is not None and (code == 0 or block.follows.line != list(said)[-1]):
                wrong = block.lines[at] if at < len(block.lines) else "(the end)"
                return f"{page}:{block.line + 1 + at}: the output has not\n  {wrong}\nThe commands of line {block.follows.line} print\n{part}"
    if code != 0:
        told = scratch / "failed"
        line, what = told.read_text().split(" ", 1) if told.exists() else ("?", f"exit code {code}\n")
        return f"{page}:{line}: {what}It printed\n{list(said.values())[-1] if said else (scratch / 'output').read_text()}"
    print(f"{page}: {sum(block.language == 'sh' for block in blocks)} blocks of commands do what the page says")
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", metavar="FILE.md", type=pathlib.Path)
    parser.add_argument("--prefix", type=pathlib.Path, default=pathlib.Path("/usr"))
    parser.add_argument("--scratch", metavar="DIRECTORY", type=pathlib.Path, required=True)
    given = parser.parse_args()
    try:
        wrong = follow(given.page, given.prefix.resolve(), given.scratch.resolve())
    except PageError as error:
        print(f"{given.page}: {error}")
        return 2
    if wrong:
        print(wrong)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
