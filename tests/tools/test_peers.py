"""./course plot peers: its message without other engines, its figure, and its claims with the installed ones."""

import contextlib
import importlib.util
import io
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(os.environ.get("COURSE_SOURCE", Path(__file__).resolve().parents[2]))
BUILD = Path(os.environ.get("COURSE_BUILD", ROOT / "build"))
FOLDER = ROOT / "plots" / "peers"
sys.path[:0] = [str(ROOT / "tools" / "course"), str(ROOT / "tests" / "tools")]

import peers  # noqa: E402
from engine import RELEASE, program  # noqa: E402
from errors import CourseError  # noqa: E402
from needs import Need, PEER_NEEDS  # noqa: E402
from try_experiment import claims_not_shown  # noqa: E402

_spec = importlib.util.spec_from_file_location("drawing", FOLDER / "peers.py")
drawing = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(drawing)
NOWHERE = tuple(Need(need.package, "header", "there/is/none.h") for need in PEER_NEEDS)


class Table:
    """The columns from which a part of the figure is drawn."""

    def __init__(self, *rows):
        self.columns = dict(zip(("engine", "us a second", "error"), zip(*rows)))

    def __getitem__(self, column):
        return list(self.columns[column])


class Peers(unittest.TestCase):
    def test_without_any_engine_it_says_what_to_install(self):
        with mock.patch.object(peers, "PEER_NEEDS", NOWHERE):
            self.assertFalse(peers.any_there())
            with self.assertRaises(CourseError) as caught:
                peers.require()
        for need in PEER_NEEDS:
            self.assertIn(need.package, str(caught.exception))

    def test_an_engine_that_is_not_there_is_named_and_left_out(self):
        for need in PEER_NEEDS:
            there, gone = Need("python3", "command", "python3"), Need(need.package, "header", "there/is/none.h")
            said = io.StringIO()
            with (mock.patch.object(peers, "PEER_NEEDS", (there, gone)), mock.patch.object(peers, "RELEASE") as tree,
                  contextlib.redirect_stderr(said)):
                tree.setting.side_effect = {"SPOOK_PEERS": "ON", "SPOOK_PEERS_FOUND": "python3"}.get
                peers.require()
                tree.configure.assert_not_called()
            self.assertIn(f"Not compared, since not installed: {need.package}.", said.getvalue())

    def test_with_mine_it_says_that_there_is_none(self):
        done = subprocess.run([str(ROOT / "course"), "plot", "peers", "--mine"], capture_output=True, text=True)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1))
        self.assertIn("has no --mine", done.stderr)

    def test_times_are_compared_at_equal_error(self):
        of = drawing._at_equal_error
        ours = [("spook", 10, 1e-2), ("spook", 100, 1e-4)]
        # To 1e-3 ours takes 100, to 1e-2 it takes 10; the slow one to 1e-3 is beaten by the other, which is better.
        self.assertEqual(of(Table(*ours, ("ODE", 50, 1e-3), ("ODE", 20, 1e-2))), "ours / fastest other: 0.5 to 2")
        self.assertEqual(of(Table(*ours, ("ODE", 50, 1e-4), ("DART", 500, 1e-3))), "ours / fastest other: 2")
        self.assertEqual(of(Table(*ours, ("ODE", 50, 1e-6))), "the least error is another's")
        self.assertEqual(of(Table(*ours, ("ODE", 0, float("inf")))), "only spook keeps it")

    def test_claims_hold_with_the_engines_that_are_there(self):
        if peers.any_there():
            peers.require()
        else:
            RELEASE.configure("-DSPOOK_PEERS=ON")
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([str(program("plot_peers")), "--quick", "--out", folder],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertNotIn("FALSE", done.stdout)
            self.assertEqual(claims_not_shown(Path(folder, "claims.json"), FOLDER / "peers.cpp"), [])
            self.assertGreater(len(json.loads(Path(folder, "claims.json").read_text())), 4)
            figure = Path(folder, "peers.png")
            subprocess.run([sys.executable, str(FOLDER / "peers.py"), "--data", folder, "--out", str(figure)],
                           check=True)
            self.assertGreater(figure.stat().st_size, 10_000)
        missing = [need.package for need in PEER_NEEDS if not need.there()]
        if missing:
            self.skipTest(f"engines to compare with that are not installed: {', '.join(missing)}")


if __name__ == "__main__":
    unittest.main()
