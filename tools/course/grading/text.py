"""Text from a submission, made safe to show on a terminal and in Markdown."""

import re

_CONTROL = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]"
                      r"|[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028\u2029\u202a-\u202e\u2066-\u2069\ufff9-\ufffb"
                      r"\ufffe\uffff\U000e0000-\U000e0fff]")
_MARKUP = re.compile(r"([\\`*_{}\[\]<>#|])")


def clean(text: str) -> str:
    """Removes characters that move a cursor, set colours, or reverse the direction of writing, and tags nobody sees."""
    return _CONTROL.sub("", text.encode("utf-8", errors="replace").decode("utf-8"))


def one_line(text: str) -> str:
    return " ".join(clean(text).split())


def markdown(text: str) -> str:
    """Escapes text so that Markdown shows it unchanged, on one line."""
    return _MARKUP.sub(r"\\\1", one_line(text))


def fenced(text: str) -> str:
    """Returns a block of code, with a fence longer than those in the text."""
    text = clean(text)
    longest = max((len(run) for run in re.findall(r"`+", text)), default=0)
    fence = "`" * max(3, longest + 1)
    return f"{fence}text\n{text}\n{fence}\n"
