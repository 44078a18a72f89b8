"""./course book: films as pages of the viewer, and publishing."""

import os
import re
import subprocess
import tempfile
import unittest

from sandbox import Sandbox
from test_book import bound

from films import films
from needs import VIEW_NEEDS


class Views(unittest.TestCase):
    def test_films_lead_to_pages_of_the_viewer(self):
        bound(self.addCleanup)
        if not VIEW_NEEDS[0].there():
            self.skipTest(f"no views: {VIEW_NEEDS[0].package} not installed")
        box = Sandbox(built=True)
        self.addCleanup(box.close)
        result = box.course("book", "--films", "--views", "--out", "site")
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in films():
            page = "index.html" if name == "README" else f"chapters/{name}/index.html"
            address = re.search(r'<figure class="film"><a href="([^"]+)"', (box.root / "site" / page).read_text())
            view = (box.root / "site" / page).parent / address[1]
            self.assertEqual(os.path.normpath(view), str(box.root / "site" / "views" / f"{name}.html"))
            self.assertIn("data-recording", view.read_text())
            back = re.search(r'id="way-back" href="([^"]+)"', view.read_text())
            self.assertEqual(os.path.normpath(view.parent / back[1]), str(box.root / "site" / page))


class Published(unittest.TestCase):
    def test_to_a_branch_that_holds_the_site_and_nothing_else(self):
        box = bound(self.addCleanup)
        with tempfile.TemporaryDirectory() as remote:
            def git(*words: str) -> str:
                done = subprocess.run(["git", "--git-dir", remote, *words], check=True, capture_output=True, text=True)
                return done.stdout

            git("init", "-q", "--bare")
            subprocess.run(["git", "-C", str(box.root), "remote", "add", "host", remote], check=True)
            for where in ("host", remote):  # by name, and by address
                result = box.course("book", "--films", "--out", "site", "--publish", where)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn("gh-pages", result.stdout)
                names = git("ls-tree", "-r", "--name-only", "gh-pages").split()
                for name in ("index.html", ".nojekyll", "assets/index.js", "chapters/01_leapfrog/film.webp"):
                    self.assertIn(name, names)
                self.assertEqual(git("rev-list", "--count", "gh-pages").strip(), "1")
            self.assertEqual(set(names), {str(path.relative_to(box.root / "site"))
                                          for path in (box.root / "site").rglob("*") if path.is_file()})


if __name__ == "__main__":
    unittest.main()
