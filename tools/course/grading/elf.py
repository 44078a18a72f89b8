"""Reads sections and symbols of an object file as the linker does, with exact names.

The output of a tool would not be safe, since a symbol's name can imitate its lines.
"""

import struct
from dataclasses import dataclass
from pathlib import Path

LARGEST = 64 << 20  # bytes of an object; the reference's largest has a fortieth of that
MOST_SYMBOLS = 100_000
MOST_OF_NAMES = 16 << 20  # bytes of all names: symbols may share one of megabytes
_HEADER = struct.Struct("<16sHHIQQQIHHHHHH")
_SECTION = struct.Struct("<IIQQQQIIQQ")
_SYMBOL = struct.Struct("<IBBHQQ")
_SYMBOL_TABLE = 2
_IN_MEMORY = 2  # a section's flag
_BINDINGS = {0: "LOCAL", 1: "GLOBAL", 2: "WEAK", 10: "UNIQUE"}
_KINDS = {0: "NOTYPE", 1: "OBJECT", 2: "FUNC", 3: "SECTION", 4: "FILE", 5: "COMMON", 6: "TLS", 10: "IFUNC"}
_PLACES = {0: "UND", 0xFFF1: "ABS", 0xFFF2: "COM"}


class TooLarge(Exception):
    pass


class Unreadable(Exception):
    pass


@dataclass(frozen=True)
class Symbol:
    name: str  # bytes that are not UTF-8 as surrogates
    defined: bool
    binding: str  # LOCAL, GLOBAL, WEAK, UNIQUE, or a number
    kind: str  # FUNC, OBJECT, IFUNC …, or a number
    section: str  # its number, UND, COM, ABS


@dataclass(frozen=True)
class Object:
    sections: tuple[str, ...]
    symbols: tuple[Symbol, ...]
    memory: int = 0  # bytes that its code and data need before anything runs

    def binding_of(self, name: str) -> str:
        """Returns GLOBAL or WEAK for a function that other objects can call; empty if there is none."""
        return next((symbol.binding for symbol in self.symbols
                     if symbol.name == name and symbol.defined and symbol.binding in ("GLOBAL", "WEAK")
                     and symbol.kind in ("FUNC", "NOTYPE")), "")

    def calls(self, name: str) -> bool:
        return any(symbol.name == name and not symbol.defined for symbol in self.symbols)


def read_object(file: Path) -> Object:
    """Raises TooLarge, and Unreadable for other files than 64-bit ELF objects, and for damaged ones."""
    if file.stat().st_size > LARGEST:
        raise TooLarge(f"more than {LARGEST >> 20} MiB")
    content = file.read_bytes()
    try:
        return _parse(content)
    except (struct.error, IndexError, ValueError) as error:
        raise Unreadable(str(error)) from None


def _parse(content: bytes) -> Object:
    header = _HEADER.unpack_from(content)
    if header[0][:6] != b"\x7fELF\2\1":
        raise ValueError("not a 64-bit ELF file")
    at, size, count, names_at = header[6], header[11], header[12], header[13]
    first = _SECTION.unpack_from(content, at)
    count, names_at = count or first[5], first[6] if names_at == 0xFFFF else names_at  # in files with many sections
    if count > MOST_SYMBOLS:
        raise TooLarge(f"{count} sections")
    headers = [_SECTION.unpack_from(content, at + k * size) for k in range(count)]
    names = _content(content, headers[names_at])
    symbols: list[Symbol] = []
    for section in headers:
        if section[1] == _SYMBOL_TABLE:
            symbols += _symbols(_content(content, section), _content(content, headers[section[6]]))
    return Object(tuple(_name(names, section[0]) for section in headers[1:]), tuple(symbols),
                  sum(section[5] for section in headers[1:] if section[2] & _IN_MEMORY))


def _content(content: bytes, section: tuple) -> bytes:
    at, size = section[4], section[5]
    if at + size > len(content):
        raise ValueError("a section ends after the file")
    return content[at: at + size]


def _symbols(table: bytes, names: bytes) -> list[Symbol]:
    if len(table) > MOST_SYMBOLS * _SYMBOL.size:
        raise TooLarge(f"{len(table) // _SYMBOL.size} symbols")
    found, left = [], MOST_OF_NAMES
    for name, info, _, section, _, _ in list(_SYMBOL.iter_unpack(table))[1:]:
        left -= names.index(b"\0", name) - name
        if left < 0:
            raise TooLarge(f"names of more than {MOST_OF_NAMES >> 20} MiB")
        found.append(Symbol(_name(names, name), section != 0, _BINDINGS.get(info >> 4, str(info >> 4)),
                            _KINDS.get(info & 15, str(info & 15)), _PLACES.get(section, str(section))))
    return found


def _name(names: bytes, at: int) -> str:
    return names[at: names.index(b"\0", at)].decode("utf-8", errors="surrogateescape")
