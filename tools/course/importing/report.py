"""Collects the parts of a model that the scene omits or replaces, with line and body."""

from xml.etree import ElementTree
from xml.etree.ElementTree import Element
from xml.parsers import expat

_WHERE = "where "  # the attribute with an element's place; no attribute of XML has a space


class Report:
    def __init__(self):
        self._left_out: dict[str, list[str]] = {}  # where each is; nothing for what is nowhere
        self._instead: dict[str, list[str]] = {}

    def leave_out(self, what: str, element: Element | None = None) -> None:
        _add(self._left_out, what, element)

    def stand_in(self, what: str, element: Element | None = None) -> None:
        _add(self._instead, what, element)

    def left_out(self) -> list[str]:
        """Returns a line for each kind, with its first place and how many more there are."""
        return _lines(self._left_out)

    def instead(self) -> list[str]:
        return _lines(self._instead)


def _add(found: dict[str, list[str]], what: str, element: Element | None) -> None:
    places = found.setdefault(what, [])
    place = where(element) if element is not None else ""
    if place and place not in places:
        places.append(place)


def _lines(found: dict[str, list[str]]) -> list[str]:
    lines = []
    for what, places in found.items():
        more = f", and {len(places) - 1} more" if len(places) > 1 else ""
        lines.append(what + (f" ({places[0]}{more})" if places else ""))
    return lines


def where(element: Element) -> str:
    """Returns the line of an element and its body; empty for an element that no file has."""
    return element.get(_WHERE, "")


def attributes(element: Element) -> dict[str, str]:
    """Returns the attributes that the file has."""
    return {name: value for name, value in element.attrib.items() if name != _WHERE}


def parsed(content: bytes, file: str) -> Element:
    """Returns the root, with the place of each element. Raises expat.ExpatError."""
    builder, bodies = ElementTree.TreeBuilder(), []
    parser = expat.ParserCreate()

    def start(tag: str, attributes: dict[str, str]) -> None:
        if tag == "body":
            bodies.append(attributes.get("name", ""))
        body = f', body "{bodies[-1]}"' if bodies and bodies[-1] else ""
        builder.start(tag, attributes | {_WHERE: f"{file}line {parser.CurrentLineNumber}{body}"})

    def end(tag: str) -> None:
        if tag == "body":
            bodies.pop()
        builder.end(tag)

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.Parse(content, True)
    return builder.close()
