"""The course accepts all commands in pages. test_grading_commands runs those that grade and export."""

import contextlib
import io
import unittest

from page_commands import commands, pages, words_of
from sandbox import ROOT

from arguments import parse


class Pages(unittest.TestCase):
    def test_every_command_is_one(self):
        """Options and names of options; test_course_sweep runs those of `run`."""
        count = 0
        for page in pages():
            for line in commands(page):
                words = words_of(line)
                if words and words[0] in ("run", "scenes"):
                    continue
                count += 1
                with self.subTest(page=page.relative_to(ROOT), line=line), contextlib.redirect_stderr(io.StringIO()):
                    parse(words)
        self.assertGreater(count, 60)


if __name__ == "__main__":
    unittest.main()
