"""A hook of mkdocs: in running text options are not broken at their hyphens, long names between their words."""

import re

CODE = re.compile(r"(<pre>.*?</pre>)|<code>(.*?)</code>", re.S)
HEADING = re.compile(r"(<h[1-6][^>]*>)([^<]*)(?=</h)")
OPTION = re.compile(r"(?<!\S)'?-[\w-]+")
NAME = re.compile(r"[\w./:]{16,}")
BETWEEN = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[./_:])(?=\w)")
LONGEST = 24  # no narrow column holds more
SHORT = 14  # a column of a table is so wide


def parted(text):
    return NAME.sub(lambda n: BETWEEN.sub("<wbr>", n[0]), text)


def whole(found):
    if found[1]:
        return found[0]
    text = parted(found[2])
    text = OPTION.sub(lambda o: f"<span>{o[0]}</span>" if len(o[0]) <= LONGEST else o[0], text)
    if len(text) <= (LONGEST if "-" in text else SHORT) and not re.search(r"\s", text):
        text = f"<span>{text}</span>"
    return f"<code>{text}</code>"


def on_page_content(html, **_):
    return HEADING.sub(lambda h: h[1] + parted(h[2]), CODE.sub(whole, html))
