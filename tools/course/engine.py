"""The programs of the engine, optimised, and built when needed."""

import json
import subprocess
from pathlib import Path

import diagnostics
from errors import CourseError
from tree import Tree

RELEASE = Tree("release")
WEB = Tree("web", ("emcmake",))


def program(target: str) -> Path:
    """Builds the program and returns its path."""
    built = RELEASE.build([target], f"building the engine{_how_long()}", keep_going=True)
    if built.ok:
        return RELEASE.program(target)
    does_not_link = diagnostics.linker_error(built.output)
    if does_not_link and target.endswith("_mine"):
        raise CourseError(f"your functions do not link with the rest: {does_not_link}")
    raise RELEASE.own_failure(built)


def parameters_of(scene: str, path: Path | None = None) -> set[str]:
    """Returns the names of a scene's parameters; empty for an unknown scene. `path` is that of a program that is built."""
    done = subprocess.run([str(path or program("spook")), "scenes", scene, "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        return set()
    return {parameter["name"] for each in json.loads(done.stdout)["scenes"] for parameter in each["parameters"]}


def program_of_pages(target: str = "spook_live") -> Path:
    """The engine as WebAssembly, up to date: the script that loads it, with the .wasm file beside."""
    archive = WEB.path / "solutions" / "libspook_scenes.a"
    first = "" if archive.exists() else " (some minutes, the first time)"
    built = WEB.build([target], f"building the engine for live figures{first}", keep_going=True)
    if not built.ok:
        raise WEB.own_failure(built)
    return WEB.path / "solutions" / f"{target}.js"


def _how_long() -> str:
    return "" if (RELEASE.path / "solutions" / "libspook_scenes.a").exists() else " (some minutes, the first time)"
