"""The map of the engine, solutions/engine/README.md, is right: files of each room, includes, and members."""

import collections
import re
import tempfile
import unittest
from pathlib import Path

from sandbox import ROOT

ENGINE = ROOT / "solutions" / "engine"
_ROW = re.compile(r"^\| `(\w+)/` \| (.+) \| (.*) \|$", re.MULTILINE)
_LINK = re.compile(r"\]\((\w+)/(\w+\.hpp)\)")
_CONSTANTS = re.compile(r"^(?:static )?constexpr [\w:]+ (\w+ = .*);", re.MULTILINE)
_TYPE = re.compile(r"^(?:struct|class|enum class) (\w+)[^;\n]*\{", re.MULTILINE)
_INCLUDE = re.compile(r'^#include "engine/(\w+)/', re.MULTILINE)


def page_text() -> str:
    return (ENGINE / "README.md").read_text(encoding="utf-8")


def rooms() -> dict[str, tuple[str, str]]:
    """Returns the files of each room, and the rooms that it may include, by the map."""
    text = page_text()
    return {name: (holds, may) for name, holds, may in _ROW.findall(text)}


def allowed(may: str, name: str, names: list[str]) -> set[str]:
    if may.startswith("all"):
        return set(names) - set(re.findall(r"but (\w+)", may))
    return {name, *re.findall(r"\w+", may)}


def misplaced(engine: Path) -> list[str]:
    """Returns the sources that have no header of their own, and whose name no header of their room declares."""
    found = []
    for source in sorted(engine.glob("*/*.cpp")):
        headers = [header.read_text(encoding="utf-8") for header in source.parent.glob("*.hpp")]
        declares = re.compile(rf"^[\w:<>]+ {source.stem}\(", re.MULTILINE)
        if not source.with_suffix(".hpp").exists() and not any(map(declares.search, headers)):
            found.append(f"{source.parent.name}/{source.name}")
    return found


class Groups(unittest.TestCase):
    def test_no_two_sources_give_one_name_to_two_things(self):
        """They are compiled in groups, and a new file moves others into another group."""
        for library in ("engine", "scenes"):
            where = collections.defaultdict(set)
            for source in (ROOT / "solutions" / library).rglob("*.cpp"):
                text = source.read_text(encoding="utf-8")
                constants = [name for line in _CONSTANTS.findall(text) for name in re.findall(r"(?:^|, )(\w+) = ", line)]
                for name in (*constants, *_TYPE.findall(text)):
                    where[name].add(source.name)
            self.assertGreater(len(where), 40)
            self.assertEqual({name: files for name, files in where.items() if len(files) > 1}, {})


class Rooms(unittest.TestCase):
    def test_the_map_names_every_room_and_every_header(self):
        told = rooms()
        self.assertEqual(set(told), {path.name for path in ENGINE.iterdir() if path.is_dir()})
        self.assertEqual([path.name for path in ENGINE.iterdir() if path.is_file()], ["README.md"])
        for name, (holds, _) in told.items():
            headers = {path.name for path in (ENGINE / name).glob("*.hpp")}
            with self.subTest(room=name):
                self.assertEqual({header for room, header in _LINK.findall(holds) if room == name}, headers)
                self.assertEqual({room for room, _ in _LINK.findall(holds)}, {name})

    def test_every_source_has_its_header_or_the_declaration_of_its_function_in_its_room(self):
        self.assertEqual(misplaced(ENGINE), [])

    def test_a_source_in_another_room_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            engine = Path(folder)
            for name, text in {"solvers/registry.hpp": "template <int Dof>\nSolver<Dof> direct();\n",
                               "solvers/registry.cpp": "", "solvers/direct.cpp": "", "linear/factors.hpp": "",
                               "linear/factors.cpp": "  direct();\n"}.items():
                (engine / name).parent.mkdir(exist_ok=True)
                (engine / name).write_text(text, encoding="utf-8")
            self.assertEqual(misplaced(engine), [])
            (engine / "solvers" / "direct.cpp").rename(engine / "linear" / "direct.cpp")
            self.assertEqual(misplaced(engine), ["linear/direct.cpp"])
            (engine / "linear" / "factors.cpp").rename(engine / "solvers" / "factors.cpp")
            self.assertEqual(misplaced(engine), ["linear/direct.cpp", "solvers/factors.cpp"])

    def test_a_room_includes_only_what_the_map_allows(self):
        told = rooms()
        for name, (_, may) in told.items():
            permitted = allowed(may, name, list(told))
            for file in sorted((ENGINE / name).iterdir()):
                used = set(_INCLUDE.findall(file.read_text(encoding="utf-8")))
                with self.subTest(file=f"{name}/{file.name}"):
                    self.assertLessEqual(used, permitted | {name})

    def test_there_is_no_circle(self):
        told = rooms()
        left = {name: allowed(may, name, list(told)) - {name} for name, (_, may) in told.items()}
        while left:
            free = [name for name, needs in left.items() if not needs & set(left)]
            self.assertTrue(free, f"these rooms include each other: {sorted(left)}")
            for name in free:
                del left[name]

    def test_every_file_is_in_a_room_and_includes_by_its_full_name(self):
        for file in sorted(ENGINE.glob("*/*.[ch]pp")):
            with self.subTest(file=file.name):
                for name in re.findall(r'^#include "([^"]+)"', file.read_text(encoding="utf-8"), re.MULTILINE):
                    self.assertIn("/", name)
                    self.assertTrue(any((ROOT / top / name).exists() for top in ("solutions", "chapters")), name)

    def test_one_file_makes_the_code_of_a_world(self):
        """An explicit instantiation may stand once in a program, and each costs seconds."""
        files = [*ENGINE.glob("*/*.[ch]pp"), *ENGINE.glob("*/*.ipp")]
        made = [file.name for file in files for _ in re.findall(r"^template class spook::World<[36]>;",
                                                                file.read_text(encoding="utf-8"), re.MULTILINE)]
        self.assertEqual(made, ["world.cpp", "world.cpp"])


class Page(unittest.TestCase):
    """The page lists every member of World and of Settings."""

    def test_it_has_every_function_of_a_world_and_every_setting(self):
        text, page = (ENGINE / "world" / "world.hpp").read_text(encoding="utf-8"), page_text()
        public = re.search(r"class World \{.*?public:(.*?)\n private:", text, re.DOTALL)[1]
        public = re.sub(r" = [\w:]+\(\)", "", public)  # what an argument is unless given
        functions = set(re.findall(r"^  [^/\n]*?\b(\w+)\([^()\n]*\)(?: const)?(?: \{.*)?;?.*$", public, re.MULTILINE))
        self.assertLessEqual({"add", "step", "x", "report", "row_updates", "remove_joint"}, functions)
        for name in functions - {"World"}:
            self.assertTrue(f"`{name}(" in page, f"{name}() is not in engine/README.md")
        settings = re.search(r"struct Settings \{(.*?)\n\};", text, re.DOTALL)[1]
        members = re.findall(r"^  (?:\[\[.*?\]\] )?[\w:<>]+ (\w+) = ", settings, re.MULTILINE)
        self.assertLessEqual({"gravity", "impacts", "rotation", "solver_limits"}, set(members))
        for name in members:
            self.assertTrue(f"| `{name}` |" in page, f"the setting {name} is not in engine/README.md")


if __name__ == "__main__":
    unittest.main()
