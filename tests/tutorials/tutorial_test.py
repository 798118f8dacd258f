"""What tutorial.py takes for a page that is true, and what it says of one that is not."""
import contextlib
import io
import pathlib
import tempfile
import unittest

import tutorial


def follow(text):
    """What is said of a page with this text ('' if it is true), the rest of what is printed, and the names of the files made."""
    with tempfile.TemporaryDirectory() as folder:
        page, scratch = pathlib.Path(folder, "page.md"), pathlib.Path(folder, "scratch")
        page.write_text(text)
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            wrong = tutorial.follow(page, pathlib.Path("/opt/lore"), scratch) or ""
        return (wrong.replace(str(page), "page.md"), printed.getvalue(),
                sorted(file.name for file in (scratch / "work").rglob("*")))


class Pages(unittest.TestCase):
    def test_commands_of_all_blocks_are_one_shell(self):
        self.assertEqual(follow("```sh\nmkdir d; cd d; x=1\n```\n\ntext\n\n```sh\necho $x >f\n```\n")[::2], ("", ["d", "f"]))

    def test_a_block_that_begins_with_a_name_is_a_file(self):
        page = "```toml\n# a.toml\nx = 1\n```\n```c\n/* b.c */\n```\n```toml\n# no name\n```\n```sh\ncat a.toml\n```\n```text\n# a.toml\nx = 1\n```\n"
        self.assertEqual(follow(page)[::2], ("", ["a.toml", "b.c"]))

    def test_a_command_that_fails_is_told_with_its_line_and_output(self):
        wrong = follow("# Title\n\n```sh\necho before\nls /nowhere\necho after\n```\n")[0]
        self.assertTrue(wrong.startswith("page.md:5: exit code 2: ls /nowhere\n"), wrong)
        self.assertIn("before\nls: cannot access", wrong)
        self.assertNotIn("after", wrong)

    def test_another_output_is_told_with_the_line_that_shows_it(self):
        wrong = follow("```sh\nprintf 'a\\nb\\n'\n```\n\n```text\na\nc\n```\n")[0]
        self.assertTrue(wrong.startswith("page.md:7: the output has not\n  c\nThe commands of line 1 print\na\nb\n"), wrong)

    def test_output_that_is_not_shown_is_told(self):
        self.assertIn("page.md:6: the output has not\n  (the end)", follow("```sh\nseq 2\n```\n```text\n1\n```\n")[0])

    def test_dots_stand_for_any_text_and_for_any_lines(self):
        self.assertEqual(follow("```sh\nseq 99\n```\n```text\n1\n...\n...8\n99\n```\n")[0], "")

    def test_output_that_is_shown_nowhere_may_be_any(self):
        self.assertEqual(follow("```sh\nseq 9\n```\n\nsome text\n")[0], "")

    def test_commands_that_need_something_are_left_out_where_it_is_not(self):
        wrong, printed, files = follow("```sh needs false\ntouch a\n```\n```text\nnever\n```\n```sh needs true\ntouch b\n```\n")
        self.assertEqual((wrong, files), ("", ["b"]))
        self.assertIn(":1: left out: this needs 'false'", printed)

    def test_usr_is_where_lore_is_installed(self):
        self.assertEqual(follow("```sh\necho /usr/share/lore\n```\n```text\n/opt/lore/share/lore\n```\n")[0], "")

    def test_a_page_that_breaks_a_rule_is_refused(self):
        for page, reason in (("```sh\nx\n", "line 1: the block does not end"),
                             ("```text\nx\n```\n", "line 1: no commands stand before this text"),
                             ("```sh\n```\n\nwords\n\n```text\nx\n```\n", "line 6: no commands stand"),
                             ("```sh if x\n```\n", "line 1: 'if x' is not 'needs COMMAND'")):
            with self.assertRaisesRegex(tutorial.PageError, reason):
                tutorial.read_page(page)


if __name__ == "__main__":
    unittest.main()
