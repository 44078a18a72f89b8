"""MJCF's defaults: classes within classes, each with attributes for some elements; and files within files."""

from pathlib import Path
from xml.etree.ElementTree import Element
from xml.parsers import expat

from errors import BadInput
from importing.report import Report, attributes, parsed
from importing.turning import named

_TOP = "main"
_DEEPEST = 300  # elements: far from where Python's own calls end


def read(path: Path, report: Report) -> Element:
    """Reads a model, with included files in place."""
    root = _parse(path, "")
    if root.tag != "mujoco":
        urdf = ": URDF is not read, but MuJoCo converts it to MJCF" if root.tag == "robot" else ""
        raise BadInput(f"{path}: MJCF begins with <mujoco>, but this with <{root.tag}>{urdf}")
    _include(root, path.parent, report)
    return root


def _parse(path: Path, file: str) -> Element:
    """Parses a file; its name is part of each element's place."""
    try:
        return parsed(path.read_bytes(), file)
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror}") from None
    except expat.ExpatError as error:
        raise BadInput(f"{path}: {error}") from None


def _include(element: Element, folder: Path, report: Report, depth: int = 0, deep: int = 1) -> None:
    if deep > _DEEPEST:
        raise BadInput(f"elements lie more than {_DEEPEST} deep in one another")
    for child in list(element):
        if child.tag != "include":
            _include(child, folder, report, depth, deep + 1)
            continue
        path = folder / child.get("file", "")
        place = list(element).index(child)
        element.remove(child)
        if not path.is_file():
            raise BadInput(f"file of {named(child)} names no file that there is: \"{child.get('file', '')}\"")
        if depth > 20:
            raise BadInput(f"{path}: files include each other without an end")
        included = _parse(path, f"{child.get('file')} ")
        _include(included, path.parent, report, depth + 1, deep)
        element[place:place] = list(included)


class Defaults:
    def __init__(self, root: Element):
        self._classes: dict[str, dict[str, dict[str, str]]] = {_TOP: {}}
        for default in root.findall("default"):
            self._add(default, default.get("class", _TOP), {})

    def _add(self, default: Element, name: str, above: dict[str, dict[str, str]]) -> None:
        here = {tag: dict(attributes) for tag, attributes in self._classes.get(name, above).items()}
        for child in default:
            if child.tag != "default":
                tag = "joint" if child.tag == "freejoint" else child.tag
                here[tag] = here.get(tag, {}) | {key: value for key, value in attributes(child).items() if key != "class"}
        self._classes[name] = here
        for child in default.findall("default"):
            if not child.get("class"):
                raise BadInput("a default within another has no class")
            self._add(child, child.get("class"), here)

    def applied(self, element: Element, childclass: str | None) -> Element:
        """Returns the element with the attributes of its class, or else of its body's class."""
        name = element.get("class") or childclass or _TOP
        if name not in self._classes:
            raise BadInput(f"class \"{name}\" of {named(element)} has no default")
        whole = Element(element.tag, self._classes[name].get(element.tag, {}) | element.attrib)
        # What is placed anew, is not placed as by default.
        for group in (("quat", "axisangle", "euler", "xyaxes", "zaxis"),):
            if any(key in element.attrib for key in group):
                for key in group:
                    if key not in element.attrib:
                        whole.attrib.pop(key, None)
        return whole
