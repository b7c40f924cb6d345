"""links.py PAGE...: prints "PAGE: LINK" for each link of a page that leads to no file, or to no heading of one."""
import functools
import pathlib
import re
import sys

LINK = re.compile(r'(?:\]\(|src="|href=")([^")# \n]*(?:#[^") \n]*)?)[")]')


@functools.lru_cache(None)
def headings(path):
    """The names that browsers give to headings: lower case, no punctuation, - for spaces."""
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    lines = re.findall(r"^#+ (.*)$", text, re.M)
    return {re.sub(r"[^\w-]", "", line.lower().replace(" ", "-")) for line in lines} | set(re.findall('<a id="([^"]*)"', text))


for page in sys.argv[1:]:
    links = set(LINK.findall(pathlib.Path(page).read_text(encoding="utf-8")))
    for link in sorted(link for link in links if not re.match("[a-z]*:", link)):
        file, _, heading = link.partition("#")
        target = pathlib.Path(page).parent / file if file else pathlib.Path(page)
        if not target.exists() or ("#" in link and heading not in headings(target)):
            print(f"{page}: {link}")
