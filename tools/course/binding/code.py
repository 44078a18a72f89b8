"""Marks keywords, comments and strings in code, by Pygments."""

import functools
import html
import re
from pathlib import Path

# What is not said to be in a language is a shell's if a line begins with one of these.
_COMMAND = re.compile(r"^(?:sudo |for )?(?:\./|(?:cmake|ninja|ctest|python3|git|gdb|sbatch|docker)\b)", re.MULTILINE)

# In what Pygments has marked, a blank may be in a span of its own.
_OPTION = re.compile(r"(?<=[\s>])--[a-z][a-z-]*")
_WHOLE = r'<span class="whole">\g<0></span>'


def highlighted(code: str, language: str) -> str:
    from pygments import highlight
    from pygments.formatters import HtmlFormatter
    from pygments.lexers import get_lexer_by_name
    from pygments.util import ClassNotFound

    language = language or ("bash" if _COMMAND.search(code) else "text")
    try:
        lexer = get_lexer_by_name(language, stripnl=False)
    except ClassNotFound:
        return f'<div class="code"><pre><code>{html.escape(code)}</code></pre></div>'
    inner = highlight(code, lexer, HtmlFormatter(nowrap=True))
    if language == "bash":
        lines = "".join(f'<span class="line">{_OPTION.sub(_WHOLE, line)}</span>'
                        for line in inner.splitlines(keepends=True))
        return f'<div class="code shell"><pre><code>{lines}</code></pre></div>'
    return f'<div class="code"><pre tabindex="0"><code>{inner}</code></pre></div>'


def code_in_text(code: str) -> str:
    """Sets code within text. A line breaks between words only, and never within an option such as --out."""
    if len(code) <= 20:
        whole = ' class="whole"' if " " in code or "-" in code else ""
        return f"<code{whole}>{html.escape(code)}</code>"
    words = (html.escape(word) if "-" not in word else f'<span class="whole">{html.escape(word)}</span>'
             for word in code.split(" "))
    return f"<code>{' '.join(words)}</code>"


def language_of(name: Path) -> str:
    """Returns Pygments' name of the language; text, if the file's name does not tell."""
    ending = name.suffix not in ("", ".txt")  # CMakeLists.txt is no text
    return _language_of(f"file{name.suffix}" if ending else name.name)


@functools.cache
def _language_of(name: str) -> str:
    from pygments.lexers import get_lexer_for_filename
    from pygments.util import ClassNotFound

    try:
        return get_lexer_for_filename(name).aliases[0]
    except ClassNotFound:
        return "text"
